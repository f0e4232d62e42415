#pragma once
#include <memory>

#include "core/solver/polyhedral_box.hpp"
#include "tests/support/convex.hpp"
#include "tests/support/polyhedra.hpp"
#include "tests/support/problems.hpp"
#include "tests/support/random_problem.hpp"

/// Random problems with facets, and their minimiser by a solver that shares nothing with the program's.
namespace signorini::test {

/// Facets at about half of the slots. Their vectors have frames, which the coarse corrections go by.
template <int B>
void add_facets(Random& random, DiscreteProblem<B>& problem) {
  Constraints<B>& c = problem.constraints;
  c.facet_row.assign(1, 0);
  for (Index slot = 0; slot < c.size(); ++slot) {
    double inside[B];
    for (int k = 0; k < B; ++k)
      inside[k] = std::clamp(random.between(-0.5, 0.5), c.lower[slot * B + k], c.upper[slot * B + k]);
    if (random.chance(0.5)) {
      const auto rotation = random_rotation<B>(random);
      std::vector<Facet<B>> facets = random_facets<B>(random, 1 + random.below(B + 1), inside, -1);
      for (const Facet<B>& f : facets) c.facet.push_back(f);
      problem.frames.add(static_cast<std::size_t>(problem.A.size()), c.vector[slot], rotation.data(), rotation.data());
    }
    c.facet_row.push_back(static_cast<Offset>(c.facet.size()));
  }
}

template <int B>
DiscreteProblem<B> random_polyhedra(Random& random, Index n) {
  DiscreteProblem<B> problem = random_problem<B>(random, n, 0.7);
  add_facets(random, problem);
  problem.segments = {{0, n, std::make_shared<PolyhedralBox<B>>()}};
  return problem;
}

/// The unknowns, and behind them what each facet measures.
template <int B>
Eigen::MatrixXd measured(const DiscreteProblem<B>& problem) {
  const Constraints<B>& c = problem.constraints;
  const Eigen::Index n = problem.A.size() * B;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + std::ssize(c.facet), n);
  K.topRows(n).setIdentity();
  for (Index slot = 0; slot < c.size(); ++slot)
    for (Offset f = c.facet_row[slot]; f < c.facet_row[slot + 1]; ++f)
      for (int k = 0; k < B; ++k) K(n + f, c.vector[slot] * B + k) = c.facet[f].normal[k];
  return K;
}

/// Empty where the convex solver finds none.
/// @param prox that of the bounds of components and of the functional: prox(rho, y)
template <int B, class Prox>
Eigen::VectorXd minimiser_with_facets(const DiscreteProblem<B>& problem, const Prox& prox) {
  const auto with_facets = [&](double rho, Eigen::VectorXd& z) {
    Eigen::VectorXd y = z.head(problem.A.size() * B);
    prox(rho, y);
    z.head(y.size()) = y;
    for (std::size_t f = 0; f < problem.constraints.facet.size(); ++f) {
      double& v = z[y.size() + static_cast<Eigen::Index>(f)];
      v = std::clamp(v, problem.constraints.facet[f].lower, problem.constraints.facet[f].upper);
    }
  };
  return convex_minimiser(dense(problem.A), vector(problem.b), measured(problem), with_facets);
}

/// Bounds of components alone.
template <int B>
auto clamped(const DiscreteProblem<B>& problem) {
  return [&problem](double, Eigen::VectorXd& y) {
    const Constraints<B>& c = problem.constraints;
    for (Index slot = 0; slot < c.size(); ++slot)
      for (int k = 0; k < B; ++k) {
        double& v = y[c.vector[slot] * B + k];
        v = std::clamp(v, c.lower[slot * B + k], c.upper[slot * B + k]);
      }
  };
}

}  // namespace signorini::test
