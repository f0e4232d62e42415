#include "core/solver/passes.hpp"

#include <algorithm>
#include <span>

namespace signorini {

template <int B>
Chunks divide(const BlockMatrix<B>& A, Offset bytes) {
  Chunks out;
  out.vectors = A.size();
  const double all_bytes = static_cast<double>(A.column.size()) * (B * B * sizeof(double) + sizeof(Index));
  const double share = std::min(1.0, static_cast<double>(bytes) / std::max(all_bytes, 1.0));
  out.size = std::max<Index>(1, static_cast<Index>(A.size() * share));
  const Index count = (A.size() + out.size - 1) / out.size;
  out.highest.resize(static_cast<std::size_t>(count));
  out.lowest.resize(static_cast<std::size_t>(count));
  for (Index c = 0; c < count; ++c) {
    const Index last = std::min(A.size(), (c + 1) * out.size);
    Index lowest = c * out.size, highest = last - 1;
    for (Offset k = A.row[c * out.size]; k < A.row[last]; ++k) {
      lowest = std::min(lowest, A.column[k]);
      highest = std::max(highest, A.column[k]);
    }
    out.lowest[c] = lowest / out.size;
    out.highest[c] = highest / out.size;
  }
  for (Index c = 1; c < count; ++c) out.highest[c] = std::max(out.highest[c], out.highest[c - 1]);
  for (Index c = count - 1; c > 0; --c) out.lowest[c - 1] = std::min(out.lowest[c], out.lowest[c - 1]);
  return out;
}

template Chunks divide(const BlockMatrix<1>&, Offset);
template Chunks divide(const BlockMatrix<2>&, Offset);
template Chunks divide(const BlockMatrix<3>&, Offset);

void Passes::run(const Chunks& chunks) const {
  const Index count = chunks.count();
  for (std::size_t begin = 0, end; begin < passes_.size(); begin = end) {
    // One train of passes that agree in their direction.
    bool forward = true, decided = false;
    if (passes_[begin].whole) {
      passes_[begin].run(0, chunks.vectors);
      end = begin + 1;
      continue;
    }
    for (end = begin; end < passes_.size() && !passes_[end].whole; ++end) {
      if (!passes_[end].ordered) continue;
      const bool wanted = passes_[end].order == Order::forward;
      if (decided && wanted != forward) break;
      forward = wanted;
      decided = true;
    }
    const std::span<const Pass> train(passes_.data() + begin, end - begin);
    std::vector<Index> left(train.size(), 0);  // chunks that each pass has left behind it
    const auto may_enter = [&](std::size_t i, Index c) {
      return (forward ? chunks.highest[c] : count - 1 - chunks.lowest[c]) < left[i - 1];
    };
    while (left.back() < count)
      for (std::size_t i = 0; i < train.size(); ++i)
        while (left[i] < count) {
          const Index c = forward ? left[i] : count - 1 - left[i];
          if (i > 0 && !may_enter(i, c)) break;
          train[i].run(c * chunks.size, std::min(chunks.vectors, (c + 1) * chunks.size));
          ++left[i];
          if (i == 0) break;
        }
  }
}

}  // namespace signorini
