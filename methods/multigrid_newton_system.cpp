#include "methods/multigrid_newton_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/flexible_gmres.hpp"
#include "core/algebra/products.hpp"
#include "methods/configuration.hpp"

namespace signorini {

namespace {

// A Newton step is one of a dozen, each from its own matrix: more digits of it would not make fewer of them.
constexpr KrylovLimits limits{.tolerance = 1e-2, .restart = 30, .most = 60};
// Of what came out of them: beyond that there is no step.
constexpr double too_little = 0.5;

bool is(Flags flags, int k) { return flags >> k & 1u; }

}  // namespace

template <int B>
MultigridNewtonSystem<B>::MultigridNewtonSystem(const DiscreteProblem<B>& problem,
                                                std::span<const Prolongation> prolongations,
                                                const SolverOptions& options, const Registry& registry)
    : problem_(problem),
      prolongations_(prolongations),
      options_(options),
      registry_(registry),
      F_(problem.constraints.vector.size() * B * B),
      V_(F_.size()),
      rows_(problem.constraints.vector.size()),
      root_(static_cast<std::size_t>(size())) {
  options_.reassemble = true;  // all levels know what is held
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k) root_[Offset{p} * B + k] = std::sqrt(problem.A.diagonal(p)[k * (B + 1)]);
}

template <int B>
void MultigridNewtonSystem<B>::set_row(Index p, const double* by_force, const double* by_value) {
  const Index slot = problem_.constraints.slot[p];
  if (slot < 0) return;
  std::copy_n(by_force, B * B, F_.data() + Offset{slot} * B * B);
  std::copy_n(by_value, B * B, V_.data() + Offset{slot} * B * B);
}

template <int B>
typename MultigridNewtonSystem<B>::Rows MultigridNewtonSystem<B>::rows_of(const double* F, const double* V, Flags off) {
  Rows rows{};
  rows.held = off;
  for (int k = 0; k < B; ++k)
    if (std::all_of(F + k * B, F + (k + 1) * B, [](double f) { return f == 0; })) rows.held |= Flags{1} << k;
  const Flags free = static_cast<Flags>(~rows.held);
  for (int j = 0; j < B; ++j) {  // the free part of F is symmetric: I - a (I - s s')
    double unit[B] = {}, column[B];
    unit[j] = 1;
    block::solve<B>(F, unit, free & ((1u << B) - 1), column);
    for (int i = 0; i < B; ++i) rows.units[i * B + j] = is(free, j) ? column[i] : 0;
  }
  block::multiply<B>(rows.units, F, rows.force);
  block::multiply<B>(rows.units, V, rows.value);
  return rows;
}

/// Bounds that hold what is held and nothing else, and the curvature of slip.
template <int B>
void MultigridNewtonSystem<B>::free_below(const Rows& rows, Index slot) {
  const Index p = problem_.constraints.vector[slot];
  double* diagonal = own_.A.value.data() + own_.A.row[p] * B * B;
  for (int i = 0; i < B; ++i) {
    own_.constraints.lower[Offset{slot} * B + i] = is(rows.held, i) ? 0 : -infinity;
    own_.constraints.upper[Offset{slot} * B + i] = is(rows.held, i) ? 0 : infinity;
    for (int j = 0; j < B; ++j)
      if (!is(rows.held, i) && !is(rows.held, j))
        diagonal[i * B + j] += 0.5 * (rows.value[i * B + j] + rows.value[j * B + i]);
  }
}

template <int B>
void MultigridNewtonSystem<B>::prepare() {
  multigrid_.reset();
  own_.A = problem_.A;
  own_.b.assign(static_cast<std::size_t>(size()), 0.0);
  own_.fixed = problem_.fixed;
  own_.frames = problem_.frames;
  own_.constraints.slot = problem_.constraints.slot;
  own_.constraints.vector = problem_.constraints.vector;
  own_.constraints.lower.resize(rows_.size() * B);
  own_.constraints.upper.resize(rows_.size() * B);
}

