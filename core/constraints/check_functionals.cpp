#include "core/constraints/check_functionals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/constraints/local_problem.hpp"
#include "core/sdk/polyhedron.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/functional.hpp"

namespace signorini {
namespace {

constexpr double beyond_bounds = 1e-9;  // of displacements and bounds, what x may be beyond these

template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

/// Asks the functionals of a problem at one vector of unknowns, node by node.
template <int B>
class Check {
 public:
  Check(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem, const std::vector<Index>& acts,
        const std::vector<double>& x)
      : places_(places),
        acts_(acts),
        problem_(problem),
        x_(x),
        data_(functional::data_at(problem_, x)),
        view_(functional::view(problem_)) {
    view_.data = data_.data();
    view_.x = const_cast<double*>(x.data());  // for sweeps, which are not asked for
    for (const double value : x)
      if (std::isfinite(value)) largest_ = std::max(largest_, std::abs(value));
  }

  /// What x is at the nodes of functionals.
  void solution() const {
    each_slot([this](Index slot) {
      if (!all_finite(at(slot))) refuse(slot, "the local solver or the linearisation leads to", at(slot));
      if (is_beyond_bounds(slot))
        refuse(slot,
               fmt::format("with the bounds ({:.6g}) and ({:.6g}) the local solver leads to",
                           fmt::join(of_slot(slot, problem_.constraints.lower), ", "),
                           fmt::join(of_slot(slot, problem_.constraints.upper), ", ")),
               at(slot));
    });
  }

  /// What functionals say about x, which is finite there.
  void answers() {
    const std::vector<double> gradient = functional::gradient(problem_, x_), zero(x_.size());
    each_slot([&](Index slot) {
      const Index p = problem_.constraints.vector[slot];
      const Functional<B>& phi = *obstacle(slot).functional();
      const auto width = static_cast<std::size_t>(view_.width);
      expect_finite(slot, "what is renewed", std::span(data_).subspan(static_cast<std::size_t>(slot) * width, width));
      expect_finite(slot, "the gradient", of_slot(slot, gradient));
      expect_finite(slot, "the change", std::array{phi.change(view_, p, p + 1, zero.data(), x_.data())});
      expect_finite(slot, "the slope", std::array{phi.slope(view_, p, p + 1, x_.data(), x_.data())});
    });
  }

  /// Whether they minimise, for the forces at x.
  void minimisers() {
    const auto length = step_of(largest_);
    each_local([&](Index slot, LocalProblem<B>& local) {
      const Vector from = vector_at(slot);
      expect_minimiser(slot, local, from, force(slot), length);
    });
  }

  /// The same for other forces as well, and what the functionals say of steps, at some of the nodes.
  void probe() {
    constexpr std::size_t most = 1000;
    const std::size_t slots = acts_.size() - static_cast<std::size_t>(std::ranges::count(acts_, -1));
    const std::size_t every = 1 + slots / most;
    const double size = size_of_answers(every);
    if (!(size > 0)) return;  // nothing happens
    std::size_t number = 0;
    each_local([&](Index slot, LocalProblem<B>& local) {
      if (number++ % every != 0) return;
      const Vector x = vector_at(slot), r = force(slot);
      Vector y = expect_minimiser(slot, local, x, r, step_of(size));
      for (const double part : {1.0, -0.05}) {
        Vector d;
        for (int k = 0; k < B; ++k) d[k] = part * size * ((number >> k) % 2 ? 1 : -1) / (k + 1);
        expect_convex(slot, local, y, size);
        Vector other = r, further = local.force(d);
        for (int k = 0; k < B; ++k) other[k] += further[k];
        y = expect_minimiser(slot, local, x, other, step_of(size));
      }
    });
  }

  /// How far the local solvers say that x is off.
  void local_solvers() {
    std::vector<double> r(x_.size());
    const std::vector<double> inverse(x_.size() * B);  // for nodes that nothing acts on
    residual<B>(problem_.A, x_.data(), problem_.b.data(), r.data());
    view_.inverse = inverse.data();
    each_slot([&](Index slot) {
      const Index p = problem_.constraints.vector[slot];
      expect_finite(slot, "the result of the local solver",
                    std::array{obstacle(slot).natural_residual(view_, p, p + 1, r.data())});
    });
  }

 private:
  using Vector = std::array<double, B>;

  /// So small that smooth functionals are nearly straight along it, and far above rounding.
  static double step_of(double size) { return 1e-3 * size; }

  /// Facets admit less than bounds do, and are not asked for here.
  template <class Use>
  void each_local(const Use& use) {
    each_slot([&](Index slot) {
      if (has_facets(view_, slot)) return;
      LocalProblem<B> local(obstacle(slot), view_, slot);
      use(slot, local);
    });
  }

  Vector vector_at(Index slot) const {
    Vector out;
    std::ranges::copy(at(slot), out.begin());
    return out;
  }

  /// b - A x
  Vector force(Index slot) const {
    const Index p = problem_.constraints.vector[slot];
    const Offset first = problem_.A.row[p], last = problem_.A.row[p + 1];
    Vector out, Ax;
    block::row_product<B>(problem_.A.value.data() + first * B * B, problem_.A.column.data() + first, last - first,
                          x_.data(), Ax.data());
    for (int k = 0; k < B; ++k) out[k] = problem_.b[Offset{p} * B + k] - Ax[k];
    return out;
  }

