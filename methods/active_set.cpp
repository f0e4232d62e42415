#include "methods/active_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/algebra/products.hpp"
#include "core/base/clock.hpp"
#include "core/base/dot.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {

namespace {

// Small shifts make large motions of what rounding leaves of loads that balance: these touch bounds, and so on.
constexpr int steps_per_shift = 10;
constexpr double largest_shift = 1e-6;
// The same where the sets come back: with steps so short they come to rest.
constexpr double damping = 1e-4;
constexpr int most_undampings = 5, most_damped_steps = 40;
constexpr int exact_after = 3;             // solves without a change of the sets
constexpr std::size_t resting_steps = 10;  // in which the residual has to fall by half

}  // namespace

template <int B>
ActiveSetIteration<B>::ActiveSetIteration(const DiscreteProblem<B>& problem, std::vector<double>& x,
                                          const SolverOptions& options, const Registry& registry,
                                          const std::string& linear, double shift_if_singular)
    : Iteration<B>(problem, x, options),
      linear_(linear),
      level_(finest_level(problem)),
      system_(problem.A, registry.create<LinearSolver>("linear", linear)),
      shift_if_singular_(shift_if_singular) {}

// Calls visit(number in active_, unknown, lower bound, upper bound) for what is not prescribed, where there are no
// facets.
template <int B>
template <class Visit>
void ActiveSetIteration<B>::visit_bounds(const Visit& visit) const {
  const Constraints<B>& c = level_.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) {
    if (c.has_facets(slot)) continue;
    for (int k = 0; k < B; ++k) {
      const Index p = c.vector[slot];
      const auto at = static_cast<std::size_t>(slot) * B + static_cast<std::size_t>(k);
      if (!(level_.off[p] >> k & 1u)) visit(at, Offset{p} * B + k, c.lower[at], c.upper[at]);
    }
  }
}

// Calls visit(number in active_ of the first component, vector, polyhedron) for the others.
template <int B>
template <class Visit>
void ActiveSetIteration<B>::visit_polyhedra(const Visit& visit) const {
  const Constraints<B>& c = level_.constraints;
  if (c.facet.empty()) return;
  for (Index slot = 0; slot < c.size(); ++slot)
    if (c.has_facets(slot)) visit(static_cast<std::size_t>(slot) * B, c.vector[slot], c.polyhedron(slot));
}

// By choose(vector, polyhedron), where there are facets.
template <int B>
template <class Choose>
void ActiveSetIteration<B>::choose_sides(std::vector<short>& active, const Choose& choose) const {
  visit_polyhedra([&](std::size_t at, Index p, const Polyhedron<B>& polyhedron) {
    const HeldSides<B> sides = choose(p, polyhedron);
    std::copy_n(sides.number, B, active.begin() + static_cast<Offset>(at));
  });
}

// Where the iterate would go beyond a bound if nothing but this component, or with facets this vector, moved.
template <int B>
std::vector<short> ActiveSetIteration<B>::predicted() const {
  std::vector<short> active(level_.constraints.lower.size(), 0);
  visit_bounds([&](std::size_t at, Offset i, double lower, double upper) {
    const double target = y_[i] + r_y_[i] / system_.diagonal(i);
    active[at] = lower == upper || target < lower ? -1 : target > upper ? 1 : 0;
  });
  choose_sides(active, [&](Index p, const Polyhedron<B>& polyhedron) {
    double d[B], target[B];
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{p} * B + k;
      d[k] = system_.diagonal(i);
      target[k] = y_[i] + r_y_[i] / d[k];
    }
    return sides_before(polyhedron, d, target);
  });
  return active;
}

template <int B>
std::vector<short> ActiveSetIteration<B>::at_bounds() const {
  std::vector<short> active(level_.constraints.lower.size(), 0);
  visit_bounds([&](std::size_t at, Offset i, double lower, double upper) {
    active[at] = y_[i] <= lower ? -1 : y_[i] >= upper ? 1 : 0;
  });
  choose_sides(active, [&](Index p, const Polyhedron<B>& polyhedron) {
    return sides_at(polyhedron, y_.data() + Offset{p} * B);
  });
  return active;
}

