#include "methods/interior_point.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/algebra/products.hpp"
#include "core/base/dense.hpp"
#include "core/base/dot.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {

namespace {

constexpr double to_the_boundary = 0.995;  // part of the longest step that keeps distances and multipliers positive
constexpr double shift = 1e-8;             // of the diagonal, for what no bound holds
constexpr int patience = 10;               // steps without an error less than this part of the least one
constexpr double less = 0.9;
constexpr double inside = 0.1;  // of the way between two bounds, or of the size of x: first distances

}  // namespace

template <int B>
InteriorPointIteration<B>::InteriorPointIteration(const DiscreteProblem<B>& problem, std::vector<double>& x,
                                                  const SolverOptions& options, const Registry& registry,
                                                  const std::string& linear)
    : Iteration<B>(problem, x, options),
      linear_(linear),
      level_(finest_level(problem)),
      system_(problem.A, registry.create<LinearSolver>("linear", linear)) {}

template <int B>
void InteriorPointIteration<B>::collect_sides() {
  const Constraints<B>& c = level_.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) {
    const Index p = c.vector[slot];
    if (c.has_facets(slot)) add_corner(slot);
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{slot} * B + k;
      if (level_.off[p] >> k & 1u) continue;
      if (c.lower[at] == c.upper[at]) {
        if (!c.has_facets(slot)) system_.change().held[Offset{p} * B + k] = 1;
        continue;
      }
      double axis[B] = {};
      axis[k] = 1;
      add_side(p, k, axis, c.lower[at], c.upper[at]);
    }
    for (Offset f = c.has_facets(slot) ? c.facet_row[slot] : 0; c.has_facets(slot) && f < c.facet_row[slot + 1]; ++f)
      if (c.facet[f].lower != c.facet[f].upper) add_side(p, -1, c.facet[f].normal, c.facet[f].lower, c.facet[f].upper);
  }
}

template <int B>
void InteriorPointIteration<B>::add_side(Index p, int component, const double* normal, double lower, double upper) {
  for (const double sign : {1.0, -1.0}) {
    const double bound = sign > 0 ? lower : upper;
    if (!std::isfinite(bound)) continue;
    Side& side = sides_.emplace_back(Side{.p = p, .component = component, .normal = {}, .value = sign * bound});
    for (int k = 0; k < B; ++k) side.normal[k] = sign * normal[k];
  }
}

template <int B>
void InteriorPointIteration<B>::add_corner(Index slot) {
  const Polyhedron<B> polyhedron = level_.constraints.polyhedron(slot);
  Corner& corner = corners_.emplace_back();
  corner.p = level_.constraints.vector[slot];
  corner.held = held_coordinates(polyhedron, equal_sides(polyhedron), level_.off[corner.p], corner.T);
  for (int k = 0; k < corner.held; ++k) system_.change().held[Offset{corner.p} * B + k] = 1;
}

// From an admissible vector into the interior; multipliers that balance the forces where they can.
template <int B>
void InteriorPointIteration<B>::start() {
  collect_sides();
  y_ = this->x_;
  d_.resize(y_.size());
  force_.resize(y_.size());
  double size = 0;
  for (std::size_t i = 0; i < y_.size(); ++i)
    size = std::max({size, std::abs(y_[i]), std::abs(this->r_before_[i]) / system_.diagonal(static_cast<Offset>(i))});
  if (size == 0) size = 1;  // the start is the solution
  const Constraints<B>& c = level_.constraints;
  for (Side& s : sides_) {
    if (c.has_facets(c.slot[s.p])) continue;
    const Offset at = Offset{c.slot[s.p]} * B + s.component;
    const double lower = c.lower[at], upper = c.upper[at], margin = inside * std::min(upper - lower, size);
    double& y = y_[Offset{s.p} * B + s.component];
    y = block::clamp(y, lower + margin, upper - margin);
  }
  residual<B>(*level_.A, y_.data(), this->problem_.b.data(), force_.data());
  for (Side& s : sides_) {
    const double there = s.along(y_) - s.value, length = block::norm<B>(s.normal);
    s.distance = c.has_facets(c.slot[s.p]) ? std::max(there, inside * size * length) : there;
    double d = 0;
    for (int k = 0; k < B; ++k) d = std::max(d, std::abs(s.normal[k]) / length * system_.diagonal(Offset{s.p} * B + k));
    s.multiplier = (std::max(-s.along(force_), 0.0) + d * length * inside * size) / (length * length);
  }
}

