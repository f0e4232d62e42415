#include "core/solver/jumps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/rounding.hpp"
#include "core/sdk/block.hpp"

namespace signorini {
namespace {

/// sum_q w_pq x_q of the slave vector with number s.
template <int B>
std::array<double, B> projected(const Jumps<B>& jumps, Index s, const std::vector<double>& x) {
  double sum[B] = {};
  for (Offset k = jumps.row[s]; k < jumps.row[s + 1]; ++k)
    for (int i = 0; i < B; ++i) sum[i] += jumps.weight[k] * x[Offset{jumps.column[k]} * B + i];
  std::array<double, B> out;
  block::product<B>(jumps.project.data() + Offset{s} * B * B, sum, out.data());
  return out;
}

template <int B>
std::vector<Index> number_of_slaves(const Jumps<B>& jumps, Index vectors) {
  std::vector<Index> out(static_cast<std::size_t>(vectors), -1);
  for (Index s = 0; s < jumps.size(); ++s) out[jumps.vector[s]] = s;
  return out;
}

/// A <- Z'A Z in place. Rows that change get longer: they are computed on their own first, then all rows move to where
/// they end, the last one first.
template <int B>
class Transformation {
 public:
  Transformation(const Jumps<B>& jumps, BlockMatrix<B>& A)
      : jumps_(jumps), A_(A), slave_(number_of_slaves(jumps, A.size())), place_(slave_.size(), -1) {
    find_slaves_of_masters();
  }

  void apply() {
    std::vector<Index> changing;
    BlockMatrix<B> changed;
    Offset shift = 0;
    for (Index p = 0; p < A_.size(); ++p) {
      if (stays(p)) continue;
      changing.push_back(p);
      append(p, changed);
      shift += changed.row.back() - changed.row.end()[-2] - length(p);
    }
    resize(A_.row.back() + shift);
    Index after = A_.size();
    for (auto i = static_cast<Index>(changing.size()); i-- > 0; after = changing[i]) {
      const Index p = changing[i];
      const Offset end = A_.row[p + 1], old_length = length(p);
      move_rows(p + 1, after, shift);
      A_.row[p + 1] = end + shift;
      const Offset begin = end + shift - (changed.row[i + 1] - changed.row[i]);
      std::copy(changed.column.begin() + changed.row[i], changed.column.begin() + changed.row[i + 1],
                A_.column.begin() + begin);
      std::copy(changed.at(changed.row[i]), changed.at(changed.row[i + 1]), A_.at(begin));
      shift = begin - (end - old_length);
    }
  }

  /// At most so many blocks more has A then.
  Offset most_added() const {
    Offset out = 0;
    for (Index p = 0; p < A_.size(); ++p) {
      out += masters_in(p);
      for (Offset j = first_[p]; j < first_[p + 1]; ++j) {
        const Index slave = jumps_.vector[pairs_[j].slave];
        out += length(slave) + masters_in(slave);
      }
    }
    return out;
  }

 private:
  struct Pair {
    Index slave;  // its number
    double weight;
  };

  void find_slaves_of_masters() {
    first_.assign(slave_.size() + 1, 0);
    for (const Index q : jumps_.column) ++first_[q + 1];
    for (std::size_t q = 0; q + 1 < first_.size(); ++q) first_[q + 1] += first_[q];
    pairs_.resize(jumps_.column.size());
    std::vector<Offset> next(first_.begin(), first_.end() - 1);
    for (Index s = 0; s < jumps_.size(); ++s)
      for (Offset k = jumps_.row[s]; k < jumps_.row[s + 1]; ++k)
        pairs_[next[jumps_.column[k]]++] = {s, jumps_.weight[k]};
  }

  bool stays(Index p) const {
    if (first_[p] < first_[p + 1]) return false;
    return std::none_of(A_.column.begin() + A_.row[p], A_.column.begin() + A_.row[p + 1],
                        [&](Index q) { return slave_[q] >= 0; });
  }

  Offset length(Index p) const { return A_.row[p + 1] - A_.row[p]; }

  /// All masters of the slaves in a row.
  Offset masters_in(Index p) const {
    Offset out = 0;
    for (Offset k = A_.row[p]; k < A_.row[p + 1]; ++k)
      if (const Index s = slave_[A_.column[k]]; s >= 0) out += jumps_.row[s + 1] - jumps_.row[s];
    return out;
  }

  void resize(Offset blocks) {
    A_.column.resize(static_cast<std::size_t>(blocks));
    A_.value.resize(static_cast<std::size_t>(blocks) * B * B);
  }

  /// To places further on, and notes where they end.
  void move_rows(Index begin, Index end, Offset shift) {
    const Offset first = A_.row[begin], last = A_.row[end];
    std::copy_backward(A_.column.begin() + first, A_.column.begin() + last, A_.column.begin() + last + shift);
    std::copy_backward(A_.at(first), A_.at(last), A_.at(last + shift));
    for (Index p = begin; p < end; ++p) A_.row[p + 1] += shift;
  }

