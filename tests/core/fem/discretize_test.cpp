#include "core/fem/assembly/discretize.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/algebra/local_basis.hpp"
#include "core/base/dense.hpp"
#include "core/base/error.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

template <int D, int B>
std::string no_solution_message(const Mesh<D>& mesh, const Model<B>& model) {
  try {
    discretize(mesh, model);
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Exit::no_solution);
    return e.what();
  }
  return "feasible";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(LocalBasis, CompletesGivenVectorsInTheirPlaces) {
  const Eigen::Matrix3d R = rotation<3>();
  for (const Eigen::Matrix3d& given : {R, Eigen::Matrix3d(-R), Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
                                       Eigen::Matrix3d(-Eigen::Matrix3d::Identity())})
    for (int leading = 0; leading <= 3; ++leading)
      for (int trailing = 0; leading + trailing <= 3; ++trailing) {
        Eigen::Matrix<double, 3, 3, Eigen::RowMajor> Q, N;
        local_basis<3>(given.data(), leading, given.data() + 3 * leading, trailing, Q.data(), N.data());
        EXPECT_LT((Q.transpose() * Q - Eigen::Matrix3d::Identity()).norm(), 1e-14);
        EXPECT_LT((Q - N).norm(), 1e-14);
        for (int k = 0; k < leading; ++k) EXPECT_EQ((N.col(k) - given.col(k)).norm(), 0);
        for (int k = 0; k < trailing; ++k) EXPECT_EQ((N.col(3 - trailing + k) - given.col(leading + k)).norm(), 0);
      }
}

TEST(LocalBasis, IsDualToObliqueVectors) {
  using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Matrix3d R = rotation<3>();
  for (const double angle : {1.5, 0.5, 3.1, 1e-3}) {
    Eigen::Matrix3d given = R;
    given.col(1) = std::cos(angle) * R.col(0) + std::sin(angle) * R.col(1);
    Block Q, N;
    local_basis<3>(given.data(), 2, given.data() + 6, 1, Q.data(), N.data());
    EXPECT_EQ((N - Block(given)).norm(), 0);
    EXPECT_LT((N.transpose() * Q - Eigen::Matrix3d::Identity()).norm(), 1e-15 / std::sin(angle));
    EXPECT_NEAR(separation<3>(given.data(), 2), std::sin(angle), 1e-15);
    EXPECT_NEAR(1 / separation<3>(given.data(), 2), Q.col(0).norm(), 1e-9);

    local_basis<3>(given.data(), 2, nullptr, 0, Q.data(), N.data());
    EXPECT_LT((N.leftCols(2) - given.leftCols(2)).norm() + (N.transpose() * Q - Block::Identity()).norm(),
              1e-15 / std::sin(angle));
    EXPECT_LT((N.leftCols(2).transpose() * N.col(2)).norm(), 1e-12) << "tangents are orthogonal to all normals";
    given.col(2) = (given.col(0) + given.col(1)).normalized();
    EXPECT_LT(separation<3>(given.data(), 3), 1e-12);
  }
}

TEST(LocalBasis, IsAccurateNextToACoordinateAxis) {
  for (const double angle : {1e-3, 1e-7, 1e-9, 1e-15}) {
    const double d[2] = {std::cos(angle), std::sin(angle)};
    double Q[4], N[4];
    local_basis<2>(d, 1, nullptr, 0, Q, N);
    EXPECT_NEAR(Q[0] * Q[1] + Q[2] * Q[3], 0, 1e-16 + 1e-16 * angle);
    EXPECT_NEAR(Q[1] * Q[1] + Q[3] * Q[3], 1, 1e-15);
  }
}

