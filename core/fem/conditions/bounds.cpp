#include "core/fem/conditions/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/algebra/local_basis.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/component/failure.hpp"
#include "core/component/settings.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/model/obstacle_motion.hpp"
#include "core/sdk/polyhedron.hpp"

namespace signorini {
namespace {

constexpr double independent = 0.02;  // separation() from which local coordinates are well conditioned
constexpr double parallel =
    rounding_of_bases;         // distance of unit vectors that are one direction, far below any tolerance
constexpr Index batch = 4096;  // vertices per call of a plugin

template <int D>
std::string position(const Nodes<D>& nodes, Index p) {
  return fmt::format("({})", fmt::join(nodes.at(p), ", "));
}

/// Of a unit vector what is across prescribed directions.
bool is_oblique(double length) { return length > same_direction && length < 1 - same_direction; }

// The nodes an obstacle may touch; on the boundary with normals of the faces it may touch.
template <int D>
struct Candidates {
  Surface<D> surface;
  std::vector<Point<D>> normals;
  bool everywhere;
  std::vector<double> areas, volumes;  // per node of the surface or of all: SurfaceVertex::measure for functionals

  template <int B>
  Candidates(const Nodes<D>& nodes, const Model<B>& model, const ObstacleTerm<B>& term)
      : surface(term.on ? signorini::surface(nodes, select_faces(nodes.mesh(), *term.on, model.t))
                        : signorini::surface(nodes)),
        normals(node_normals(nodes, surface)),
        everywhere(!term.on) {
    if (!term.obstacle->functional()) return;
    if (B == 1 && everywhere)
      volumes = node_volumes(nodes, model.plane);
    else
      areas = node_areas(nodes, surface, model.plane);
  }

  Index size(const Nodes<D>& nodes) const {
    return everywhere ? nodes.size() : static_cast<Index>(surface.nodes.size());
  }

  // Calls use(node, normal, measure) by ascending node.
  template <class Use>
  void each(const Nodes<D>& nodes, const Use& use) const {
    const auto on_surface = static_cast<Index>(surface.nodes.size());
    Index next = 0;
    for (Index k = 0; k < size(nodes); ++k) {
      const Index p = everywhere ? k : surface.nodes[k];
      const bool here = next < on_surface && surface.nodes[next] == p;
      const double measure = !volumes.empty() ? volumes[p] : here && !areas.empty() ? areas[next] : 0;
      use(p, here ? normals[next] : Point<D>{}, measure);
      next += here;
    }
  }
};

template <int D, int B>
class Collector {
 public:
  Collector(const Nodes<D>& nodes, const Model<B>& model, std::vector<Bound<B>>& bounds,
            std::vector<FunctionalNumbers<B>>& functionals, const PairedBodies<B>* pairing)
      : nodes_(nodes),
        model_(model),
        bounds_(bounds),
        functionals_(functionals),
        pairing_(pairing),
        constraints_(batch) {}

  void collect(Index obstacle) {
    obstacle_ = obstacle;
    const Candidates<D> candidates(nodes_, model_, model_.obstacles[obstacle]);
    if (bounds_.empty()) bounds_.reserve(static_cast<std::size_t>(candidates.size(nodes_)));
    const Obstacle<B>& of = *model_.obstacles[obstacle].obstacle;
    functional_ = of.functional() != nullptr;
    told_ = of.descriptor().data;
    describes_none_ = of.descriptor().directions == 0;
    if (model_.obstacles[obstacle].other)
      collect_paired(candidates);
    else
      candidates.each(nodes_, [&](Index p, const Point<D>& normal, double measure) { push(p, normal, measure); });
    flush();
  }

 private:
  /// The nodes that the other body is in front of.
  void collect_paired(const Candidates<D>& candidates) {
    auto next = std::ranges::find(pairing_->nodes, obstacle_, &PairedNode<B>::obstacle);
    candidates.each(nodes_, [&](Index p, const Point<D>& normal, double measure) {
      if (next == pairing_->nodes.end() || next->obstacle != obstacle_ || next->node != p) return;
      push(p, normal, measure, &*next++);
    });
  }