  void append(Index p, BlockMatrix<B>& out) {
    columns_.clear();
    values_.clear();
    place(p);  // the diagonal comes first
    for (Offset k = A_.row[p]; k < A_.row[p + 1]; ++k) add_through(A_.column[k], A_.at(k));
    for (Offset j = first_[p]; j < first_[p + 1]; ++j) {
      const auto [s, weight] = pairs_[j];
      const Index of = jumps_.vector[s];
      for (Offset k = A_.row[of]; k < A_.row[of + 1]; ++k) {
        double M[B * B];
        block::transposed_multiply<B>(projector(s), A_.at(k), M);
        for (double& m : M) m *= weight;
        add_through(A_.column[k], M);
      }
    }
    std::sort(columns_.begin() + 1, columns_.end());
    for (const Index q : columns_) {
      out.column.push_back(q);
      const double* value = values_.data() + Offset{place_[q]} * B * B;
      out.value.insert(out.value.end(), value, value + B * B);
    }
    for (const Index q : columns_) place_[q] = -1;
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }

  /// Adds M Z_q. to the row.
  void add_through(Index q, const double* M) {
    add(q, M, 1);
    const Index s = slave_[q];
    if (s < 0) return;
    double MP[B * B];
    block::multiply<B>(M, projector(s), MP);
    for (Offset k = jumps_.row[s]; k < jumps_.row[s + 1]; ++k) add(jumps_.column[k], MP, jumps_.weight[k]);
  }

  void add(Index q, const double* M, double factor) {
    const Offset at = place(q) * B * B;
    double* value = values_.data() + at;
    for (int i = 0; i < B * B; ++i) value[i] += factor * M[i];
  }

  Offset place(Index q) {
    if (place_[q] < 0) {
      place_[q] = static_cast<Index>(columns_.size());
      columns_.push_back(q);
      values_.resize(values_.size() + B * B);
    }
    return place_[q];
  }

  const double* projector(Index s) const { return jumps_.project.data() + Offset{s} * B * B; }

  const Jumps<B>& jumps_;
  BlockMatrix<B>& A_;
  const std::vector<Index> slave_;  // per vector its number among the slaves, -1: none
  std::vector<Offset> first_;       // per vector: where the slaves that it is a master of begin
  std::vector<Pair> pairs_;
  std::vector<Index> place_;  // per vector: its block in the row at work, -1: none
  std::vector<Index> columns_;
  std::vector<double> values_;
};

/// A row of weights, each column once.
template <int B>
class WeightRow {
 public:
  using Block = std::array<double, B * B>;

  explicit WeightRow(Index columns) : place_(static_cast<std::size_t>(columns), -1) {}

  /// Adds factor * M.
  void add(Index column, double factor, const Block& M) {
    if (place_[column] < 0) {
      place_[column] = static_cast<Index>(entries_.size());
      entries_.emplace_back(column, Block{});
    }
    Block& sum = entries_[place_[column]].second;
    for (int i = 0; i < B * B; ++i) sum[i] += factor * M[i];
  }

  /// Appends it without what is zero but for rounding, and is empty again.
  void take(Prolongation& out) {
    constexpr double rounding = rounding_of_differences;
    std::ranges::sort(entries_, {}, &Entry::first);
    for (const auto& [column, weight] : entries_) {
      place_[column] = -1;
      if (std::ranges::all_of(weight, [](double w) { return std::abs(w) <= rounding; })) continue;
      out.column.push_back(column);
      out.block.insert(out.block.end(), weight.begin(), weight.end());
    }
    entries_.clear();
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }

 private:
  using Entry = std::pair<Index, Block>;
  std::vector<Index> place_;
  std::vector<Entry> entries_;
};

/// One row of Z_fine^-1 P Z_coarse after the other.
template <int B>
class JumpInterpolation {
 public:
  using Block = typename WeightRow<B>::Block;

  JumpInterpolation(const Prolongation& P, const Jumps<B>& fine, const Jumps<B>& coarse)
      : P_(P),
        fine_(fine),
        coarse_(coarse),
        fine_slave_(number_of_slaves(fine, P.fine())),
        coarse_slave_(number_of_slaves(coarse, P.coarse)),
        row_(P.coarse) {}

  Prolongation product() {
    Prolongation out;
    out.coarse = P_.coarse;
    out.twin = P_.twins();
    out.row.reserve(P_.row.size());
    out.column.reserve(P_.column.size());
    out.block.reserve(P_.column.size() * B * B);
    for (Index p = 0; p < P_.fine(); ++p) {
      add_displacement(p, 1, identity());
      if (const Index s = fine_slave_[p]; s >= 0)
        for (Offset j = fine_.row[s]; j < fine_.row[s + 1]; ++j)
          add_displacement(fine_.column[j], -fine_.weight[j], projector(fine_, s));
      row_.take(out);
    }
    return out;
  }