template <int B>
typename InteriorPointIteration<B>::Step InteriorPointIteration<B>::advance() {
  if (!std::exchange(started_, true)) start();
  this->x_before_ = this->x_;
  Step step;
  if (!predict_and_correct()) step.stuck = "the matrix with the multipliers is not positive definite";
  put_onto_bounds();
  this->sums_ = this->evaluate(this->x_, this->r_);
  this->refuse_nan(this->sums_.natural_residual);
  const double last_gain = std::sqrt(2 * std::abs(this->sums_.gain));  // what falls for ever has no gap
  step.error = this->sums_.natural_residual == 0 ? 0 : std::max(error_bound(), last_gain);
  if (step.stuck.empty() && !progresses(step.error)) step.stuck = "the interior points make no progress";
  step.levels = {report()};
  return step;
}

template <int B>
bool InteriorPointIteration<B>::progresses(double error) {
  idle_ = error < less * least_error_ ? 0 : idle_ + 1;
  least_error_ = std::min(least_error_, error);
  return idle_ < patience;
}

template <int B>
LevelReport InteriorPointIteration<B>::report() const {
  LevelReport out;
  out.vectors = level_.vectors;
  const Constraints<B>& c = level_.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) {
    bool critical = false;
    for (int k = 0; k < B; ++k) {
      const double x = this->x_[Offset{c.vector[slot]} * B + k];
      const bool contact = x <= c.lower[Offset{slot} * B + k] || x >= c.upper[Offset{slot} * B + k];
      out.contact[static_cast<std::size_t>(k)] += contact;
      critical = critical || contact;
    }
    if (c.has_facets(slot)) {
      const Polyhedron<B> polyhedron = c.polyhedron(slot);
      for (int k = 0; k < polyhedron.facets(); ++k)
        critical = critical || polyhedron.touches(k, this->x_.data() + Offset{c.vector[slot]} * B);
    }
    out.critical += critical;
  }
  return out;
}

template <int B>
bool InteriorPointIteration<B>::predict_and_correct() {
  residual<B>(*level_.A, y_.data(), this->problem_.b.data(), force_.data());
  if (!factorise() || !find_direction(0, false)) return false;
  const double now = complementarity(0), after = complementarity(longest_step());
  if (now > 0 && !find_direction(now * std::pow(after / now, 3), true)) return false;
  take(std::min(1.0, to_the_boundary * longest_step()));
  return true;
}

template <int B>
bool InteriorPointIteration<B>::factorise() {
  SystemChange<B>& change = system_.change();
  const Constraints<B>& c = level_.constraints;
  VectorBlocks<B> springs(level_.vectors);
  for (std::size_t i = 0; i < y_.size(); ++i) change.added[i] = shift * system_.diagonal(static_cast<Offset>(i));
  for (const Side& s : sides_) {
    const double spring = s.multiplier / s.distance;
    if (!c.has_facets(c.slot[s.p])) {
      change.added[Offset{s.p} * B + s.component] += spring;
      continue;
    }
    double* block = springs.add(s.p);
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) block[i * B + j] += spring * s.normal[i] * s.normal[j];
  }
  turn_into_springs(springs);
  return system_.factorise();
}

// At corners the springs are strong in some directions and weak in others: with these as coordinates they are entries
// of the diagonal, which leave the matrix as definite as it was.
template <int B>
void InteriorPointIteration<B>::turn_into_springs(const VectorBlocks<B>& springs) {
  using Matrix = Eigen::Matrix<double, B, B, Eigen::RowMajor>;
  SystemChange<B>& change = system_.change();
  for (const Corner& corner : corners_) {
    Eigen::Map<Matrix> T(change.turned.add(corner.p));
    T = Eigen::Map<const Matrix>(corner.T);
    const double* block = springs.at(corner.p);
    const int free = B - corner.held;
    if (!block || free == 0) continue;
    const Eigen::MatrixXd Z = T.rightCols(free);
    const Eigenpairs own = eigenpairs(Z.transpose() * Eigen::Map<const Matrix>(block) * Z);
    T.rightCols(free) = Z * own.vectors;
    for (int k = 0; k < free; ++k) change.added[Offset{corner.p} * B + corner.held + k] += std::max(own.values[k], 0.0);
  }
}

