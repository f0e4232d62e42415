#include "amg/coarsening/fourth_order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/algebra/products.hpp"
#include "core/base/dot.hpp"
#include "core/solver/masked_cg.hpp"

namespace signorini {
namespace {

constexpr double outweighs = 1.05;  // negative couplings over the diagonal; of a beam 4/3, of a plate 8/5
constexpr double unlike = 0.3;      // norm of what the square of the root lacks, over that of positive couplings
constexpr double nearly_all = 0.7;  // of the rows
constexpr double one = 0.999;       // but for rounding: sums of weights
constexpr int sweeps = 4;           // on each level, after a start that is smooth already
constexpr double parts = 16;        // of one, which dampings are multiples of

/// Visits q and |a| for the couplings a < 0 between p and others that are free.
template <class Visit>
void each_negative(const BlockMatrix<1>& A, const std::vector<Flags>& off, Index p, const Visit& visit) {
  if (off[p]) return;
  for (Offset k = A.row[p] + 1; k < A.row[p + 1]; ++k)
    if (*A.at(k) < 0 && !off[A.column[k]]) visit(A.column[k], -*A.at(k));
}

/// Whether negative couplings outweigh the diagonal: then positive ones make up for it, as in no row of an M-matrix.
bool may_be_square(const BlockMatrix<1>& A, const std::vector<Flags>& off, Index p) {
  double sum = 0;
  each_negative(A, off, p, [&](Index, double a) { sum += a; });
  return sum > outweighs * *A.diagonal(p);
}

/// d with d^2 + sum of w_j^2 = a_ii and -a_ij = 2 d w_j, as if all neighbours had the same d.
double diagonal_of_root(const BlockMatrix<1>& A, const std::vector<Flags>& off, Index p) {
  if (off[p]) return 1;
  const double diagonal = *A.diagonal(p);
  double squares = 0;
  each_negative(A, off, p, [&](Index, double a) { squares += a * a; });
  return std::sqrt((diagonal + std::sqrt(std::max(diagonal * diagonal - squares, 0.0))) / 2);
}

BlockMatrix<1> root_of(const BlockMatrix<1>& A, const std::vector<Flags>& off) {
  std::vector<double> d;
  d.reserve(static_cast<std::size_t>(A.size()));
  for (Index p = 0; p < A.size(); ++p) d.push_back(diagonal_of_root(A, off, p));
  BlockMatrix<1> L;
  for (Index p = 0; p < A.size(); ++p) {
    const std::size_t diagonal = L.value.size();
    L.column.push_back(p);
    L.value.push_back(0);
    double sum = 0;
    each_negative(A, off, p, [&](Index q, double a) {
      L.column.push_back(q);
      L.value.push_back(-a / (d[p] + d[q]));
      sum += a / (d[p] + d[q]);
    });
    L.value[diagonal] = std::max(d[p], sum);
    L.row.push_back(static_cast<Offset>(L.column.size()));
  }
  return L;
}

/// Compares rows of A with those of the square of L.
class Comparison {
 public:
  Comparison(const BlockMatrix<1>& A, const BlockMatrix<1>& L)
      : A_(A), L_(L), difference_(static_cast<std::size_t>(A.size()), 0.0) {}

  bool alike(Index p) {
    double all = 0, left = 0;
    for (Offset k = A_.row[p]; k < A_.row[p + 1]; ++k) {
      add(A_.column[k], *A_.at(k));
      if (k > A_.row[p] && *A_.at(k) > 0) all += *A_.at(k) * *A_.at(k);
    }
    for (Offset k = L_.row[p]; k < L_.row[p + 1]; ++k) {
      const Index q = L_.column[k];
      for (Offset m = L_.row[q]; m < L_.row[q + 1]; ++m) add(L_.column[m], -L_.value[k] * L_.value[m]);
    }
    for (const Index q : touched_) {
      left += difference_[q] * difference_[q];
      difference_[q] = 0;
    }
    touched_.clear();
    return left <= unlike * unlike * all;
  }

 private:
  void add(Index q, double value) {
    difference_[q] += value;
    touched_.push_back(q);
  }

  const BlockMatrix<1>&A_, &L_;
  std::vector<double> difference_;  // zero between the rows
  std::vector<Index> touched_;      // some more than once: what is left of them is zero then
};

std::vector<double> interpolated(const Prolongation& P, const std::vector<double>& coarse) {
  std::vector<double> out(static_cast<std::size_t>(P.fine()), 0.0);
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) out[p] += P.weight[k] * coarse[P.column[k]];
  return out;
}

std::vector<double> restricted(const Prolongation& P, const std::vector<double>& forces) {
  std::vector<double> out(static_cast<std::size_t>(P.coarse), 0.0);
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) out[P.column[k]] += P.weight[k] * forces[p];
  return out;
}

