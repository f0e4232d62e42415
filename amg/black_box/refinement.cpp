#include "amg/black_box/refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "amg/black_box/refuse_indefinite.hpp"
#include "amg/linear/held_cholesky.hpp"
#include "amg/linear/unit_diagonal.hpp"
#include "core/algebra/products.hpp"
#include "core/algebra/two_doubles.hpp"
#include "core/base/clock.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/convergence.hpp"
#include "core/solver/multigrid.hpp"
#include "methods/stages.hpp"

namespace signorini {
namespace {

using Real = long double;
using Vector = std::vector<Real>;
using Set = std::vector<signed char>;  // per unknown: -1 at the lower bound, 1 at the upper one, 0 free

constexpr int most_sets = 40, most_steps = 8;
constexpr Real no_pivot = 4 * std::numeric_limits<double>::epsilon();  // of a diagonal of about one: a motion
constexpr Real rounding_of_pivots = 512 * std::numeric_limits<Real>::epsilon();
constexpr double last_digit = std::numeric_limits<double>::epsilon();
constexpr double rounding_of_terms = 16 * last_digit;  // of their sum
constexpr double weightless = 8 * last_digit;          // supports that are rounding, of the diagonal
constexpr double harmless = 0.1;                       // part of the tolerance
constexpr double balanced = 1e-2;                      // ties of the diagonal that cycles see
constexpr Real slowest = 0.5;                          // reduction of the correction in a step
constexpr Real small_part = 0.01;                      // part of the tolerance: errors that need no further step
constexpr Real rounding = 64 * std::numeric_limits<Real>::epsilon();
constexpr double inaccurate = 1e-2;  // relative errors from which on nothing is claimed

// What costs little beside any solve: few vectors, or nearly a tree; of either the factorisation, too.
constexpr Index few_blocks = 400;
constexpr double cheap_operations = 20;  // per entry

/// Active sets from an admissible vector on.
template <int B>
class ExtendedSets {
 public:
  ExtendedSets(const DiscreteProblem<B>& problem, const HeldRows<B>& held, std::span<const double> b, double tolerance,
               double most_operations, bool regular)
      : problem_(problem),
        held_(held),
        b_(b),
        tolerance_(tolerance),
        most_operations_(most_operations),
        regular_(regular),
        no_pivot_(regular ? rounding_of_pivots : no_pivot),
        x_(b.size()),
        r_(b.size()),
        active_(b.size(), 0) {}

  /// Returns whether the solution was found.
  bool solve(const std::vector<double>& start) {
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = TwoDoubles(start[i]);
    residual();
    active_ = predicted();
    for (int set = 0; set < most_sets; ++set) {
      const std::vector<TwoDoubles> before = x_;
      if (!factorise() || !solve_free()) return false;
      if (set > 0 && distance(before) <= small_part * tolerance_ * size()) return true;
      const Set last = std::exchange(active_, predicted());
      if (active_ == last) return true;
    }
    return false;
  }

  /// The admissible vector next to it.
  std::vector<double> rounded() const {
    std::vector<double> x;
    for (const TwoDoubles& value : x_) x.push_back(value.high);
    make_admissible(problem_, x);
    return x;
  }

  double error(const std::vector<double>& x) const {
    return static_cast<double>(distance(std::vector<TwoDoubles>(x.begin(), x.end())));
  }

  /// ||x||_A, prescribed values counted in; r = b - A x.
  Real size() const {
    Real squared = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) squared += x_[i].value() * (b_[i] - r_[i]);
    return std::sqrt(std::max(squared, Real{0}));
  }

  /// Whether the way d from there has A d = 0 but for rounding in all rows that are free: then the rounding in A alone
  /// may have led here.
  bool came_by_motion(const std::vector<double>& from) const {
    const BlockMatrix<B>& A = problem_.A;
    for (Index p = 0; p < A.size(); ++p)
      for (int i = 0; i < B; ++i) {
        const Offset row = Offset{p} * B + i;
        if (prescribed(static_cast<std::size_t>(row)) || active_[row] != 0) continue;
        Real sum = 0, terms = 0;
        for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
          for (int j = 0; j < B; ++j) {
            const Offset column = Offset{A.column[k]} * B + j;
            const Real term = A.at(k)[i * B + j] * (x_[column].value() - from[column]);
            sum += term;
            terms += std::abs(term);
          }
        if (std::abs(sum) > rounding_of_terms * terms) return false;
      }
    return true;
  }

