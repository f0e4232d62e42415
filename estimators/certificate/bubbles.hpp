#pragma once
#include <vector>

#include "core/sdk/polyhedron.hpp"
#include "estimators/certificate/flux.hpp"
#include "estimators/certificate/true_problem.hpp"

namespace signorini {

/// The bubbles b = 4 phi_a phi_b of edges, B coefficients for each, of a function with the values of the finite element
/// function u at vertices: those of u to begin with, changed so that it keeps to what is prescribed and, between nodes,
/// to the right side of obstacles. Where bodies may touch each other values at vertices are changed, too, along the
/// normal.
template <int D, int B>
class Bubbles {
 public:
  /// Keeps a reference.
  explicit Bubbles(const TrueProblem<D, B>& problem);

  /// The least change that makes u admissible between nodes. Returns whether there is one.
  bool lift();
  /// One projected Gauss-Seidel sweep over all edges, or over those that lift() has moved. Returns the energy won: what
  /// J is less than before.
  double sweep(bool lifted_only = false);

  /// J of the function less that of u.
  double energy() const;

  const std::vector<double>& coefficients() const { return c_; }
  const std::vector<double>& at_vertex() const { return at_vertex_; }
  bool lifted() const { return any_lifted_; }
  /// What is left of the distances between bodies, per row of TrueProblem::jumps.
  const std::vector<double>& left() const { return left_; }

  /// The coefficients of the function's gradient: sum over vertices x of phi_x out[x].
  std::array<Gradient<D, B>, D + 1> gradients(Index e) const;

 private:
  struct Local {
    std::array<double, B> residual{};
    std::array<double, B * B> stiffness{};
  };
  Local local(Index edge) const;
  std::array<double, B> minimiser(Index edge, const Local& local);
  std::array<double, B> at(Index edge) const;
  void gather_facets(Index edge);
  bool nearest(const std::array<double, B * B>& M, std::array<double, B>& c) const;
  const FixedDirections<B>* fixed(Index edge) const;
  std::array<Index, 2> ends(Index edge) const;
  Index vertices() const { return problem_.mesh.vertices(); }

  /// A vertex at an interface of bodies, and how it may move.
  struct Movable {
    Index vertex;
    std::array<double, B> way;
    double stiffness;            // along that
    std::array<double, B> load;  // on its hat function, from outside
  };
  void find_ways();
  bool lift_jumps();
  double sweep_jumps();
  double lack_at(Index vertex) const;
  void move(const Movable& here, double by);
  void change_left(Index dof, const std::array<double, B>& step);
  std::array<double, 2> range(Index dof, const std::array<double, B>& way) const;
  std::array<double, B> residual_at(const Movable& here) const;

  const TrueProblem<D, B>& problem_;
  bool any_;
  std::vector<double> c_, at_vertex_;
  std::vector<double> left_;  // see left()
  std::vector<Movable> movable_;
  std::vector<bool> lifted_;
  bool any_lifted_ = false;
  std::vector<Facet<B>> facets_;  // what obstacles and fixes demand of the edge looked at
};

/// Distances of u from the bounds of one obstacle along their direction: direction . u - lower, upper - direction . u.
template <int D, int B>
std::array<double, 2> distances(const TrueProblem<D, B>& problem, const Gaps<D, B>& gaps, Index p) {
  const auto* bound = gaps.at_vertex(p);
  if (!bound) return {infinity, infinity};
  double v = 0;
  for (int i = 0; i < B; ++i) v += bound->direction[i] * problem.u.at_vertex[Offset{p} * B + i];
  return {v - bound->lower, bound->upper - v};
}

}  // namespace signorini
