#include "core/solver/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/algebra/careful_residual.hpp"
#include "core/algebra/energy_along.hpp"
#include "core/algebra/products.hpp"
#include "core/base/clock.hpp"
#include "core/base/dot.hpp"
#include "core/solver/falling.hpp"
#include "core/solver/functional.hpp"
#include "core/solver/line_search.hpp"
#include "core/solver/polyhedral_box.hpp"
#include "core/solver/rounding.hpp"
#include "core/solver/slide.hpp"
#include "core/solver/smooth_interpolation.hpp"

namespace signorini {

namespace {

constexpr int response_cycles = 10;
constexpr double grown = 1.1,
                 far_below = 0.01;  // squares of norms: of a response in a cycle, and beside what is enough
constexpr double enough_curvature = 0.1;

template <int B>
std::vector<Segment<B>> one_box_segment(Index vectors) {
  return {{0, vectors, std::make_shared<const PolyhedralBox<B>>()}};
}

// Where most vectors have bounds, the others get infinite ones: then loops over them need no look-ups.
template <int B>
Constraints<B> completed(const Constraints<B>& c, Index vectors) {
  if (B > 1 || !c.data.empty() || c.size() == vectors || c.size() < vectors - c.size()) return c;
  Constraints<B> out;
  const auto n = static_cast<std::size_t>(vectors);
  out.slot.resize(n);
  out.vector.resize(n);
  std::iota(out.slot.begin(), out.slot.end(), 0);
  std::iota(out.vector.begin(), out.vector.end(), 0);
  out.lower.assign(n * B, -infinity);
  out.upper.assign(n * B, infinity);
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      out.lower[Offset{c.vector[slot]} * B + k] = c.lower[Offset{slot} * B + k];
      out.upper[Offset{c.vector[slot]} * B + k] = c.upper[Offset{slot} * B + k];
    }
  return out;
}

// Whether a direction that is not truncated is at a bound. Facets that are met are not told from those that do not
// interpolate.
template <int B>
bool meets_bound(const Level<B>& level) {
  const Constraints<B>& c = level.constraints;
  if (!c.facet.empty()) return true;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const double x = level.x[Offset{c.vector[slot]} * B + k];
      const Offset at = Offset{slot} * B + k;
      if ((x <= c.lower[at] || x >= c.upper[at]) && !(level.removed(c.vector[slot]) >> k & 1u)) return true;
    }
  return false;
}

// Slips that a correction has turned round end: where friction pulls the other way the linear model does not hold, and
// what goes beyond by little has to stick, which cycles would find out from its edge inwards, layer by layer.
// @param start the iterate before the correction
// @return whether there were any
template <int B>
bool end_slips(const Level<B>& level, const std::vector<double>& start) {
  const Constraints<B>& c = level.constraints;
  bool any = false;
  level.for_each_segment(0, level.vectors, Order::forward, [&](const Segment<B>& s, Index first, Index last) {
    if (!s.obstacle->friction()) return;
    const auto [from, to] = slots_between(c, first, last);
    for (Index slot = from; slot < to; ++slot) {
      const Offset at = Offset{c.vector[slot]} * B, own = Offset{slot} * B;
      double forward = 0, pull = 0;
      for (int k = 0; k < B; ++k) {
        if (!(c.tangential[slot] >> k & 1u)) continue;
        forward += (level.x[at + k] - c.last[own + k]) * (start[at + k] - c.last[own + k]);
        pull += std::abs(level.piece.gradient[own + k]);
      }
      if (!(forward < 0 && pull > 0)) continue;
      any = true;
      for (int k = 0; k < B; ++k)
        if (c.tangential[slot] >> k & 1u) level.x[at + k] = c.last[own + k];
    }
  });
  return any;
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
  level.constraints = completed(problem.constraints, level.vectors);
  if (level.constraints.slot.empty()) level.constraints.slot.assign(static_cast<std::size_t>(level.vectors), -1);
  level.segments = problem.segments.empty() ? one_box_segment<B>(level.vectors) : problem.segments;
  if (!level.constraints.facet.empty()) level.phases.whole_dual = level.frames.dual;
  level.nonlinear = has_functional(level.segments);
  level.off = problem.fixed;
  level.inverse.resize(static_cast<std::size_t>(level.vectors) * B * B);
  for (Index p = 0; p < level.vectors; ++p)
    block::invert<B>(problem.A.diagonal(p), level.inverse.data() + Offset{p} * B * B);
  return level;
}

