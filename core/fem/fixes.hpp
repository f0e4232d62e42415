#pragma once
#include "core/fem/model.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// Directions along which the unknowns v of one vertex are prescribed: direction[k] . v = value[k]. The directions are
/// orthonormal; a direction within rounding of a coordinate axis is exactly that axis.
template <int B>
struct FixedDirections {
  Index vertex = 0;
  int count = 0;
  double direction[B][B] = {};
  double value[B] = {};

  /// Adds the condition d . v = v0 (d a unit vector), solved for the part of d that is not yet prescribed. Nothing
  /// happens where there is no such part.
  void add(const double* d, double v0);
  /// Only coordinate axes.
  bool along_axes() const;
};

/// All Dirichlet conditions of a model, per vertex, ascending. Where conditions contradict each other in a direction,
/// the later [[fix]] holds. In a normal frame the components are those along the outer normal, averaged over the picked
/// faces around the vertex, and along the tangents (see tangents()); where these faces fall into groups whose normals
/// differ by more than 30 degrees (and that do not lie on one curve), the condition holds along each group's normal.
template <int D, int B>
std::vector<FixedDirections<B>> collect_fixes(const Mesh<D>& mesh, const Model<B>& model);

/// Unit tangents to a unit normal: D = 2: the normal turned by +90 degrees; D = 3: first the projection of the
/// coordinate axis that is farthest from the normal, then the cross product of both.
std::array<Point<2>, 1> tangents(const Point<2>& normal);
std::array<Point<3>, 2> tangents(const Point<3>& normal);

}  // namespace signorini