/// On the coarsest level.
std::vector<double> solution(const BlockMatrix<1>& L, const std::vector<Flags>& off, std::vector<double> forces) {
  std::vector<double> v;
  apply_mask<1>(off, forces);
  masked_cg<1>(
      L, off,
      [&](const std::vector<double>& r, std::vector<double>& z) {
        z.assign(r.size(), 0.0);
        symmetric_gauss_seidel<1>(L, off, r, z);
      },
      {.reduction = 1e-3}, forces, v);
  return v;
}

}  // namespace

std::optional<BlockMatrix<1>> second_order_root(const BlockMatrix<1>& A, const std::vector<Flags>& off) {
  Index free = 0, count = 0;
  for (Index p = 0; p < A.size(); ++p) {
    free += !off[p];
    count += may_be_square(A, off, p);
  }
  if (count == 0 || count < nearly_all * free) return {};
  BlockMatrix<1> L = root_of(A, off);
  Comparison comparison(A, L);
  count = 0;
  for (Index p = 0; p < A.size(); ++p) count += !off[p] && comparison.alike(p);
  if (count < nearly_all * free) return {};
  return L;
}

std::vector<double> at_twins(const std::vector<double>& v, const Prolongation& P) {
  std::vector<double> out;
  for (const Index p : P.twin) out.push_back(v[p]);
  return out;
}

std::vector<double> under_even_load(const BlockMatrix<1>& L, const std::vector<Flags>& off,
                                    std::span<const Prolongation> prolongations,
                                    std::span<const GalerkinMatrix<1>> matrices) {
  const std::size_t finest = prolongations.size();
  std::vector<std::vector<double>> loads(finest + 1);
  loads[finest].assign(static_cast<std::size_t>(L.size()), 1.0);
  apply_mask<1>(off, loads[finest]);
  for (std::size_t k = finest; k-- > 0;) loads[k] = restricted(prolongations[k], loads[k + 1]);
  std::vector<double> v;
  for (std::size_t k = 0; k <= finest; ++k) {
    const BlockMatrix<1>& matrix = k < finest ? matrices[k].A : L;
    const std::vector<Flags>& mask = k < finest ? matrices[k].off : off;
    v = k == 0 ? solution(matrix, mask, loads[k]) : interpolated(prolongations[k - 1], v);
    for (int sweep = 0; k > 0 && sweep < sweeps; ++sweep) symmetric_gauss_seidel<1>(matrix, mask, loads[k], v);
  }
  return v;
}

void fit_near_edges(const std::vector<double>& v, Prolongation& P) {
  const std::vector<double> found = interpolated(P, at_twins(v, P));
  for (Index p = 0; p < P.fine(); ++p) {
    const auto first = P.weight.begin() + P.row[p], last = P.weight.begin() + P.row[p + 1];
    if (std::accumulate(first, last, 0.0) >= one || !(found[p] > 0 && v[p] > 0)) continue;
    std::for_each(first, last, [scale = v[p] / found[p]](double& weight) { weight *= scale; });
  }
}

double kink_damping(const BlockMatrix<1>& L, const std::vector<Flags>& off, const Prolongation& P,
                    const std::vector<double>& v) {
  const std::vector<double> u = interpolated(P, at_twins(v, P));
  std::vector<double> Lu(u.size()), LDLu(u.size());
  product<1>(L, u.data(), Lu.data());
  std::vector<double> DLu = Lu;
  for (Index p = 0; p < L.size(); ++p) DLu[p] /= *L.diagonal(p);
  apply_mask<1>(off, DLu);
  product<1>(L, DLu.data(), LDLu.data());
  const double along = dot(LDLu, LDLu), best = along > 0 ? dot(Lu, LDLu) / along : 1;
  return std::clamp(std::round(parts * best), 1.0, parts) / parts;
}

Prolongation rounded_off(const BlockMatrix<1>& L, const std::vector<Flags>& off, const Prolongation& P,
                         double damping) {
  Prolongation out;
  out.coarse = P.coarse;
  out.twin = P.twin;
  std::vector<double> sum(static_cast<std::size_t>(P.coarse), 0.0);  // zero between the rows
  std::vector<Index> found;
  for (Index p = 0; p < P.fine(); ++p) {
    const double of_others = damping / *L.diagonal(p);
    for (Offset k = L.row[p]; !off[p] && k < L.row[p + 1]; ++k) {
      const Index q = L.column[k];
      const double part = q == p ? 1 - damping : -of_others * L.value[k];
      for (Offset m = P.row[q]; part > 0 && m < P.row[q + 1]; ++m) {
        if (sum[P.column[m]] == 0) found.push_back(P.column[m]);
        sum[P.column[m]] += part * P.weight[m];
      }
    }
    std::ranges::sort(found);
    for (const Index q : found) {
      out.column.push_back(q);
      out.weight.push_back(sum[q]);
      sum[q] = 0;
    }
    found.clear();
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

}  // namespace signorini