template <int B>
MonotoneMultigrid<B>::MonotoneMultigrid(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                                        Components<B> components, Settings settings)
    : levels_(prolongations.size() + 1),
      components_(std::move(components)),
      settings_(settings),
      crew_(std::min(settings.threads, std::max(settings.pre, settings.post) + 2)) {  // no more passes go one way
  levels_.back() = finest_level(problem);
  knows_frames_ = prolongations.empty() || !prolongations.back().local;
  fourth_order_ = B == 1 && !prolongations.empty() && is_smooth(prolongations.back()) && !levels_.back().nonlinear;
  transfers_.resize(prolongations.size());
  const bool known = problem.galerkin.size() == prolongations.size() &&
                     (settings.rotate == Rotate::all || problem.frames.slot.empty());
  for (std::size_t k = prolongations.size(); k-- > 0;) {
    const bool rotate = settings.rotate == Rotate::all || (settings.rotate == Rotate::not_coarsest && k > 0) ||
                        (settings.rotate == Rotate::meshes && !prolongations[k].algebraic);
    transfers_[k] = components_.transfer();
    if (known) levels_[k].galerkin = &problem.galerkin[k];
    transfers_[k]->prepare(levels_[k + 1], prolongations[k], rotate, levels_[k]);
    levels_[k].segments = one_box_segment<B>(levels_[k].vectors);
  }
  for (Level<B>& level : levels_) {
    level.relaxation = settings.relaxation;
    level.clear_phases();
  }
  if (!settings.reassemble)
    while (lasting_ < prolongations.size() && prolongations[lasting_].algebraic) ++lasting_;
  if (lasting_ > 0 && !known) assemble_once();
  smoothers_.resize(levels_.size());
  for (std::size_t k = 1; k < levels_.size(); ++k) smoothers_[k] = components_.smoother->on(levels_[k]);
}

// All coarser matrices before anything is truncated.
template <int B>
void MonotoneMultigrid<B>::assemble_once() {
  for (std::size_t k = transfers_.size(); k-- > 0;) reassemble(*transfers_[k], levels_[k + 1], levels_[k]);
  for (Level<B>& level : levels_) level.outdated.renewed.clear();
}

template <int B>
CycleReport MonotoneMultigrid<B>::cycle(double* x, const Passes::Run& before, const Passes::Run& after) {
  report_ = {};
  for (const Level<B>& level : levels_) report_.levels.push_back({.vectors = level.vectors});
  levels_.back().x = x;
  descend(levels_.size() - 1, settings_.cycle, before, after);
  return report_;
}

template <int B>
void MonotoneMultigrid<B>::begin_at(double* x) {
  report_ = {};
  report_.levels.resize(levels_.size());
  Level<B>& level = levels_.back();
  level.x = x;
  if (fourth_order_) find_residual(level, 0, level.vectors);
  update_phases(level, 0, level.vectors, fourth_order_ ? r_.data() : nullptr);
}

