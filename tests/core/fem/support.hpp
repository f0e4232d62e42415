#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "core/base/dense.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/mesh/structured.hpp"
#include "core/sdk/box_obstacle.hpp"
#include "tests/support/on_mesh.hpp"

namespace signorini::testing {

/// An expression as the scene reader would make it.
inline Field expression(std::function<double(const Site&)> f, std::string text = "f") {
  return {std::move(f), std::move(text), "scene.toml:1"};
}

template <int D>
Mesh<D> unit_mesh(Index cells) {
  if constexpr (D == 2)
    return rectangle({0, 0}, {1, 1}, {cells, cells + 1});
  else
    return box({0, 0, 0}, {1, 1, 1}, {cells, cells + 1, cells});
}

/// The unit square or cube with its inner vertices moved at random by up to a sixth of a cell.
template <int D>
Mesh<D> distorted_mesh(Index cells) {
  Mesh<D> mesh = unit_mesh<D>(cells);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-1.0 / (6 * (cells + 1)), 1.0 / (6 * (cells + 1)));
  for (Point<D>& x : mesh.points) {
    const bool inside = std::all_of(x.begin(), x.end(), [](double c) { return c > 1e-9 && c < 1 - 1e-9; });
    for (double& c : x) c += inside ? shift(random) : 0;
  }
  return mesh;
}

/// A rotation of no special angle or axis.
template <int D>
Eigen::Matrix<double, D, D> rotation() {
  if constexpr (D == 2)
    return Eigen::Rotation2Dd(0.7).toRotationMatrix();
  else
    return Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}

template <int D>
Eigen::Matrix<double, D, 1> vector(const Point<D>& x) {
  return Eigen::Map<const Eigen::Matrix<double, D, 1>>(x.data());
}

template <int D>
void rotate_mesh(Mesh<D>& mesh) {
  for (Point<D>& x : mesh.points) Eigen::Map<Eigen::Matrix<double, D, 1>>(x.data()) = rotation<D>() * vector<D>(x);
}

template <int D>
Index vertex_at(const Mesh<D>& mesh, const Point<D>& x) {
  for (Index p = 0; p < mesh.vertices(); ++p)
    if ((vector<D>(mesh.points[p]) - vector<D>(x)).norm() < 1e-12) return p;
  return -1;
}

template <int B>
Eigen::MatrixXd dense(const BlockMatrix<B>& A) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(A.size() * B, A.size() * B);
  for (Index p = 0; p < A.size(); ++p)
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) M(p * B + i, A.column[k] * B + j) += A.at(k)[i * B + j];
  return M;
}

inline std::vector<double> to_std(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

/// The solution without bounds, in local coordinates.
template <int B>
std::vector<double> solve_dense(const DiscreteProblem<B>& problem) {
  const Eigen::Map<const Eigen::VectorXd> b(problem.b.data(), static_cast<Index>(problem.b.size()));
  return to_std(SymmetricFactors(dense(problem.A)).solve(b));
}

/// The solution with bounds, by a primal-dual active set method with dense solves that starts from full contact.
template <int B>
std::vector<double> solve_bounded(const DiscreteProblem<B>& problem) {
  const Eigen::MatrixXd A = dense(problem.A);
  const Index n = static_cast<Index>(A.rows());
  const Eigen::Map<const Eigen::VectorXd> b(problem.b.data(), n);
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(n, -infinity), upper = Eigen::VectorXd::Constant(n, infinity);
  for (Index slot = 0; slot < problem.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      lower[problem.constraints.vector[slot] * B + k] = problem.constraints.lower[slot * B + k];
      upper[problem.constraints.vector[slot] * B + k] = problem.constraints.upper[slot * B + k];
    }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), force = x;
  std::vector<int> active(n, 0), next(n);
  for (Index i = 0; i < n; ++i) next[i] = lower[i] > -infinity ? -1 : upper[i] < infinity ? 1 : 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    for (Index i = 0; i < n && iteration > 0; ++i) {
      const double trial = x[i] - force[i] / A(i, i);
      next[i] = trial <= lower[i] ? -1 : trial >= upper[i] ? 1 : 0;
    }
    if (iteration > 0 && next == active) break;
    active = next;
    Eigen::MatrixXd M = A;
    Eigen::VectorXd rhs = b;
    for (Index i = 0; i < n; ++i)
      if (active[i]) {
        M.row(i).setZero();
        M(i, i) = 1;
        rhs[i] = active[i] < 0 ? lower[i] : upper[i];
      }
    x = M.partialPivLu().solve(rhs);
    for (Index i = 0; i < n; ++i)
      if (active[i]) x[i] = rhs[i];
    force = A * x - b;
    for (Index i = 0; i < n; ++i)
      if (!active[i]) force[i] = 0;
  }
  return to_std(x);
}

/// An obstacle given by a function from a vertex to its constraint.
template <int B>
class TestObstacle : public BoxObstacle<B> {
 public:
  using Rule = std::function<LocalConstraint<B>(const SurfaceVertex&)>;
  explicit TestObstacle(Rule rule, int values = 2) : rule_(std::move(rule)), values_(values) {}

  ObstacleDescriptor descriptor() const noexcept override {
    ObstacleDescriptor d;
    d.directions = 1;
    d.direction[0] = {"normal", 1, values_};
    return d;
  }
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status&) const noexcept override {
    for (std::size_t i = 0; i < count; ++i) constraints[i] = rule_(vertices[i]);
  }

 private:
  Rule rule_;
  int values_;
};

template <int B>
ObstacleTerm<B> term(typename TestObstacle<B>::Rule rule, const std::optional<std::string>& part,
                     std::string origin = "obstacle.0", int values = 2) {
  ObstacleTerm<B> out{std::make_shared<TestObstacle<B>>(std::move(rule), values), {}, origin};
  if (part) out.on = Selection{part, {}, std::move(origin)};
  return out;
}

template <int B>
LocalConstraint<B> bound(std::array<double, B> direction, double lower, double upper) {
  LocalConstraint<B> c;
  c.directions = 1;
  std::copy(direction.begin(), direction.end(), c.direction[0]);
  c.lower[0] = lower;
  c.upper[0] = upper;
  return c;
}

template <int B>
Fix<B> fix(const std::optional<std::string>& part, std::array<std::optional<Field>, B> value,
           Frame frame = Frame::global) {
  return {Selection{part, {}, "fix.0"}, std::move(value), frame};
}

}  // namespace signorini::testing
