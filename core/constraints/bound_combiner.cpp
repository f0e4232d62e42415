#include "core/constraints/bound_combiner.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/algebra/local_basis.hpp"
#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/sdk/polyhedron.hpp"

namespace signorini {
namespace {

constexpr double independent = 0.02;  // separation() from which local coordinates are well conditioned
constexpr double parallel =
    rounding_of_bases;  // distance of unit vectors that are one direction, far below any tolerance

/// Of a unit vector what is across prescribed directions.
bool is_oblique(double length) { return length > same_direction && length < 1 - same_direction; }

}  // namespace

template <int B>
BoundCombiner<B>::BoundCombiner(const ObstaclePlaces<B>& places, const std::vector<Bound<B>>& bounds,
                                const std::vector<FixedDirections<B>>& fixes)
    : places_(places), bounds_(bounds), size_(B > 1 ? places.size() : 0), rounding_(places.count(), -1) {
  for (const FixedDirections<B>& fixed : fixes)
    for (int k = 0; k < fixed.count; ++k) size_ = std::max(size_, std::fabs(fixed.value[k]));
}

template <int B>
const std::vector<CombinedBound<B>>& BoundCombiner<B>::combine(const Bound<B>* first, const Bound<B>* last,
                                                               const FixedDirections<B>* fixed,
                                                               std::vector<Bound<B>>& held) {
  reduced_.clear();
  combined_.clear();
  facets_.clear();
  find_functional(first, last);
  if (fixed) refuse_fixed_coordinates(first, last, *fixed);
  for (const Bound<B>* bound = first; bound != last; ++bound) reduce(*bound, fixed, held);
  if (reduced_.size() > 1)  // it takes memory
    std::stable_sort(reduced_.begin(), reduced_.end(), [this](const Reduced& a, const Reduced& b) {
      const bool a_rules = rules(a), b_rules = rules(b);
      return a_rules != b_rules ? a_rules : !a_rules && a.distance() < b.distance();
    });
  for (const Reduced& bound : reduced_) merge(bound);
  for (CombinedBound<B>& bound : combined_) check_order(bound, first->vertex);
  for (CombinedBound<B>& bound : facets_) check_order(bound, first->vertex);
  if (!facets_.empty()) check_room(first->vertex);
  return combined_;
}

template <int B>
void BoundCombiner<B>::find_functional(const Bound<B>* first, const Bound<B>* last) {
  functional_ = nullptr;
  for (const Bound<B>* bound = first; bound != last; ++bound) {
    if (bound->data < 0 || is_friction_on_axis(*bound)) continue;
    if (functional_)
      input_error(places_.origin(bound->obstacle),
                  fmt::format("acts at {} together with {}, and two obstacles with friction or another energy of their "
                              "own at one vertex are not available in this version",
                              places_.place(bound->vertex), places_.origin(functional_->obstacle)));
    functional_ = bound;
  }
}

/// Where nothing can slide, for the radial displacement is prescribed, and the obstacle's direction is oblique to it.
template <int B>
bool BoundCombiner<B>::is_friction_on_axis(const Bound<B>& bound) const {
  if (!places_.on_axis(bound.vertex)) return false;
  return places_.obstacle(bound.obstacle)->friction() && is_oblique(std::fabs(bound.direction[B - 1]));
}

// A functional that has coordinates of its own counts on all of them.
template <int B>
void BoundCombiner<B>::refuse_fixed_coordinates(const Bound<B>* first, const Bound<B>* last,
                                                const FixedDirections<B>& fixed) const {
  if (!functional_ || fixed.count == B) return;
  const Index obstacle = functional_->obstacle;
  if (std::count_if(first, last, [&](const Bound<B>& bound) { return bound.obstacle == obstacle; }) == 1) return;
  input_error(places_.origin(obstacle),
              fmt::format("adds an energy of several directions at {}, where a direction is prescribed, which is not "
                          "available in this version",
                          places_.place(functional_->vertex)));
}

// Takes out of a bound what is prescribed: direction . v = prescribed + |rest| (rest / |rest|) . v.
template <int B>
void BoundCombiner<B>::reduce(const Bound<B>& bound, const FixedDirections<B>* fixed, std::vector<Bound<B>>& held) {
  Reduced out{bound.direction, bound.lower, bound.upper, &bound};
  if (!fixed) {
    reduced_.push_back(out);
    return;
  }
  double prescribed = 0;
  for (int k = 0; k < fixed->count; ++k) {
    double c = 0;
    for (int i = 0; i < B; ++i) c += out.direction[i] * fixed->direction[k][i];
    for (int i = 0; i < B; ++i) out.direction[i] -= c * fixed->direction[k][i];
    prescribed += c * fixed->value[k];
  }
  const double length = normalise(out.direction);
  if (&bound == functional_ && is_oblique(length) && fixed->count < B)
    input_error(places_.origin(bound.obstacle),
                fmt::format("meets a direction prescribed at {} that is neither along its normal nor across it, which "
                            "is not available in this version",
                            places_.place(bound.vertex)));
  if (length > same_direction) {
    out.lower = (bound.lower - prescribed) / length;
    out.upper = (bound.upper - prescribed) / length;
    reduced_.push_back(out);
    return;
  }
  const double violation = std::max(bound.lower - prescribed, prescribed - bound.upper);
  if (violation > 0 && violation > rounding(bound.obstacle))
    no_solution(bound.obstacle, bound.vertex,
                fmt::format("obstacle beyond the fixed boundary: the fixed value {} lies {} the obstacle's bound {}",
                            prescribed, prescribed < bound.lower ? "below" : "above",
                            (prescribed < bound.lower ? bound.lower : bound.upper) + 0.0));  // no -0
  if (violation >= -rounding(bound.obstacle)) held.push_back(bound);
}

// Takes a bound into the combined ones along its direction, or beside them.
template <int B>
void BoundCombiner<B>::merge(const Reduced& bound) {
  const Index obstacle = bound.from->obstacle;
  for (auto* known : {&combined_, &facets_})
    for (CombinedBound<B>& other : *known) {
      const double sign = dot(bound.direction, other.direction) > 0 ? 1 : -1;
      double apart = 0;
      for (int i = 0; i < B; ++i) apart = std::max(apart, std::fabs(bound.direction[i] - sign * other.direction[i]));
      if (apart > parallel) continue;
      const double lower = sign > 0 ? bound.lower : -bound.upper, upper = sign > 0 ? bound.upper : -bound.lower;
      // Of two that touch at once the one with a functional presses, not the one that rounding puts in front.
      const double tie = functional_ && other.lower_from == functional_ ? rounding(obstacle) : 0;
      const bool same = bound.from->direction == other.lower_from->direction || lower == -infinity;
      if (!same && std::abs(lower - other.lower) <= rounding(obstacle))
        other.tied = true;
      else if (lower > other.lower)
        other.tied = false;
      if (lower > other.lower + tie)
        other.lower = lower, other.lower_obstacle = obstacle, other.lower_from = bound.from;
      if (upper < other.upper) other.upper = upper, other.upper_obstacle = obstacle, other.upper_from = bound.from;
      return;
    }
  const bool direction = functional_ ? bound.from == functional_ || (rules(bound) && independent_of_combined(bound))
                                     : independent_of_combined(bound);
  (direction ? combined_ : facets_)
      .push_back({bound.direction, bound.lower, bound.upper, obstacle, obstacle, bound.from, bound.from});
}

template <int B>
bool BoundCombiner<B>::mixes_types() const {
  const auto type = [this](Index k) { return places_.obstacle(k)->descriptor(); };
  return std::any_of(reduced_.begin(), reduced_.end(), [&](const Reduced& bound) {
    const Index first = reduced_.front().from->obstacle, other = bound.from->obstacle;
    return other != first && !type(other).same_type(type(first));
  });
}

template <int B>
bool BoundCombiner<B>::independent_of_combined(const Reduced& bound) const {
  const std::size_t count = combined_.size();
  if (count == B) return false;
  double directions[B * B];
  for (std::size_t k = 0; k < count; ++k) std::copy_n(combined_[k].direction.begin(), B, directions + k * B);
  std::copy_n(bound.direction.begin(), B, directions + count * B);
  return separation<B>(directions, static_cast<int>(count) + 1) >= independent;
}

template <int B>
void BoundCombiner<B>::check_order(CombinedBound<B>& bound, Index vertex) {
  if (bound.lower <= bound.upper) return;
  if (bound.lower - bound.upper > std::max(rounding(bound.lower_obstacle), rounding(bound.upper_obstacle)))
    no_solution(
        bound.lower_obstacle, vertex,
        fmt::format("lower bound {} above the upper bound {}{}", bound.lower, bound.upper,
                    bound.lower_obstacle == bound.upper_obstacle ? "" : " of " + places_.origin(bound.upper_obstacle)));
  bound.lower = bound.upper = 0.5 * (bound.lower + bound.upper);
}

// Where directions and faces leave a point but for rounding, they leave it.
template <int B>
void BoundCombiner<B>::check_room(Index vertex) {
  const std::array<std::vector<CombinedBound<B>>*, 2> all{&combined_, &facets_};
  tolerated_ = 0;
  for (const Reduced& bound : reduced_) tolerated_ = std::max(tolerated_, rounding(bound.from->obstacle));
  std::vector<Facet<B>> faces;
  double lower[B], upper[B], unit[B * B] = {}, nowhere[B] = {}, y[B];
  std::fill_n(lower, B, -infinity);
  std::fill_n(upper, B, infinity);
  for (int i = 0; i < B; ++i) unit[i * (B + 1)] = 1;
  for (const auto* bounds : all)
    for (const CombinedBound<B>& bound : *bounds) {
      Facet<B>& face = faces.emplace_back(Facet<B>{{}, bound.lower, bound.upper, tolerated_});
      std::copy_n(bound.direction.begin(), B, face.normal);
    }
  if (!Polyhedron<B>(lower, upper, faces.data(), faces.data() + faces.size()).nearest(unit, nowhere, y)) {
    std::vector<std::string> others;
    for (const Reduced& bound : reduced_)
      if (const std::string name = places_.origin(bound.from->obstacle);
          bound.from->obstacle != reduced_[0].from->obstacle &&
          std::find(others.begin(), others.end(), name) == others.end())
        others.push_back(name);
    no_solution(reduced_[0].from->obstacle, vertex,
                others.empty() ? "it leaves no room"
                               : fmt::format("together with {} it leaves no room", fmt::join(others, ", ")));
  }
  for (auto* bounds : all)
    for (CombinedBound<B>& bound : *bounds) {
      double value = 0;
      for (int i = 0; i < B; ++i) value += bound.direction[i] * y[i];
      bound.lower = std::min(bound.lower, value);
      bound.upper = std::max(bound.upper, value);
    }
}

// 1e-12 of the numbers that bounds are compared with and computed from. The median, for users write 1e30 for infinity.
template <int B>
double BoundCombiner<B>::rounding(Index obstacle) {
  double& rounding = rounding_[obstacle];
  if (rounding >= 0) return rounding;
  std::vector<double> sizes;
  for (const Bound<B>& bound : bounds_)
    if (bound.obstacle == obstacle)
      for (const double value : {bound.lower, bound.upper})
        if (std::isfinite(value)) sizes.push_back(std::fabs(value));
  double median = 0;
  if (const auto middle = sizes.begin() + static_cast<Offset>(sizes.size() / 2); middle != sizes.end()) {
    std::nth_element(sizes.begin(), middle, sizes.end());
    median = *middle;
  }
  return rounding = rounding_of_differences * (median + size_);
}

template <int B>
void BoundCombiner<B>::no_solution(Index obstacle, Index vertex, const std::string& why) const {
  throw Error(Exit::no_solution,
              fmt::format("{}: no solution at {}: {}", places_.origin(obstacle), places_.place(vertex), why));
}

template class BoundCombiner<1>;
template class BoundCombiner<2>;
template class BoundCombiner<3>;

}  // namespace signorini
