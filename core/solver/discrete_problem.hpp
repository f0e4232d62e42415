#pragma once
#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/sdk/obstacle.hpp"
#include "core/sdk/polyhedron.hpp"
#include "core/solver/jumps.hpp"

namespace signorini {

/// Local changes of basis: a vector with slot[p] >= 0 is stored in coordinates of its own. Q and its dual N = Q^-T are
/// row-major. Values transform as v_global = Q v_local and v_local = N' v_global: the columns of N are the directions
/// that the local components measure. Forces transform the other way round, f_local = Q' f_global. Q = N where these
/// directions are orthonormal.
template <int B>
struct Frames {
  std::vector<Index> slot;          ///< per vector, -1: global coordinates; empty: no frame at all
  std::vector<double> basis, dual;  ///< B * B per slot

  /// Q and N of a vector, null where it has no frame.
  const double* at(Index p) const { return find(basis, p); }
  const double* dual_at(Index p) const { return find(dual, p); }

  /// Gives one of `vectors` vectors a frame.
  void add(std::size_t vectors, Index p, const double* Q, const double* N) {
    if (slot.empty()) slot.assign(vectors, -1);
    slot[p] = static_cast<Index>(basis.size() / (B * B));
    basis.insert(basis.end(), Q, Q + B * B);
    dual.insert(dual.end(), N, N + B * B);
  }

 private:
  const double* find(const std::vector<double>& blocks, Index p) const {
    return slot.empty() || slot[p] < 0 ? nullptr : blocks.data() + Offset{slot[p]} * B * B;
  }
};

/// Bounds of the vectors that an obstacle can reach, on the iterate of their level in local coordinates. Only those
/// vectors store anything.
template <int B>
struct Constraints {
  std::vector<Index> slot;           ///< per vector, -1: none
  std::vector<Index> vector;         ///< per slot, ascending
  std::vector<double> lower, upper;  ///< B per slot, infinite where there is none
  std::vector<double> data;          ///< `width` per slot, see LevelView::data; empty without functionals
  int width = 0;
  std::vector<double> before;     ///< `width` per slot, see LevelView::before; empty without functionals
  std::vector<double> last;       ///< B per slot, see LevelView::last; empty without functionals
  std::vector<Flags> tangential;  ///< per slot, see LevelView::tangential; empty without functionals
  std::vector<Offset> facet_row;  ///< slots + 1, see LevelView::facet_row; empty where no slot has facets
  std::vector<Facet<B>> facet;    ///< what is admissible beside the bounds