  void push(Index p, const Point<D>& normal, double measure, const PairedNode<B>* pair = nullptr) {
    SurfaceVertex v{};
    v.measure = measure;
    v.vertex = nodes_.vertex(p);
    std::copy_n(nodes_.at(p).data(), D, v.position);
    std::copy_n(normal.data(), D, v.normal);
    if (pair) {
      v.gap = pair->gap;
      std::copy_n(pair->away.data(), B, v.away);
    }
    numbers_.push_back(p);
    parts_.push_back(pair ? pair->part : 1);
    if (vertices_.emplace_back(v); vertices_.size() == batch) flush();
  }

  void flush() {
    const ObstacleTerm<B>& term = model_.obstacles[obstacle_];
    std::fill(constraints_.begin(), constraints_.end(), LocalConstraint<B>{});
    Status status;
    term.obstacle->assemble(vertices_.data(), vertices_.size(), constraints_.data(), status);
    if (term.settings) check_asked(*term.settings, term.origin);
    if (!status.ok()) throw_failure(status, term.origin);
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      check_directions(numbers_[i], constraints_[i].directions);
      rules_ = false;
      for (int k = 0; k < constraints_[i].directions; ++k)
        add(numbers_[i], vertices_[i], parts_[i], constraints_[i], k);
    }
    numbers_.clear();
    parts_.clear();
    vertices_.clear();
  }

  void check_directions(Index vertex, int directions) const {
    if (directions < 0 || directions > B)
      throw Error(Exit::plugin,
                  fmt::format("{}: the plugin bounds {} directions at {}, expected 0 to {}",
                              model_.obstacles[obstacle_].origin, directions, position(nodes_, vertex), B));
    if (directions > 0 && describes_none_)
      throw Error(Exit::plugin, fmt::format("{}: the plugin bounds {} at {}, and its descriptor has no direction",
                                            model_.obstacles[obstacle_].origin,
                                            directions == 1 ? "a direction" : fmt::format("{} directions", directions),
                                            position(nodes_, vertex)));
  }

  /// @param part of its bounds, see PairedNode
  void add(Index vertex, const SurfaceVertex& at, double part, const LocalConstraint<B>& constraint, int k) {
    Bound<B> bound{vertex, obstacle_, {}, constraint.lower[k], constraint.upper[k]};
    std::copy_n(constraint.direction[k], B, bound.direction.begin());
    if (model_.obstacles[obstacle_].other) bound.gap = -at.gap;
    bound.lower *= part;
    bound.upper *= part;
    bound.gap *= part;
    bound.part = part;
    const double length = normalise(bound.direction);
    const std::string& origin = model_.obstacles[obstacle_].origin;
    // Fields of the user are finite, see Field: whatever else is not is the plugin's.
    if (!(std::fabs(length - 1) < same_direction))
      blame(vertex, fmt::format("gives direction {} of length {}, expected a unit vector", k, length));
    if (std::isnan(bound.lower) || std::isnan(bound.upper))
      blame(vertex, fmt::format("gives direction {} a bound that is not a number", k));
    if (bound.lower == infinity || bound.upper == -infinity)
      throw Error(Exit::no_solution,
                  fmt::format("{}: no solution: the {} at {} leaves nothing admissible", origin,
                              bound.lower == infinity ? "infinite lower bound" : "upper bound of minus infinity",
                              position(nodes_, vertex)));
    const bool bounded = bound.lower > -infinity || bound.upper < infinity;
    const bool numbers = functional_ && k == 0 && has_numbers(constraint, vertex);
    if (functional_ && k == 0 && (told_ == 0 || numbers || bounded)) {
      rules_ = true;
      bound.data = static_cast<Index>(functionals_.size());
      add_functional(at, constraint);
    }
    if (rules_ || bounded) bounds_.push_back(bound);
  }

  void add_functional(const SurfaceVertex& at, const LocalConstraint<B>& constraint) {
    Status status;
    FunctionalNumbers<B>& numbers = functionals_.emplace_back();
    std::copy(std::begin(constraint.data), std::end(constraint.data), numbers.data.begin());
    numbers.motion = obstacle_motion(model_.obstacles[obstacle_], at, status);
    if (!status.ok()) throw_failure(status, model_.obstacles[obstacle_].origin);
  }