template <int B>
bool MultigridNewtonSystem<B>::factorise() {
  ++factorisations_;
  prepare();
  for (Index slot = 0; slot < problem_.constraints.size(); ++slot) {
    const Offset at = Offset{slot} * B * B;
    rows_[slot] = rows_of(F_.data() + at, V_.data() + at, problem_.fixed[problem_.constraints.vector[slot]]);
    free_below(rows_[slot], slot);
  }
  multigrid_ = std::make_unique<MonotoneMultigrid<B>>(own_, prolongations_, components_of<B>(options_, registry_),
                                                      settings_of<B>(options_));
  multigrid_->search_lines(options_.truncate != "none");
  return true;
}

/// The matrix on what is not held, in the rows' own units, each over the root of the diagonal.
template <int B>
void MultigridNewtonSystem<B>::apply(const Vector& v, Vector& out) const {
  product(problem_.A, v.data(), out.data());
  for (Index p = 0; p < problem_.A.size(); ++p) {
    double* y = out.data() + Offset{p} * B;
    const Index slot = problem_.constraints.slot[p];
    Flags held = problem_.fixed[p];
    if (slot >= 0) {
      double sum[B] = {};
      block::add_product<B>(rows_[slot].force, y, sum);
      block::add_product<B>(rows_[slot].value, v.data() + Offset{p} * B, sum);
      std::copy_n(sum, B, y);
      held = rows_[slot].held;
    }
    for (int k = 0; k < B; ++k) y[k] = is(held, k) ? 0 : y[k] / root_[Offset{p} * B + k];
  }
}

template <int B>
void MultigridNewtonSystem<B>::precondition(const Vector& r, Vector& out) {
  for (std::size_t i = 0; i < r.size(); ++i) own_.b[i] = r[i] * root_[i];
  std::fill(out.begin(), out.end(), 0.0);
  multigrid_->cycle(out.data());
}

/// What the rows that are held say, and what it leaves for the others, as of apply().
template <int B>
void MultigridNewtonSystem<B>::hold(Vector& b, Vector& known) const {
  for (Index p = 0; p < problem_.A.size(); ++p) {
    const Index slot = problem_.constraints.slot[p];
    const Flags off = problem_.fixed[p], held = slot < 0 ? off : rows_[slot].held;
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{p} * B + k;
      if (is(held, k)) known[i] = b[i] / (is(off, k) ? 1 : V_[Offset{slot} * B * B + k * (B + 1)]);
    }
  }
  Vector taken(b.size());
  apply(known, taken);
  for (Index p = 0; p < problem_.A.size(); ++p) {
    const Index slot = problem_.constraints.slot[p];
    const Flags held = slot < 0 ? problem_.fixed[p] : rows_[slot].held;
    double* y = b.data() + Offset{p} * B;
    if (slot >= 0) {
      double sum[B] = {};
      block::add_product<B>(rows_[slot].units, y, sum);
      std::copy_n(sum, B, y);
    }
    for (int k = 0; k < B; ++k) y[k] = is(held, k) ? 0 : y[k] / root_[Offset{p} * B + k] - taken[Offset{p} * B + k];
  }
}

template <int B>
bool MultigridNewtonSystem<B>::solve(std::vector<double>& b) {
  ++solves_;
  Vector known(b.size());
  hold(b, known);
  Vector x;
  const KrylovResult found =
      flexible_gmres([this](const Vector& v, Vector& out) { apply(v, out); },
                     [this](const Vector& r, Vector& out) { precondition(r, out); }, b, x, limits);
  if (!(found.residual <= too_little)) return false;
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = known[i] + x[i];
  return true;
}

template class MultigridNewtonSystem<1>;
template class MultigridNewtonSystem<2>;
template class MultigridNewtonSystem<3>;

}  // namespace signorini
