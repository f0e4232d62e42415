#include "core/constraints/bound_collector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/algebra/local_basis.hpp"
#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/component/failure.hpp"

namespace signorini {
namespace {

constexpr Index batch = 4096;  // vertices per call of a plugin

}  // namespace

template <int B>
BoundCollector<B>::BoundCollector(const ObstaclePlaces<B>& places, Index obstacle, std::vector<Bound<B>>& bounds,
                                  std::vector<FunctionalNumbers<B>>& numbers)
    : places_(places),
      number_(obstacle),
      obstacle_(*places.obstacle(obstacle)),
      bounds_(bounds),
      functionals_(numbers),
      functional_(obstacle_.functional() != nullptr),
      told_(obstacle_.descriptor().data),
      describes_none_(obstacle_.descriptor().directions == 0) {}

template <int B>
void BoundCollector<B>::push(Index vector, const SurfaceVertex& at, double part) {
  vectors_.push_back(vector);
  parts_.push_back(part);
  if (vertices_.emplace_back(at); vertices_.size() == batch) flush();
}

template <int B>
void BoundCollector<B>::flush() {
  constraints_.assign(vertices_.size(), LocalConstraint<B>{});
  Status status;
  obstacle_.assemble(vertices_.data(), vertices_.size(), constraints_.data(), status);
  places_.check_asked(number_);
  if (!status.ok()) refuse(status);
  for (std::size_t i = 0; i < vectors_.size(); ++i) {
    check_directions(vectors_[i], constraints_[i].directions);
    rules_ = false;
    for (int k = 0; k < constraints_[i].directions; ++k) add(vectors_[i], vertices_[i], parts_[i], constraints_[i], k);
  }
  vectors_.clear();
  parts_.clear();
  vertices_.clear();
}

/// Names the first vertex at which the obstacle fails alone.
template <int B>
void BoundCollector<B>::refuse(const Status& status) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    LocalConstraint<B> alone;
    Status again;
    obstacle_.assemble(&vertices_[i], 1, &alone, again);
    if (again.ok()) continue;
    first = i;
    break;
  }
  throw_failure(status, vectors_.empty() ? places_.origin(number_) : places_.origin_at(number_, vectors_[first]));
}

template <int B>
void BoundCollector<B>::check_directions(Index vector, int directions) const {
  if (directions < 0 || directions > B)
    throw Error(Exit::plugin, fmt::format("{}: the plugin bounds {} directions at {}, expected 0 to {}",
                                          places_.origin(number_), directions, places_.place(vector), B));
  if (directions > 0 && describes_none_)
    throw Error(
        Exit::plugin,
        fmt::format("{}: the plugin bounds {} at {}, and its descriptor has no direction", places_.origin(number_),
                    directions == 1 ? "a direction" : fmt::format("{} directions", directions), places_.place(vector)));
}

template <int B>
void BoundCollector<B>::add(Index vector, const SurfaceVertex& at, double part, const LocalConstraint<B>& constraint,
                            int k) {
  Bound<B> bound{vector, number_, {}, constraint.lower[k], constraint.upper[k]};
  std::copy_n(constraint.direction[k], B, bound.direction.begin());
  bound.lower *= part;
  bound.upper *= part;
  bound.gap = (0 - at.gap) * part;
  bound.part = part;
  const double length = normalise(bound.direction);
  // Fields of the user are finite, see Field: whatever else is not is the plugin's.
  if (!(std::fabs(length - 1) < same_direction))
    blame(vector, fmt::format("gives direction {} of length {}, expected a unit vector", k, length));
  if (std::isnan(bound.lower) || std::isnan(bound.upper))
    blame(vector, fmt::format("gives direction {} a bound that is not a number", k));
  if (bound.lower == infinity || bound.upper == -infinity)
    throw Error(Exit::no_solution,
                fmt::format("{}: no solution: the {} at {} leaves nothing admissible", places_.origin(number_),
                            bound.lower == infinity ? "infinite lower bound" : "upper bound of minus infinity",
                            places_.place(vector)));
  const bool bounded = bound.lower > -infinity || bound.upper < infinity;
  const bool numbers = functional_ && k == 0 && has_numbers(constraint, vector);
  if (functional_ && k == 0 && (told_ == 0 || numbers || bounded)) {
    rules_ = true;
    bound.data = static_cast<Index>(functionals_.size());
    add_functional(at, constraint);
  }
  if (rules_ || bounded) bounds_.push_back(bound);
}

template <int B>
void BoundCollector<B>::add_functional(const SurfaceVertex& at, const LocalConstraint<B>& constraint) {
  Status status;
  FunctionalNumbers<B>& numbers = functionals_.emplace_back();
  std::copy(std::begin(constraint.data), std::end(constraint.data), numbers.data.begin());
  numbers.motion = places_.motion(number_, at, status);
  if (!status.ok()) throw_failure(status, places_.origin(number_));
}

/// Any but zeros. Those beyond what the descriptor tells are kept nowhere.
template <int B>
bool BoundCollector<B>::has_numbers(const LocalConstraint<B>& constraint, Index vector) const {
  bool any = false;
  for (int k = 0; k < most_data; ++k) {
    const double value = constraint.data[k];
    if (k >= told_ && value != 0)
      throw Error(Exit::plugin,
                  fmt::format("{}: the plugin gives its functional {} numbers at {}, and its descriptor tells of {}",
                              places_.origin(number_), k + 1, places_.place(vector), told_));
    if (!std::isfinite(value))
      blame(vector, fmt::format("gives its functional a number {} that is not finite ({})", k, value));
    any = any || value != 0;
  }
  return any;
}

template <int B>
void BoundCollector<B>::blame(Index vector, const std::string& what) const {
  throw Error(Exit::plugin,
              fmt::format("{}: at {} the plugin {}", places_.origin(number_), places_.place(vector), what));
}

template class BoundCollector<1>;
template class BoundCollector<2>;
template class BoundCollector<3>;

}  // namespace signorini