  [[noreturn]] void blame(Index vertex, const std::string& what) const {
    throw Error(Exit::plugin, fmt::format("{}: at {} the plugin {}", model_.obstacles[obstacle_].origin,
                                          position(nodes_, vertex), what));
  }

  // Any but zeros. Those beyond what the descriptor tells are kept nowhere.
  bool has_numbers(const LocalConstraint<B>& constraint, Index vertex) const {
    bool any = false;
    for (int k = 0; k < most_data; ++k) {
      const double value = constraint.data[k];
      if (k >= told_ && value != 0)
        throw Error(Exit::plugin,
                    fmt::format("{}: the plugin gives its functional {} numbers at {}, and its descriptor tells of {}",
                                model_.obstacles[obstacle_].origin, k + 1, position(nodes_, vertex), told_));
      if (!std::isfinite(value))
        blame(vertex, fmt::format("gives its functional a number {} that is not finite ({})", k, value));
      any = any || value != 0;
    }
    return any;
  }

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  std::vector<Bound<B>>& bounds_;
  std::vector<FunctionalNumbers<B>>& functionals_;
  const PairedBodies<B>* pairing_;
  Index obstacle_ = 0;
  bool functional_ = false;
  int told_ = 0;  // numbers of its own that the descriptor tells of
  bool describes_none_ = false;
  bool rules_ = false;  // its functional acts at the vertex, all of whose directions are coordinates then
  std::vector<Index> numbers_;
  std::vector<double> parts_;
  std::vector<SurfaceVertex> vertices_;
  std::vector<LocalConstraint<B>> constraints_;
};

}  // namespace