TEST(Eliminate, LeavesASymmetricDefiniteMatrixAndTheReducedSolution) {
  const Mesh<3> mesh = distorted_mesh<3>(2);
  Model<3> model;
  model.poisson = 0.3;
  model.fixes = {fix<3>("left", {0.1, std::nullopt, 0.2}), fix<3>("bottom", {std::nullopt, 0.3, -0.1})};
  model.loads = {{{}, {1.0, -2.0, 0.5}}};
  const DiscreteProblem<3> problem = discretize(mesh, model).problem;
  const Eigen::MatrixXd A = dense(problem.A);
  EXPECT_LT((A - A.transpose()).norm(), 1e-15 * A.norm());
  EXPECT_GT(eigenpairs(A).values[0], 0);

  Model<3> natural = model;
  natural.fixes.clear();
  const DiscreteProblem<3> full = discretize(mesh, natural).problem;
  const auto x = solve_dense(problem);
  const Eigen::Map<const Eigen::VectorXd> v(x.data(), static_cast<Index>(x.size()));
  const Eigen::VectorXd r = dense(full.A) * v - Eigen::Map<const Eigen::VectorXd>(full.b.data(), v.size());
  for (Index k = 0; k < v.size(); ++k)
    if (problem.fixed[k / 3] >> (k % 3) & 1)
      EXPECT_EQ(x[k], problem.start[k]);
    else
      EXPECT_NEAR(r[k], 0, 1e-13);
}

// The same problem with all frames turned must have the same solution in global coordinates.
TEST(Discretize, FramesDoNotChangeTheSolution) {
  const Mesh<3> mesh = distorted_mesh<3>(2);
  Model<3> model;
  model.poisson = 0.3;
  model.fixes = {fix<3>("left", {0.0, 0.0, 0.0})};
  model.loads = {{{}, {0.1, -0.2, 0.3}}};
  const auto plain = discretize(mesh, model).problem;
  const auto u = solve_dense(plain);
  // Bounds far away along an oblique direction.
  const Eigen::Vector3d d = Eigen::Vector3d(1, 2, -2) / 3;
  model.obstacles = {term<3>([d](const SurfaceVertex&) { return bound<3>({d[0], d[1], d[2]}, -1e3, infinity); }, {})};
  const auto turned = discretize(mesh, model).problem;
  EXPECT_FALSE(turned.frames.slot.empty());
  const auto x = solve_dense(turned);
  const auto v = to_global(turned, x);
  for (std::size_t k = 0; k < u.size(); ++k) EXPECT_NEAR(u[k], v[k], 1e-12);
  const auto back = to_local(turned, v);
  for (std::size_t k = 0; k < u.size(); ++k) EXPECT_NEAR(back[k], x[k], 1e-14);
}

TEST(Discretize, FirstLocalDirectionIsTheObstaclesThenTangentsThenFixed) {
  const Mesh<3> mesh = unit_mesh<3>(2);
  Model<3> model;
  model.fixes = {fix<3>("left", {0.5, std::nullopt, std::nullopt})};
  model.obstacles = {term<3>([](const SurfaceVertex&) { return bound<3>({0, 0, 1}, -0.1, infinity); }, "bottom")};
  const auto problem = discretize(mesh, model).problem;
  const Index p = vertex_at<3>(mesh, {0, 1.0 / 3, 0}), inner = vertex_at<3>(mesh, {0.5, 1.0 / 3, 0});
  ASSERT_NE(problem.frames.at(p), nullptr);
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> Q(problem.frames.at(p));
  EXPECT_EQ((Q.col(0) - Eigen::Vector3d::UnitZ()).norm(), 0);
  EXPECT_EQ((Q.col(2) - Eigen::Vector3d::UnitX()).norm(), 0);
  EXPECT_EQ(problem.fixed[p], 4);
  EXPECT_EQ(problem.start[p * 3 + 2], 0.5);
  EXPECT_EQ(Eigen::Vector3d(problem.frames.at(inner)[0], problem.frames.at(inner)[3], problem.frames.at(inner)[6]),
            Eigen::Vector3d::UnitZ());
  EXPECT_EQ(problem.fixed[inner], 0);
  EXPECT_EQ(problem.constraints.lower[problem.constraints.slot[inner] * 3], -0.1);
  EXPECT_EQ(problem.constraints.upper[problem.constraints.slot[inner] * 3], infinity);
  EXPECT_EQ(problem.constraints.lower[problem.constraints.slot[inner] * 3 + 1], -infinity);
}