// From zero on, with bounds that hold what is held and no others. What the cycles find grows up to what is sought.
template <int B>
std::optional<double> MonotoneMultigrid<B>::response(const std::vector<double>& x, const std::vector<double>& forces,
                                                     double enough) {
  Level<B>& level = levels_.back();
  Constraints<B> linear = level.constraints;
  if (level.nonlinear) {
    std::vector<double> now = x;
    level.x = now.data();
    level.locate(0, level.vectors);
  }
  const auto keep = [](bool held, double& lower, double& upper) {
    lower = held ? 0 : -infinity;
    upper = held ? 0 : infinity;
  };
  for (Index slot = 0; slot < linear.size(); ++slot) {
    const double* v = x.data() + Offset{linear.vector[slot]} * B;
    if (linear.has_facets(slot))
      for (Offset f = linear.facet_row[slot]; f < linear.facet_row[slot + 1]; ++f)
        keep(level.constraints.polyhedron(slot).touches(static_cast<int>(f - linear.facet_row[slot]), v),
             linear.facet[f].lower, linear.facet[f].upper);
    for (int k = 0; k < B; ++k) {
      double &lower = linear.lower[Offset{slot} * B + k], &upper = linear.upper[Offset{slot} * B + k];
      keep(v[k] <= lower || v[k] >= upper || (level.nonlinear && level.phases.critical[slot] >> k & 1u), lower, upper);
    }
  }
  std::vector<Segment<B>> segments = one_box_segment<B>(level.vectors);
  const bool nonlinear = std::exchange(level.nonlinear, false);
  const double *b = std::exchange(level.b, forces.data()), near = std::exchange(near_, 0.0);
  const bool search = std::exchange(line_search_, settings_.truncate != Truncation::none);
  std::swap(level.constraints, linear);
  std::swap(level.segments, segments);
  std::vector<double> d(x.size(), 0.0);
  double squared = 0, last = -1;
  bool bounded = true;
  for (int k = 0; k < response_cycles && bounded && squared > grown * last; ++k) {
    bounded = cycle(d.data()).bounded;
    last = squared;
    squared = std::abs(dot(d, forces));
    if (squared <= far_below * enough * enough) break;
  }
  std::swap(level.constraints, linear);
  std::swap(level.segments, segments);
  level.nonlinear = nonlinear;
  level.b = b;
  near_ = near;
  line_search_ = search;
  return bounded ? std::optional(std::sqrt(squared)) : std::nullopt;
}

template <int B>
void MonotoneMultigrid<B>::subtract_gradient(const double* x, double* r) {
  Level<B>& level = levels_.back();
  level.x = const_cast<double*>(x);
  level.locate(0, level.vectors);
  level.subtract_gradient(0, level.vectors, r);
}

template <int B>
void MonotoneMultigrid<B>::descend(std::size_t k, Cycle cycle, const Passes::Run& before, const Passes::Run& after) {
  const double begin = seconds();
  double elsewhere = 0;
  Level<B>& level = levels_[k];
  const bool finest = k + 1 == levels_.size();
  report_.levels[k].critical = 0;
  report_.levels[k].contact = {};
  Passes down, up;
  if (before) down.add(before);
  if (k == 0) {
    down.run(level.chunks, crew_);
    if (finest) {
      update_phases(level, 0, level.vectors, nullptr);
      report_.rounding = rounding_of_work(level);
    }
    auto* falling = dynamic_cast<Falling*>(components_.coarse.get());
    if (falling) falling->go_on(!finest && levels_.back().nonlinear);
    if (!components_.coarse->solve(level) && lasting_ == 0) report_.bounded = false;
    level.outdated.renewed.clear();
  } else {
    smoothers_[k]->add_passes(settings_.pre, Side::descend, down);
    Level<B>& coarse = levels_[k - 1];
    transfers_[k - 1]->begin_restriction(coarse);
    coarse.inherited_rounding = level.inherited_rounding;
    down.add([this, k, &level, &coarse](Index first, Index last) {
      in_pieces<B>(first, last, [&](Index from, Index to) {
        find_residual(level, from, to);
        update_phases(level, from, to, r_.data());
        restrict_residual(k, from, to);
        coarse.inherited_rounding += rounding_of_residual(level, from, to);
      });
    });
    down.run(level.chunks, crew_);
    if (finest) report_.rounding = coarse.inherited_rounding;
    elsewhere = correct(k, cycle);
    if (searches(k)) {
      search(k);
      if (const auto* falling = dynamic_cast<const Falling*>(components_.coarse.get());
          finest && level.nonlinear && falling)
        slide(levels_, transfers_, falling->left_out());
    } else {
      up.add([this, k](Index first, Index last) {
        in_pieces<B>(first, last, [this, k](Index from, Index to) {
          transfers_[k - 1]->prolongate(levels_[k - 1], levels_[k], from, to);
        });
      });
    }
    smoothers_[k]->add_passes(settings_.post, Side::ascend, up);
  }
  if (after) up.add(after);
  up.run(level.chunks, crew_);
  report_.levels[k].seconds += seconds() - begin - elsewhere;
}