 private:
  static Block identity() {
    Block out{};
    for (int i = 0; i < B; ++i) out[i * (B + 1)] = 1;
    return out;
  }

  static Block projector(const Jumps<B>& jumps, Index s) {
    Block out;
    std::copy_n(jumps.project.data() + Offset{s} * B * B, B * B, out.begin());
    return out;
  }

  /// Adds factor * M times the displacement of the fine vector p.
  void add_displacement(Index p, double factor, const Block& M) {
    for (Offset k = P_.row[p]; k < P_.row[p + 1]; ++k) {
      const double weight = factor * P_.weight[k];
      row_.add(P_.column[k], weight, M);
      const Index s = coarse_slave_[P_.column[k]];
      if (s < 0) continue;
      Block MP;
      block::multiply<B>(M.data(), coarse_.project.data() + Offset{s} * B * B, MP.data());
      for (Offset j = coarse_.row[s]; j < coarse_.row[s + 1]; ++j)
        row_.add(coarse_.column[j], weight * coarse_.weight[j], MP);
    }
  }

  const Prolongation& P_;
  const Jumps<B>&fine_, &coarse_;
  const std::vector<Index> fine_slave_, coarse_slave_;
  WeightRow<B> row_;
};

}  // namespace

template <int B>
void to_displacements(const Jumps<B>& jumps, std::vector<double>& x) {
  for (Index s = 0; s < jumps.size(); ++s) {
    const std::array<double, B> sum = projected(jumps, s, x);
    for (int i = 0; i < B; ++i) x[Offset{jumps.vector[s]} * B + i] += sum[i];
  }
}

template <int B>
void to_jumps(const Jumps<B>& jumps, std::vector<double>& u) {
  for (Index s = 0; s < jumps.size(); ++s) {
    const std::array<double, B> sum = projected(jumps, s, u);
    for (int i = 0; i < B; ++i) u[Offset{jumps.vector[s]} * B + i] -= sum[i];
  }
}

template <int B>
void transform_forces(const Jumps<B>& jumps, std::vector<double>& b) {
  for (Index s = 0; s < jumps.size(); ++s) {
    double force[B];
    block::transposed_product<B>(jumps.project.data() + Offset{s} * B * B, b.data() + Offset{jumps.vector[s]} * B,
                                 force);
    for (Offset k = jumps.row[s]; k < jumps.row[s + 1]; ++k)
      for (int i = 0; i < B; ++i) b[Offset{jumps.column[k]} * B + i] += jumps.weight[k] * force[i];
  }
}

// No master's vector is a slave's one: what is added needs no transformation of its own.
template <int B>
void transform_row(const Jumps<B>& jumps, VectorRow<B>& c) {
  const VectorRow<B> of_displacements = c;
  for (const auto& [p, value] : of_displacements) {
    const auto at = std::lower_bound(jumps.vector.begin(), jumps.vector.end(), p);
    if (at == jumps.vector.end() || *at != p) continue;
    const auto s = at - jumps.vector.begin();
    double through[B];
    block::transposed_product<B>(jumps.project.data() + s * B * B, value.data(), through);
    for (Offset k = jumps.row[s]; k < jumps.row[s + 1]; ++k)
      for (int i = 0; i < B; ++i) c[jumps.column[k]][i] += jumps.weight[k] * through[i];
  }
}

template <int B>
void transform(const Jumps<B>& jumps, BlockMatrix<B>& A) {
  Transformation<B>(jumps, A).apply();
}

template <int B>
void reserve_couplings(const Jumps<B>& jumps, BlockMatrix<B>& A) {
  A.value.reserve((A.column.size() + static_cast<std::size_t>(Transformation<B>(jumps, A).most_added())) * B * B);
}

template <int B>
Prolongation between_jumps(const Prolongation& prolongation, const Jumps<B>& fine, const Jumps<B>& coarse) {
  return JumpInterpolation<B>(prolongation, fine, coarse).product();
}

#define SIGNORINI_INSTANTIATE(B)                                         \
  template void to_displacements(const Jumps<B>&, std::vector<double>&); \
  template void to_jumps(const Jumps<B>&, std::vector<double>&);         \
  template void transform_forces(const Jumps<B>&, std::vector<double>&); \
  template void transform_row<B>(const Jumps<B>&, VectorRow<B>&);        \
  template void transform(const Jumps<B>&, BlockMatrix<B>&);             \
  template void reserve_couplings(const Jumps<B>&, BlockMatrix<B>&);     \
  template Prolongation between_jumps(const Prolongation&, const Jumps<B>&, const Jumps<B>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