  /// Whether the matrix has no motion, but a direction of so little energy that rounding hides it.
  bool hidden() const { return hidden_; }
  /// About the relative error of the start, by the first correction; zero where there was none.
  double first_error() const { return first_error_; }
  int sets() const { return sets_; }
  int solves() const { return solves_; }

 private:
  bool prescribed(std::size_t i) const { return problem_.fixed[i / B] >> (i % B) & 1u; }

  void residual() {
    const BlockMatrix<B>& A = problem_.A;
    for (Index p = 0; p < A.size(); ++p)
      for (int i = 0; i < B; ++i) {
        TwoDoubles rest(b_[Offset{p} * B + i]);
        for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
          for (int j = 0; j < B; ++j) rest.add_product(-A.at(k)[i * B + j], x_[Offset{A.column[k]} * B + j]);
        r_[Offset{p} * B + i] = rest.value();
      }
    held_.residual(problem_, x_.data(), b_.data(), r_.data());
  }

  /// ||x - other||_A
  Real distance(const std::vector<TwoDoubles>& other) const {
    const BlockMatrix<B>& A = problem_.A;
    Vector d(x_.size());
    for (std::size_t i = 0; i < d.size(); ++i)
      d[i] = prescribed(i) ? 0 : (Real{x_[i].high} - other[i].high) + (Real{x_[i].low} - other[i].low);
    Real squared = 0;
    for (Index p = 0; p < A.size(); ++p)
      for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
        for (int i = 0; i < B; ++i)
          for (int j = 0; j < B; ++j)
            squared += d[Offset{p} * B + i] * A.at(k)[i * B + j] * d[Offset{A.column[k]} * B + j];
    return std::sqrt(std::max(squared, Real{0}));
  }

  /// Where the iterate would go beyond a bound if nothing but this component moved.
  Set predicted() const {
    Set out(x_.size(), 0);
    visit_bounds([&](Offset i, Real lower, Real upper) {
      const Real x = x_[i].value(), slack = (active_[i] ? rounding : -rounding) * std::abs(x);
      const Real target = x + r_[i] / problem_.A.diagonal(static_cast<Index>(i / B))[i % B * (B + 1)];
      out[i] = target < lower + slack ? -1 : target > upper - slack ? 1 : 0;
    });
    return out;
  }

  template <class Visit>
  void visit_bounds(const Visit& visit) const {
    const Constraints<B>& c = problem_.constraints;
    for (Index slot = 0; slot < c.size(); ++slot)
      for (int k = 0; k < B; ++k) {
        const Offset i = Offset{c.vector[slot]} * B + k, at = Offset{slot} * B + k;
        if (!prescribed(static_cast<std::size_t>(i))) visit(i, c.lower[at], c.upper[at]);
      }
  }

  bool factorise() {
    std::vector<Flags> mask = problem_.fixed;
    for (std::size_t i = 0; i < active_.size(); ++i)
      if (active_[i] != 0) mask[i / B] |= static_cast<Flags>(1u << (i % B));
    ++sets_;
    if (!factor_.factorise(scaled_exactly(problem_.A, mask, scale_), most_operations_, no_pivot_)) return false;
    hidden_ = regular_ && !factor_.held().empty();
    return !hidden_ && factor_.falling_direction().size() == 0;
  }

  bool solve_free() {
    visit_bounds([&](Offset i, double lower, double upper) {
      if (active_[i] != 0) x_[i] = TwoDoubles(active_[i] < 0 ? lower : upper);
    });
    residual();
    Real last = infinity;
    for (int step = 0; step < most_steps; ++step) {
      const Real move = correct();
      residual();
      if (solves_ == 1 && move > 0) first_error_ = static_cast<double>(move / std::max(move, size()));
      if (move <= small_part * tolerance_ * size()) return true;
      if (!(move <= slowest * last)) return false;
      last = move;
    }
    return false;
  }

  /// Returns the size of the correction.
  Real correct() {
    Eigen::Matrix<Real, Eigen::Dynamic, 1> d(static_cast<Eigen::Index>(r_.size()));
    for (std::size_t i = 0; i < r_.size(); ++i) d[static_cast<Eigen::Index>(i)] = scale_[i] * r_[i];
    d = factor_.solve(d);
    ++solves_;
    Real squared = 0;
    for (std::size_t i = 0; i < r_.size(); ++i) {
      const Real moved = scale_[i] * d[static_cast<Eigen::Index>(i)];
      squared += moved * r_[i];
      x_[i].add(moved);
    }
    return std::sqrt(std::abs(squared));
  }

