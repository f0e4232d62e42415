#include "core/fem/nested.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/energy_along.hpp"
#include "core/algebra/random_vector.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/discretize.hpp"
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

template <int D>
Prolongation prolongation(const Refinement& refinement, const Nodes<D>& coarse, const Nodes<D>& fine) {
  Prolongation out;
  out.coarse = coarse.size();
  out.midpoints = refinement.uniform;
  const auto size = static_cast<std::size_t>(fine.size());
  out.row.reserve(size + 1);
  out.column.reserve(2 * size);
  out.weight.reserve(2 * size);
  for (Index p = 0; p < fine.size(); ++p) {
    const auto [a, b] = coarse.of(refinement.parents[fine.vertex(p)]);
    out.column.push_back(std::min(a, b));
    out.weight.push_back(a == b ? 1.0 : 0.5);
    if (a != b) {
      out.column.push_back(std::max(a, b));
      out.weight.push_back(0.5);
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

template <int D>
std::vector<Prolongation> prolongations(const MeshHierarchy<D>& hierarchy, const std::vector<Nodes<D>>& nodes) {
  std::vector<Prolongation> out;
  for (std::size_t k = 0; k < hierarchy.refinements.size(); ++k)
    out.push_back(prolongation(hierarchy.refinements[k], nodes[k], nodes[k + 1]));
  return out;
}

template Prolongation prolongation(const Refinement&, const Nodes<2>&, const Nodes<2>&);
template Prolongation prolongation(const Refinement&, const Nodes<3>&, const Nodes<3>&);
template std::vector<Prolongation> prolongations(const MeshHierarchy<2>&, const std::vector<Nodes<2>>&);
template std::vector<Prolongation> prolongations(const MeshHierarchy<3>&, const std::vector<Nodes<3>>&);

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
