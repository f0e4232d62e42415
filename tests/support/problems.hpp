#pragma once
#include <cmath>

#include "amg/registration.hpp"
#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/fem/elements/nested.hpp"
#include "core/mesh/refine.hpp"
#include "core/mesh/structured.hpp"
#include "core/solver/interpolate.hpp"
#include "methods/solve.hpp"
#include "tests/support/dense.hpp"
#include "tests/support/obstacles.hpp"
#include "tests/support/on_mesh.hpp"

/// Small problems on hierarchies of rectangles and boxes, and how to solve them.
namespace signorini::test {

/// One problem on all levels, coarsest first.
template <int B>
struct Nested {
  std::vector<DiscreteProblem<B>> levels;
  std::vector<Prolongation> prolongations;
  BlockMatrix<B> stiffness;  ///< on the finest mesh, in global coordinates and without any condition
  std::vector<double> load;  ///< as well

  const DiscreteProblem<B>& finest() const { return levels.back(); }
};

template <int D, int B>
Nested<B> discretize_all(const Mesh<D>& coarsest, int refinements, const Model<B>& model) {
  const MeshHierarchy<D> meshes = hierarchy<D>(coarsest, refinements);
  Nested<B> out;
  for (const Mesh<D>& mesh : meshes.levels) out.levels.push_back(discretize<D, B>(mesh, model).problem);
  out.prolongations = prolongations(meshes);
  out.stiffness = stiffness<D, B>(meshes.finest(), model);
  out.load = load_vector<D, B>(meshes.finest(), model);
  return out;
}

/// ||x||_A with the prescribed values counted in.
template <int B>
double solution_norm(const Nested<B>& p, const Eigen::VectorXd& x) {
  const std::vector<double> u = to_global(p.finest(), std::vector<double>(x.data(), x.data() + x.size()));
  return energy_norm(p.stiffness, vector(u));
}

inline const Registry& registry() {
  static const Registry all = solver_components();
  return all;
}

template <int B>
Summary solve_from(const Nested<B>& p, std::vector<double>& x, const SolverOptions& options = {},
                   const Monitor& monitor = {}) {
  return solve<B>(p.finest(), p.prolongations, x, options, registry(), monitor);
}

template <int B>
Summary solve_from_zero(const Nested<B>& p, std::vector<double>& x, const SolverOptions& options = {},
                        const Monitor& monitor = {}) {
  x.assign(p.finest().b.size(), 0.0);
  return solve_from(p, x, options, monitor);
}

/// Nested iteration: every level starts from the interpolated solution of the one before.
template <int B>
Summary solve_nested(const Nested<B>& p, std::vector<double>& x, const SolverOptions& options = {}) {
  x.assign(p.levels.front().b.size(), 0.0);
  Summary summary;
  for (std::size_t k = 0; k < p.levels.size(); ++k) {
    if (k > 0) x = interpolate(p.levels[k - 1], x, p.prolongations[k - 1], p.levels[k]);
    SolverOptions here = options;
    if (k + 1 < p.levels.size()) here.tolerance = 1e-3;
    summary = solve<B>(p.levels[k], std::span(p.prolongations).first(k), x, here, registry());
  }
  return summary;
}

inline Selection on(std::string part) { return {std::move(part), {}, "test"}; }

inline Field field(std::function<double(const double*)> f) {
  return Field([f = std::move(f)](const Site& s) { return f(s.x); }, "function", "test");
}

template <int D>
double radius(const double* x) {
  double s = 0;
  for (int i = 0; i < D; ++i) s += x[i] * x[i];
  return std::sqrt(s);
}

template <int D>
Mesh<D> cube(double low, double high, Index cells) {
  Point<D> from, to;
  std::array<Index, D> n;
  from.fill(low);
  to.fill(high);
  n.fill(cells);
  if constexpr (D == 2)
    return rectangle(from, to, n);
  else
    return box(from, to, n);
}

/// A membrane over a ball of radius 1 with the rotationally symmetric solution on the boundary of (-2, 2)^D: contact
/// inside radius 0.697965 (D = 2) or the one of 1 / (2 r) (D = 3).
template <int D>
Model<1> radial_model() {
  Model<1> model;
  const auto solution = [](const double* x) {
    const double r = radius<D>(x);
    return D == 2 ? -0.680259411891719 * std::log(r) + 0.471519893402112 : 1 / (2 * r);
  };
  model.fixes.push_back({on("boundary"), {field(solution)}});
  const auto psi = [](const double* x) {
    const double r = radius<D>(x), edge = 0.9;
    if (r <= edge) return std::sqrt(1 - r * r);
    const double height = std::sqrt(1 - edge * edge);
    return height - edge / height * (r - edge);
  };
  model.obstacles.push_back({between(psi, {}), {}, "test"});
  return model;
}

/// -Laplace u = source with u = 0 on the boundary and bounds.
inline Model<1> membrane(double source, const Bound1& lower, const Bound1& upper) {
  Model<1> model;
  model.fixes.push_back({on("boundary"), {Field(0)}});
  model.loads.push_back({{}, {Field(source)}});
  if (lower || upper) model.obstacles.push_back({between(lower, upper), {}, "test"});
  return model;
}

/// An elastic unit block whose top is pushed down by `push`, above an obstacle that its bottom may touch.
template <int D>
Model<D> pressed_block(std::shared_ptr<const Obstacle<D>> obstacle, double push) {
  Model<D> model;
  model.poisson = 0.3;
  Fix<D> top{on("top"), {}};
  for (int i = 0; i < D; ++i) top.value[i] = Field(i == D - 1 ? -push : 0.0);
  model.fixes.push_back(top);
  model.obstacles.push_back({std::move(obstacle), on("bottom"), "test"});
  return model;
}

/// An elastic unit block that only the plane holds vertically: its left (and front) side slides, a load presses it.
template <int D>
Model<D> resting_block(Point<D> traction, const std::vector<std::string>& sliding) {
  Model<D> model;
  model.poisson = 0.3;
  for (const std::string& side : sliding) {
    Fix<D> fix{on(side), {}, Frame::normal};
    fix.value[0] = Field(0);
    model.fixes.push_back(fix);
  }
  Load<D> load{on("top"), {}};
  for (int i = 0; i < D; ++i) load.value[i] = Field(traction[i]);
  model.loads.push_back(load);
  Point<D> up{};
  up[D - 1] = 1;
  model.obstacles.push_back({plane<D>({}, up), on("bottom"), "test"});
  return model;
}

}  // namespace signorini::test
