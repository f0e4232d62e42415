#include "core/mortar/jump_basis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"

namespace signorini {
namespace {

// An entry of an interpolation that is less than this part of what its row is the difference of is rounding.
constexpr double rounding = 1e-12;

/// Per vector the slave nodes whose rows name it.
struct Users {
  std::vector<Offset> row;
  std::vector<Index> slave;
  std::vector<double> weight;

  explicit Users(const JumpBasis& Z) : row(Z.row.size(), 0), slave(Z.column.size()), weight(Z.column.size()) {
    for (const Index q : Z.column) ++row[static_cast<std::size_t>(q) + 1];
    std::partial_sum(row.begin(), row.end(), row.begin());
    std::vector<Offset> next(row.begin(), row.end() - 1);
    for (Index p = 0; p < Z.vectors(); ++p)
      for (Offset k = Z.row[p]; k < Z.row[p + 1]; ++k) {
        const Offset at = next[Z.column[k]]++;
        slave[at] = p;
        weight[at] = Z.weight[k];
      }
  }
};

/// One row of a product after the other: columns with a value of `Size` numbers each.
template <int Size>
class RowSum {
 public:
  explicit RowSum(Index columns) : place_(static_cast<std::size_t>(columns), -1) {}

  void clear() {
    for (const Index q : column_) place_[q] = -1;
    column_.clear();
    value_.clear();
  }
  /// What is at column q, zero at first.
  double* at(Index q) {
    if (place_[q] < 0) {
      place_[q] = static_cast<Index>(column_.size());
      column_.push_back(q);
      value_.resize(value_.size() + Size, 0.0);
    }
    return value_.data() + std::size_t(place_[q]) * Size;
  }
  /// Orders the columns, the first `kept` staying in front; at() goes on.
  const std::vector<Index>& sort(std::size_t kept) {
    sorted_ = column_;
    std::sort(sorted_.begin() + static_cast<std::ptrdiff_t>(kept), sorted_.end());
    return sorted_;
  }

 private:
  std::vector<Index> place_, column_, sorted_;
  std::vector<double> value_;
};

/// Adds `factor` times row p of AZ.
template <int B>
void add_row(const BlockMatrix<B>& A, const JumpBasis& Z, Index p, double factor, RowSum<B * B>& sum) {
  const auto add = [&](Index q, double weight, const double* block) {
    double* to = sum.at(q);
    for (int i = 0; i < B * B; ++i) to[i] += weight * block[i];
  };
  for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) {
    const Index j = A.column[k];
    add(j, factor, A.at(k));
    for (Offset m = Z.row[j]; m < Z.row[j + 1]; ++m) add(Z.column[m], factor * Z.weight[m], A.at(k));
  }
}

template <int D>
void check_roles(std::span<const MortarCoupling<D>> couplings, Index vectors, std::string_view place) {
  enum Role : char { none, master, slave };
  std::vector<Role> role(static_cast<std::size_t>(vectors), none);
  for (const auto& c : couplings)
    for (const Index q : c.column) role[q] = master;
  for (const auto& c : couplings)
    for (const Index p : c.node) {
      if (role[p] == slave) input_error(place, fmt::format("node {} is on the slave side of two contacts", p));
      if (role[p] == master)
        input_error(place, fmt::format("node {} is on the slave side of one contact and on the master side of another; "
                                       "expected sides that share no node",
                                       p));
      role[p] = slave;
    }
}

}  // namespace

template <int D>
JumpBasis jump_basis(Index vectors, std::span<const MortarCoupling<D>> couplings, std::string_view place) {
  check_roles(couplings, vectors, place);
  JumpBasis out;
  out.row.assign(static_cast<std::size_t>(vectors) + 1, 0);
  for (const auto& c : couplings)
    for (Index i = 0; i < c.nodes(); ++i) out.row[static_cast<std::size_t>(c.node[i]) + 1] = c.row[i + 1] - c.row[i];
  std::partial_sum(out.row.begin(), out.row.end(), out.row.begin());
  out.column.resize(static_cast<std::size_t>(out.row.back()));
  out.weight.resize(out.column.size());
  for (const auto& c : couplings)
    for (Index i = 0; i < c.nodes(); ++i) {
      std::copy(c.column.begin() + c.row[i], c.column.begin() + c.row[i + 1], out.column.begin() + out.row[c.node[i]]);
      std::copy(c.value.begin() + c.row[i], c.value.begin() + c.row[i + 1], out.weight.begin() + out.row[c.node[i]]);
    }
  return out;
}

