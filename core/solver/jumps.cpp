#include "core/solver/jumps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/rounding.hpp"
#include "core/sdk/block.hpp"

namespace signorini {
namespace {

/// What the rows make of x, B numbers each.
template <int B>
std::vector<double> products(const BlockRows<B>& rows, const std::vector<double>& x) {
  std::vector<double> out((rows.row.size() - 1) * B);
  for (std::size_t s = 0; s + 1 < rows.row.size(); ++s)
    for (Offset k = rows.row[s]; k < rows.row[s + 1]; ++k)
      block::add_product<B>(rows.at(k), x.data() + Offset{rows.column[k]} * B, out.data() + s * B);
  return out;
}

/// x <- Z x with these rows of Z.
template <int B>
void change(const std::vector<Index>& vector, const BlockRows<B>& rows, std::vector<double>& x) {
  const std::vector<double> out = products(rows, x);
  for (std::size_t s = 0; s < vector.size(); ++s) std::copy_n(out.data() + s * B, B, x.data() + Offset{vector[s]} * B);
}

/// b <- Z'b.
template <int B>
void change_forces(const std::vector<Index>& vector, const BlockRows<B>& rows, std::vector<double>& b) {
  std::vector<double> taken;
  for (const Index p : vector)
    for (int i = 0; i < B; ++i) taken.push_back(std::exchange(b[Offset{p} * B + i], 0));
  for (std::size_t s = 0; s < vector.size(); ++s)
    for (Offset k = rows.row[s]; k < rows.row[s + 1]; ++k) {
      double force[B];
      block::transposed_product<B>(rows.at(k), taken.data() + s * B, force);
      for (int i = 0; i < B; ++i) b[Offset{rows.column[k]} * B + i] += force[i];
    }
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
      : rows_(jumps.basis),
        vector_(jumps.vector),
        A_(A),
        slave_(number_of_slaves(jumps, A.size())),
        place_(slave_.size(), -1) {
    find_rows_with_columns();
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
        const Index slave = vector_[pairs_[j].row];
        out += length(slave) + masters_in(slave);
      }
    }
    return out;
  }

 private:
  struct Pair {
    Index row;
    Offset at;
  };

  void find_rows_with_columns() {
    first_.assign(slave_.size() + 1, 0);
    for (const Index q : rows_.column) ++first_[q + 1];
    for (std::size_t q = 0; q + 1 < first_.size(); ++q) first_[q + 1] += first_[q];
    pairs_.resize(rows_.column.size());
    std::vector<Offset> next(first_.begin(), first_.end() - 1);
    for (Index s = 0; s < static_cast<Index>(vector_.size()); ++s)
      for (Offset k = rows_.row[s]; k < rows_.row[s + 1]; ++k) pairs_[next[rows_.column[k]]++] = {s, k};
  }

  bool stays(Index p) const {
    if (slave_[p] >= 0 || first_[p] < first_[p + 1]) return false;
    return std::none_of(A_.column.begin() + A_.row[p], A_.column.begin() + A_.row[p + 1],
                        [&](Index q) { return slave_[q] >= 0; });
  }

  Offset length(Index p) const { return A_.row[p + 1] - A_.row[p]; }