// From the restricted residual to the correction that prolongate() adds. Returns the time spent on coarser levels.
template <int B>
double MonotoneMultigrid<B>::correct(std::size_t k, Cycle cycle) {
  Level<B>& fine = levels_[k];
  Level<B>& coarse = levels_[k - 1];
  Transfer<B>& transfer = *transfers_[k - 1];
  if (k > lasting_) {
    report_.levels[k - 1].renewed += reassemble(transfer, fine, coarse);
  } else {
    fine.outdated.clear();
  }
  transfer.end_restriction(coarse);
  if (line_search_)
    coarse.constraints.clear_bounds();
  else
    transfer.restrict_bounds(fine, coarse);
  const double begin = seconds();
  descend(k - 1, cycle, {}, {});
  if (k > 1 && cycle != Cycle::V) descend(k - 1, cycle == Cycle::F ? Cycle::V : cycle, {}, {});
  const double elsewhere = seconds() - begin;
  if (fine.nonlinear) {
    coarse_work_ = dot(coarse.own_b, coarse.own_x);
    coarse_energy_ = energy_along(*coarse.A, coarse.own_x).of_matrix;
  }
  transfer.begin_prolongation(coarse);
  return elsewhere;
}

// Whether the correction of level k may raise the energy, without bounds or by a matrix that knows no truncation, or
// goes further than bounds let it.
template <int B>
bool MonotoneMultigrid<B>::searches(std::size_t k) const {
  return ((line_search_ || extended_) && k + 1 == levels_.size()) || levels_[k].nonlinear ||
         (k <= lasting_ && levels_[k].constraints.size() > 0);
}

// prolongate() projects onto the bounds. Where that cuts nothing off, a correction without bounds lowers the energy as
// it is, for it is a linear one in the truncated space. Else the energy has its minimum along the step to there where
// r'd vanishes; beyond the full step it may go on until it meets a bound.
template <int B>
void MonotoneMultigrid<B>::search(std::size_t k) {
  Level<B>& level = levels_[k];
  const auto n = static_cast<std::size_t>(level.vectors) * B;
  start_.assign(level.x, level.x + n);
  transfers_[k - 1]->prolongate(levels_[k - 1], level, 0, level.vectors);
  const bool ended = level.nonlinear && end_slips(level, start_);
  const bool met = ended || meets_bound(level);
  report_.cut_off = report_.cut_off || (line_search_ && met);
  if (k > lasting_ && !extended_ && !level.nonlinear && !met) return;
  step_.resize(n);
  if (level.nonlinear && k > lasting_ && !met) return search_by_coarse_level(level);
  for (std::size_t i = 0; i < n; ++i) step_[i] = level.x[i] - start_[i];
  double energy = 0, work = 0;
  for (Index p = 0; p < level.vectors; ++p) {  // both products while the row is at hand
    const Offset at = Offset{p} * B;
    double Ad[B], r[B];
    find_products(level, p, Ad, r);
    for (int i = 0; i < B; ++i) {
      energy += step_[at + i] * Ad[i];
      work += step_[at + i] * r[i];
    }
  }
  if (level.nonlinear) return search_nonlinear(level, energy, work);
  if (!(energy > 0 || work < 0)) return;
  double length = energy > 0 ? std::max(0.0, 1 + work / energy) : 0.0;
  const Constraints<B>& c = level.constraints;
  for (Index slot = 0; slot < c.size(); ++slot)
    for (int j = 0; j < B; ++j) {
      const Offset at = Offset{slot} * B + j, i = Offset{c.vector[slot]} * B + j;
      const double room = step_[i] > 0 ? c.upper[at] - start_[i] : start_[i] - c.lower[at];
      const double needed = std::abs(step_[i]);
      if (length * needed > room) length = std::max(1.0, room / needed);
    }
  if (!c.facet.empty()) length = std::min(length, 1.0);
  for (std::size_t i = 0; i < n; ++i) level.x[i] = start_[i] + length * step_[i];
  for (Index slot = 0; slot < c.size(); ++slot) c.project(slot, level.x + Offset{c.vector[slot]} * B);
}

