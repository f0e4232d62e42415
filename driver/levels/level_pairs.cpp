#include "driver/levels/level_pairs.hpp"

#include <optional>
#include <tuple>
#include <utility>

#include "core/fem/assembly/discretize.hpp"
#include "core/fem/conditions/moved_on.hpp"
#include "core/fem/elements/nested.hpp"
#include "core/mesh/simplex.hpp"
#include "core/solver/interpolate.hpp"
#include "core/solver/weights.hpp"
#include "driver/motions/loose_body.hpp"

namespace signorini {
namespace {

/// Elements that bodies slip past each other before they find each other anew: a little more than a quarter, so that
/// rounding does not decide where they are moved by just that.
constexpr double far_slip = 0.2501;
/// The same where no step came before: what is looked at anew there is off, and answers of either slave are to agree.
constexpr double far_slip_at_first = 0.025;

}  // namespace

template <int D, int B>
void LevelPairs<D, B>::begin_at(std::size_t first) {
  first_ = first;
  for (MeshLevel<D, B>& level : levels_) level.connected = {};
}

template <int D, int B>
auto LevelPairs<D, B>::found() const -> Found {
  Found out{{}, shift_};
  for (const MeshLevel<D, B>& level : levels_) out.of_level.emplace_back(level.all_pairs, level.pairs);
  return out;
}

template <int D, int B>
void LevelPairs<D, B>::put_back(Found found) {
  shift_ = std::move(found.shift);
  for (std::size_t k = 0; k < levels_.size(); ++k)
    std::tie(levels_[k].all_pairs, levels_[k].pairs) = std::move(found.of_level[k]);
}

template <int D, int B>
void LevelPairs<D, B>::forget() {
  if (given_) return;
  held_ = false;
  for (MeshLevel<D, B>& level : levels_) level.all_pairs = level.pairs = nullptr;
}

template <int D, int B>
void LevelPairs<D, B>::give(std::vector<Pairs> pairs) {
  for (std::size_t k = 0; k < levels_.size(); ++k) levels_[k].all_pairs = levels_[k].pairs = std::move(pairs[k]);
  given_ = true;
}

template <int D, int B>
Model<B> LevelPairs<D, B>::moved(Model<B> model, const std::vector<Point<B>>& shift) {
  for (std::size_t k = 0; k < shift.size(); ++k)
    if (model.obstacles[k].shape) model.obstacles[k].moved = shift[k];
  return model;
}

template <int D, int B>
bool LevelPairs<D, B>::find(const Model<B>& model) {
  bool stay = true;
  if constexpr (D == B) {
    if (given_) return true;
    for (std::size_t k = first_; k < levels_.size(); ++k) {
      MeshLevel<D, B>& level = levels_[k];
      Pairs now = pair_bodies<D>(level.nodes, model, collect_fixes(level.nodes, model), shift_);
      stay = stay && level.all_pairs && same_jumps(*now, *level.all_pairs);
      level.all_pairs = std::move(now);
    }
    refuse_lost<D>(levels_.finest().nodes, model, *levels_.finest().all_pairs);
    const bool held_before = std::exchange(held_, held(model));
    stay = stay && held_ == held_before;
    for (std::size_t k = first_; k < levels_.size(); ++k)
      levels_[k].pairs = stay ? with_new_gaps(*levels_[k].all_pairs, *levels_[k].pairs) : levels_[k].all_pairs;
  }
  return stay;
}

/// What holds a loose body may be far from where it is.
template <int D, int B>
bool LevelPairs<D, B>::held(const Model<B>& model) const {
  if constexpr (D == B)
    return LooseBody<D, B>(levels_[first_].nodes, model,
                           discretize(levels_[first_].nodes, model, levels_[first_].all_pairs))
        .held();
  return false;
}

/// The shape stays the undeformed one: in the dent of a body that slides the next step would have to climb its slope.
template <int D, int B>
std::vector<Point<B>> LevelPairs<D, B>::shift_after(const Place& place, const Model<B>& model,
                                                    const std::vector<double>& u) const {
  std::vector<Point<B>> shift = place.shift;
  if constexpr (D == B) {
    if (given_) return shift;
    const Nodes<D>& nodes = levels_.finest().nodes;
    shift.resize(model.obstacles.size());
    const Model<B> here = moved(model, shift);
    const bool paired = is_paired(model) && place.all;
    const Pairs near = paired ? near_contact(nodes, model, *place.all, u) : nullptr;
    const double far = model.follows ? far_slip : far_slip_at_first;
    bool any = false;
    for (Index k = 0; k < std::ssize(model.obstacles); ++k) {
      const ObstacleTerm<B>& term = model.obstacles[k];
      std::optional<Point<D>> to;
      if (!term.renew) continue;
      if (term.shape) {
        to = moved_on(nodes, here, k, u);
      } else if (paired && term.other && !term.tied) {
        const Slip<D> slip = slip_past(nodes, model, k, *place.all, *near, u);
        if (length<D>(difference<D>(slip.mean, shift[k])) > far * slip.length) to = slip.mean;
      }
      if (!to) continue;
      shift[k] = *to;
      any = true;
    }
    if (!any) return place.shift;
  }
  return shift;
}

template <int D, int B>
bool LevelPairs<D, B>::narrow(const Model<B>& model, std::size_t level, const std::vector<double>& u) {
  constexpr std::size_t most = 2;  // times as many as are needed
  if constexpr (D == B) {
    const auto& [all, nodes] = std::tie(levels_[level].all_pairs, levels_[level].nodes);
    Pairs& chosen = levels_[level].pairs;
    const Pairs needed = near_contact(nodes, model, *all, u);
    if (chosen->nodes.size() < all->nodes.size()) {
      const Pairs both = near_contact(nodes, model, *all, u, chosen.get());
      if (both->nodes.size() <= most * needed->nodes.size()) {
        if (both->nodes.size() == chosen->nodes.size()) return false;
        chosen = both;
        return true;
      }
    }
    chosen = needed;
    return true;
  }
  return false;
}

template <int D, int B>
void LevelPairs<D, B>::narrow_by_coarser(const Model<B>& model, std::size_t level, const std::vector<double>& u) {
  const Prolongation P = interpolation(level);
  std::vector<double> refined(static_cast<std::size_t>(P.fine()) * B);
  weights::with<B>(P, [&](const auto& weight) {
    for (Index p = 0; p < P.fine(); ++p)
      weights::interpolate<B>(P, weight, p, u.data(), refined.data() + Offset{p} * B);
  });
  narrow(model, level, refined);
}

template <int D, int B>
bool LevelPairs<D, B>::widen(const Model<B>& model, const std::vector<double>& u) {
  if constexpr (D == B) {
    const auto& [all, nodes] = std::tie(levels_.finest().all_pairs, levels_.finest().nodes);
    Pairs& chosen = levels_.finest().pairs;
    if (!all || chosen == all || !touches_elsewhere(nodes, model, *all, *chosen, u)) return false;
    chosen = near_contact(nodes, model, *all, u, chosen.get());
    return true;
  }
  return false;
}

template <int D, int B>
void LevelPairs<D, B>::connect(std::size_t level, std::span<Prolongation> between) {
  if (!levels_[level].all_pairs) return;
  for (std::size_t k = first_ + 1; k <= level; ++k) {
    const std::array now{levels_[k - 1].pairs->jumps, levels_[k].pairs->jumps};
    if (levels_[k].connected == now) continue;
    between[k - 1 - first_] = between_jumps(interpolation(k), *now[1], *now[0]);
    levels_[k].connected = now;
  }
}

/// From the next coarser mesh, between displacements.
template <int D, int B>
Prolongation LevelPairs<D, B>::interpolation(std::size_t level) const {
  return prolongation(*levels_[level].refinement, levels_[level - 1].nodes, levels_[level].nodes);
}

template class LevelPairs<2, 1>;
template class LevelPairs<3, 1>;
template class LevelPairs<2, 2>;
template class LevelPairs<3, 3>;

}  // namespace signorini