template <int B>
std::vector<short> ActiveSetIteration<B>::all_bounded() const {
  std::vector<short> active(level_.constraints.lower.size(), 0);
  visit_bounds([&](std::size_t at, Offset, double lower, double upper) {
    active[at] = lower > -infinity ? -1 : upper < infinity ? 1 : 0;
  });
  choose_sides(active, [](Index, const Polyhedron<B>& polyhedron) { return all_sides(polyhedron); });
  return active;
}

template <int B>
typename ActiveSetIteration<B>::Step ActiveSetIteration<B>::advance() {
  const double begin = seconds();
  ++steps_;
  this->x_before_ = this->x_;
  if (steps_ == 1) {
    y_ = this->x_;
    r_y_ = this->r_before_;
    active_ = at_bounds();
  }
  const std::vector<short> last = std::exchange(active_, predicted());
  bool changed = steps_ == 1 || active_ != last;
  at_rest_ = changed ? 0 : at_rest_ + 1;
  damped_steps_ += damped_;
  if (damped_ && !changed && undamped_ < most_undampings) {
    end_damping();
    changed = true;  // the matrix has
  }
  if (changed && shift_ > 0 && !damped_ && steps_ % steps_per_shift == 0) shift_ = std::min(10 * shift_, largest_shift);
  Step step;
  step.error = infinity;
  const bool solved = minimise(changed);
  this->sums_ = this->evaluate(this->x_, this->r_);
  this->refuse_nan(this->sums_.natural_residual);
  if (solved) step.error = remaining_error(changed);
  step.stuck = solved ? why_stuck(changed)
                      : "the matrix is singular on the components that are not active: nothing holds the body there";
  step.exact = shift_ == 0 && at_rest_ >= exact_after;
  step.levels = {report(last)};
  step.levels.front().renewed = changed ? level_.vectors : 0;
  step.levels.front().seconds = seconds() - begin;
  return step;
}

// Sets that come back do so for ever, but for shifts that grow. With a shift what nothing holds falls by the same in
// each step.
template <int B>
std::string ActiveSetIteration<B>::why_stuck(bool changed) {
  if (changed) residuals_.clear();
  residuals_.push_back(this->sums_.natural_residual);
  const std::size_t n = residuals_.size();
  if (shift_ > 0 && n > resting_steps && residuals_[n - 1] > 0.5 * residuals_[n - 1 - resting_steps])
    return "the active sets rest, but not the iterates: nothing holds the body there";
  const std::string_view bytes(reinterpret_cast<const char*>(active_.data()), active_.size() * sizeof(short));
  const auto [found, fresh] = seen_.try_emplace(std::hash<std::string_view>()(bytes), steps_);
  if (damped_ && damped_steps_ <= most_damped_steps) return "";  // what they are moved from changes all the time
  if (!changed || fresh || (shift_ > 0 && shift_ < largest_shift)) return "";
  if (shift_if_singular_ > 0 && shift_ == 0 && undamped_ < most_undampings) {
    damped_ = true;
    shift_ = damping;
    seen_.clear();
    return "";
  }
  return fmt::format("the active sets of step {} came back in step {}: the method cycles", found->second, steps_);
}

template <int B>
void ActiveSetIteration<B>::end_damping() {
  damped_ = false;
  ++undamped_;
  shift_ = 0;
  at_rest_ = 0;
  seen_.clear();
}

// The step itself bounds the error of the iterate before. With a shift the steps become shorter by and by.
template <int B>
double ActiveSetIteration<B>::remaining_error(bool changed) {
  const double move = std::sqrt(std::abs(this->sums_.correction)), last = std::exchange(last_move_, move);
  if (shift_ == 0 || changed || move == 0) return move;
  return move < last ? move / (1 - move / last) : infinity;
}

