#include "core/constraints/localise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/algebra/local_basis.hpp"
#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/constraints/bound_combiner.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/polyhedral_box.hpp"

namespace signorini {
namespace {

template <int B>
class Localiser {
 public:
  Localiser(const ObstaclePlaces<B>& places, std::size_t vectors, const std::vector<FixedDirections<B>>& fixes,
            const std::vector<Bound<B>>& bounds, const std::vector<FunctionalNumbers<B>>& functionals)
      : places_(places), fixes_(fixes), bounds_(bounds), functionals_(functionals), combiner_(places, bounds, fixes) {
    problem().fixed.assign(vectors, 0);
    problem().start.assign(vectors * B, 0);
    constraints().slot.assign(vectors, -1);
    for (Index k = 0; !functionals.empty() && k < places.count(); ++k)
      if (const Obstacle<B>& obstacle = *places.obstacle(k); obstacle.functional())
        constraints().width = std::max({1, constraints().width, obstacle.descriptor().data});
  }

  LocalisedProblem<B> run() {
    reserve(bounds_.size());
    localise();
    add_segments();
    for (const Bound<B>& bound : held_) hold(bound);
    return std::move(out_);
  }

 private:
  DiscreteProblem<B>& problem() { return out_.problem; }
  Constraints<B>& constraints() { return out_.problem.constraints; }

  void reserve(std::size_t slots) {
    constraints().vector.reserve(slots);
    for (auto* bounds : {&constraints().lower, &constraints().upper}) bounds->reserve(slots * B);
    for (auto* obstacles : {&out_.lower_obstacle, &out_.upper_obstacle}) obstacles->reserve(slots * B);
    out_.tied.reserve(slots * B);
  }

  // Visits the nodes with fixes or bounds in ascending order.
  void localise() {
    auto fix = fixes_.begin();
    auto bound = bounds_.begin();
    while (fix != fixes_.end() || bound != bounds_.end()) {
      const bool fix_first = bound == bounds_.end() || (fix != fixes_.end() && fix->vertex <= bound->vertex);
      const Index p = fix_first ? fix->vertex : bound->vertex;
      const auto last = std::find_if(bound, bounds_.end(), [p](const Bound<B>& b) { return b.vertex != p; });
      localise(p, fix_first ? &*fix : nullptr, bounds_.data() + (bound - bounds_.begin()),
               bounds_.data() + (last - bounds_.begin()));
      bound = last;
      if (fix_first) ++fix;
    }
  }

  void localise(Index p, const FixedDirections<B>* fixed, const Bound<B>* first, const Bound<B>* last) {
    static const std::vector<CombinedBound<B>> none;
    const auto& combined = first == last ? none : combiner_.combine(first, last, fixed, held_);
    // What cannot move does not change a functional.
    const Bound<B>* functional = first == last || (fixed && fixed->count == B) ? nullptr : combiner_.functional();
    if (functional && !combined.empty() && cannot_press(*functional, combined.front())) functional = nullptr;
    const auto& faces = first == last ? none : combiner_.facets();
    const bool constrained = !combined.empty() || !faces.empty() || functional;
    if (constrained) add_constraint(p, combined);
    if (B > 1 && fixed && !combined.empty()) add_reduced(combined);
    if (fixed && !constrained && (fixed->count == B || fixed->along_axes()))
      prescribe_global(p, *fixed);
    else if (fixed)
      prescribe_last(p, *fixed);
    if (B > 1 && (constrained || (fixed && fixed->count < B && !fixed->along_axes())))
      add_frame(p, combined, fixed, !faces.empty());
    if (constrained && constraints().width > 0) add_functional(p, functional);
    if (functional) refuse_unknown_force(p, *functional, !faces.empty());
    if (!faces.empty()) add_facets(p, faces);
    if (constrained) own_.push_back(!functional && (!faces.empty() || combiner_.mixes_types()));
  }

  // To the slot added last.
  void add_functional(Index p, const Bound<B>* bound) {
    out_.functional.push_back(bound ? bound->obstacle : -1);
    std::vector<double>& data = constraints().data;
    data.resize(data.size() + static_cast<std::size_t>(constraints().width));
    constraints().before.resize(data.size());
    constraints().tangential.push_back(0);
    constraints().last.resize(constraints().last.size() + B);
    if (!bound) return;
    const FunctionalNumbers<B>& numbers = functionals_[bound->data];
    std::copy_n(numbers.data.begin(), constraints().width, data.end() - constraints().width);
    const double* N = problem().frames.dual_at(p);
    double* last = constraints().last.data() + constraints().last.size() - B;  // of what sticks to the obstacle
    std::copy_n(numbers.motion.begin(), B, last);
    if (N) block::transposed_product<B>(N, numbers.motion.data(), last);
    for (int k = 0; k < B; ++k) {
      double across = 0;
      for (int i = 0; i < B; ++i) across += (N ? N[i * B + k] : i == k ? 1.0 : 0.0) * bound->direction[i];
      if (std::fabs(across) < same_direction) constraints().tangential.back() |= static_cast<Flags>(1u << k);
      if (!(problem().fixed[p] >> k & 1u)) continue;
      const std::size_t at = constraints().lower.size() - B + static_cast<std::size_t>(k);
      constraints().lower[at] = constraints().upper[at] = problem().start[Offset{p} * B + k];
    }
  }

