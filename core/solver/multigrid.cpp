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
  level.chunks = divide(problem.A);
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
CycleReport MonotoneMultigrid<B>::cycle(double* x, const Passes::Run& before, const Passes::Run& after) {
  report_ = {};
  levels_.back().x = x;
  descend(levels_.size() - 1, before, after);
  return report_;
}

template <int B>
void MonotoneMultigrid<B>::descend(std::size_t k, const Passes::Run& before, const Passes::Run& after) {
  Level<B>& level = levels_[k];
  Passes down, up;
  if (before) down.add(before);
  if (k == 0) {
    down.run(level.chunks);
    if (levels_.size() == 1) update_phases(level, 0, level.vectors);
    if (!components_.coarse->solve(level)) report_.bounded = false;
    level.renewed.clear();
  } else {
    components_.smoother->add_passes(level, settings_.pre, Side::descend, down);
    Level<B>& coarse = levels_[k - 1];
    transfers_[k - 1]->begin_restriction(coarse);
    coarse.inherited_rounding = level.inherited_rounding;
    down.add([this, k, &level, &coarse](Index first, Index last) {
      update_phases(level, first, last);
      restrict_residual(k, first, last);
      coarse.inherited_rounding += rounding_of_work(level, first, last);
    });
    down.run(level.chunks);
    if (k + 1 == levels_.size()) report_.rounding = coarse.inherited_rounding;
    correct(k);
    up.add(
        [this, k](Index first, Index last) { transfers_[k - 1]->prolongate(levels_[k - 1], levels_[k], first, last); });
    components_.smoother->add_passes(level, settings_.post, Side::ascend, up);
  }
  if (after) up.add(after);
  up.run(level.chunks);
}

// From the restricted residual to the correction that prolongate() adds.
template <int B>
void MonotoneMultigrid<B>::correct(std::size_t k) {
  Level<B>& fine = levels_[k];
  Level<B>& coarse = levels_[k - 1];
  Transfer<B>& transfer = *transfers_[k - 1];
  report_.renewed += transfer.assemble(fine, coarse);
  transfer.end_restriction(coarse);
  transfer.restrict_bounds(fine, coarse);
  const int visits = k == 1 ? 1 : settings_.gamma;
  for (int visit = 0; visit < visits; ++visit) descend(k - 1, {}, {});
  transfer.begin_prolongation(coarse);
}

template <int B>
void MonotoneMultigrid<B>::restrict_residual(std::size_t k, Index first, Index last) {
  const Level<B>& fine = levels_[k];
  r_.resize(static_cast<std::size_t>(last - first) * B);
  residual<B>(*fine.A, fine.x, fine.b, first, last, r_.data());
  transfers_[k - 1]->restrict_residual(fine, first, last, r_.data(), levels_[k - 1]);
}

// Distances and critical flags are recomputed from the iterate; what differs from the state the coarser matrices were
// made with is listed for their local reassembly.
template <int B>
void MonotoneMultigrid<B>::update_phases(Level<B>& level, Index first, Index last) {
  const LevelView<B> view = level.view();
  level.for_each_segment(first, last, Order::forward, [&](const Segment<B>& s, Index begin, Index end) {
    s.obstacle->distance(view, begin, end, level.lower.data(), level.upper.data(), level.critical.data());
  });
  Index contact = 0, changed = 0;
  const auto [from, to] = slots_between(level.constraints, first, last);
  for (Index slot = from; slot < to; ++slot) {
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
    report_.contact += contact;
    report_.changed += changed;
  }
}

template class MonotoneMultigrid<1>;
template class MonotoneMultigrid<2>;
template class MonotoneMultigrid<3>;
template Level<1> finest_level(const DiscreteProblem<1>&);
template Level<2> finest_level(const DiscreteProblem<2>&);
template Level<3> finest_level(const DiscreteProblem<3>&);

}  // namespace signorini