  /// How large unknowns are: those there are, and the corrections that the nodes ask for alone.
  double size_of_answers(std::size_t every) {
    double size = largest_;
    std::size_t number = 0;
    each_local([&](Index slot, LocalProblem<B>& local) {
      if (number++ % every != 0) return;
      const Vector d = local.correction(force(slot));
      if (const double length = block::norm<B>(d.data()); std::isfinite(length)) size = std::max(size, length);
    });
    return size;
  }

  /// What is not finite is told in the end, when it is known that it has done harm.
  Vector expect_minimiser(Index slot, LocalProblem<B>& local, const Vector& x, const Vector& r, double length) {
    const Vector y = local.minimiser(x, r);
    if (!all_finite(y) || !all_finite(r)) return x;
    if (const auto better = local.better_than(y, x, r, length))
      refuse(slot,
             fmt::format("for the force ({:.6g}) the local solver leads to ({:.6g}), which is no minimiser: there is "
                         "less energy at",
                         fmt::join(r, ", "), fmt::join(y, ", ")),
             *better);
    return y;
  }

  /// Along each component, to either side, within the bounds.
  void expect_convex(Index slot, const LocalProblem<B>& local, const Vector& x, double size) const {
    for (int side = 0; side < 2 * B; ++side)
      for (const double length : {step_of(size), size}) {
        Vector d{};
        d[side / 2] = side % 2 ? -length : length;
        const Vector z = local.moved(x, d);
        if (z == x) continue;
        if (const auto wrong = local.contradiction(x, z))
          refuse(slot,
                 fmt::format("a step to ({:.6g}) changes the functional by {:.6g}, and its slope along it, which never "
                             "falls where a functional is convex, is at its ends",
                             fmt::join(z, ", "), wrong->change),
                 std::array{wrong->first, wrong->last});
      }
  }

  template <class Use>
  void each_slot(const Use& use) const {
    for (std::size_t slot = 0; slot < acts_.size(); ++slot)
      if (acts_[slot] >= 0) use(static_cast<Index>(slot));
  }

  const Obstacle<B>& obstacle(Index slot) const { return *places_.obstacle(acts_[slot]); }

  std::span<const double> at(Index slot) const {
    return std::span(x_).subspan(static_cast<std::size_t>(problem_.constraints.vector[slot]) * B, B);
  }
  static std::span<const double> of_slot(Index slot, const std::vector<double>& all) {
    return std::span(all).subspan(static_cast<std::size_t>(slot) * B, B);
  }

  bool is_beyond_bounds(Index slot) const {
    const auto lower = of_slot(slot, problem_.constraints.lower), upper = of_slot(slot, problem_.constraints.upper);
    for (int k = 0; k < B; ++k) {
      const double beyond = std::max(lower[k] - at(slot)[k], at(slot)[k] - upper[k]);
      const double bound = std::min(std::abs(lower[k]), std::abs(upper[k]));
      if (beyond > beyond_bounds * (largest_ + bound)) return true;
    }
    return false;
  }

  template <class Numbers>
  void expect_finite(Index slot, const char* what, const Numbers& found) const {
    if (!all_finite(found)) refuse(slot, fmt::format("at finite unknowns {} is", what), found);
  }

  template <class Numbers>
  [[noreturn]] void refuse(Index slot, const std::string& what, const Numbers& found) const {
    throw Error(Exit::plugin, fmt::format("{}: at {}, in local coordinates, {} ({:.6g}): a fault of the plugin",
                                          places_.origin(acts_[slot]), places_.place(problem_.constraints.vector[slot]),
                                          what, fmt::join(found, ", ")));
  }

  const ObstaclePlaces<B>& places_;
  const std::vector<Index>& acts_;  // per slot the obstacle whose functional does
  const DiscreteProblem<B>& problem_;
  const std::vector<double>& x_;
  std::vector<double> data_;  // what functionals are frozen with
  LevelView<B> view_;
  double largest_ = 0;
};

}  // namespace

template <int B>
void check_functionals(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem,
                       const std::vector<Index>& acts, const std::vector<double>& x) {
  if (acts.empty()) return;
  Check<B> check(places, problem, acts, x);
  check.solution();
  if (!all_finite(x)) return;
  check.answers();
  check.minimisers();
}

template <int B>
void probe_functionals(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem,
                       const std::vector<Index>& acts, const std::vector<double>& x) {
  if (acts.empty() || !all_finite(x)) return;
  std::vector<double> start = x;
  make_admissible(problem, start);
  Check<B>(places, problem, acts, start).probe();
}

template <int B>
void blame_functionals(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem,
                       const std::vector<Index>& acts, std::vector<double> x) {
  if (acts.empty()) return;
  for (double& value : x)
    if (!std::isfinite(value)) value = 0;
  make_admissible(problem, x);
  std::vector<double> r(x.size());
  residual<B>(problem.A, x.data(), problem.b.data(), r.data());
  if (!std::isfinite(dot(r, r)) || !std::isfinite(dot(x, x))) return;  // no finite question
  Check<B> check(places, problem, acts, x);
  check.answers();
  check.local_solvers();
}

#define SIGNORINI_INSTANTIATE(B)                                                                                     \
  template void probe_functionals<B>(const ObstaclePlaces<B>&, const DiscreteProblem<B>&, const std::vector<Index>&, \
                                     const std::vector<double>&);                                                    \
  template void check_functionals<B>(const ObstaclePlaces<B>&, const DiscreteProblem<B>&, const std::vector<Index>&, \
                                     const std::vector<double>&);                                                    \
  template void blame_functionals<B>(const ObstaclePlaces<B>&, const DiscreteProblem<B>&, const std::vector<Index>&, \
                                     std::vector<double>);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