  /// Friction by the force of an obstacle that another one along the same direction is in front of: there is none.
  bool cannot_press(const Bound<B>& bound, const CombinedBound<B>& along) const {
    const Obstacle<B>& obstacle = *places_.obstacle(bound.obstacle);
    if (along.lower_from == &bound || !obstacle.renewal()) return false;
    const Friction* friction = obstacle.friction();
    const FrictionLaw law = friction ? friction->law(functionals_[bound.data].data.data()) : FrictionLaw{1, 1};
    if (law.coefficient == 0) return false;
    if (law.bound == 0) return true;
    input_error(places_.origin(bound.obstacle),
                fmt::format("at {} {} is nearer along the same direction, so that the force that its "
                            "friction depends on is another one's, which is not available in this "
                            "version",
                            places_.place(bound.vertex), places_.origin(along.lower_obstacle)));
  }

  /// A functional that follows the force along its direction has to know that.
  void refuse_unknown_force(Index p, const Bound<B>& bound, bool has_faces) const {
    const Obstacle<B>& obstacle = *places_.obstacle(bound.obstacle);
    const Friction* friction = obstacle.friction();
    const bool given = friction && friction->law(functionals_[bound.data].data.data()).coefficient == 0;
    if (!obstacle.renewal() || given) return;
    const bool held = out_.problem.fixed[p] & ~out_.problem.constraints.tangential.back();
    if (!has_faces && !held) return;
    input_error(
        places_.origin(bound.obstacle),
        fmt::format("at {} {}, so that the force that friction depends on is not known there, which is not "
                    "available in this version{}",
                    places_.place(p),
                    has_faces ? "other obstacles hold the body along other directions"
                              : "a fix prescribes the displacement along the normal",
                    has_faces ? "; one obstacle whose 'distance' is the least of theirs may take their place" : ""));
  }

  void prescribe_global(Index p, const FixedDirections<B>& fixed) {
    double* start = problem().start.data() + Offset{p} * B;
    for (int k = 0; k < fixed.count; ++k)
      for (int i = 0; i < B; ++i) {
        start[i] += fixed.value[k] * fixed.direction[k][i];
        if (fixed.direction[k][i] != 0) problem().fixed[p] |= static_cast<Flags>(1u << i);
      }
  }

  // The fixed directions are the last local ones.
  void prescribe_last(Index p, const FixedDirections<B>& fixed) {
    for (int k = 0; k < fixed.count; ++k) {
      const int component = B - fixed.count + k;
      problem().start[Offset{p} * B + component] = fixed.value[k];
      problem().fixed[p] |= static_cast<Flags>(1u << component);
    }
  }

  // Faces change how a vector is interpolated, which is by its frame.
  void add_frame(Index p, const std::vector<CombinedBound<B>>& combined, const FixedDirections<B>* fixed,
                 bool has_facets) {
    double leading[B * B], Q[B * B], N[B * B];
    for (std::size_t k = 0; k < combined.size(); ++k) std::copy_n(combined[k].direction.begin(), B, leading + k * B);
    local_basis<B>(leading, static_cast<int>(combined.size()), fixed ? fixed->direction[0] : nullptr,
                   fixed ? fixed->count : 0, Q, N);
    bool identity = !has_facets;
    for (int i = 0; i < B * B; ++i) identity = identity && N[i] == (i % (B + 1) == 0 ? 1 : 0);
    if (!identity) problem().frames.add(problem().fixed.size(), p, Q, N);
  }

  void add_constraint(Index p, const std::vector<CombinedBound<B>>& combined) {
    constraints().slot[p] = constraints().size();
    constraints().vector.push_back(p);
    for (std::size_t k = 0; k < B; ++k) {
      const bool here = k < combined.size();
      // A scalar unknown has no frame: -v is bounded by turning the bounds.
      const bool turned = B == 1 && here && combined[k].direction[0] < 0;
      const double lower = here ? combined[k].lower : -infinity, upper = here ? combined[k].upper : infinity;
      const Index below = here && lower > -infinity ? combined[k].lower_obstacle : -1;
      const Index above = here && upper < infinity ? combined[k].upper_obstacle : -1;
      constraints().lower.push_back(turned ? -upper : lower);
      constraints().upper.push_back(turned ? -lower : upper);
      out_.lower_obstacle.push_back(turned ? above : below);
      out_.upper_obstacle.push_back(turned ? below : above);
      out_.tied.push_back(here && combined[k].tied);
    }
  }