  /// All masters of the slaves in a row.
  Offset masters_in(Index p) const {
    Offset out = 0;
    for (Offset k = A_.row[p]; k < A_.row[p + 1]; ++k)
      if (const Index s = slave_[A_.column[k]]; s >= 0) out += rows_.row[s + 1] - rows_.row[s];
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
    if (slave_[p] < 0)
      for (Offset k = A_.row[p]; k < A_.row[p + 1]; ++k) add_through(A_.column[k], A_.at(k));
    for (Offset j = first_[p]; j < first_[p + 1]; ++j) {
      const auto [s, at] = pairs_[j];
      const Index of = vector_[s];
      for (Offset k = A_.row[of]; k < A_.row[of + 1]; ++k) {
        double M[B * B];
        block::transposed_multiply<B>(rows_.at(at), A_.at(k), M);
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
    const Index s = slave_[q];
    if (s < 0) return add(q, M);
    for (Offset k = rows_.row[s]; k < rows_.row[s + 1]; ++k) {
      double MW[B * B];
      block::multiply<B>(M, rows_.at(k), MW);
      add(rows_.column[k], MW);
    }
  }

  void add(Index q, const double* M) {
    const Offset at = place(q) * B * B;
    double* value = values_.data() + at;
    for (int i = 0; i < B * B; ++i) value[i] += M[i];
  }

  Offset place(Index q) {
    if (place_[q] < 0) {
      place_[q] = static_cast<Index>(columns_.size());
      columns_.push_back(q);
      values_.resize(values_.size() + B * B);
    }
    return place_[q];
  }

  const BlockRows<B>& rows_;
  const std::vector<Index>& vector_;
  BlockMatrix<B>& A_;
  const std::vector<Index> slave_;  // per vector the number of its row, -1: that of the identity
  std::vector<Offset> first_;       // per vector: where the rows that it is a column of begin
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
  void add(Index column, double factor, const double* M) {
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
    for (std::size_t k = 0; k < fine_.common.size(); ++k) pair_up(k, out.twin);
    out.row.reserve(P_.row.size());
    out.column.reserve(P_.column.size());
    out.block.reserve(P_.column.size() * B * B);
    for (Index p = 0; p < P_.fine(); ++p) {
      if (const auto common = std::ranges::find(fine_.common, p); common != fine_.common.end())
        row_.add(coarse_.common[common - fine_.common.begin()], 1, identity().data());
      else if (const Index s = fine_slave_[p]; s >= 0)
        for (Offset j = fine_.inverse.row[s]; j < fine_.inverse.row[s + 1]; ++j)
          add_displacement(fine_.inverse.column[j], fine_.inverse.at(j));
      else
        add_displacement(p, identity().data());
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

  /// The k-th common unknown is the same one on both levels, though it may be at another node.
  void pair_up(std::size_t k, std::vector<Index>& twin) const {
    std::ranges::replace(twin, fine_.common[k], Index{-1});
    twin[coarse_.common[k]] = fine_.common[k];
  }

  /// Adds M times the displacement of the fine vector p.
  void add_displacement(Index p, const double* M) {
    for (Offset k = P_.row[p]; k < P_.row[p + 1]; ++k) {
      const Index s = coarse_slave_[P_.column[k]];
      if (s < 0) {
        row_.add(P_.column[k], P_.weight[k], M);
        continue;
      }
      for (Offset j = coarse_.basis.row[s]; j < coarse_.basis.row[s + 1]; ++j) {
        Block MW;
        block::multiply<B>(M, coarse_.basis.at(j), MW.data());
        row_.add(coarse_.basis.column[j], P_.weight[k], MW.data());
      }
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
  change(jumps.vector, jumps.basis, x);
}

template <int B>
void to_jumps(const Jumps<B>& jumps, std::vector<double>& u) {
  change(jumps.vector, jumps.inverse, u);
}

template <int B>
void transform_forces(const Jumps<B>& jumps, std::vector<double>& b) {
  change_forces(jumps.vector, jumps.basis, b);
}

template <int B>
void transform_forces_back(const Jumps<B>& jumps, std::vector<double>& b) {
  change_forces(jumps.vector, jumps.inverse, b);
}

template <int B>
void transform_row(const Jumps<B>& jumps, VectorRow<B>& c) {
  const VectorRow<B> of_displacements = c;
  for (const auto& [p, value] : of_displacements)
    if (std::ranges::binary_search(jumps.vector, p)) c.erase(p);
  for (const auto& [p, value] : of_displacements) {
    const auto at = std::ranges::lower_bound(jumps.vector, p);
    if (at == jumps.vector.end() || *at != p) continue;
    const auto s = at - jumps.vector.begin();
    for (Offset k = jumps.basis.row[s]; k < jumps.basis.row[s + 1]; ++k) {
      double through[B];
      block::transposed_product<B>(jumps.basis.at(k), value.data(), through);
      for (int i = 0; i < B; ++i) c[jumps.basis.column[k]][i] += through[i];
    }
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

#define SIGNORINI_INSTANTIATE(B)                                              \
  template void to_displacements(const Jumps<B>&, std::vector<double>&);      \
  template void to_jumps(const Jumps<B>&, std::vector<double>&);              \
  template void transform_forces(const Jumps<B>&, std::vector<double>&);      \
  template void transform_forces_back(const Jumps<B>&, std::vector<double>&); \
  template void transform_row<B>(const Jumps<B>&, VectorRow<B>&);             \
  template void transform(const Jumps<B>&, BlockMatrix<B>&);                  \
  template void reserve_couplings(const Jumps<B>&, BlockMatrix<B>&);          \
  template Prolongation between_jumps(const Prolongation&, const Jumps<B>&, const Jumps<B>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