TEST(Discretize, BoundsAreReducedByThePrescribedPart) {
  const Mesh<2> mesh = unit_mesh<2>(2);
  Model<2> model;
  model.fixes = {fix<2>("bottom", {0.5, std::nullopt})};
  model.obstacles = {term<2>([](const SurfaceVertex&) { return bound<2>({0.6, 0.8}, -1, 2); }, "bottom")};
  const auto problem = discretize(mesh, model).problem;
  ASSERT_EQ(problem.constraints.size(), 3);
  for (Index slot = 0; slot < 3; ++slot) {
    EXPECT_NEAR(problem.constraints.lower[slot * 2], (-1 - 0.3) / 0.8, 1e-15);
    EXPECT_NEAR(problem.constraints.upper[slot * 2], (2 - 0.3) / 0.8, 1e-15);
    EXPECT_NEAR(std::fabs(problem.frames.at(problem.constraints.vector[slot])[2]), 1, 1e-15);
  }
}

TEST(Discretize, ObstacleBeyondTheFixedBoundaryHasNoSolution) {
  const Mesh<2> mesh = unit_mesh<2>(2);
  Model<1> scalar;
  scalar.fixes = {fix<1>({}, {Field(0.0)})};
  scalar.obstacles = {
      term<1>([](const SurfaceVertex&) { return bound<1>({1}, 0.1, infinity); }, {}, "scene.toml:5: obstacle.0")};
  const std::string message = no_solution_message(mesh, scalar);
  expect_contains(message, "scene.toml:5: obstacle.0");
  expect_contains(message, "(0, 0)");
  expect_contains(message, "obstacle beyond the fixed boundary");

  Model<2> elastic;
  elastic.fixes = {fix<2>("bottom", {std::nullopt, -0.3})};
  elastic.obstacles = {term<2>([](const SurfaceVertex&) { return bound<2>({0, 1}, -0.2, infinity); }, "bottom")};
  expect_contains(no_solution_message(mesh, elastic), "obstacle beyond the fixed boundary");
  elastic.fixes = {fix<2>("bottom", {std::nullopt, -0.1})};
  EXPECT_EQ(no_solution_message(mesh, elastic), "feasible");
  EXPECT_TRUE(discretize(mesh, elastic).problem.segments.empty());
}

// On the boundary obstacle and prescribed value agree up to rounding only.
TEST(Discretize, TouchingTheFixedBoundaryUpToRoundingIsFeasible) {
  const Mesh<2> mesh = unit_mesh<2>(5);
  for (const double unit : {1e-6, 1.0, 1e6}) {
    Model<1> model;
    model.fixes = {fix<1>({}, {expression([unit](const Site& s) { return unit * (0.1 + s.x[0] / 3); })})};
    const auto rule = [unit](double excess) {
      return [=](const SurfaceVertex& v) {
        return bound<1>({1}, unit * (0.3 + v.position[0] + excess) / 3 * (1 + 4e-16), infinity);
      };
    };
    model.obstacles = {term<1>(rule(0), {})};
    EXPECT_EQ(no_solution_message(mesh, model), "feasible");
    model.obstacles = {term<1>(rule(1e-9), {})};
    expect_contains(no_solution_message(mesh, model), "obstacle beyond");
  }
}

