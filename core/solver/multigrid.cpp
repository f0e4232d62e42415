#include "core/solver/multigrid.hpp"

#include "core/algebra/products.hpp"
#include "core/sdk/box_obstacle.hpp"
#include "core/solver/rounding.hpp"

namespace signorini {

namespace {

// Coarse corrections live in boxes whatever the obstacle on the finest level is.
template <int B>
class CoarseBox final : public BoxObstacle<B> {
 public:
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"box", B, 2}}}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<B>*, Status& status) const noexcept override {
    status.fail(1, "coarse bounds come from the monotone restriction");
  }
};

template <int B>
std::vector<Segment<B>> one_box_segment(Index vectors) {
  return {{0, vectors, std::make_shared<const CoarseBox<B>>()}};
}

}  // namespace

template <int B>
Level<B> finest_level(const DiscreteProblem<B>& problem) {
  Level<B> level;
  level.vectors = problem.A.size();
  level.A = &problem.A;
  level.b = problem.b.data();
  level.r.resize(problem.b.size());
  level.frames = problem.frames;
  level.constraints = problem.constraints;
  if (level.constraints.slot.empty()) level.constraints.slot.assign(static_cast<std::size_t>(level.vectors), -1);
  level.segments = problem.segments.empty() ? one_box_segment<B>(level.vectors) : problem.segments;
  level.off = problem.fixed;
  level.inverse.resize(static_cast<std::size_t>(level.vectors) * B * B);
  for (Index p = 0; p < level.vectors; ++p)
    block::invert<B>(problem.A.diagonal(p), level.inverse.data() + Offset{p} * B * B);
  return level;
}

template <int B>
MonotoneMultigrid<B>::MonotoneMultigrid(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                                        Components<B> components, Settings settings)
    : levels_(prolongations.size() + 1), components_(std::move(components)), settings_(settings) {
  levels_.back() = finest_level(problem);
  transfers_.resize(prolongations.size());
  for (std::size_t k = prolongations.size(); k-- > 0;) {
    const bool rotate = settings.rotate == Rotate::all || (settings.rotate == Rotate::not_coarsest && k > 0);
    transfers_[k] = components_.transfer();
    transfers_[k]->prepare(levels_[k + 1], prolongations[k], rotate, levels_[k]);
    levels_[k].segments = one_box_segment<B>(levels_[k].vectors);
  }
  for (Level<B>& level : levels_) {
    const auto slots = static_cast<std::size_t>(level.constraints.size());
    level.removed = level.off;
    level.critical.assign(slots, 0);
    level.phase.assign(slots, 0);
    level.lower.resize(slots * B);
    level.upper.resize(slots * B);
  }
}

template <int B>
CycleReport MonotoneMultigrid<B>::cycle(double* x) {
  report_ = {};
  levels_.back().x = x;
  descend(levels_.size() - 1);
  return report_;
}

template <int B>
void MonotoneMultigrid<B>::descend(std::size_t k) {
  Level<B>& level = levels_[k];
  if (k == 0) {
    if (levels_.size() == 1) update_phases(level);
    if (!components_.coarse->solve(level)) report_.bounded = false;
    level.renewed.clear();
    return;
  }
  components_.smoother->smooth(level, settings_.pre, Side::descend);
  correct(k);
  components_.smoother->smooth(level, settings_.post, Side::ascend);
}

template <int B>
void MonotoneMultigrid<B>::correct(std::size_t k) {
  Level<B>& fine = levels_[k];
  Level<B>& coarse = levels_[k - 1];
  Transfer<B>& transfer = *transfers_[k - 1];
  update_phases(fine);
  report_.renewed += transfer.assemble(fine, coarse);
  residual<B>(*fine.A, fine.x, fine.b, fine.r.data());
  transfer.restrict_residual(fine, coarse);
  transfer.restrict_bounds(fine, coarse);
  coarse.inherited_rounding = rounding_of_work(fine);
  const int visits = k == 1 ? 1 : settings_.gamma;
  for (int visit = 0; visit < visits; ++visit) descend(k - 1);
  transfer.prolongate(coarse, fine);
}

// Distances and critical flags are recomputed from the iterate; what differs from the state the coarser matrices were
// made with is listed for their local reassembly.
template <int B>
void MonotoneMultigrid<B>::update_phases(Level<B>& level) {
  const LevelView<B> view = level.view();
  for (const Segment<B>& s : level.segments)
    s.obstacle->distance(view, s.first, s.last, level.lower.data(), level.upper.data(), level.critical.data());
  Index contact = 0, changed = 0;
  for (Index slot = 0; slot < level.constraints.size(); ++slot) {
    const Index p = level.constraints.vector[slot];
    const Flags critical = level.critical[slot] & static_cast<Flags>(~level.off[p]);
    contact += critical != 0;
    changed += critical != level.phase[slot];
    level.phase[slot] = critical;
    const Flags removed = level.off[p] | (settings_.truncate ? critical : Flags{0});
    if (removed == level.removed[p]) continue;
    level.removed[p] = removed;
    level.changed.push_back(p);
  }
  if (&level == &levels_.back()) {
    report_.contact = contact;
    report_.changed = changed;
  }
}

template class MonotoneMultigrid<1>;
template class MonotoneMultigrid<2>;
template class MonotoneMultigrid<3>;
template Level<1> finest_level(const DiscreteProblem<1>&);
template Level<2> finest_level(const DiscreteProblem<2>&);
template Level<3> finest_level(const DiscreteProblem<3>&);

}  // namespace signorini