template <int B>
void from_jumps(const JumpBasis& Z, double* x) {
  for (Index p = 0; p < Z.vectors(); ++p)
    for (Offset k = Z.row[p]; k < Z.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i) x[Offset{p} * B + i] += Z.weight[k] * x[Offset{Z.column[k]} * B + i];
}

template <int B>
void to_jumps(const JumpBasis& Z, double* x) {
  for (Index p = 0; p < Z.vectors(); ++p)
    for (Offset k = Z.row[p]; k < Z.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i) x[Offset{p} * B + i] -= Z.weight[k] * x[Offset{Z.column[k]} * B + i];
}

template <int B>
void forces_to_jumps(const JumpBasis& Z, double* r) {
  for (Index p = 0; p < Z.vectors(); ++p)
    for (Offset k = Z.row[p]; k < Z.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i) r[Offset{Z.column[k]} * B + i] += Z.weight[k] * r[Offset{p} * B + i];
}

template <int B>
BlockMatrix<B> matrix_of_jumps(const BlockMatrix<B>& A, const JumpBasis& Z) {
  assert(A.size() == Z.vectors());
  const Users users(Z);
  RowSum<B * B> sum(A.size());
  BlockMatrix<B> out;
  out.row.reserve(A.row.size());
  out.column.reserve(A.column.size());
  out.value.reserve(A.value.size());
  for (Index p = 0; p < A.size(); ++p) {
    const Offset first = A.row[p], last = A.row[p + 1];
    const bool as_before =
        users.row[p] == users.row[p + 1] &&
        std::none_of(A.column.begin() + first, A.column.begin() + last, [&](Index q) { return Z.jumps(q); });
    if (as_before) {
      out.column.insert(out.column.end(), A.column.begin() + first, A.column.begin() + last);
      out.value.insert(out.value.end(), A.at(first), A.at(last));
    } else {
      sum.clear();
      sum.at(p);
      add_row(A, Z, p, 1, sum);
      for (Offset k = users.row[p]; k < users.row[p + 1]; ++k) add_row(A, Z, users.slave[k], users.weight[k], sum);
      for (const Index q : sum.sort(1)) {
        out.column.push_back(q);
        out.value.insert(out.value.end(), sum.at(q), sum.at(q) + B * B);
      }
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

Prolongation prolongation_of_jumps(const JumpBasis& Z, const Prolongation& P, const JumpBasis& coarse) {
  assert(P.block.empty() && P.fine() == Z.vectors() && P.coarse == coarse.vectors());
  RowSum<2> sum(P.coarse);  // the entry, and the sizes of what it is the sum of
  const auto add_row_of = [&](Index p, double factor) {
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
      const auto add = [&](Index q, double value) {
        double* to = sum.at(q);
        to[0] += value;
        to[1] += std::abs(value);
      };
      const Index j = P.column[k];
      const double weight = factor * P.weight[k];
      add(j, weight);
      for (Offset m = coarse.row[j]; m < coarse.row[j + 1]; ++m) add(coarse.column[m], weight * coarse.weight[m]);
    }
  };
  Prolongation out;
  out.coarse = P.coarse;
  out.algebraic = P.algebraic;
  out.local = P.local;
  out.twin = P.twins();
  for (Index p = 0; p < P.fine(); ++p) {
    sum.clear();
    add_row_of(p, 1);
    for (Offset k = Z.row[p]; k < Z.row[p + 1]; ++k) add_row_of(Z.column[k], -Z.weight[k]);
    const std::vector<Index>& columns = sum.sort(0);
    double largest = 0;
    for (const Index q : columns) largest = std::max(largest, sum.at(q)[1]);
    for (const Index q : columns) {
      const double value = *sum.at(q);
      if (!(std::abs(value) > rounding * largest)) continue;
      out.column.push_back(q);
      out.weight.push_back(value);
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

template JumpBasis jump_basis(Index, std::span<const MortarCoupling<2>>, std::string_view);
template JumpBasis jump_basis(Index, std::span<const MortarCoupling<3>>, std::string_view);

#define SIGNORINI_INSTANTIATE(B)                               \
  template void from_jumps<B>(const JumpBasis&, double*);      \
  template void to_jumps<B>(const JumpBasis&, double*);        \
  template void forces_to_jumps<B>(const JumpBasis&, double*); \
  template BlockMatrix<B> matrix_of_jumps(const BlockMatrix<B>&, const JumpBasis&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