// Where bounds cut nothing off the step is the interpolation of the coarse correction, and Galerkin's products tell its
// work and its energy, those of the linearised functionals included, without the finer matrix.
template <int B>
void MonotoneMultigrid<B>::search_by_coarse_level(Level<B>& level) {
  const Constraints<B>& c = level.constraints;
  double curvature = 0, of_gradient = 0;
  for (Index slot = 0; slot < c.size(); ++slot) {
    const Offset at = Offset{c.vector[slot]} * B;
    const double* H = level.piece.used_hessian.data() + Offset{slot} * B * B;
    for (int i = 0; i < B; ++i) step_[at + i] = level.x[at + i] - start_[at + i];
    for (int i = 0; i < B; ++i) {
      of_gradient += step_[at + i] * level.piece.gradient[Offset{slot} * B + i];
      for (int j = 0; j < B; ++j) curvature += step_[at + i] * H[i * B + j] * step_[at + j];
    }
  }
  const double energy = coarse_energy_ - curvature;
  search_nonlinear(level, energy, coarse_work_ + of_gradient - energy);
}

// The same with a functional; a step within bounds stays there.
// @param energy, work of the full step, work with the forces at its end; step_ holds it at the slots
template <int B>
void MonotoneMultigrid<B>::search_nonlinear(Level<B>& level, double energy, double work) {
  const Constraints<B>& c = level.constraints;
  const auto go = [&](double t) {
    for (const Index p : c.vector)
      for (Offset i = Offset{p} * B; i < (Offset{p} + 1) * B; ++i) level.x[i] = start_[i] + t * step_[i];
  };
  const double length = step_length([&](double t) {
    go(t);
    return -work - (1 - t) * energy + functional::slope(level, level.x, step_.data());
  });
  go(1);
  if (length < 1)
    for (std::size_t i = 0; i < start_.size(); ++i) level.x[i] = start_[i] + length * (level.x[i] - start_[i]);
  for (Index slot = 0; slot < c.size(); ++slot) c.project(slot, level.x + Offset{c.vector[slot]} * B);
}

template <int B>
void MonotoneMultigrid<B>::find_residual(const Level<B>& level, Index first, Index last) {
  r_.resize(static_cast<std::size_t>(last - first) * B);
  if constexpr (B == 1)
    if (is_careful(level)) return careful_residual(*level.A, level.x, level.b, first, last, r_.data());
  residual<B>(*level.A, level.x, level.b, first, last, r_.data());
}

// Of the row of one vector with the step of a line search, and with the iterate: its residual.
template <int B>
void MonotoneMultigrid<B>::find_products(const Level<B>& level, Index p, double* Ad, double* r) const {
  if constexpr (B == 1)
    if (is_careful(level)) {
      *Ad = -careful_residual(*level.A, p, step_.data(), 0);
      *r = careful_residual(*level.A, p, level.x, level.b[p]);
      return;
    }
  row_product(*level.A, p, step_.data(), Ad);
  row_product(*level.A, p, level.x, r);
  for (int i = 0; i < B; ++i) r[i] = level.b[Offset{p} * B + i] - r[i];
}

// In the units of rounding_of_work(); of a careful one nothing but loads is rounded.
template <int B>
double MonotoneMultigrid<B>::rounding_of_residual(const Level<B>& level, Index first, Index last) const {
  if (!is_careful(level)) return rounding_of_work(level, first, last);
  return rounding_of_work<B>(level.off, first, last,
                             [&](Index p, int k) { return std::abs(level.b[Offset{p} * B + k]); });
}

// From what find_residual() has found.
template <int B>
void MonotoneMultigrid<B>::restrict_residual(std::size_t k, Index first, Index last) {
  const Level<B>& fine = levels_[k];
  if (fine.nonlinear) fine.subtract_gradient(first, last, r_.data());
  transfers_[k - 1]->restrict_residual(fine, first, last, r_.data(), levels_[k - 1]);
}

// Distances and critical flags are recomputed from the iterate; what differs from the state the coarser matrices were
// made with is listed for their local reassembly.
// @param r residual at these vectors; null where it is not known
template <int B>
void MonotoneMultigrid<B>::update_phases(Level<B>& level, Index first, Index last, const double* r) {
  level.locate(first, last);
  LevelReport& report = report_.levels[static_cast<std::size_t>(&level - levels_.data())];
  const auto [from, to] = slots_between(level.constraints, first, last);
  if (rests(level, from, to, report)) return;
  for (Index slot = from; slot < to; ++slot) {
    const Index p = level.constraints.vector[slot];
    const Flags critical = level.phases.critical[slot] & static_cast<Flags>(~level.off[p]);
    report.critical += critical != 0;
    for (int k = 0; k < B; ++k) report.contact[k] += critical >> k & 1u;
    const bool free = fourth_order_ && r && critical && !is_pressed(level, slot, r[p - first]);
    Flags removed = level.off[p] | (free ? Flags{0} : truncated(level, slot, critical));
    const bool turned = level.constraints.has_facets(slot) && hold_facets(level, slot, removed);
    const bool differs = level.truncate(p, removed);
    if (turned && !differs) level.outdated.changed.push_back(p);
    report.changed += critical != level.phases.phase[slot] || differs || turned;
    level.phases.phase[slot] = critical;
    if (level.nonlinear) renew_curvature(level, slot);
  }
}