TEST(Discretize, InfiniteBoundsStoreNothing) {
  const Mesh<2> mesh = unit_mesh<2>(3);
  Model<1> model;
  model.obstacles = {term<1>(
      [](const SurfaceVertex& v) { return bound<1>({1}, v.position[0] > 0.9 ? -1 : -infinity, infinity); }, {})};
  const auto problem = discretize(mesh, model).problem;
  EXPECT_EQ(problem.constraints.size(), 5);
  ASSERT_EQ(problem.segments.size(), 1u);
  EXPECT_EQ(problem.segments[0].first, 0);
  EXPECT_EQ(problem.segments[0].last, mesh.vertices());
  EXPECT_TRUE(std::is_sorted(problem.constraints.vector.begin(), problem.constraints.vector.end()));
}

TEST(Discretize, ScalarObstaclesMayBoundTheNegativeUnknown) {
  Model<1> model;
  model.obstacles = {term<1>([](const SurfaceVertex&) { return bound<1>({-1}, -2, 5); }, {})};
  const auto discrete = discretize(unit_mesh<2>(1), model);
  EXPECT_EQ(discrete.problem.constraints.lower[0], -5);
  EXPECT_EQ(discrete.problem.constraints.upper[0], 2);
  EXPECT_TRUE(discrete.problem.frames.slot.empty());
}

TEST(Discretize, ParallelBoundsIntersectAndRememberTheirObstacles) {
  Model<2> model;
  model.obstacles = {term<2>(
                         [](const SurfaceVertex&) {
                           return bound<2>({0, 1}, -0.1, infinity);
                         },
                         "bottom", "first"),
                     term<2>(
                         [](const SurfaceVertex&) {
                           return bound<2>({0, -1}, -0.3, infinity);
                         },
                         "bottom", "second")};
  const Mesh<2> mesh = unit_mesh<2>(2);
  const auto discrete = discretize(mesh, model);
  ASSERT_EQ(discrete.problem.constraints.size(), 3);
  EXPECT_TRUE(discrete.facets.empty());
  EXPECT_EQ(discrete.problem.constraints.lower[0], -0.1);
  EXPECT_EQ(discrete.problem.constraints.upper[0], 0.3);
  EXPECT_EQ(discrete.lower_obstacle[0], 0);
  EXPECT_EQ(discrete.upper_obstacle[0], 1);
  model.obstacles[1] = term<2>(
      [](const SurfaceVertex&) {
        return bound<2>({0, -1}, 0.2, infinity);
      },
      "bottom", "second");
  expect_contains(no_solution_message(mesh, model), "second");
}

TEST(Discretize, OrthogonalBoundsOfOneTypeAreBothKept) {
  const Mesh<2> mesh = unit_mesh<2>(2);
  Model<2> model;
  model.obstacles = {term<2>(
                         [](const SurfaceVertex&) {
                           return bound<2>({0, 1}, -0.1, infinity);
                         },
                         "bottom"),
                     term<2>(
                         [](const SurfaceVertex&) {
                           return bound<2>({1, 0}, -0.05, infinity);
                         },
                         "left")};
  const auto discrete = discretize(mesh, model);
  const Index corner = discrete.problem.constraints.slot[vertex_at<2>(mesh, {0, 0})];
  EXPECT_EQ(discrete.problem.constraints.lower[corner * 2], -0.05);  // the nearest first
  EXPECT_EQ(discrete.problem.constraints.lower[corner * 2 + 1], -0.1);
  EXPECT_TRUE(discrete.facets.empty());
  EXPECT_EQ(discrete.problem.segments.front().first, 0);
  EXPECT_EQ(discrete.problem.segments.back().last, mesh.vertices());
  for (std::size_t k = 1; k < discrete.problem.segments.size(); ++k)
    EXPECT_EQ(discrete.problem.segments[k].first, discrete.problem.segments[k - 1].last);

  // Those of another type as well; then neither rules the vertex.
  model.obstacles[1] = term<2>(
      [](const SurfaceVertex&) {
        return bound<2>({1, 0}, -0.05, infinity);
      },
      "left", "obstacle.1", 3);
  const auto mixed = discretize(mesh, model);
  EXPECT_TRUE(mixed.facets.empty());
  EXPECT_EQ(mixed.problem.constraints.lower, discrete.problem.constraints.lower);
  const Index p = vertex_at<2>(mesh, {0, 0});
  for (const Segment<2>& s : mixed.problem.segments)
    if (s.first <= p && p < s.last)
      for (const auto& term : model.obstacles) EXPECT_NE(s.obstacle, term.obstacle);
}

