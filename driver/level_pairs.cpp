#include "driver/level_pairs.hpp"

#include <utility>

#include "core/fem/discretize.hpp"
#include "core/fem/nested.hpp"
#include "core/mesh/simplex.hpp"
#include "core/solver/weights.hpp"
#include "driver/loose_body.hpp"

namespace signorini {
namespace {

/// Elements that bodies slip past each other before they find each other anew: a little more than a quarter, so that
/// rounding does not decide where they are moved by just that.
constexpr double far = 0.2501;

}  // namespace

template <int D, int B>
void LevelPairs<D, B>::give(std::vector<Pairs> pairs) {
  all_ = std::move(pairs);
  chosen_ = all_;
  given_ = true;
}

template <int D, int B>
bool LevelPairs<D, B>::find(const Model<B>& model) {
  bool stay = true;
  if constexpr (D == B) {
    if (given_) return true;
    if (!model.follows) shift_.clear();
    for (std::size_t level = first_; level < nodes_.size(); ++level) {
      Pairs now = pair_bodies<D>(nodes_[level], model, collect_fixes(nodes_[level], model), shift_);
      stay = stay && all_[level] && same_jumps(*now, *all_[level]);
      all_[level] = std::move(now);
    }
    const bool held_before = std::exchange(held_, held(model));
    stay = stay && held_ == held_before;
    for (std::size_t level = first_; level < nodes_.size(); ++level)
      chosen_[level] = stay ? with_new_gaps(*all_[level], *chosen_[level]) : all_[level];
  }
  return stay;
}

/// What holds a loose body may be far from where it is.
template <int D, int B>
bool LevelPairs<D, B>::held(const Model<B>& model) const {
  if constexpr (D == B)
    return LooseBody<D, B>(nodes_[first_], model, discretize(nodes_[first_], model, all_[first_])).held();
  return false;
}

/// The shape stays the undeformed one: in the dent of a body that slides the next step would have to climb its slope.
template <int D, int B>
bool LevelPairs<D, B>::follow(const Model<B>& model, const std::vector<double>& u) {
  std::vector<Point<B>> shift = shift_after({shift_, all_.back()}, model, u);
  if (shift == shift_) return false;
  shift_ = std::move(shift);
  return true;
}

template <int D, int B>
std::vector<Point<B>> LevelPairs<D, B>::shift_after(const Place& place, const Model<B>& model,
                                                    const std::vector<double>& u) const {
  std::vector<Point<B>> shift = place.shift;
  if constexpr (D == B) {
    if (given_ || !model.follows || !is_paired(model) || !place.all) return shift;
    shift.resize(model.obstacles.size());
    const Pairs near = near_contact(nodes_.back(), model, *place.all, u);
    bool moved = false;
    for (Index k = 0; k < std::ssize(model.obstacles); ++k) {
      const ObstacleTerm<B>& term = model.obstacles[k];
      if (!term.other || !term.renew) continue;
      Slip<D> slip = slip_past(nodes_.back(), model, k, *place.all, *near, u);
      if (slip.length == 0 && shift[k] != Point<B>{}) {  // past each other's ends: how far tells where they began
        const Pairs first = pair_bodies<D>(nodes_.back(), model, collect_fixes(nodes_.back(), model));
        slip = slip_past(nodes_.back(), model, k, *first, *first, u);
      }
      if (!(length<D>(difference<D>(slip.mean, shift[k])) > far * slip.length)) continue;
      shift[k] = slip.mean;
      moved = true;
    }
    if (!moved) return place.shift;
  }
  return shift;
}

template <int D, int B>
bool LevelPairs<D, B>::narrow(const Model<B>& model, std::size_t level, const std::vector<double>& u) {
  constexpr std::size_t most = 2;  // times as many as are needed
  if constexpr (D == B) {
    Pairs& chosen = chosen_[level];
    const Pairs needed = near_contact(nodes_[level], model, *all_[level], u);
    if (chosen->nodes.size() < all_[level]->nodes.size()) {
      const Pairs both = near_contact(nodes_[level], model, *all_[level], u, chosen.get());
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
  const Prolongation P = interpolation(level - 1);
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
    const Pairs& all = all_.back();
    Pairs& chosen = chosen_.back();
    if (!all || chosen == all || !touches_elsewhere(nodes_.back(), model, *all, *chosen, u)) return false;
    chosen = near_contact(nodes_.back(), model, *all, u, chosen.get());
    return true;
  }
  return false;
}

template <int D, int B>
void LevelPairs<D, B>::connect(std::size_t level, std::span<Prolongation> between) {
  if (!all_[level]) return;
  for (std::size_t k = first_; k < level; ++k) {
    const std::array now{chosen_[k]->jumps, chosen_[k + 1]->jumps};
    if (connected_[k] == now) continue;
    between[k - first_] = between_jumps(interpolation(k), *now[1], *now[0]);
    connected_[k] = now;
  }
}

template <int D, int B>
Prolongation LevelPairs<D, B>::interpolation(std::size_t refinement) const {
  return prolongation(hierarchy_.refinements[refinement], nodes_[refinement], nodes_[refinement + 1]);
}

template class LevelPairs<2, 1>;
template class LevelPairs<3, 1>;
template class LevelPairs<2, 2>;
template class LevelPairs<3, 3>;

}  // namespace signorini