  const DiscreteProblem<B>& problem_;
  const HeldRows<B>& held_;
  std::span<const double> b_;
  const double tolerance_, most_operations_;
  const bool regular_;
  const Real no_pivot_;
  bool hidden_ = false;
  double first_error_ = 0;
  std::vector<TwoDoubles> x_;
  Vector r_;
  Set active_;
  std::vector<double> scale_;  // zero where held
  BasicHeldCholesky<Real> factor_;
  int sets_ = 0, solves_ = 0;
};

/// About the inverse of the condition in units in which the diagonal is one, of a matrix whose diagonal dominates: by
/// its weakest coupling or support. Zero where that does not tell.
template <int B>
double weakest_tie(const BlockMatrix<B>& A) {
  double weakest = 1;
  for (Index p = 0; p < A.size(); ++p)
    for (int i = 0; i < B; ++i) {
      const double own = A.diagonal(p)[i * (B + 1)];
      double others = -own;
      for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
        for (int j = 0; j < B; ++j)
          if (const double tie = std::abs(A.at(k)[i * B + j]); tie > 0) {
            others += tie;
            weakest = std::min(weakest, tie / own);
          }
      const double support = (own - others) / own;
      if (support < -weightless) return 0;
      if (support > weightless) weakest = std::min(weakest, support);
    }
  return weakest;
}

/// Whether rounding may do harm, or so slow cycles that their gains do not show what is left.
template <int B>
bool may_mislead(const BlockMatrix<B>& A, double tolerance, bool tree) {
  const double weakest = weakest_tie(A), longest = tree ? 2 : 1;
  return weakest < balanced || last_digit * std::pow(A.size(), longest) > harmless * tolerance * weakest;
}

/// What a factorisation may take; zero: none is to be made.
template <int B>
double most_operations(const BlockMatrix<B>& A, const SolverOptions& options, const Summary& s) {
  const Offset blocks = A.row[A.size()], entries = blocks * B * B / 2;
  const bool small = A.size() <= few_blocks, tree = blocks <= blocks_of_a_tree * A.size();
  switch (s.outcome) {
    case Outcome::converged:
      if (s.rounding_error > 0) return affordable_operations(entries);
      if (!small && !tree) return 0;
      return may_mislead(A, options.tolerance, tree) ? cheap_operations * static_cast<double>(entries) : 0;
    case Outcome::iteration_limit:
    case Outcome::stuck:
      if (options.method != "auto" || options.max_iterations < automatic::patience_with_cycles.first) return 0;
      [[fallthrough]];
    case Outcome::unbounded:
    case Outcome::rounding:
    case Outcome::inaccurate:
      return affordable_operations(entries);
    default:
      return 0;
  }
}

template <int B>
double natural_residual(const DiscreteProblem<B>& problem, std::vector<double> x) {
  std::vector<double> r(x.size());
  residual<B>(problem.A, x.data(), problem.b.data(), r.data());
  const Level<B> level = finest_level(problem);
  LevelView<B> view = level.view();
  view.x = x.data();
  double largest = 0;
  level.for_each_segment(0, level.vectors, Order::forward, [&](const Segment<B>& s, Index first, Index last) {
    largest = block::larger(largest, s.obstacle->natural_residual(view, first, last, r.data()));
  });
  return largest;
}

void judge(Summary& s, double tolerance) {
  if (s.algebraic_error > inaccurate) {
    s.outcome = Outcome::inaccurate;
    s.reason = fmt::format(
        "rounding leaves an algebraic error of about {:.1e}, tolerance {:.3e}: the matrix is too "
        "badly conditioned for the machine's precision",
        s.algebraic_error, tolerance);
  } else if (s.algebraic_error > tolerance || s.residual > tolerance) {
    s.outcome = Outcome::rounding;
    s.reason = fmt::format("limited by rounding: residual {:.3e} and algebraic error {:.3e} reached, tolerance {:.3e}",
                           s.residual, s.algebraic_error, tolerance);
  } else {
    s.outcome = Outcome::converged;
    s.reason = fmt::format("residual {:.3e} and algebraic error {:.3e} are at most {:.3e}", s.residual,
                           s.algebraic_error, tolerance);
  }
}

template <int B>
bool is_tree(const BlockMatrix<B>& A) {
  return A.row[A.size()] <= 3 * Offset{A.size()};  // each vector, and each of less edges twice
}

/// Where rounding in the matrix alone may have led to another solution, either may be the right one.
void doubt(Summary& s, double difference, double tolerance) {
  if (!s.converged() || difference <= std::max(s.algebraic_error, tolerance)) return;
  s.algebraic_error = s.rounding_error = difference;
  s.history.back().algebraic_error = difference;
  judge(s, tolerance);
}

}  // namespace

