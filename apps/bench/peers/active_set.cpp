#include "apps/bench/peers/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/bench/peers/accuracy.hpp"
#include "apps/bench/processor_time.hpp"

namespace signorini::bench {
namespace {

enum class Side : signed char { free, lower, upper };

/// The method on one level.
class ActiveSet {
 public:
  ActiveSet(const GridLevel& level, LinearSolver& solver, const ActiveSetOptions& options)
      : level_(level),
        program_(bounded(level.problem)),
        residual_of_(program_),
        diagonal_(diagonal(program_.A)),
        solver_(solver),
        options_(options),
        gradient_(program_.b.size()),
        load_(program_.b.size()) {}

  int solve(std::vector<double>& x, double tolerance) {
    constexpr int most = 300;
    for (int step = 0; step <= most; ++step) {
      const double residual = residual_of_(x.data());
      if (residual <= tolerance) return step;
      if (!std::isfinite(residual)) break;
      const bool changed = choose(x);
      if (changed) reduce(x);
      const double still = tolerance / residual;
      const double wanted =
          changed ? std::max(options_.reduction, 0.1 * still) : std::min(options_.reduction, 0.3 * still);
      solver_.solve(load_, x, std::max(wanted, 1e-12));
      hold(x);
    }
    throw std::runtime_error("active sets do not settle");
  }

 private:
  const std::vector<double>& bound(Side side) const {
    return side == Side::lower ? level_.problem.lower : level_.problem.upper;
  }

  // A free unknown that left its bounds is held there, a held one is let go where the bound would have to pull. The
  // first choice takes both together.
  Side choose(std::size_t i, double x) const {
    const double y = side_.empty() ? x - gradient_[i] / diagonal_[i] : x;
    if (side_.empty() || side_[i] == Side::free)
      return y < program_.lower[i] ? Side::lower : y > program_.upper[i] ? Side::upper : Side::free;
    const bool pushes = side_[i] == Side::lower ? gradient_[i] > 0 : gradient_[i] < 0;
    return pushes ? side_[i] : Side::free;
  }

  bool choose(const std::vector<double>& x) {
    multiply(program_.A, x.data(), gradient_.data());
    std::vector<Side> next(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      gradient_[i] -= program_.b[i];
      next[i] = choose(i, x[i]);
    }
    if (next == side_) return false;
    side_ = std::move(next);
    return true;
  }

  void hold(std::vector<double>& x) const {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (side_[i] != Side::free) x[i] = bound(side_[i])[i];
  }

  /// The system of the free unknowns; the held ones keep their diagonal.
  void reduce(std::vector<double>& x) {
    const SparseRows& A = program_.A;
    const bool keep_all = solver_.wants_fixed_pattern();
    hold(x);
    reduced_.rows = reduced_.columns = A.rows;
    reduced_.row.assign(1, 0);
    reduced_.row.reserve(A.row.size());
    reduced_.column.clear();
    reduced_.value.clear();
    for (Index i = 0; i < A.rows; ++i) {
      const bool free = side_[i] == Side::free;
      load_[i] = free ? program_.b[i] : diagonal_[i] * x[i];
      for (Offset k = A.row[i]; k < A.row[i + 1]; ++k) {
        const Index j = A.column[k];
        const bool both = j == i || (free && side_[j] == Side::free);
        if (free && !both) load_[i] -= A.value[k] * x[j];
        if (!both && !keep_all) continue;
        reduced_.column.push_back(j);
        reduced_.value.push_back(both ? A.value[k] : 0);
      }
      reduced_.row.push_back(static_cast<Offset>(reduced_.column.size()));
    }
    if (age_++ % options_.lag == 0)
      solver_.set_up(reduced_, level_.coordinates);
    else
      solver_.change(reduced_);
  }

  const GridLevel& level_;
  const QuadraticProgram program_;
  const NaturalResidual residual_of_;
  const std::vector<double> diagonal_;
  LinearSolver& solver_;
  const ActiveSetOptions& options_;
  std::vector<double> gradient_, load_;
  std::vector<Side> side_;
  SparseRows reduced_;
  int age_ = 0;
};

}  // namespace

std::vector<double> start_from(const GridLevel& level, const std::vector<double>& coarse) {
  std::vector<double> x(level.offset.size());
  multiply(level.interpolation, coarse.data(), x.data());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += level.offset[i];
  return x;
}

Attempt active_set(const Instance& instance, const MakeLinearSolver& make, const ActiveSetOptions& options,
                   double tolerance) {
  Attempt out;
  const ProcessorTime time;
  const std::size_t finest = instance.levels.size() - 1;
  for (std::size_t k = options.nested ? 0 : finest; k <= finest; ++k) {
    const GridLevel& level = instance.levels[k];
    out.x = out.x.empty() ? bounded(level.problem).projected_zero() : start_from(level, out.x);
    const auto solver = make();
    out.iterations =
        ActiveSet(level, *solver, options).solve(out.x, k == finest ? tolerance : std::max(tolerance, 1e-4));
  }
  out.seconds = time.elapsed();
  return out;
}

}  // namespace signorini::bench
