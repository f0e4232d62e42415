#include "methods/near_start.hpp"

#include <cassert>

#include "core/algebra/products.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/multigrid.hpp"
#include "core/solver/weights.hpp"

namespace signorini {

namespace {

/// Of its coarser meshes' solutions, interpolated, over that of zero: such starts are wrong by some hundredths, more or
/// less, whatever the mesh.
constexpr double gained = 0.03;

/// Forces at x, in global coordinates, without those that prescribed values and bounds hold.
template <int B>
std::vector<double> free_forces(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  std::vector<double> r(x.size());
  residual<B>(problem.A, x.data(), problem.b.data(), r.data());
  for (std::size_t i = 0; i < r.size(); ++i)
    if (problem.fixed[i / B] >> (i % B) & 1u) r[i] = 0;
  const Constraints<B>& c = problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{c.vector[slot]} * B + k, at = Offset{slot} * B + k;
      if ((x[i] <= c.lower[at] && r[i] < 0) || (x[i] >= c.upper[at] && r[i] > 0)) r[i] = 0;
    }
  for (Index p = 0; p < problem.A.size(); ++p)
    if (const double* N = problem.frames.dual_at(p)) {
      double global[B];
      block::product<B>(N, r.data() + Offset{p} * B, global);
      std::copy_n(global, B, r.data() + Offset{p} * B);
    }
  return r;
}

/// @param off per vector: components whose rows are those of the identity
template <int B>
double forces_over_stiffness(const BlockMatrix<B>& A, const std::vector<Flags>& off, const std::vector<double>& r) {
  double sum = 0;
  for (Index p = 0; p < A.size(); ++p) {
    double squared = 0, stiffness = 0;  // which does not depend on the frame
    int free = 0;
    for (int k = 0; k < B; ++k) {
      squared += r[Offset{p} * B + k] * r[Offset{p} * B + k];
      if (!(off[p] >> k & 1u)) ++free, stiffness += A.diagonal(p)[k * (B + 1)];
    }
    if (stiffness > 0) sum += free * squared / stiffness;
  }
  return sum;
}

template <int B>
std::vector<double> restricted(const Prolongation& P, const std::vector<double>& r) {
  std::vector<double> out(Offset{P.coarse} * B, 0.0);
  weights::with<B>(P, [&](const auto& weight) {
    for (Index p = 0; p < P.fine(); ++p)
      for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
        weight(k).add_force(r.data() + Offset{p} * B, out.data() + Offset{P.column[k]} * B);
  });
  return out;
}

}  // namespace

template <int B>
double squared_distance(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                        std::span<const GalerkinMatrix<B>> matrices, const std::vector<double>& x) {
  assert(prolongations.size() == matrices.size());
  std::vector<double> r = free_forces(problem, x);
  double sum = forces_over_stiffness(problem.A, problem.fixed, r);
  for (std::size_t k = prolongations.size(); k-- > 0;) {
    r = restricted<B>(prolongations[k], r);
    sum += forces_over_stiffness(matrices[k].A, matrices[k].off, r);
  }
  return sum;
}

template <int B>
bool is_near(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
             std::span<const GalerkinMatrix<B>> matrices, std::vector<double>& x) {
  std::vector<double> none = problem.start;
  make_admissible(problem, none);
  make_admissible(problem, x);
  Level<B> level = finest_level(problem);
  level.x = x.data();
  level.sweep(Order::forward);
  level.sweep(Order::backward);
  const auto squared = [&](const std::vector<double>& v) {
    return squared_distance(problem, prolongations, matrices, v);
  };
  return squared(x) <= gained * gained * squared(none);
}

#define SIGNORINI_INSTANTIATE(B)                                                                                      \
  template double squared_distance(const DiscreteProblem<B>&, std::span<const Prolongation>,                          \
                                   std::span<const GalerkinMatrix<B>>, const std::vector<double>&);                   \
  template bool is_near(const DiscreteProblem<B>&, std::span<const Prolongation>, std::span<const GalerkinMatrix<B>>, \
                        std::vector<double>&)
SIGNORINI_INSTANTIATE(1);
SIGNORINI_INSTANTIATE(2);
SIGNORINI_INSTANTIATE(3);
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
