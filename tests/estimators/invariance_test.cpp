#include <gtest/gtest.h>

#include <numeric>

#include "estimators/certificate/certificate.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::test {
namespace {

using namespace signorini::testing;

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

template <int D>
std::array<double, D> as_array(const Vector<D>& v) {
  std::array<double, D> out;
  Eigen::Map<Vector<D>>(out.data()) = v;
  return out;
}

/// An elastic body on a distorted mesh that is pressed on a plane, with all vectors turned by R.
template <int D>
Model<D> pressed(const Eigen::Matrix<double, D, D>& R) {
  const Vector<D> up = R * Vector<D>::Unit(D - 1), right = R * Vector<D>::Unit(0);
  Model<D> model;
  model.young = 1;
  model.poisson = 0.3;
  std::array<std::optional<Field>, D> held;
  held.fill(Field(0.0));
  model.fixes.push_back(fix<D>("left", held));
  Load<D> load;
  for (int i = 0; i < D; ++i) load.value[i] = -0.05 * up[i] + 0.02 * right[i];
  model.loads.push_back(load);
  model.obstacles.push_back(term<D>(
      [up](const SurfaceVertex& v) {
        double height = 0.01;
        for (int i = 0; i < D; ++i) height += up[i] * v.position[i];
        return bound<D>(as_array<D>(up), -height, infinity);
      },
      "bottom"));
  return model;
}

template <int D>
std::vector<double> solution(const Mesh<D>& mesh, const Model<D>& model) {
  const Discretization<D> found = discretize<D, D>(Nodes<D>(mesh), model);
  return to_global(found.problem, solve_bounded(found.problem));
}

template <int D>
std::vector<double> turned(std::vector<double> u, const Eigen::Matrix<double, D, D>& R) {
  for (std::size_t k = 0; k < u.size(); k += D) {
    Eigen::Map<Vector<D>> v(u.data() + k);
    v = (R * v).eval();
  }
  return u;
}

template <int D>
std::vector<double> backwards(const std::vector<double>& u) {
  std::vector<double> out;
  for (std::size_t k = u.size(); k > 0; k -= D) out.insert(out.end(), u.begin() + k - D, u.begin() + k);
  return out;
}

template <int D>
Estimate estimate(const Mesh<D>& mesh, const Model<D>& model, const std::vector<double>& u) {
  EstimateOptions<D> options;
  options.solve = [](const DiscreteProblem<D>& problem, std::vector<double>& x) {
    x = solve_dense(problem);
    return true;
  };
  return certificate<D, D>(Nodes<D>(mesh), model, u, options);
}

template <int D>
Mesh<D> numbered_backwards(Mesh<D> mesh) {
  const Index last = mesh.vertices() - 1;
  std::ranges::reverse(mesh.points);
  for (auto& element : mesh.elements)
    for (Index& p : element) p = last - p;
  for (Face<D>& face : mesh.boundary)
    for (Index& p : face.vertices) p = last - p;
  return mesh;
}

template <int D>
void expect_invariant() {
  const Eigen::Matrix<double, D, D> identity = Eigen::Matrix<double, D, D>::Identity();
  const Mesh<D> mesh = distorted_mesh<D>(D == 2 ? 4 : 2);
  Mesh<D> other = mesh;
  rotate_mesh(other);
  const std::vector<double> u = solution(mesh, pressed<D>(identity));
  const Estimate here = estimate(mesh, pressed<D>(identity), u),
                 there = estimate(other, pressed<D>(rotation<D>()), turned<D>(u, rotation<D>())),
                 renumbered = estimate(numbered_backwards(mesh), pressed<D>(identity), backwards<D>(u));
  EXPECT_TRUE(here.guaranteed);
  EXPECT_GT(here.parts.contact, 0);
  EXPECT_NEAR(there.lower, here.lower, 1e-9 * here.lower);
  EXPECT_NEAR(there.upper, here.upper, 1e-9 * here.upper);
  // The sweep goes another way.
  EXPECT_NEAR(renumbered.lower, here.lower, 0.1 * here.lower);
  EXPECT_NEAR(renumbered.upper, here.upper, 0.1 * here.upper);
  for (const Estimate& one : {here, there, renumbered}) EXPECT_LT(one.imbalance, 1e-13);
}

/// The stress without the correction is in equilibrium all the same.
template <int D>
void expect_bounds_without_solve() {
  const Mesh<D> mesh = distorted_mesh<D>(D == 2 ? 4 : 2);
  const Model<D> model = pressed<D>(Eigen::Matrix<double, D, D>::Identity());
  const std::vector<double> u = solution(mesh, model);
  EstimateOptions<D> fails;
  fails.solve = [](const DiscreteProblem<D>&, std::vector<double>&) { return false; };
  const Estimate sharp = estimate(mesh, model, u), found = certificate<D, D>(Nodes<D>(mesh), model, u, fails),
                 cheap = certificate<D, D>(Nodes<D>(mesh), model, u);
  EXPECT_TRUE(found.solve_failed);
  EXPECT_FALSE(sharp.solve_failed || cheap.solve_failed);
  EXPECT_TRUE(found.guaranteed);
  EXPECT_LT(found.imbalance, 1e-12);
  EXPECT_GT(found.upper, sharp.lower);
  EXPECT_EQ(found.lower, cheap.lower);
}

TEST(Certificate, HoldsWhereTheCorrectiveSolveFails) {
  expect_bounds_without_solve<2>();
  expect_bounds_without_solve<3>();
}

TEST(CertificateInvariance, PlaneDoesNotDependOnRotationAndNumbers) { expect_invariant<2>(); }
TEST(CertificateInvariance, SpaceDoesNotDependOnRotationAndNumbers) { expect_invariant<3>(); }

}  // namespace
}  // namespace signorini::test
