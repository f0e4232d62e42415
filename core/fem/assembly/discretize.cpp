#include "core/fem/assembly/discretize.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "core/algebra/local_basis.hpp"
#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/base/release.hpp"
#include "core/fem/assembly/admissible_sets.hpp"
#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/magnitude.hpp"
#include "core/fem/assembly/springs.hpp"
#include "core/fem/conditions/bound_coefficients.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/model/same.hpp"
#include "core/fem/pairs/paired_bodies.hpp"
#include "core/fem/pairs/rigid_parts.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/local_coordinates.hpp"
#include "core/solver/polyhedral_box.hpp"

namespace signorini {
namespace {

// T with v_old = T v_new of the vectors whose frame is another one; nothing where some of them have prescribed
// components.
template <int B>
std::optional<Frames<B>> change(const Frames<B>& old, const Frames<B>& now, const std::vector<Flags>& fixed) {
  static const std::array<double, B* B> identity = [] {
    std::array<double, B * B> I{};
    for (int i = 0; i < B; ++i) I[i * (B + 1)] = 1;
    return I;
  }();
  Frames<B> turned;
  if (old.slot.empty() && now.slot.empty()) return turned;
  for (Index p = 0; p < static_cast<Index>(fixed.size()); ++p) {
    const double *from = old.at(p), *to = now.at(p);
    if (!from && !to) continue;
    if (from && to && std::equal(from, from + B * B, to)) continue;
    if (fixed[p]) return {};
    double T[B * B];
    const double* N = from ? old.dual_at(p) : identity.data();
    block::transposed_multiply<B>(N, to ? to : identity.data(), T);
    turned.add(fixed.size(), p, T, identity.data());
  }
  return turned;
}

template <int D, int B>
std::shared_ptr<const PairedBodies<B>> pair_bodies(const Nodes<D>& nodes, const Model<B>& model,
                                                   const std::vector<FixedDirections<B>>& fixes) {
  if constexpr (D == B)
    return signorini::pair_bodies<D>(nodes, model, fixes);
  else
    return nullptr;
}

/// Whether the unknowns mean the same.
template <int B>
bool same_jumps(const DiscreteProblem<B>& a, const DiscreteProblem<B>& b) {
  if (a.jumps == b.jumps) return true;
  return a.jumps && b.jumps && *a.jumps == *b.jumps;
}

template <int D, int B>
class Discretizer {
 public:
  Discretizer(const Nodes<D>& nodes, const Model<B>& model, std::shared_ptr<const PairedBodies<B>> pairing)
      : nodes_(nodes),
        model_(model),
        fixes_(collect_fixes(nodes, model)),
        pairing_(pairing ? std::move(pairing) : pair_bodies(nodes, model, fixes_)),
        bounds_(collect_bounds(nodes, model, functionals_, pairing_.get())),
        combiner_(nodes, model, bounds_, fixes_) {
    if (pairing_) {
      hold_pairs();
      problem().jumps = pairing_->jumps;
      out_.pairs = pairing_;
      refuse_other_bounds();
    }
    bound_coefficients(nodes, model, fixes_, bounds_);
    const auto n = static_cast<std::size_t>(nodes.size());
    problem().fixed.assign(n, 0);
    problem().start.assign(n * B, 0);
    problem().constraints.slot.assign(n, -1);
    if (!functionals_.empty())
      for (const ObstacleTerm<B>& term : model.obstacles)
        if (term.obstacle->functional())
          constraints().width = std::max({1, constraints().width, term.obstacle->descriptor().data});
    reserve(bounds_.size());
    localise();
    add_segments();
    check_admissible_sets(nodes, model, problem());
    out_.fixes = std::move(fixes_);
    for (const Bound<B>& bound : held_) hold(bound);
    release(bounds_);  // of scalar bodies as much as their matrix, which is to come
  }

  Discretization<B> discretize() {
    check_lengths(nodes_.mesh(), model_);
    assemble_stiffness();
    assemble_load();
    place_load();
    if (!out_.fixes.empty()) eliminate(problem());
    check_load(nodes_, model_, problem());
    return std::move(out_);
  }