// What nothing holds stays next to where it is with a shift. Without one the start may be a body that touches nothing:
// with all bounds active there may be something to hold it, however weakly, and it comes to rest anywhere.
template <int B>
bool ActiveSetIteration<B>::minimise(bool changed) {
  if ((!changed || factorise()) && solve_free()) return true;
  if (shift_if_singular_ > 0) {
    if (shift_ > 0) return false;
    shift_ = shift_if_singular_;
    seen_.clear();
  } else {
    if (steps_ > 1 || active_ == all_bounded()) return false;
    active_ = all_bounded();
  }
  return factorise() && solve_free();
}

template <int B>
bool ActiveSetIteration<B>::factorise() {
  SystemChange<B>& change = system_.change();
  std::fill(change.held.begin(), change.held.end(), 0);
  for (std::size_t i = 0; i < y_.size(); ++i) change.added[i] = shift_ * system_.diagonal(static_cast<Offset>(i));
  visit_bounds([&](std::size_t at, Offset i, double, double) { change.held[i] = active_[at] != 0; });
  change.turned.clear();
  visit_polyhedra([&](std::size_t at, Index p, const Polyhedron<B>& polyhedron) {
    const HeldSides<B> sides = sides_of(at);
    if (!sides.any()) return;
    const int count = held_coordinates(polyhedron, sides, level_.off[p], change.turned.add(p));
    for (int k = 0; k < B; ++k) change.held[Offset{p} * B + k] = k < count;
  });
  return system_.factorise();
}

template <int B>
HeldSides<B> ActiveSetIteration<B>::sides_of(std::size_t at) const {
  HeldSides<B> sides;
  std::copy_n(active_.begin() + static_cast<Offset>(at), B, sides.number);
  return sides;
}

template <int B>
bool ActiveSetIteration<B>::solve_free() {
  const DiscreteProblem<B>& problem = this->problem_;
  visit_bounds([&](std::size_t at, Offset i, double lower, double upper) {
    if (active_[at] != 0) y_[i] = active_[at] < 0 ? lower : upper;
  });
  visit_polyhedra([&](std::size_t at, Index p, const Polyhedron<B>& polyhedron) {
    go_onto(polyhedron, sides_of(at), y_.data() + Offset{p} * B);
  });
  residual<B>(problem.A, y_.data(), problem.b.data(), r_y_.data());
  if (!system_.solve(r_y_)) return false;
  for (std::size_t i = 0; i < r_y_.size(); ++i) y_[i] += r_y_[i];
  residual<B>(problem.A, y_.data(), problem.b.data(), r_y_.data());
  this->x_ = y_;
  make_admissible(this->problem_, this->x_);
  return true;
}

template <int B>
LevelReport ActiveSetIteration<B>::report(const std::vector<short>& last) const {
  LevelReport out;
  out.vectors = level_.vectors;
  for (Index slot = 0; slot < level_.constraints.size(); ++slot) {
    bool critical = false, changed = false;
    for (int k = 0; k < B; ++k) {
      const auto at = static_cast<std::size_t>(slot) * B + static_cast<std::size_t>(k);
      if (!level_.constraints.has_facets(slot))
        out.contact[static_cast<std::size_t>(k)] += active_[at] != 0;
      else if (active_[at] > 0 && active_[at] <= 2 * B)  // a side of a component
        ++out.contact[static_cast<std::size_t>((active_[at] - 1) / 2)];
      critical = critical || active_[at] != 0;
      changed = changed || active_[at] != last[at];
    }
    out.critical += critical;
    out.changed += changed;
  }
  return out;
}

template <int B>
void ActiveSetIteration<B>::add_work(Stage& stage) const {
  stage.linear = linear_;
  stage.linear_solves = system_.solves();
  stage.factorisations = system_.factorisations();
}

// By the factorisation of the last step.
template <int B>
std::optional<double> ActiveSetIteration<B>::response(const std::vector<double>& forces, double) {
  std::vector<double> d = forces;
  if (!system_.solve(d)) return {};
  return std::sqrt(std::abs(dot(d, forces)));
}

template class ActiveSetIteration<1>;
template class ActiveSetIteration<2>;
template class ActiveSetIteration<3>;

}  // namespace signorini
