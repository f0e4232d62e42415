#include "amg/black_box/refuse_indefinite.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "amg/linear/held_cholesky.hpp"
#include "amg/linear/unit_diagonal.hpp"
#include "core/algebra/random_vector.hpp"
#include "core/solver/masked_cg.hpp"
#include "core/solver/weights.hpp"

namespace signorini {
namespace {

using Values = std::vector<double>;  // B per vector of a level

constexpr int steps_on_coarsest = 40, steps_on_finest = 8;  // of conjugate gradients
constexpr int inverse_iterations = 4;
constexpr int steps_of_long_search = 2000;  // about what sixty cycles take

template <int B>
Values interpolated(const Prolongation& P, const Values& coarse) {
  Values fine(static_cast<std::size_t>(P.fine()) * B, 0.0);
  weights::with<B>(P, [&](const auto& weight) {
    for (Index p = 0; p < P.fine(); ++p)
      weights::interpolate<B>(P, weight, p, coarse.data(), fine.data() + Offset{p} * B);
  });
  return fine;
}

template <int B, class Visit>
void for_each_diagonal(const BlockMatrix<B>& A, const Visit& visit) {
  for (Index p = 0; p < A.size(); ++p)
    for (int i = 0; i < B; ++i) visit(Offset{p} * B + i, A.diagonal(p)[i * B + i]);
}

template <int B>
Precondition by_diagonal(const BlockMatrix<B>& A) {
  return [&](const Values& r, Values& z) {
    for_each_diagonal(A, [&](Offset i, double diagonal) { z[i] = r[i] / diagonal; });
  };
}

/// The levels of a matrix, the finest last.
template <int B>
class Search {
 public:
  Search(const BlockMatrix<B>& A, const AlgebraicLevels<B>& levels)
      : A_(A), levels_(levels), nothing_off_(static_cast<std::size_t>(A.size()), 0) {}

  void run() const {
    Values smooth = smoothest_on_coarsest();
    for (std::size_t k = 0; k <= levels_.matrices.size(); ++k) {
      if (k < levels_.matrices.size()) check_lost(k);
      if (k > 0) smooth = interpolated<B>(levels_.prolongations[k - 1], smooth);
      check(k, solution(k, random_vector(smooth.size()), steps(k)));
      if (k > 0) check(k, smooth = solution(k, times_diagonal(k, smooth), steps(k)));
    }
  }

 private:
  const BlockMatrix<B>& matrix(std::size_t k) const { return k < levels_.matrices.size() ? levels_.matrices[k].A : A_; }
  const std::vector<Flags>& off(std::size_t k) const {
    return k < levels_.matrices.size() ? levels_.matrices[k].off : nothing_off_;
  }

  // Up to rounding, Galerkin's matrices tell what the finest one will.
  void check(std::size_t level, Values d) const {
    if (energy_along(matrix(level), d).of_matrix < 0) check_on_finest(level, std::move(d));
  }

  void check_on_finest(std::size_t level, Values d) const {
    for (std::size_t k = level; k < levels_.prolongations.size(); ++k) d = interpolated<B>(levels_.prolongations[k], d);
    refuse_if_negative_along(A_, d);
  }

  /// More on coarser levels, where they cost less.
  int steps(std::size_t k) const {
    return k == 0 ? steps_on_coarsest : std::min(steps_on_finest << (levels_.matrices.size() - k), steps_on_coarsest);
  }

  /// By conjugate gradients; where they meet a direction without energy, or with less, that one. For the diagonal
  /// times a smooth direction this is a step of inverse iteration, and whatever falls in the space it searches is met.
  Values solution(std::size_t k, Values r, int steps) const {
    const BlockMatrix<B>& A = matrix(k);
    Values d;
    apply_mask<B>(off(k), r);
    masked_cg<B>(A, off(k), by_diagonal(A), {.iterations = steps}, r, d);
    scale_to_one(d);
    return d;
  }

  Values times_diagonal(std::size_t k, Values d) const {
    for_each_diagonal(matrix(k), [&](Offset i, double diagonal) { d[i] *= diagonal; });
    return d;
  }

  static void scale_to_one(Values& d) {
    double largest = 0;
    for (const double value : d) largest = std::max(largest, std::abs(value));
    if (largest > 0)
      for (double& value : d) value /= largest;
  }