template <int D, int B>
std::vector<Bound<B>> collect_bounds(const Nodes<D>& nodes, const Model<B>& model,
                                     std::vector<FunctionalNumbers<B>>& numbers, const PairedBodies<B>* pairing) {
  std::vector<Bound<B>> bounds;
  Collector<D, B> collector(nodes, model, bounds, numbers, pairing);
  for (std::size_t k = 0; k < model.obstacles.size(); ++k) collector.collect(static_cast<Index>(k));
  if (model.obstacles.size() > 1)
    std::stable_sort(bounds.begin(), bounds.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  return bounds;
}

template <int D, int B>
BoundCombiner<D, B>::BoundCombiner(const Nodes<D>& nodes, const Model<B>& model, const std::vector<Bound<B>>& bounds,
                                   const std::vector<FixedDirections<B>>& fixes)
    : nodes_(nodes), model_(model), bounds_(bounds), size_(0), rounding_(model.obstacles.size(), -1) {
  for (const FixedDirections<B>& fixed : fixes)
    for (int k = 0; k < fixed.count; ++k) size_ = std::max(size_, std::fabs(fixed.value[k]));
  if (B > 1)
    for (const Point<D>& x : nodes.mesh().points)
      for (const double c : x) size_ = std::max(size_, std::fabs(c));
}

template <int D, int B>
const std::vector<CombinedBound<B>>& BoundCombiner<D, B>::combine(const Bound<B>* first, const Bound<B>* last,
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

template <int D, int B>
void BoundCombiner<D, B>::find_functional(const Bound<B>* first, const Bound<B>* last) {
  functional_ = nullptr;
  for (const Bound<B>* bound = first; bound != last; ++bound) {
    if (bound->data < 0 || is_friction_on_axis(*bound)) continue;
    if (functional_)
      input_error(model_.obstacles[bound->obstacle].origin,
                  fmt::format("acts at {} together with {}, and two obstacles with friction or another energy of their "
                              "own at one vertex are not available in this version",
                              position(nodes_, bound->vertex), model_.obstacles[functional_->obstacle].origin));
    functional_ = bound;
  }
}

/// Where nothing can slide, for the radial displacement is prescribed, and the obstacle's direction is oblique to it.
template <int D, int B>
bool BoundCombiner<D, B>::is_friction_on_axis(const Bound<B>& bound) const {
  if (B != D || model_.plane != Plane::axisymmetric || nodes_.at(bound.vertex)[0] != 0) return false;
  return model_.obstacles[bound.obstacle].obstacle->friction() && is_oblique(std::fabs(bound.direction[B - 1]));
}

// A functional that has coordinates of its own counts on all of them.
template <int D, int B>
void BoundCombiner<D, B>::refuse_fixed_coordinates(const Bound<B>* first, const Bound<B>* last,
                                                   const FixedDirections<B>& fixed) const {
  if (!functional_ || fixed.count == B) return;
  const Index obstacle = functional_->obstacle;
  if (std::count_if(first, last, [&](const Bound<B>& bound) { return bound.obstacle == obstacle; }) == 1) return;
  input_error(model_.obstacles[obstacle].origin,
              fmt::format("adds an energy of several directions at {}, where a direction is prescribed, which is not "
                          "available in this version",
                          position(nodes_, functional_->vertex)));
}

// Takes out of a bound what is prescribed: direction . v = prescribed + |rest| (rest / |rest|) . v.
template <int D, int B>
void BoundCombiner<D, B>::reduce(const Bound<B>& bound, const FixedDirections<B>* fixed, std::vector<Bound<B>>& held) {
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
    input_error(model_.obstacles[bound.obstacle].origin,
                fmt::format("meets a direction prescribed at {} that is neither along its normal nor across it, which "
                            "is not available in this version",
                            position(nodes_, bound.vertex)));
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
template <int D, int B>
void BoundCombiner<D, B>::merge(const Reduced& bound) {
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

template <int D, int B>
bool BoundCombiner<D, B>::mixes_types() const {
  const auto type = [this](Index k) { return model_.obstacles[k].obstacle->descriptor(); };
  return std::any_of(reduced_.begin(), reduced_.end(), [&](const Reduced& bound) {
    const Index first = reduced_.front().from->obstacle, other = bound.from->obstacle;
    return other != first && !type(other).same_type(type(first));
  });
}

template <int D, int B>
bool BoundCombiner<D, B>::independent_of_combined(const Reduced& bound) const {
  const std::size_t count = combined_.size();
  if (count == B) return false;
  double directions[B * B];
  for (std::size_t k = 0; k < count; ++k) std::copy_n(combined_[k].direction.begin(), B, directions + k * B);
  std::copy_n(bound.direction.begin(), B, directions + count * B);
  return separation<B>(directions, static_cast<int>(count) + 1) >= independent;
}

template <int D, int B>
void BoundCombiner<D, B>::check_order(CombinedBound<B>& bound, Index vertex) {
  if (bound.lower <= bound.upper) return;
  if (bound.lower - bound.upper > std::max(rounding(bound.lower_obstacle), rounding(bound.upper_obstacle)))
    no_solution(bound.lower_obstacle, vertex,
                fmt::format("lower bound {} above the upper bound {}{}", bound.lower, bound.upper,
                            bound.lower_obstacle == bound.upper_obstacle
                                ? ""
                                : " of " + model_.obstacles[bound.upper_obstacle].origin));
  bound.lower = bound.upper = 0.5 * (bound.lower + bound.upper);
}

// Where directions and faces leave a point but for rounding, they leave it.
template <int D, int B>
void BoundCombiner<D, B>::check_room(Index vertex) {
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
      if (const std::string& name = model_.obstacles[bound.from->obstacle].origin;
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
template <int D, int B>
double BoundCombiner<D, B>::rounding(Index obstacle) {
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

template <int D, int B>
void BoundCombiner<D, B>::no_solution(Index obstacle, Index vertex, const std::string& why) const {
  throw Error(Exit::no_solution, fmt::format("{}: no solution at {}: {}", model_.obstacles[obstacle].origin,
                                             position(nodes_, vertex), why));
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                                   \
  template std::vector<Bound<B>> collect_bounds(const Nodes<D>&, const Model<B>&, std::vector<FunctionalNumbers<B>>&, \
                                                const PairedBodies<B>*);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE
template class BoundCombiner<2, 1>;
template class BoundCombiner<3, 1>;
template class BoundCombiner<2, 2>;
template class BoundCombiner<3, 3>;

}  // namespace signorini
