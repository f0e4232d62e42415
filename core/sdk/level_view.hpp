#pragma once
#include "core/base/types.hpp"

namespace signorini {

enum class Order : int { forward, backward };

/// A bound along any direction at a vector: lower <= normal . x <= upper. Beside the bounds of components it makes what
/// is admissible there a polyhedron (core/sdk/polyhedron.hpp).
template <int B>
struct Facet {
  double normal[B];  ///< in local coordinates, of any length
  double lower, upper;
  double tolerated;  ///< by how much rounding may let bounds contradict each other
};

/// One level as smoothers and obstacles see it: pointers only, no ownership. A is in block compressed rows with the
/// diagonal block first in every row and row-major blocks; everything is in local coordinates.
template <int B>
struct LevelView {
  Index vectors;
  const Offset* row;  ///< vectors + 1
  const Index* column;
  const double* value;       ///< B * B per column
  const double* inverse;     ///< B * B per vector: inverse diagonal block (rows of missing components zero)
  const double* b;           ///< B per vector
  double* x;                 ///< B per vector: the iterate
  const Index* slot;         ///< per vector: its slot, -1 without obstacle
  const Index* constrained;  ///< per slot, ascending: its vector
  Index slots;
  const double* lower;  ///< B per slot: bounds on x
  const double* upper;
  double relaxation;   ///< in (0, 2): how far sweeps go towards the local minimiser where no bound is met; 1 is there
  const double* data;  ///< `width` per slot: what LocalConstraint::data says; null where no obstacle has any
  int width;
  const double* last;       ///< B per slot: the vectors' values after the last load step, zero in the first
  const Flags* tangential;  ///< per slot: components orthogonal to the obstacle's direction; null like `data`
  const Offset* facet_row;  ///< slots + 1: where the facets of each begin; null where no slot has any
  const Facet<B>* facet;
  /// `width` per slot: `data` at the end of the last load step, as renew() left them; zero in the first.
  const double* before = nullptr;
};

}  // namespace signorini