// Where interpolation knows no frames, a vector that touches a facet does not take part in it.
template <int B>
bool MonotoneMultigrid<B>::hold_facets(Level<B>& level, Index slot, Flags& removed) {
  if (settings_.truncate == Truncation::none) return false;
  if (knows_frames_) return level.hold_facets(slot, removed);
  if (level.phases.critical[slot] & on_facet<B>) removed = every_component;
  return false;
}

// The coarser matrices follow the Hessian once it has changed by more than a tenth; line searches make up for the rest.
template <int B>
void MonotoneMultigrid<B>::renew_curvature(Level<B>& level, Index slot) {
  const double* now = level.piece.hessian.data() + Offset{slot} * B * B;
  double* used = level.piece.used_hessian.data() + Offset{slot} * B * B;
  double largest = 0, changed = 0;
  for (int i = 0; i < B * B; ++i) {
    largest = std::max({largest, std::abs(now[i]), std::abs(used[i])});
    changed = std::max(changed, std::abs(now[i] - used[i]));
  }
  if (changed <= enough_curvature * largest) return;
  std::copy_n(now, B * B, used);
  level.outdated.renewed.push_back(level.constraints.vector[slot]);
}

// Whether no phase has changed, found without branches where every vector has a slot.
template <int B>
bool MonotoneMultigrid<B>::rests(const Level<B>& level, Index from, Index to, LevelReport& report) const {
  if (level.constraints.size() != level.vectors || !level.constraints.facet.empty() || level.nonlinear || near_ > 0 ||
      fourth_order_ || settings_.truncate == Truncation::tangential)
    return false;
  const Flags kept = settings_.truncate == Truncation::none ? 0 : every_component;
  const Flags *critical = level.phases.critical.data(), *phase = level.phases.phase.data();
  const Flags *off = level.off.data(), *removed = level.phases.removed.data();
  Flags different = 0;
  for (Index p = from; p < to; ++p) {
    const Flags now = critical[p] & static_cast<Flags>(~off[p]);
    different |= static_cast<Flags>((now ^ phase[p]) | (removed[p] ^ (off[p] | (now & kept))));
  }
  if (different) return false;
  for (Index p = from; p < to; ++p) report.critical += phase[p] != 0;
  for (int k = 0; k < B; ++k)
    for (Index p = from; p < to; ++p) report.contact[k] += phase[p] >> k & 1u;
  return true;
}

template <int B>
Flags MonotoneMultigrid<B>::truncated(const Level<B>& level, Index slot, Flags critical) const {
  if (settings_.truncate == Truncation::none) return 0;
  if (near_ > 0)
    for (int k = 0; k < B; ++k)
      if (std::min(-level.phases.lower[Offset{slot} * B + k], level.phases.upper[Offset{slot} * B + k]) <= near_)
        critical |= static_cast<Flags>(1u << k);
  if (critical && settings_.truncate == Truncation::tangential) return every_component;
  return critical & every_component;
}

// Of a scalar in contact.
template <int B>
bool MonotoneMultigrid<B>::is_pressed(const Level<B>& level, Index slot, double force) const {
  const bool below = level.phases.lower[slot] >= 0, above = level.phases.upper[slot] <= 0;
  return (below && above) || (below && force < 0) || (above && force > 0);
}

template class MonotoneMultigrid<1>;
template class MonotoneMultigrid<2>;
template class MonotoneMultigrid<3>;
template Level<1> finest_level(const DiscreteProblem<1>&);
template Level<2> finest_level(const DiscreteProblem<2>&);
template Level<3> finest_level(const DiscreteProblem<3>&);

}  // namespace signorini