  Discretization<B> renew(Discretization<B> last, const Model<B>& before, Assembled& assembled) {
    assembled.load = !same_loads(before, model_);
    assembled.stiffness = !same_stiffness(before, model_) || !take_stiffness(last, assembled.turned);
    if (assembled.stiffness) assemble_stiffness();
    if (assembled.load) {
      assemble_load();
    } else {
      out_.load = std::move(last.load);
      out_.applied = std::move(last.applied);
    }
    place_load();
    if (assembled.stiffness && !out_.fixes.empty()) eliminate(problem());
    if (!assembled.stiffness) prescribe(problem(), out_.prescribed);
    if (assembled.stiffness || assembled.load) check_load(nodes_, model_, problem());
    return std::move(out_);
  }

 private:
  DiscreteProblem<B>& problem() { return out_.problem; }
  Constraints<B>& constraints() { return out_.problem.constraints; }

  void assemble_stiffness() {
    problem().A = stiffness(nodes_, model_, problem().jumps.get());
    add_springs(nodes_, model_, problem().A);
    check_stiffness(nodes_, model_, problem().A);
    if (problem().jumps) transform(*problem().jumps, problem().A);
    rotate(problem().A, problem().frames);
    keep_prescribed_rows();
  }

  void keep_prescribed_rows() {
    const BlockMatrix<B>& A = problem().A;
    Offset entries = 0;
    for (const FixedDirections<B>& fixed : out_.fixes) entries += A.row[fixed.vertex + 1] - A.row[fixed.vertex];
    out_.prescribed.column.reserve(entries);
    out_.prescribed.value.reserve(entries * B * B);
    for (const FixedDirections<B>& fixed : out_.fixes) out_.prescribed.add(A, fixed.vertex);
  }

  /// Takes over the matrix, turned to the frames of now; false where it is that of other prescribed components.
  bool take_stiffness(Discretization<B>& last, bool& turn) {
    const DiscreteProblem<B>& old = last.problem;
    if (old.fixed != problem().fixed || !same_jumps(old, problem())) return false;
    const std::optional<Frames<B>> turned = change(old.frames, problem().frames, problem().fixed);
    if (!turned) return false;
    problem().A = std::move(last.problem.A);
    out_.prescribed = std::move(last.prescribed);
    turn = !turned->slot.empty();
    rotate(problem().A, *turned);
    out_.prescribed.rotate_columns(*turned);
    return true;
  }

  void assemble_load() {
    out_.load = load_vector<D, B>(nodes_, model_, &out_.applied);
    if constexpr (D == B)
      if (pairing_) add_rigid_loads<D>(nodes_, model_, *pairing_, out_.load);
  }

  void place_load() {
    problem().b = local_forces(problem(), out_.load);
    out_.prescribed.take_load(problem().b);
  }

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
    const ObstacleTerm<B>& term = model_.obstacles[bound.obstacle];
    if (along.lower_from == &bound || !term.obstacle->renewal()) return false;
    const Friction* friction = term.obstacle->friction();
    const FrictionLaw law = friction ? friction->law(functionals_[bound.data].data.data()) : FrictionLaw{1, 1};
    if (law.coefficient == 0) return false;
    if (law.bound == 0) return true;
    input_error(term.origin,
                fmt::format("at ({}) {} is nearer along the same direction, so that the force that its "
                            "friction depends on is another one's, which is not available in this "
                            "version",
                            fmt::join(nodes_.at(bound.vertex), ", "), model_.obstacles[along.lower_obstacle].origin));
  }