  Index size() const { return static_cast<Index>(vector.size()); }
  bool has_facets(Index at) const { return !facet_row.empty() && facet_row[at] < facet_row[at + 1]; }
  /// Of a slot with facets.
  Polyhedron<B> polyhedron(Index at) const {
    return {lower.data() + Offset{at} * B, upper.data() + Offset{at} * B, facet.data() + facet_row[at],
            facet.data() + facet_row[at + 1]};
  }
  /// Whether v, B numbers, is admissible at a slot, but for rounding at facets.
  bool admits(Index at, const double* v) const {
    for (int k = 0; k < B; ++k)
      if (!(v[k] >= lower[Offset{at} * B + k] && v[k] <= upper[Offset{at} * B + k])) return false;
    return !has_facets(at) || polyhedron(at).contains(v);
  }
  /// The admissible point next to v at a slot: component by component, and then in local coordinates.
  void project(Index at, double* v) const {
    const double *low = lower.data() + Offset{at} * B, *high = upper.data() + Offset{at} * B;
    for (int k = 0; k < B; ++k) v[k] = block::clamp(v[k], low[k], high[k]);
    if (B == 1 || !has_facets(at)) return;
    double unit[B * B] = {}, y[B];
    for (int k = 0; k < B; ++k) unit[k * (B + 1)] = 1;
    if (polyhedron(at).nearest(unit, v, y)) std::copy_n(y, B, v);
  }
  /// The bounds of what is left to do after a motion, B numbers per vector.
  void move(const std::vector<double>& way) {
    for (Index at = 0; at < size(); ++at) {
      const double* v = way.data() + Offset{vector[at]} * B;
      for (int k = 0; k < B; ++k) {
        lower[Offset{at} * B + k] -= v[k];
        upper[Offset{at} * B + k] -= v[k];
      }
      if (!has_facets(at)) continue;
      for (Offset f = facet_row[at]; f < facet_row[at + 1]; ++f) {
        double by = 0;
        for (int k = 0; k < B; ++k) by += facet[f].normal[k] * v[k];
        facet[f].lower -= by;
        facet[f].upper -= by;
      }
    }
  }
  /// Takes away all bounds; the slots stay.
  void clear_bounds() {
    std::fill(lower.begin(), lower.end(), -infinity);
    std::fill(upper.begin(), upper.end(), infinity);
    facet_row.clear();
    facet.clear();
  }
};

/// Slots of the vectors first <= p < last: the first one, and one behind the last.
template <int B>
std::pair<Index, Index> slots_between(const Constraints<B>& c, Index first, Index last) {
  if (!c.vector.empty() && c.vector.size() == c.slot.size()) return {first, last};
  const auto from = std::lower_bound(c.vector.begin(), c.vector.end(), first);
  const auto to = std::lower_bound(from, c.vector.end(), last);
  return {static_cast<Index>(from - c.vector.begin()), static_cast<Index>(to - c.vector.begin())};
}

/// Vectors first <= p < last whose constraints belong to one obstacle.
template <int B>
struct Segment {
  Index first, last;
  std::shared_ptr<const Obstacle<B>> obstacle;
};

/// Whether an obstacle adds to the energy.
template <int B>
bool has_functional(const std::vector<Segment<B>>& segments) {
  return std::any_of(segments.begin(), segments.end(),
                     [](const Segment<B>& s) { return s.obstacle->functional() != nullptr; });
}

/// Whether the energy that an obstacle adds depends on the solution.
template <int B>
bool follows_solution(const std::vector<Segment<B>>& segments) {
  return std::any_of(segments.begin(), segments.end(),
                     [](const Segment<B>& s) { return s.obstacle->renewal() != nullptr; });
}

/// The matrix of a coarser level without any truncation.
template <int B>
struct GalerkinMatrix {
  BlockMatrix<B> A;
  std::vector<Flags> off;  ///< per vector: components prescribed, or without any fine function
  bool complete = true;    ///< whether A stores a coupling wherever truncation may leave one, even where it is zero
};

template <int B>
class FollowingLoad;

/// min 1/2 x'Ax - b'x + sum of phi_p(x_p) with x within bounds: what the solver is given; the obstacles of the segments
/// know phi. All of it is in local coordinates. A component
/// whose bit is set in `fixed` is prescribed: its row and column are those of the identity and b holds its value, while
/// the other entries of b account for it.
template <int B>
struct DiscreteProblem {
  BlockMatrix<B> A;
  std::vector<double> b;      ///< B per vector
  std::vector<Flags> fixed;   ///< per vector
  std::vector<double> start;  ///< B per vector: prescribed values, zero elsewhere
  Frames<B> frames;
  Constraints<B> constraints;
  double prescribed_energy = 0;  ///< g'A g of the prescribed values g, before elimination
  double prescribed_work = 0;    ///< b'g, before elimination
  std::vector<Index> coupled;    ///< ascending: vectors with free components that A couples to prescribed values
  std::vector<double> coupling;  ///< B per coupled vector: (A g) on its free components, zero on the others
  /// The coarser levels' matrices where they are known from before, coarsest first, one for each prolongation; with
  /// frames only for Rotate::all. Not owned.
  std::span<const GalerkinMatrix<B>> galerkin;
  /// Where bodies may touch each other: unknowns that are jumps, and global coordinates mean those; null: none.
  std::shared_ptr<const Jumps<B>> jumps;
  FollowingLoad<B>* following = nullptr;  ///< a part of b that follows the solution; null: none. Not owned
  std::vector<Segment<B>> segments;       ///< cover all vectors in ascending order; empty when there is no obstacle
  /// Whether nothing but friction holds it against its loads, and no load step before tells what presses.
  bool loose = false;
  /// Whether a factorisation of A costs no more than some cycles, so that A needs no coarser level.
  bool cheap_to_factorise = false;
  /// Whether it is a part of a load step for the whole of which methods that factorise have been in vain.
  bool spent = false;
};

}  // namespace signorini
