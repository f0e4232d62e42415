#include "core/fem/assembly/discretize.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/base/release.hpp"
#include "core/constraints/admissible_sets.hpp"
#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/magnitude.hpp"
#include "core/fem/assembly/springs.hpp"
#include "core/fem/conditions/bound_coefficients.hpp"
#include "core/fem/conditions/model_places.hpp"
#include "core/fem/conditions/walls.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/model/same.hpp"
#include "core/fem/pairs/paired_bodies.hpp"
#include "core/fem/pairs/pretension.hpp"
#include "core/fem/pairs/rigid_parts.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/local_coordinates.hpp"

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
        bounds_(collect_bounds(nodes, model, functionals_, pairing_.get())) {
    if (pairing_) {
      hold_pairs();
      out_.pairs = pairing_;
      refuse_other_bounds();
    }
    bound_coefficients(nodes, model, fixes_, bounds_);
    const ModelPlaces<D, B> places(nodes, model);
    static_cast<LocalisedProblem<B>&>(out_) =
        localise(places, static_cast<std::size_t>(nodes.size()), fixes_, bounds_, functionals_);
    check_admissible_sets(places, problem(), extent(nodes.mesh()));
    if (pairing_) problem().jumps = pairing_->jumps;
    out_.fixes = std::move(fixes_);
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
      if (pairing_) {
        add_rigid_loads<D>(nodes_, model_, *pairing_, out_.load);
        add_pretension<D>(model_, *pairing_, out_.load);
      }
  }

  void place_load() {
    problem().b = local_forces(problem(), out_.load);
    out_.prescribed.take_load(problem().b);
  }

  /// What is rigid moves by the motion of its point, and what is tied has no jump but that of a bolt.
  void hold_pairs() {
    if constexpr (D == B)
      if (!pairing_->rigid.empty()) signorini::hold<D>(nodes_, model_, pairing_->rigid, fixes_);
    if (pairing_->ties.empty()) return;
    std::map<Index, FixedDirections<B>> held;
    for (const FixedDirections<B>& fixed : fixes_) held.emplace(fixed.vertex, fixed);
    if constexpr (D == B)
      for (const PretensionedTie<B>& tie : pairing_->pretensioned)
        hold_carrier<D>(tie, *model_.obstacles[tie.obstacle].pretension,
                        held.try_emplace(tie.carrier, FixedDirections<B>{.vertex = tie.carrier}).first->second);
    for (const TiedNode& node : pairing_->ties)
      if (!is_carrier(node.node))
        held.try_emplace(node.node, FixedDirections<B>{.vertex = node.node})
            .first->second.hold_rest(by_tie(node.obstacle));
    fixes_.clear();
    for (const auto& [node, fixed] : held) fixes_.push_back(fixed);
  }

  bool is_carrier(Index node) const {
    return std::ranges::find(pairing_->pretensioned, node, &PretensionedTie<B>::carrier) !=
           pairing_->pretensioned.end();
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
  std::vector<FunctionalNumbers<B>> functionals_;  // see Bound::data
  std::vector<Bound<B>> bounds_;
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
