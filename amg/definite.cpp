#include "amg/definite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "amg/direction.hpp"
#include "amg/masked_cg.hpp"
#include "core/base/error.hpp"

namespace signorini {
namespace {

using Vector = std::vector<double>;  // B per vector of a level

constexpr double rounding = 1e-12;  // of d'Ad, relative to d'Dd with the diagonal D of A
constexpr int steps = 40;

template <int B>
Vector interpolated(const Prolongation& P, const Vector& coarse) {
  Vector fine(static_cast<std::size_t>(P.fine()) * B, 0.0);
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i) fine[Offset{p} * B + i] += P.weight[k] * coarse[Offset{P.column[k]} * B + i];
  return fine;
}

/// By the transposed weights, to the power given.
template <int B>
Vector restricted(const Prolongation& P, const Vector& fine, int power = 1) {
  Vector coarse(static_cast<std::size_t>(P.coarse) * B, 0.0);
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
      const double weight = power == 1 ? P.weight[k] : P.weight[k] * P.weight[k];
      for (int i = 0; i < B; ++i) coarse[Offset{P.column[k]} * B + i] += weight * fine[Offset{p} * B + i];
    }
  return coarse;
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

/// Bramble, Pasciak and Xu's preconditioner (Math. Comp. 55, 1990): a diagonal correction on every level at once. It
/// needs no coarse matrix.
template <int B>
class Bpx {
 public:
  Bpx(const BlockMatrix<B>& A, std::span<const Prolongation> prolongations)
      : prolongations_(prolongations), inverse_(prolongations.size() + 1) {
    Vector diagonal;
    for (Index p = 0; p < A.size(); ++p)
      for (int k = 0; k < B; ++k) diagonal.push_back(A.diagonal(p)[k * B + k]);
    inverse_.back() = inverted(diagonal, 1);
    for (std::size_t k = prolongations.size(); k-- > 0;) {
      diagonal = restricted<B>(prolongations[k], diagonal, 2);
      inverse_[k] = inverted(diagonal, part_of_diagonal(A, k, diagonal));
    }
  }

  void operator()(const Vector& r, Vector& z) const {
    std::vector<Vector> residual(inverse_.size());
    residual.back() = r;
    for (std::size_t k = prolongations_.size(); k-- > 0;)
      residual[k] = restricted<B>(prolongations_[k], residual[k + 1]);
    z.clear();
    for (std::size_t k = 0; k < inverse_.size(); ++k) {
      z = k == 0 ? Vector(residual[0].size(), 0.0) : interpolated<B>(prolongations_[k - 1], z);
      for (std::size_t i = 0; i < z.size(); ++i) z[i] += inverse_[k][i] * residual[k][i];
    }
  }

 private:
  // The diagonal of P'DP says how the energies of the coarse functions compare with each other; how much smaller all of
  // them are, one rough function says.
  double part_of_diagonal(const BlockMatrix<B>& A, std::size_t level, const Vector& diagonal) const {
    Vector d = random_vector(diagonal.size());
    double size = 0;
    for (std::size_t i = 0; i < d.size(); ++i) size += diagonal[i] * d[i] * d[i];
    for (std::size_t k = level; k < prolongations_.size(); ++k) d = interpolated<B>(prolongations_[k], d);
    refuse_if_negative(A, d);
    return size > 0 ? std::max(energy_along(A, d).of_matrix / size, rounding) : 1;
  }

  static Vector inverted(const Vector& diagonal, double part) {
    Vector out(diagonal.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = diagonal[i] > 0 ? 1 / (part * diagonal[i]) : 0;
    return out;
  }

  std::span<const Prolongation> prolongations_;
  std::vector<Vector> inverse_;  // per level, coarsest first
};

}  // namespace

template <int B>
void refuse_indefinite(const BlockMatrix<B>& A, std::span<const Prolongation> prolongations) {
  const Bpx<B> precondition(A, prolongations);
  const std::vector<Flags> mask(static_cast<std::size_t>(A.size()), 0);
  Vector r = random_vector(mask.size() * B), d;
  if (masked_cg<B>(A, mask, precondition, {.iterations = steps}, r, d).singular) refuse_if_negative(A, d);
}

template void refuse_indefinite(const BlockMatrix<1>&, std::span<const Prolongation>);
template void refuse_indefinite(const BlockMatrix<2>&, std::span<const Prolongation>);
template void refuse_indefinite(const BlockMatrix<3>&, std::span<const Prolongation>);

}  // namespace signorini
