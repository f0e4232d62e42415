#include "amg/coarse/coarse_newton.hpp"

#include <algorithm>
#include <cmath>

#include "amg/coarse/allowed_motions.hpp"
#include "amg/linear/unit_diagonal.hpp"
#include "core/algebra/products.hpp"
#include "core/base/dense.hpp"
#include "core/base/dot.hpp"
#include "core/solver/functional.hpp"
#include "core/solver/masked_cg.hpp"
#include "core/solver/rounding.hpp"

namespace signorini {

namespace {

constexpr int max_newton_steps = 12;
constexpr int max_cg_iterations = 500;
constexpr std::size_t max_motions = 20;  // without energy that are projected onto what the bounds allow
constexpr double shift = 1e-6;           // of a diagonal of ones, where there are more
constexpr int worn_out = 6;              // iterations above which a new factorisation pays
constexpr int most_refinements = 12;     // at which it replaces the old one at once, where it holds everything
constexpr double enough = 1e-3;          // energy decrease of a step, relative to all so far, that ends the loop
constexpr double shortening = 0.25;      // of steps whose parts within the bounds raise the energy
constexpr double no_component = 1e-6;    // components of a direction without energy that are zero but for rounding
constexpr double doubtful = 1e-5;  // part of p'Dp below which a direction's energy may come from a stale factorisation
constexpr int max_sweeps = 60;     // of Gauss-Seidel alone, there and back
constexpr int cheap_sweeps = 12;   // that cost less than a factorisation
constexpr double enough_by_sweeps = 0.1 * enough;  // the same of one sweep there and back
template <int B>
constexpr Index max_direct = B == 3 ? 4000 : 12000;  // vectors; above, fill-in costs more than iterations, unless
constexpr double per_entry = 100;                    // it takes at most so many multiplications for each one of A

template <int B>
double decrease(const Level<B>& level, const std::vector<double>& before) {
  // J(before) - J(x) = d'(r_before + r_after) / 2 needs two residuals; r_after and A d give the same.
  std::vector<double> d(before.size()), Ad(before.size()), r(before.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = level.x[i] - before[i];
  product<B>(*level.A, d.data(), Ad.data());
  residual<B>(*level.A, level.x, level.b, r.data());
  double sum = 0;
  for (std::size_t i = 0; i < d.size(); ++i) sum += d[i] * (r[i] + 0.5 * Ad[i]);
  return sum;
}

// What rounding may do to that.
template <int B>
double rounding_of_gain(const Level<B>& level, const std::vector<double>& before) {
  double largest = 0;
  for (std::size_t i = 0; i < before.size(); ++i) largest = std::max(largest, std::abs(level.x[i] - before[i]));
  return rounding_of_work(level) * largest;
}

// Bounds of component k at a slot, on x
template <int B>
struct SlotBound {
  double lower, upper;
  SlotBound(const Level<B>& level, Index slot, int k)
      : lower(level.constraints.lower[Offset{slot} * B + k]), upper(level.constraints.upper[Offset{slot} * B + k]) {}
};

template <int B>
void mask_contact(const Level<B>& level, std::vector<Flags>& mask) {
  mask = level.off;
  for (Index slot = 0; slot < level.constraints.size(); ++slot) {
    const Index p = level.constraints.vector[slot];
    for (int k = 0; k < B; ++k) {
      const SlotBound<B> bound(level, slot, k);
      const double x = level.x[Offset{p} * B + k];
      if (x <= bound.lower || x >= bound.upper) mask[p] |= static_cast<Flags>(1u << k);
    }
  }
}

// Largest step <= limit along d that stays within the bounds. Components of d up to `negligible` do not count.
template <int B>
double admissible_step(const Level<B>& level, const std::vector<double>& d, double limit, double negligible) {
  double step = limit;
  for (Index slot = 0; slot < level.constraints.size(); ++slot) {
    const Index p = level.constraints.vector[slot];
    for (int k = 0; k < B; ++k) {
      const SlotBound<B> bound(level, slot, k);
      const Offset i = Offset{p} * B + k;
      if (d[i] > negligible) step = std::min(step, (bound.upper - level.x[i]) / d[i]);
      if (d[i] < -negligible) step = std::min(step, (bound.lower - level.x[i]) / d[i]);
    }
  }
  return std::max(step, 0.0);
}

template <int B>
void clamp(const Level<B>& level) {
  for (Index slot = 0; slot < level.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const SlotBound<B> bound(level, slot, k);
      double& x = level.x[Offset{level.constraints.vector[slot]} * B + k];
      x = block::clamp(x, bound.lower, bound.upper);
    }
}

/// Projected symmetric Gauss-Seidel.
template <int B>
class Sweeps {
 public:
  explicit Sweeps(const Level<B>& level) : level_(level) {}

  void run(int most) {
    for (int k = 0; k < most && !settled(); ++k) sweep();
  }

  /// Sweeps as long as `most` of them promise to be enough; whether they were.
  bool suffice(int most) {
    for (int k = 0; k < most && !settled(); ++k) {
      sweep();
      if (k > 1 && needed() > most - k) return false;
    }
    return settled();
  }

 private:
  void sweep() {
    before_.assign(level_.x, level_.x + static_cast<std::size_t>(level_.vectors) * B);
    level_.sweep(Order::forward);
    level_.sweep(Order::backward);
    const double gained =
        decrease<B>(level_, before_) - functional::change(level_, before_.data(), level_.x, 0, level_.vectors);
    rate_ = gained / gained_;
    gained_ = gained;
    total_ += gained;
  }

  bool settled() const { return !(gained_ > enough_by_sweeps * total_); }

  /// Further ones, if gains go on falling as they did.
  double needed() const {
    return rate_ < 1 ? std::log(enough_by_sweeps * total_ / gained_) / std::log(rate_) : infinity;
  }

  const Level<B>& level_;
  std::vector<double> before_;
  double gained_ = infinity, rate_ = 0, total_ = 0;  // energy
};

}  // namespace

template <int B>
bool CoarseNewton<B>::solve(const Level<B>& level) {
  const bool constrained = level.constraints.size() > 0;
  left_out_.resize(0, 0);
  if (constrained && worn_ && Sweeps<B>(level).suffice(cheap_sweeps)) return true;
  double total = 0;
  for (int step = 0; step < max_newton_steps; ++step) {
    const std::vector<double> before(level.x, level.x + static_cast<std::size_t>(level.vectors) * B);
    if (constrained) {
      level.sweep(Order::forward);
      level.sweep(Order::backward);
    }
    if (!newton_step(level)) return false;
    const double gained = decrease<B>(level, before);
    if (!(gained >= -rounding_of_gain(level, before))) {
      std::copy(before.begin(), before.end(), level.x);
      break;
    }
    total += gained;
    if (!constrained || !(gained > enough * total)) break;
  }
  return left_out_.cols() == 0;
}

template <int B>
bool CoarseNewton<B>::newton_step(const Level<B>& level) {
  mask_contact<B>(level, mask_);
  r_.resize(static_cast<std::size_t>(level.vectors) * B);
  residual<B>(*level.A, level.x, level.b, r_.data());
  apply_mask<B>(mask_, r_);
  const CgResult cg = too_dear_ ? solve_iteratively(level) : solve_directly(level);
  if (cg.singular && falls_forever(level)) return goes_on_ && move_across(level);
  return move(level, cg.singular);
}

// Without the motions along which it falls: the factorisation holds one component for each of them.
template <int B>
bool CoarseNewton<B>::move_across(const Level<B>& level) {
  left_out_ = motions();
  Eigen::Map<Eigen::VectorXd> r(r_.data(), std::ssize(r_));
  r -= left_out_ * (left_out_.transpose() * r);
  precondition(level, r_, d_);
  apply_mask<B>(mask_, d_);
  return left_out_.cols() > 0 && move(level, false);
}

// Where the factorisation met a pivot on every component that is free now, none of their motions is without energy,
// however little rounding would let it have: the steps are taken as they are. With a factorisation from other phases
// directions of little energy are hardly told from such without any: there and where it is worn out it is made anew.
template <int B>
CgResult CoarseNewton<B>::solve_directly(const Level<B>& level) {
  const Precondition precondition_masked = [&](const std::vector<double>& r, std::vector<double>& z) {
    precondition(level, r, z);
    apply_mask<B>(mask_, z);
  };
  const auto attempt = [&](double without_energy) {
    // Of scalars, semidefinite ones above all, small pivots may be rounding alone.
    const bool definite = B > 1 && holds_everything();
    const CgLimits limits{.reduction = 1e-8,
                          .iterations = definite ? most_refinements : max_cg_iterations,
                          .rounding = definite ? 0 : rounding_of_work(level),
                          .without_energy = without_energy,
                          .definite = definite};
    const CgResult cg = masked_cg<B>(*level.A, mask_, precondition_masked, limits, rest_ = r_, d_);
    worn_ = cg.iterations > worn_out;
    return cg;
  };
  if (!worn_) {
    const CgResult cg = attempt(doubtful);
    if (!cg.singular && (cg.converged || cg.iterations != most_refinements)) return cg;
  }
  if (!factorise(level, mask_)) return solve_iteratively(level);
  return attempt(no_energy);
}

template <int B>
bool CoarseNewton<B>::holds_everything() const {
  for (std::size_t p = 0; p < mask_.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (!(mask_[p] >> k & 1u) && scale_[p * B + k] == 0) return false;
  return factor_.held().empty();
}

template <int B>
CgResult CoarseNewton<B>::solve_iteratively(const Level<B>& level) {
  const Precondition precondition_masked = [&](const std::vector<double>& r, std::vector<double>& z) {
    z.assign(r.size(), 0.0);
    symmetric_gauss_seidel<B>(*level.A, mask_, r, z);
    apply_mask<B>(mask_, z);
  };
  return masked_cg<B>(*level.A, mask_, precondition_masked,
                      {.reduction = 1e-3, .iterations = max_cg_iterations, .rounding = rounding_of_work(level)}, r_,
                      d_);
}

// Orthonormal, without energy, as far as the factorised components allow; its columns. None where they are too many.
template <int B>
Eigen::MatrixXd CoarseNewton<B>::motions() const {
  const std::vector<Eigen::Index>& held = factor_.held();
  const Eigen::Index n = factor_.size(), count = held.size() <= max_motions ? std::ssize(held) : 0;
  Eigen::MatrixXd out(n, count);
  if (count == 0) return out;
  const Eigen::Map<const Eigen::VectorXd> scale(scale_.data(), n);
  for (Eigen::Index k = 0; k < count; ++k)
    out.col(k) = scale.cwiseProduct(factor_.solve(Eigen::VectorXd::Unit(n, held[static_cast<std::size_t>(k)])));
  return orthonormal_columns(out);
}

// Whether the residual does work along a motion without energy that no bound ends: along the motion next to it among
// those that every bound allows.
template <int B>
bool CoarseNewton<B>::falls_forever(const Level<B>& level) const {
  const Eigen::MatrixXd motions = this->motions();
  if (motions.cols() == 0) return false;
  const Eigen::VectorXd g = motions.transpose() * Eigen::Map<const Eigen::VectorXd>(r_.data(), motions.rows());
  AllowedMotions allowed(g.size());
  const double nothing = no_component / std::sqrt(static_cast<double>(motions.rows()));
  for (Index slot = 0; slot < level.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const SlotBound<B> bound(level, slot, k);
      const auto row = motions.row(Offset{level.constraints.vector[slot]} * B + k);
      if (row.norm() > nothing) allowed.bound(row, bound.lower, bound.upper);
    }
  return allowed.nearest(g).norm() > no_component * g.norm();
}

// The full step cut off component by component where that lowers the energy, else shorter ones, else as far as the
// bounds allow. Along a direction without energy the obstacle must end the fall.
template <int B>
bool CoarseNewton<B>::move(const Level<B>& level, bool singular) {
  const double largest = max_norm(d_);
  const double step =
      singular ? admissible_step<B>(level, d_, infinity, no_component * largest) : admissible_step<B>(level, d_, 1, 0);
  if (step == infinity) return false;
  const auto n = d_.size();
  const std::vector<double> before(level.x, level.x + n);
  const auto take = [&](double t) {
    for (std::size_t i = 0; i < n; ++i) level.x[i] = before[i] + t * d_[i];
    clamp<B>(level);
  };
  take(step);
  if (singular || step == 1) return true;
  std::vector<double> best(level.x, level.x + n);
  const double most = decrease<B>(level, before);
  double gained = -infinity;
  for (double t = 1; t > step && !(gained > 0); t *= shortening) {
    take(t);
    gained = decrease<B>(level, before);
  }
  if (!(gained >= most)) std::copy(best.begin(), best.end(), level.x);
  return true;
}

// Where motions without energy are many, a shift keeps steps out of them: the bounds cut off least of the shortest one.
template <int B>
bool CoarseNewton<B>::factorise(const Level<B>& level, const std::vector<Flags>& mask) {
  Eigen::SparseMatrix<double> S = with_unit_diagonal(*level.A, mask, scale_);
  const double most =
      level.vectors <= max_direct<B> ? infinity : per_entry * static_cast<double>(level.A->value.size());
  too_dear_ = !factor_.factorise(S, most);
  if (too_dear_ || factor_.held().size() <= max_motions) return !too_dear_;
  for (Eigen::Index i = 0; i < S.rows(); ++i) S.coeffRef(i, i) += shift;
  return factor_.factorise(S);
}

template <int B>
void CoarseNewton<B>::precondition(const Level<B>& level, const std::vector<double>& r, std::vector<double>& z) const {
  Eigen::VectorXd s(static_cast<Eigen::Index>(r.size()));
  for (std::size_t i = 0; i < r.size(); ++i) s[static_cast<Eigen::Index>(i)] = scale_[i] * r[i];
  s = factor_.solve(s);
  for (std::size_t i = 0; i < r.size(); ++i) z[i] = scale_[i] * s[static_cast<Eigen::Index>(i)];
  // Components that were masked when it was made are unknown to the factorisation.
  for (Index p = 0; p < level.vectors; ++p)
    for (int k = 0; k < B; ++k)
      if (const Offset i = Offset{p} * B + k; scale_[i] == 0) z[i] = r[i] / level.A->diagonal(p)[k * B + k];
}

template <int B>
bool CoarseGaussSeidel<B>::solve(const Level<B>& level) {
  Sweeps<B>(level).run(max_sweeps);
  return true;
}

template class CoarseNewton<1>;
template class CoarseNewton<2>;
template class CoarseNewton<3>;
template class CoarseGaussSeidel<1>;
template class CoarseGaussSeidel<2>;
template class CoarseGaussSeidel<3>;

}  // namespace signorini