  /// A direction of about the least energy there, or one that falls.
  Values smoothest_on_coarsest() const {
    const BlockMatrix<B>& A = matrix(0);
    std::vector<double> scale;
    const Eigen::SparseMatrix<double> S = with_unit_diagonal(A, off(0), scale);
    HeldCholesky factor;
    Values out = random_vector(scale.size());
    if (!factor.factorise(S, affordable_operations(S.nonZeros()))) return solution(0, out, steps_on_coarsest);
    Eigen::Map<Eigen::VectorXd> d(out.data(), S.rows());
    for (std::size_t i = 0; i < out.size(); ++i)
      if (scale[i] == 0) out[i] = 0;
    if (const Eigen::VectorXd falling = factor.falling_direction(); falling.size() > 0)
      d = falling;
    else
      for (int step = 0; step < inverse_iterations; ++step) d = factor.solve(d.normalized());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] *= scale[i];
    scale_to_one(out);
    check(0, out);
    return out;
  }

  // A component is decoupled when its diagonal entry, the energy of its function, is not positive.
  void check_lost(std::size_t k) const {
    const Values energy = energy_of_lost(k);
    const auto least = std::min_element(energy.begin(), energy.end());
    if (least == energy.end() || *least >= 0) return;
    Values d(energy.size(), 0.0);
    d[static_cast<std::size_t>(least - energy.begin())] = 1;
    check_on_finest(k, std::move(d));
  }

  /// d'Ad for the function d of each component that is off on level k, zero for the others; empty where none is off.
  Values energy_of_lost(std::size_t k) const {
    const std::vector<Flags>& lost = off(k);
    if (std::ranges::all_of(lost, [](Flags flags) { return flags == 0; })) return {};
    const Prolongation& P = levels_.prolongations[k];
    const BlockMatrix<B>& A = matrix(k + 1);
    const std::vector<Flags>& gone = off(k + 1);
    Values energy(lost.size() * B, 0.0);
    weights::with<B>(P, [&](const auto& weight) {
      for (Index p = 0; p < A.size(); ++p)
        for (Offset c = P.row[p]; c < P.row[p + 1]; ++c)
          for (int i = 0; i < B; ++i) {
            const Index q = P.column[c];
            if (!(lost[q] >> i & 1u)) continue;
            double unit[B] = {}, d[B] = {}, Ad[B] = {};
            unit[i] = 1;
            weight(c).add_value(unit, d);
            add_product_with(A, P, weight, p, q, unit, Ad);
            for (int j = 0; j < B; ++j)
              if (!(gone[p] >> j & 1u)) energy[Offset{q} * B + i] += d[j] * Ad[j];
          }
    });
    return energy;
  }

  /// Adds (Ad)_p with the function d of a unit vector at q.
  template <class Weight>
  static void add_product_with(const BlockMatrix<B>& A, const Prolongation& P, const Weight& weight, Index p, Index q,
                               const double* unit, double* Ad) {
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      for (Offset m = P.row[A.column[k]]; m < P.row[A.column[k] + 1]; ++m)
        if (P.column[m] == q) {
          double d[B] = {};
          weight(m).add_value(unit, d);
          block::add_product<B>(A.at(k), d, Ad);
        }
  }

  const BlockMatrix<B>& A_;
  const AlgebraicLevels<B>& levels_;
  const std::vector<Flags> nothing_off_;
};

}  // namespace

double affordable_operations(Offset entries) {
  constexpr double few = 1e7, per_entry = 600;
  return std::max(few, per_entry * static_cast<double>(entries));
}

template <int B>
void refuse_indefinite(const BlockMatrix<B>& A, const AlgebraicLevels<B>& levels) {
  Search<B>(A, levels).run();
}

template <int B>
void refuse_indefinite_by_steps(const BlockMatrix<B>& A) {
  const std::vector<Flags> nothing_off(static_cast<std::size_t>(A.size()), 0);
  Values r = random_vector(nothing_off.size() * B), d;
  if (masked_cg<B>(A, nothing_off, by_diagonal(A), {.iterations = steps_of_long_search}, r, d).singular)
    refuse_if_negative_along(A, d);
}

template void refuse_indefinite_by_steps(const BlockMatrix<1>&);
template void refuse_indefinite_by_steps(const BlockMatrix<2>&);
template void refuse_indefinite_by_steps(const BlockMatrix<3>&);
template void refuse_indefinite(const BlockMatrix<1>&, const AlgebraicLevels<1>&);
template void refuse_indefinite(const BlockMatrix<2>&, const AlgebraicLevels<2>&);
template void refuse_indefinite(const BlockMatrix<3>&, const AlgebraicLevels<3>&);

}  // namespace signorini