template <int B>
void refine(const DiscreteProblem<B>& problem, const HeldRows<B>& held, std::span<const double> b,
            const SolverOptions& options, const Motions<B>& motions, std::vector<double>& x, Summary& summary) {
  const double most = most_operations(problem.A, options, summary);
  if (most == 0) return;
  const double begin = seconds();
  ExtendedSets<B> sets(problem, held, b, options.tolerance, most, motions.regular());
  if (!sets.solve(x)) {
    if (motions.regular()) doubt(summary, sets.hidden() ? 1 : sets.first_error(), options.tolerance);
    return;
  }
  const auto size = static_cast<double>(sets.size());
  const auto relative = [&](double error) { return error == 0 ? 0 : size > 0 ? error / size : 1; };
  const double before = relative(sets.error(x));
  if (!motions.regular() && sets.came_by_motion(x)) {
    if (!motions.complete() && is_tree(problem.A)) doubt(summary, before, options.tolerance);
    return;
  }
  if (!motions.regular() && summary.outcome == Outcome::unbounded &&
      sets.came_by_motion(std::vector<double>(x.size(), 0.0)))
    return;
  if (summary.outcome == Outcome::converged && before <= options.tolerance) {
    summary.algebraic_error = std::max(summary.algebraic_error, before);
    summary.history.back().algebraic_error = summary.algebraic_error;
    return;
  }
  const std::vector<double> nearest = sets.rounded();
  const double after = relative(sets.error(nearest));
  if (summary.converged() && after > std::max(options.tolerance, summary.algebraic_error) &&
      (after >= before || !motions.regular())) {
    if (motions.regular()) doubt(summary, before, options.tolerance);
    return;
  }
  x = nearest;
  Summary more;
  more.algebraic_error = more.rounding_error = after;
  more.energy = energy(problem, x);
  std::vector<double> zero(x.size(), 0.0);
  make_admissible(problem, zero);
  const double reference = natural_residual(problem, zero);
  more.residual = natural_residual(problem, x) / (reference > 0 ? reference : 1);
  judge(more, options.tolerance);
  if (more.outcome == Outcome::converged) more.rounding_error = 0;
  Stage stage;
  const automatic::Attempt& refinement = automatic::attempt(automatic::Kind::refinement);
  stage.method = refinement.method;
  stage.linear = refinement.solver;
  stage.factorisations = sets.sets();
  stage.linear_solves = sets.solves();
  stage.seconds = seconds() - begin;
  stage.outcome = more.outcome;
  stage.reason = more.reason;
  more.stages = {std::move(stage)};
  more.options = options;
  more.options.method = refinement.method;
  more.finest_level = summary.finest_level;
  more.setup_seconds = summary.setup_seconds;
  more.solve_seconds = summary.solve_seconds + more.stages.front().seconds;
  more.history.push_back({summary.history.empty() ? 1 : summary.history.back().iteration + 1,
                          more.residual,
                          more.algebraic_error,
                          more.energy,
                          0,
                          0,
                          {{.vectors = problem.A.size()}}});
  more.rate = summary.rate;
  summary.append(std::move(more));
}

template void refine(const DiscreteProblem<1>&, const HeldRows<1>&, std::span<const double>, const SolverOptions&,
                     const Motions<1>&, std::vector<double>&, Summary&);
template void refine(const DiscreteProblem<2>&, const HeldRows<2>&, std::span<const double>, const SolverOptions&,
                     const Motions<2>&, std::vector<double>&, Summary&);
template void refine(const DiscreteProblem<3>&, const HeldRows<3>&, std::span<const double>, const SolverOptions&,
                     const Motions<3>&, std::vector<double>&, Summary&);

}  // namespace signorini
