#pragma once
#include <string>
#include <vector>

#include "core/constraints/bound.hpp"

namespace signorini {

/// Asks one obstacle for its bounds at vectors, many at a time, and checks what it says. Bounds that are infinite on
/// both sides are left out unless a functional comes with them. An obstacle that fails is an Error with its code; a
/// bound that no number satisfies is an Error(Exit::no_solution).
template <int B>
class BoundCollector {
 public:
  /// @param bounds, numbers are appended to, see Bound::data
  BoundCollector(const ObstaclePlaces<B>& places, Index obstacle, std::vector<Bound<B>>& bounds,
                 std::vector<FunctionalNumbers<B>>& numbers);

  /// The next vector, in ascending order.
  /// @param part of its bounds, see PairedNode::part
  void push(Index vector, const SurfaceVertex& at, double part = 1);
  /// Once, after the last one.
  void flush();

 private:
  [[noreturn]] void refuse(const Status& status);
  void check_directions(Index vector, int directions) const;
  void add(Index vector, const SurfaceVertex& at, double part, const LocalConstraint<B>& constraint, int k);
  void add_functional(const SurfaceVertex& at, const LocalConstraint<B>& constraint);
  bool has_numbers(const LocalConstraint<B>& constraint, Index vector) const;
  [[noreturn]] void blame(Index vector, const std::string& what) const;

  const ObstaclePlaces<B>& places_;
  const Index number_;
  const Obstacle<B>& obstacle_;
  std::vector<Bound<B>>& bounds_;
  std::vector<FunctionalNumbers<B>>& functionals_;
  const bool functional_;
  const int told_;             // numbers of its own that the descriptor tells of
  const bool describes_none_;  // directions
  bool rules_ = false;         // its functional acts at the vector, all of whose directions are coordinates then
  std::vector<Index> vectors_;
  std::vector<double> parts_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<LocalConstraint<B>> constraints_;
};

}  // namespace signorini
