#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "core/constraints/bound.hpp"
#include "core/constraints/fixed_directions.hpp"

namespace signorini {

/// One direction of a local constraint and the obstacles its two bounds come from.
template <int B>
struct CombinedBound {
  std::array<double, B> direction;
  double lower, upper;
  Index lower_obstacle, upper_obstacle;
  const Bound<B>*lower_from, *upper_from;  ///< before they were reduced
  /// Obstacles with several normals, of which what is prescribed leaves one direction, are equally near.
  bool tied = false;
};

/// Decides what holds at a vertex where bounds meet prescribed directions and each other.
template <int B>
class BoundCombiner {
 public:
  /// All of these are kept references to.
  BoundCombiner(const ObstaclePlaces<B>& places, const std::vector<Bound<B>>& bounds,
                const std::vector<FixedDirections<B>>& fixes);

  /// Combines the bounds first <= bound < last of one vertex; `fixed` may be null. Each bound is reduced to the part of
  /// its direction that is not prescribed, and bounds along one direction are intersected. What is returned are the
  /// directions for local coordinates: independent ones, nearest first, as far as coordinates are well conditioned: up
  /// to 0.02 of their length from the span of the others, for rounding grows by that number's inverse squared. The
  /// other bounds are facets(). Unit vectors, in storage that the next call overwrites. Bounds along a direction that
  /// is prescribed and that what is prescribed there touches are appended to `held`. Error(Exit::no_solution): bounds
  /// that are violated whatever the free components are, or that leave nothing admissible. An obstacle with a
  /// functional rules its vertex: its directions alone are coordinates, in its order; others are faces.
  /// Error(Exit::input): two functionals at one vertex, or one whose direction is neither free nor prescribed. Friction
  /// of such a direction on the axis of an axisymmetric body, which has no area there, is left out instead.
  const std::vector<CombinedBound<B>>& combine(const Bound<B>* first, const Bound<B>* last,
                                               const FixedDirections<B>* fixed, std::vector<Bound<B>>& held);

  /// Of the vertex combined last, what is admissible beside the bounds along its directions.
  const std::vector<CombinedBound<B>>& facets() const { return facets_; }
  /// By how much rounding may let these contradict each other.
  double tolerated() const { return tolerated_; }
  /// Whether obstacles of several types bound it.
  bool mixes_types() const;

  /// Of the vertex combined last, the bound with a functional; null where there is none.
  const Bound<B>* functional() const { return functional_; }

 private:
  struct Reduced {
    std::array<double, B> direction;
    double lower, upper;
    const Bound<B>* from;
    double distance() const { return std::min(-lower, upper); }
  };

  /// Whether it is along a direction of the obstacle whose functional acts at the vertex.
  bool rules(const Reduced& bound) const { return functional_ && bound.from->obstacle == functional_->obstacle; }

  void find_functional(const Bound<B>* first, const Bound<B>* last);
  bool is_friction_on_axis(const Bound<B>& bound) const;
  void refuse_fixed_coordinates(const Bound<B>* first, const Bound<B>* last, const FixedDirections<B>& fixed) const;
  void reduce(const Bound<B>& bound, const FixedDirections<B>* fixed, std::vector<Bound<B>>& held);
  void merge(const Reduced& bound);
  bool independent_of_combined(const Reduced& bound) const;
  void check_order(CombinedBound<B>& bound, Index vertex);
  void check_room(Index vertex);
  double rounding(Index obstacle);
  [[noreturn]] void no_solution(Index obstacle, Index vertex, const std::string& why) const;

  const ObstaclePlaces<B>& places_;
  const std::vector<Bound<B>>& bounds_;
  double size_;                   // of prescribed values, and of coordinates where bounds are computed from them
  std::vector<double> rounding_;  // per obstacle, negative until it is needed
  const Bound<B>* functional_ = nullptr;
  std::vector<Reduced> reduced_;
  std::vector<CombinedBound<B>> combined_, facets_;
  double tolerated_ = 0;
};

}  // namespace signorini