ObstacleTerm<2> side(double angle, double distance) {
  return term<2>(
      [=](const SurfaceVertex&) {
        return bound<2>({std::cos(angle), std::sin(angle)}, -distance, infinity);
      },
      "bottom");
}

TEST(Discretize, ObliqueBoundsAreKeptBesideEachOther) {
  Model<2> model;
  model.obstacles = {side(0.3, 0.2), side(2.3, 0.1)};
  const auto discrete = discretize(unit_mesh<2>(2), model);
  const DiscreteProblem<2>& problem = discrete.problem;
  EXPECT_TRUE(discrete.facets.empty());
  const std::vector<double> u{0.1, -0.2, 0.3, 0.7, -0.4, 0.2};
  std::vector<double> global(problem.b.size());
  std::copy(u.begin(), u.end(), global.begin());
  const auto x = to_local(problem, global), back = to_global(problem, x);
  for (Index slot = 0; slot < problem.constraints.size(); ++slot) {
    const Index p = problem.constraints.vector[slot];
    for (int k = 0; k < 2; ++k) {
      const double angle = k == 0 ? 2.3 : 0.3;  // the nearest first
      EXPECT_EQ(discrete.lower_obstacle[slot * 2 + k], 1 - k);
      EXPECT_EQ(problem.constraints.lower[slot * 2 + k], k == 0 ? -0.1 : -0.2);
      EXPECT_NEAR(x[p * 2 + k], std::cos(angle) * global[p * 2] + std::sin(angle) * global[p * 2 + 1], 1e-15);
      EXPECT_NEAR(back[p * 2 + k], global[p * 2 + k], 1e-15);
    }
  }
}

TEST(Discretize, DependentBoundsAreFacetsBesideTheNearestOnes) {
  Model<2> model;
  model.obstacles = {side(0.3, 0.2), side(2.3, 0.1), side(0.3 + 0.015, 0.05), side(0.3 + std::numbers::pi, 0.4)};
  const Mesh<2> mesh = unit_mesh<2>(2);
  const auto discrete = discretize(mesh, model);
  const DiscreteProblem<2>& problem = discrete.problem;
  const Constraints<2>& c = problem.constraints;
  ASSERT_EQ(c.size(), 3);
  ASSERT_EQ(c.facet.size(), 3u) << "one per vertex: two of the obstacles have one direction";
  const std::vector<double> global{0.1, -0.2, 0.3, 0.7, -0.4, 0.2};
  std::vector<double> u(problem.b.size());
  std::copy(global.begin(), global.end(), u.begin());
  const auto x = to_local(problem, u);
  for (Index slot = 0; slot < c.size(); ++slot) {
    EXPECT_EQ(discrete.lower_obstacle[slot * 2], 2);
    EXPECT_EQ(discrete.lower_obstacle[slot * 2 + 1], 1);
    ASSERT_TRUE(c.has_facets(slot));
    const Index p = c.vector[slot];
    const Facet<2>& facet = c.facet[c.facet_row[slot]];
    EXPECT_NEAR(facet.normal[0] * x[p * 2] + facet.normal[1] * x[p * 2 + 1],
                std::cos(0.3) * u[p * 2] + std::sin(0.3) * u[p * 2 + 1], 1e-15);
    EXPECT_EQ(facet.lower, -0.2);
    EXPECT_EQ(facet.upper, 0.4);
    EXPECT_EQ(discrete.facets[c.facet_row[slot]].obstacle, (std::array<Index, 2>{0, 3}));
  }
}