  /// To the slot added last.
  void add_facets(Index p, const std::vector<CombinedBound<B>>& faces) {
    Constraints<B>& c = constraints();
    if (c.facet_row.empty()) c.facet_row.assign(1, 0);
    c.facet_row.resize(static_cast<std::size_t>(c.size()), static_cast<Offset>(c.facet.size()));
    for (const CombinedBound<B>& bound : faces) {
      Facet<B>& face = c.facet.emplace_back(Facet<B>{{}, bound.lower, bound.upper, combiner_.tolerated()});
      block::transposed_product<B>(problem().frames.at(p), bound.direction.data(), face.normal);
      for (int k = 0; k < B; ++k)
        if (problem().fixed[p] >> k & 1u) face.normal[k] = 0;
      FacetSource<B> source{
          {bound.lower > -infinity ? bound.lower_obstacle : -1, bound.upper < infinity ? bound.upper_obstacle : -1},
          {},
          {}};
      for (const bool upper : {false, true}) std::tie(source.normal[upper], source.part[upper]) = whole(bound, upper);
      out_.facets.push_back(source);
    }
  }

  /// The normal that a bound has been reduced from, and the part of it that is left.
  static std::pair<std::array<double, B>, double> whole(const CombinedBound<B>& bound, bool upper) {
    std::array<double, B> normal = (upper ? bound.upper_from : bound.lower_from)->direction;
    const double part = dot(normal, bound.direction);
    if (part < 0)
      for (double& c : normal) c = -c;
    return {normal, std::fabs(part)};
  }

  /// Of the slot added last.
  void add_reduced(const std::vector<CombinedBound<B>>& combined) {
    const Offset first = Offset{constraints().size() - 1} * B;
    for (std::size_t k = 0; k < combined.size(); ++k)
      for (const bool upper : {false, true}) {
        const auto [normal, part] = whole(combined[k], upper);
        out_.reduced.push_back({first + static_cast<Offset>(k), upper, normal, part});
      }
  }

  void hold(const Bound<B>& bound) {
    HeldBound<B> held{bound, bound.direction};
    const Friction* friction = places_.obstacle(bound.obstacle)->friction();
    const Index slot = constraints().slot[bound.vertex];
    if (friction && bound.data >= 0 && (slot < 0 || out_.functional[slot] < 0)) {  // else there is a functional
      held.law = friction->law(functionals_[bound.data].data.data());
      held.last = functionals_[bound.data].motion;
    }
    if (const double* N = problem().frames.dual_at(bound.vertex))
      block::transposed_product<B>(N, bound.direction.data(), held.along.data());
    out_.held.push_back(held);
  }

  /// -1: the kernel's own.
  Index ruling_obstacle(Index slot) const {
    if (own_[slot]) return -1;
    if (!out_.functional.empty() && out_.functional[slot] >= 0) return out_.functional[slot];
    const Offset k = Offset{slot} * B;
    return out_.lower_obstacle[k] >= 0 ? out_.lower_obstacle[k] : out_.upper_obstacle[k];
  }

  void add_segments() {
    const auto n = static_cast<Index>(problem().fixed.size());
    const auto own = std::make_shared<const PolyhedralBox<B>>();
    if (!constraints().facet_row.empty())
      constraints().facet_row.resize(static_cast<std::size_t>(constraints().size()) + 1,
                                     static_cast<Offset>(constraints().facet.size()));
    Index ruling = -2;
    for (Index slot = 0; slot < constraints().size(); ++slot) {
      const Index obstacle = ruling_obstacle(slot);
      if (obstacle == ruling) continue;
      const Index first = problem().segments.empty() ? 0 : constraints().vector[slot];
      if (!problem().segments.empty()) problem().segments.back().last = first;
      problem().segments.push_back({first, n, obstacle < 0 ? own : places_.obstacle(obstacle)});
      ruling = obstacle;
    }
  }

  const ObstaclePlaces<B>& places_;
  const std::vector<FixedDirections<B>>& fixes_;
  const std::vector<Bound<B>>& bounds_;
  const std::vector<FunctionalNumbers<B>>& functionals_;  // see Bound::data
  BoundCombiner<B> combiner_;
  LocalisedProblem<B> out_;
  std::vector<char> own_;  // per slot: ruled by the kernel's own obstacle
  std::vector<Bound<B>> held_;
};

}  // namespace

template <int B>
LocalisedProblem<B> localise(const ObstaclePlaces<B>& places, std::size_t vectors,
                             const std::vector<FixedDirections<B>>& fixes, const std::vector<Bound<B>>& bounds,
                             const std::vector<FunctionalNumbers<B>>& numbers) {
  return Localiser<B>(places, vectors, fixes, bounds, numbers).run();
}

#define SIGNORINI_INSTANTIATE(B)                                                                                       \
  template LocalisedProblem<B> localise(const ObstaclePlaces<B>&, std::size_t, const std::vector<FixedDirections<B>>&, \
                                        const std::vector<Bound<B>>&, const std::vector<FunctionalNumbers<B>>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