  /// A functional that follows the force along its direction has to know that.
  void refuse_unknown_force(Index p, const Bound<B>& bound, bool has_faces) const {
    const ObstacleTerm<B>& term = model_.obstacles[bound.obstacle];
    const Friction* friction = term.obstacle->friction();
    const bool given = friction && friction->law(functionals_[bound.data].data.data()).coefficient == 0;
    if (!term.obstacle->renewal() || given) return;
    const bool held = out_.problem.fixed[p] & ~out_.problem.constraints.tangential.back();
    if (!has_faces && !held) return;
    input_error(
        term.origin,
        fmt::format("at ({}) {}, so that the force that friction depends on is not known there, which is not "
                    "available in this version{}",
                    fmt::join(nodes_.at(p), ", "),
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
    const Friction* friction = model_.obstacles[bound.obstacle].obstacle->friction();
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
      problem().segments.push_back({first, n, obstacle < 0 ? own : model_.obstacles[obstacle].obstacle});
      ruling = obstacle;
    }
  }

  /// What is rigid moves by the motion of its point, and what is tied has no jump.
  void hold_pairs() {
    if constexpr (D == B)
      if (!pairing_->rigid.empty()) signorini::hold<D>(nodes_, model_, pairing_->rigid, fixes_);
    if (pairing_->ties.empty()) return;
    std::map<Index, FixedDirections<B>> held;
    for (const FixedDirections<B>& fixed : fixes_) held.emplace(fixed.vertex, fixed);
    for (const TiedNode& node : pairing_->ties)
      held.try_emplace(node.node, FixedDirections<B>{.vertex = node.node})
          .first->second.hold_rest(by_tie(node.obstacle));
    fixes_.clear();
    for (const auto& [node, fixed] : held) fixes_.push_back(fixed);
  }

  /// A bound of what one body does is none of a jump.
  void refuse_other_bounds() const {
    const auto is_taken = [&](Index p) {
      const auto has = [&](const RigidNodes<B>& part) { return std::ranges::binary_search(part.nodes, p); };
      return std::ranges::binary_search(pairing_->jumps->vector, p) || std::ranges::any_of(pairing_->rigid, has);
    };
    for (const Bound<B>& bound : bounds_)
      if (!model_.obstacles[bound.obstacle].other && is_taken(bound.vertex))
        input_error(model_.obstacles[bound.obstacle].origin,
                    fmt::format("acts at ({}), where {} holds, which is not available in this version; expected faces "
                                "apart from those, or, of two bodies, these exchanged there",
                                fmt::join(nodes_.at(bound.vertex), ", "), origin_of_pair(bound.vertex)));
  }

  const std::string& origin_of_pair(Index node) const {
    for (std::size_t k = 0; k < pairing_->rigid.size(); ++k)
      if (std::ranges::binary_search(pairing_->rigid[k].nodes, node)) return model_.rigid[k].on.origin;
    if (const auto tie = std::ranges::find(pairing_->ties, node, &TiedNode::node); tie != pairing_->ties.end())
      return model_.obstacles[tie->obstacle].origin;
    const auto found = std::ranges::find(pairing_->nodes, node, &PairedNode<B>::node);
    return model_.obstacles[found->obstacle].origin;
  }

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  Discretization<B> out_;
  std::vector<FixedDirections<B>> fixes_;
  std::shared_ptr<const PairedBodies<B>> pairing_;
  std::vector<char> own_;                          // per slot: ruled by the kernel's own obstacle
  std::vector<FunctionalNumbers<B>> functionals_;  // see Bound::data
  std::vector<Bound<B>> bounds_, held_;
  BoundCombiner<D, B> combiner_;
};

}  // namespace

template <int D, int B>
Discretization<B> discretize(const Nodes<D>& nodes, const Model<B>& model,
                             std::shared_ptr<const PairedBodies<B>> pairing) {
  return Discretizer<D, B>(nodes, model, std::move(pairing)).discretize();
}

template <int D, int B>
Assembled renew(const Nodes<D>& nodes, const Model<B>& before, const Model<B>& model, Discretization<B>& last,
                std::shared_ptr<const PairedBodies<B>> pairing) {
  Assembled assembled;
  last = Discretizer<D, B>(nodes, model, std::move(pairing)).renew(std::move(last), before, assembled);
  return assembled;
}

template <int B>
std::vector<double> to_global(const DiscreteProblem<B>& problem, std::vector<double> x) {
  out_of_frames(problem.frames, x);
  if (problem.jumps) to_displacements(*problem.jumps, x);
  return x;
}

template <int B>
std::vector<double> to_local(const DiscreteProblem<B>& problem, std::vector<double> u) {
  if (problem.jumps) to_jumps(*problem.jumps, u);
  into_frames(problem.frames, u);
  return u;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                                \
  template Discretization<B> discretize(const Nodes<D>&, const Model<B>&, std::shared_ptr<const PairedBodies<B>>); \
  template Assembled renew(const Nodes<D>&, const Model<B>&, const Model<B>&, Discretization<B>&,                  \
                           std::shared_ptr<const PairedBodies<B>>);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE
#define SIGNORINI_INSTANTIATE(B)                                                          \
  template std::vector<double> to_global(const DiscreteProblem<B>&, std::vector<double>); \
  template std::vector<double> to_local(const DiscreteProblem<B>&, std::vector<double>);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