TEST(Discretize, ObstaclesThatLeaveNoRoomTogetherAreRefused) {
  Model<2> model;
  const double third = 2 * std::numbers::pi / 3;
  model.obstacles = {side(0.2, 0.1), side(0.2 + third, 0.1), side(0.2 - third, -0.2)};
  EXPECT_NO_THROW(discretize(unit_mesh<2>(2), model)) << "a point is left";
  model.obstacles[2] = side(0.2 - third, -0.2 - 1e-9);
  expect_contains(no_solution_message(unit_mesh<2>(2), model), "no room");
}

TEST(Discretize, ObstaclesSeeNormalsOfTheirOwnFaces) {
  const Mesh<3> mesh = unit_mesh<3>(2);
  int inner = 0, seen = 0;
  Model<3> model;
  const auto check = [&](const SurfaceVertex& v) {
    ++seen;
    EXPECT_EQ(v.normal[0], 0);
    EXPECT_NEAR(v.normal[2], -1, 1e-15);
    return bound<3>({0, 0, 1}, -1, infinity);
  };
  model.obstacles = {term<3>(check, "bottom")};
  discretize(mesh, model);
  EXPECT_EQ(seen, 12);
  model.obstacles = {term<3>(
      [&](const SurfaceVertex& v) {
        const double length = std::hypot(v.normal[0], v.normal[1], v.normal[2]);
        inner += length == 0;
        EXPECT_NEAR(length, length == 0 ? 0 : 1, 1e-14);
        return bound<3>({0, 0, 1}, -1, infinity);
      },
      {})};
  discretize(mesh, model);
  EXPECT_EQ(inner, 2);
}

template <int B>
class FailingObstacle : public TestObstacle<B> {
 public:
  FailingObstacle() : TestObstacle<B>({}) {}
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<B>*, Status& status) const noexcept override {
    status.fail(static_cast<int>(Exit::input), "lower is nan at (1, 2, 3)");
  }
};

TEST(Discretize, FailuresOfObstaclesNameTheirOrigin) {
  Model<1> model;
  model.obstacles = {{std::make_shared<FailingObstacle<1>>(), {}, "scene.toml:8: obstacle.1"}};
  try {
    discretize(unit_mesh<2>(1), model);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), Exit::input);
    EXPECT_STREQ(e.what(), "scene.toml:8: obstacle.1: lower is nan at (1, 2, 3)");
  }
}

TEST(Discretize, NumbersOfDirectionsThatDoNotExistAreRejected) {
  for (const int directions : {9, 2, -1}) {
    Model<1> model;
    LocalConstraint<1> wrong = bound<1>({1}, 0, infinity);
    wrong.directions = directions;
    model.obstacles = {term<1>([=](const SurfaceVertex&) { return wrong; }, {})};
    try {
      discretize(unit_mesh<2>(1), model);
      FAIL() << directions;
    } catch (const Error& e) {
      EXPECT_EQ(e.status(), Exit::plugin);
      expect_contains(e.what(), "bounds " + std::to_string(directions) + " directions");
    }
  }
}

TEST(Discretize, BoundsThatAreNotNumbersAreRejected) {
  Model<1> model;
  model.obstacles = {term<1>([](const SurfaceVertex&) { return bound<1>({1}, std::nan(""), infinity); }, {})};
  EXPECT_THROW(discretize(unit_mesh<2>(1), model), Error);
  model.obstacles = {term<1>([](const SurfaceVertex&) { return bound<1>({0}, 0, infinity); }, {})};
  EXPECT_THROW(discretize(unit_mesh<2>(1), model), Error);
  model.obstacles = {term<1>([](const SurfaceVertex&) { return bound<1>({1}, infinity, infinity); }, {})};
  expect_contains(no_solution_message(unit_mesh<2>(1), model), "nothing admissible");
}

}  // namespace
}  // namespace signorini::testing
