#include "core/solver/jumps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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

/// The rows of Z' A Z, one after the other.
template <int B>
class Transformation {
 public:
  Transformation(const Jumps<B>& jumps, const BlockMatrix<B>& A)
      : jumps_(jumps), A_(A), slave_(number_of_slaves(jumps, A.size())), place_(slave_.size(), -1) {
    find_slaves_of_masters();
  }

  BlockMatrix<B> product() {
    BlockMatrix<B> out;
    out.row.reserve(A_.row.size());
    out.column.reserve(A_.column.size());
    out.value.reserve(A_.value.size());
    for (Index p = 0; p < A_.size(); ++p) {
      if (stays(p))
        copy(p, out);
      else
        append(p, out);
      out.row.push_back(static_cast<Offset>(out.column.size()));
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

  void copy(Index p, BlockMatrix<B>& out) const {
    out.column.insert(out.column.end(), A_.column.begin() + A_.row[p], A_.column.begin() + A_.row[p + 1]);
    out.value.insert(out.value.end(), A_.at(A_.row[p]), A_.at(A_.row[p + 1]));
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
  const BlockMatrix<B>& A_;
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
    constexpr double rounding = 1e-12;
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

template <int B>
void transform(const Jumps<B>& jumps, BlockMatrix<B>& A) {
  A = Transformation<B>(jumps, A).product();
}

template <int B>
Prolongation between_jumps(const Prolongation& prolongation, const Jumps<B>& fine, const Jumps<B>& coarse) {
  return JumpInterpolation<B>(prolongation, fine, coarse).product();
}

#define SIGNORINI_INSTANTIATE(B)                                         \
  template void to_displacements(const Jumps<B>&, std::vector<double>&); \
  template void to_jumps(const Jumps<B>&, std::vector<double>&);         \
  template void transform_forces(const Jumps<B>&, std::vector<double>&); \
  template void transform(const Jumps<B>&, BlockMatrix<B>&);             \
  template Prolongation between_jumps(const Prolongation&, const Jumps<B>&, const Jumps<B>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
