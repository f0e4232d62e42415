#include "core/solver/interpolate.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/energy_along.hpp"
#include "core/algebra/random_vector.hpp"
#include "core/base/rounding.hpp"
#include "core/solver/local_coordinates.hpp"
#include "core/solver/weights.hpp"

namespace signorini {

namespace {

// Energies of a random vector agree that well where only rounding tells the matrices apart. On curved boundaries, or
// with coefficients that vary, they differ far more.
constexpr double same_energy = 1e-11;

template <int B>
void clear_fixed(const DiscreteProblem<B>& problem, std::vector<double>& x) {
  for (std::size_t k = 0; k < x.size(); ++k)
    if (problem.fixed[k / B] >> (k % B) & 1) x[k] = 0;
}

// Whether each coarse vector has the frame of its twin, which is the one that a solver gives it.
template <int B>
bool same_frames(const DiscreteProblem<B>& coarse, const Prolongation& prolongation, const DiscreteProblem<B>& fine) {
  constexpr double equal = rounding_of_differences;
  const std::vector<Index> twins = prolongation.twins();
  for (Index q = 0; q < prolongation.coarse; ++q) {
    const double *Q = coarse.frames.at(q), *twin = fine.frames.at(twins[q]);
    if (!Q != !twin) return false;
    if (Q && !std::equal(Q, Q + B * B, twin, [](double a, double b) { return std::abs(a - b) <= equal; })) return false;
  }
  return true;
}

}  // namespace

template <int B>
std::vector<double> interpolate(const DiscreteProblem<B>& coarse, const std::vector<double>& x,
                                const Prolongation& prolongation, const DiscreteProblem<B>& fine) {
  std::vector<double> u = x;
  out_of_frames(coarse.frames, u);
  std::vector<double> out(Offset{prolongation.fine()} * B);
  weights::with<B>(prolongation, [&](const auto& weight) {
    for (Index p = 0; p < prolongation.fine(); ++p)
      weights::interpolate<B>(prolongation, weight, p, u.data(), out.data() + Offset{p} * B);
  });
  if (!prolongation.local) into_frames(fine.frames, out);
  for (std::size_t k = 0; k < out.size(); ++k)
    if (fine.fixed[k / B] >> (k % B) & 1) out[k] = fine.start[k];
  return out;
}

template <int B>
bool is_galerkin(const DiscreteProblem<B>& coarse, const Prolongation& prolongation, const DiscreteProblem<B>& fine) {
  if (!same_frames(coarse, prolongation, fine)) return false;
  std::vector<double> z = random_vector(static_cast<std::size_t>(prolongation.coarse) * B);
  clear_fixed(coarse, z);
  std::vector<double> Pz = interpolate(coarse, z, prolongation, fine);
  clear_fixed(fine, Pz);
  const double below = energy_along(coarse.A, z).of_matrix, above = energy_along(fine.A, Pz).of_matrix;
  return std::abs(above - below) <= same_energy * below;
}

#define SIGNORINI_INSTANTIATE(B)                                                                                       \
  template std::vector<double> interpolate(const DiscreteProblem<B>&, const std::vector<double>&, const Prolongation&, \
                                           const DiscreteProblem<B>&);                                                 \
  template bool is_galerkin(const DiscreteProblem<B>&, const Prolongation&, const DiscreteProblem<B>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