// Newton's step for distance * multiplier = complementarity and forces that balance.
template <int B>
bool InteriorPointIteration<B>::find_direction(double complementarity, bool correct) {
  d_ = force_;
  const Constraints<B>& c = level_.constraints;
  const auto wanted = [&](const Side& s) {
    return complementarity - (correct ? s.distance_step * s.multiplier_step : 0);
  };
  for (Side& s : sides_) {
    if (c.has_facets(c.slot[s.p])) s.missing = s.along(y_) - s.value - s.distance;
    s.add((wanted(s) - s.multiplier * s.missing) / s.distance, d_);
  }
  for (std::size_t i = 0; i < d_.size(); ++i)
    if (level_.off[i / B] >> (i % B) & 1u) d_[i] = 0;
  if (!system_.solve(d_)) return false;
  for (Side& s : sides_) {
    const double aim = wanted(s);
    s.distance_step = s.along(d_) + s.missing;
    s.multiplier_step = (aim - s.multiplier * s.distance_step) / s.distance - s.multiplier;
  }
  return true;
}

template <int B>
double InteriorPointIteration<B>::longest_step() const {
  double step = 1 / to_the_boundary;
  for (const Side& s : sides_) {
    if (s.distance_step < 0) step = std::min(step, -s.distance / s.distance_step);
    if (s.multiplier_step < 0) step = std::min(step, -s.multiplier / s.multiplier_step);
  }
  return step;
}

template <int B>
void InteriorPointIteration<B>::take(double step) {
  for (std::size_t i = 0; i < y_.size(); ++i) y_[i] += step * d_[i];
  for (Side& s : sides_) {
    s.distance += step * s.distance_step;
    s.multiplier += step * s.multiplier_step;
    s.missing *= 1 - step;
  }
}

/// The mean of distance * multiplier after a step.
template <int B>
double InteriorPointIteration<B>::complementarity(double step) const {
  double sum = 0;
  for (const Side& s : sides_) sum += (s.distance + step * s.distance_step) * (s.multiplier + step * s.multiplier_step);
  return sides_.empty() ? 0 : sum / static_cast<double>(sides_.size());
}

template <int B>
void InteriorPointIteration<B>::put_onto_bounds() {
  this->x_ = y_;
  const Constraints<B>& c = level_.constraints;
  for (const Side& s : sides_) {
    if (s.component < 0 || c.has_facets(c.slot[s.p])) continue;
    const Offset i = Offset{s.p} * B + s.component;
    if (s.distance * system_.diagonal(i) < s.multiplier) this->x_[i] = s.normal[s.component] * s.value;
  }
  if (!c.facet.empty()) put_onto_facets();
}

// Those that the forces of all its sides together would take the vector to if it moved alone.
template <int B>
void InteriorPointIteration<B>::put_onto_facets() {
  const Constraints<B>& c = level_.constraints;
  std::vector<double> force(y_.size());
  for (const Side& s : sides_)
    if (c.has_facets(c.slot[s.p])) s.add(-s.multiplier, force);
  for (Index slot = 0; slot < c.size(); ++slot) {
    if (!c.has_facets(slot)) continue;
    const Offset at = Offset{c.vector[slot]} * B;
    double d[B], target[B];
    for (int k = 0; k < B; ++k) {
      d[k] = system_.diagonal(at + k);
      target[k] = y_[at + k] + force[at + k] / d[k];
    }
    const Polyhedron<B> polyhedron = c.polyhedron(slot);
    go_onto(polyhedron, sides_before(polyhedron, d, target), this->x_.data() + at);
    c.project(slot, this->x_.data() + at);
  }
}

// Where the forces balance, J(y) - J(x*) <= the sum of (normal . y - value) * multiplier.
template <int B>
double InteriorPointIteration<B>::error_bound() const {
  std::vector<double> moved(y_.size()), A_moved(y_.size());
  for (std::size_t i = 0; i < y_.size(); ++i) moved[i] = this->x_[i] - y_[i];
  product<B>(*level_.A, moved.data(), A_moved.data());
  double squared = 0, gap = 0;
  for (std::size_t i = 0; i < y_.size(); ++i) squared += moved[i] * A_moved[i];
  for (const Side& s : sides_) gap += (s.distance + std::abs(s.missing)) * s.multiplier;
  return std::sqrt(2 * gap) + std::sqrt(std::max(squared, 0.0));
}

template <int B>
void InteriorPointIteration<B>::add_work(Stage& stage) const {
  stage.linear = linear_;
  stage.linear_solves = system_.solves();
  stage.factorisations = system_.factorisations();
}

// By the factorisation of the last step, where the multipliers are springs that hold what is at a bound.
template <int B>
std::optional<double> InteriorPointIteration<B>::response(const std::vector<double>& forces, double) {
  std::vector<double> d = forces;
  if (!system_.solve(d)) return {};
  return std::sqrt(std::abs(dot(d, forces)));
}

template class InteriorPointIteration<1>;
template class InteriorPointIteration<2>;
template class InteriorPointIteration<3>;

}  // namespace signorini
