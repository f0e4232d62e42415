#include "amg/definite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "amg/direction.hpp"
#include "amg/masked_cg.hpp"
#include "core/base/error.hpp"
#include "core/solver/weights.hpp"

namespace signorini {
namespace {

using Vector = std::vector<double>;  // B per vector of a level

constexpr double rounding = 1e-12;                       // of d'Ad, relative to d'Dd with the diagonal D of A
constexpr int steps_on_coarsest = 40, steps_above = 16;  // of conjugate gradients

template <int B>
Vector interpolated(const Prolongation& P, const Vector& coarse) {
  Vector fine(static_cast<std::size_t>(P.fine()) * B, 0.0);
  weights::with<B>(P, [&](const auto& weight) {
    for (Index p = 0; p < P.fine(); ++p)
      weights::interpolate<B>(P, weight, p, coarse.data(), fine.data() + Offset{p} * B);
  });
  return fine;
}

Vector random_vector(std::size_t size) {
  std::mt19937_64 random;
  Vector out(size);
  for (double& value : out) value = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
  return out;
}

template <int B>
void refuse_if_negative(const BlockMatrix<B>& A, const Vector& d) {
  const DirectionEnergy found = energy_along(A, d);
  if (!(found.of_matrix < -rounding * found.of_diagonal)) return;
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto largest = std::max_element(d.begin(), d.end(), larger);
  input_error("matrix",
              fmt::format("indefinite: d'Ad is {:.3g} times d'Dd, D its diagonal, for a direction d with the largest "
                          "entry in row {}; expected a positive semidefinite matrix",
                          found.of_matrix / found.of_diagonal, largest - d.begin() + 1));
}

/// The levels of a matrix, the finest last.
template <int B>
class Search {
 public:
  Search(const BlockMatrix<B>& A, const AlgebraicLevels<B>& levels)
      : A_(A), levels_(levels), nothing_off_(static_cast<std::size_t>(A.size()), 0) {}

  void run() const {
    for (std::size_t k = 0; k <= levels_.matrices.size(); ++k) {
      if (k < levels_.matrices.size()) check_lost(k);
      Vector d = falling_direction(k);
      if (!d.empty()) check(k, std::move(d));
    }
  }

 private:
  const BlockMatrix<B>& matrix(std::size_t k) const { return k < levels_.matrices.size() ? levels_.matrices[k].A : A_; }
  const std::vector<Flags>& off(std::size_t k) const {
    return k < levels_.matrices.size() ? levels_.matrices[k].off : nothing_off_;
  }

  void check(std::size_t level, Vector d) const {
    for (std::size_t k = level; k < levels_.prolongations.size(); ++k) d = interpolated<B>(levels_.prolongations[k], d);
    refuse_if_negative(A_, d);
  }

  /// Empty where conjugate gradients met none.
  Vector falling_direction(std::size_t k) const {
    const BlockMatrix<B>& A = matrix(k);
    const Precondition by_diagonal = [&](const Vector& r, Vector& z) {
      for (Index p = 0; p < A.size(); ++p)
        for (int i = 0; i < B; ++i) z[Offset{p} * B + i] = r[Offset{p} * B + i] / A.diagonal(p)[i * B + i];
    };
    Vector r = random_vector(static_cast<std::size_t>(A.size()) * B), d;
    apply_mask<B>(off(k), r);
    const int steps = k == 0 ? steps_on_coarsest : steps_above;
    if (!masked_cg<B>(A, off(k), by_diagonal, {.iterations = steps}, r, d).singular) return {};
    return d;
  }

  // A component is decoupled when its diagonal entry, the energy of its function, is not positive.
  void check_lost(std::size_t k) const {
    const Vector energy = energy_of_lost(k);
    const auto least = std::min_element(energy.begin(), energy.end());
    if (least == energy.end() || *least >= 0) return;
    Vector d(energy.size(), 0.0);
    d[static_cast<std::size_t>(least - energy.begin())] = 1;
    check(k, std::move(d));
  }

  /// d'Ad for the function d of each component that is off on level k, zero for the others; empty where none is off.
  Vector energy_of_lost(std::size_t k) const {
    const std::vector<Flags>& lost = off(k);
    if (std::ranges::all_of(lost, [](Flags flags) { return flags == 0; })) return {};
    const Prolongation& P = levels_.prolongations[k];
    const BlockMatrix<B>& A = matrix(k + 1);
    const std::vector<Flags>& gone = off(k + 1);
    Vector energy(lost.size() * B, 0.0);
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

template <int B>
bool diagonal_dominates(const BlockMatrix<B>& A) {
  for (Index p = 0; p < A.size(); ++p)
    for (int i = 0; i < B; ++i) {
      double others = 0;
      for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
        for (int j = 0; j < B; ++j) others += std::abs(A.at(k)[i * B + j]);
      const double diagonal = A.diagonal(p)[i * B + i];
      if (!(others - diagonal <= (1 + rounding) * diagonal)) return false;
    }
  return true;
}

template <int B>
void refuse_indefinite(const BlockMatrix<B>& A, const AlgebraicLevels<B>& levels) {
  if (!diagonal_dominates(A)) Search<B>(A, levels).run();
}

template void refuse_indefinite(const BlockMatrix<1>&, const AlgebraicLevels<1>&);
template void refuse_indefinite(const BlockMatrix<2>&, const AlgebraicLevels<2>&);
template void refuse_indefinite(const BlockMatrix<3>&, const AlgebraicLevels<3>&);
template bool diagonal_dominates(const BlockMatrix<1>&);
template bool diagonal_dominates(const BlockMatrix<2>&);
template bool diagonal_dominates(const BlockMatrix<3>&);

}  // namespace signorini
