#include "core/solver/passes.hpp"

#include <algorithm>
#include <mutex>
#include <thread>

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

namespace {

// Passes in one direction, the chunks counted from where they begin. A pass is claimed for its next chunk and leaves it
// behind before it is claimed again.
class Train {
 public:
  Train(const Chunks& chunks, bool forward, std::size_t passes)
      : chunks_(chunks), forward_(forward), left_(passes, 0), busy_(passes, 0) {}

  bool arrived() const { return left_.back() == chunks_.count(); }

  // The last pass that may enter its next chunk, for its data are the longest in the cache; -1: none now.
  int claim() {
    for (int i = static_cast<int>(left_.size()) - 1; i >= 0; --i)
      if (!busy_[i] && may_go_on(i)) {
        busy_[i] = 1;
        return i;
      }
    return -1;
  }

  Index next_chunk(int i) const { return forward_ ? left_[i] : chunks_.count() - 1 - left_[i]; }

  void leave(int i) {
    ++left_[i];
    busy_[i] = 0;
  }

 private:
  bool may_go_on(int i) const {
    if (left_[i] == chunks_.count()) return false;
    if (i == 0) return true;
    const Index c = next_chunk(i);
    return (forward_ ? chunks_.highest[c] : chunks_.count() - 1 - chunks_.lowest[c]) < left_[i - 1];
  }

  const Chunks& chunks_;
  const bool forward_;
  std::vector<Index> left_;  // per pass: chunks behind it
  std::vector<char> busy_;
};

// Calls visit(pass, chunk) until the train has arrived, on every thread of the crew.
template <class Visit>
void drive(Train& train, Crew& crew, const Visit& visit) {
  std::mutex mutex;
  bool failed = false;
  crew.run([&] {
    std::unique_lock lock(mutex);
    while (!train.arrived() && !failed) {
      const int i = train.claim();
      const Index c = i < 0 ? 0 : train.next_chunk(i);
      lock.unlock();
      if (i < 0) {
        std::this_thread::yield();
        lock.lock();
        continue;
      }
      try {
        visit(i, c);
      } catch (...) {
        lock.lock();
        failed = true;
        throw;
      }
      lock.lock();
      train.leave(i);
    }
  });
}

template <class Visit>
void drive(Train& train, const Visit& visit) {
  while (!train.arrived()) {
    const int i = train.claim();
    visit(i, train.next_chunk(i));
    train.leave(i);
  }
}

}  // namespace

void Passes::run(const Chunks& chunks, Crew& crew) const {
  constexpr Index worth_threads = 8;  // chunks: some megabytes
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
    Train train(chunks, forward, end - begin);
    const auto visit = [&](int i, Index c) {
      passes_[begin + static_cast<std::size_t>(i)].run(c * chunks.size,
                                                       std::min(chunks.vectors, (c + 1) * chunks.size));
    };
    if (crew.size() > 1 && end - begin > 1 && chunks.count() >= worth_threads)
      drive(train, crew, visit);
    else
      drive(train, visit);
  }
}

}  // namespace signorini
