// Bodies between obstacles that are oblique to each other, some vertices touching several of them. The optimality
// conditions are checked in global coordinates: nothing here knows of local ones.
#include <Eigen/Geometry>

#include "core/algebra/products.hpp"
#include "run.hpp"
#include "tests/support/dense.hpp"

namespace signorini::test {
namespace {

/// Planes through the origin that a body touches or may come to touch, in a scene that is turned as a whole.
template <int D>
struct Corner {
  using Vector = Eigen::Matrix<double, D, 1>;
  std::string shape;
  std::vector<Vector> normals;
  Vector load;
  double distance = 0;  ///< of the planes from the origin, against their normals

  std::string scene() const {
    const auto list = [](const Vector& v) { return fmt::format("{:.17g}", fmt::join(v.data(), v.data() + D, ", ")); };
    std::string text = "title = \"corner\"\n[[body]]\nname = \"b\"\n" + shape + "\nyoung = 1\npoisson = 0.3\n";
    text += "[[load]]\nbody = \"b\"\nvalue = [" + list(load) + "]\n";
    for (const Vector& n : normals)
      text += fmt::format(
          "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\nwhere = \"1\"\nshape = \"plane\"\npoint = [{}]\nnormal = "
          "[{}]\n",
          list(-distance * n), list(n));
    return text;
  }
};

template <int D>
class Optimality {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  Optimality(const Corner<D>& corner, std::vector<std::string> settings)
      : corner_(corner), run_(run<D, D>(corner.scene(), settings)) {
    Model<D> free = run_.model;
    free.obstacles.clear();
    const DiscreteProblem<D> problem = discretize(run_.mesh(), free).problem;
    EXPECT_TRUE(problem.frames.slot.empty());
    force_.resize(run_.u().size());
    residual(problem.A, run_.u().data(), problem.b.data(), force_.data());
    for (const double v : run_.u()) size_ = std::max(size_, std::abs(v));
    for (double& f : force_) largest_ = std::max(largest_, std::abs(f = -f));
  }

  /// @param meeting how many obstacles press on one vertex, at least
  void expect(std::size_t meeting = 2) {
    std::vector<Vector> total(corner_.normals.size(), Vector::Zero());
    for (Index p = 0; p < run_.mesh().vertices(); ++p) expect_at(p, total);
    for (std::size_t k = 0; k < total.size(); ++k)
      EXPECT_LT((total[k] - vector(k)).norm(), 1e-6 * total[k].norm() + 1e-6 * largest_) << "force of obstacle " << k;
    EXPECT_GE(most_at_a_vertex, meeting);
    show("{}: {} cycles, {} obstacles at a vertex\n", testing::UnitTest::GetInstance()->current_test_info()->name(),
         run_.summary().iterations, most_at_a_vertex);
  }

  std::size_t most_at_a_vertex = 0;

 private:
  Vector vector(std::size_t obstacle) const {
    return Eigen::Map<const Vector>(run_.contact(static_cast<int>(obstacle)).force.data());
  }

  // No obstacle is violated, and the force is a positive combination of the normals of those that are touched.
  void expect_at(Index p, std::vector<Vector>& total) {
    const Eigen::Map<const Vector> x(run_.mesh().points[p].data()), u(run_.u().data() + p * D),
        f(force_.data() + p * D);
    Eigen::Matrix<double, D, Eigen::Dynamic> normals(D, 0);
    std::vector<std::size_t> touched;
    for (std::size_t k = 0; k < corner_.normals.size(); ++k) {
      const double gap = (x + u).dot(corner_.normals[k]) + corner_.distance;
      EXPECT_GE(gap, -1e-12 * size_);
      if (gap > 1e-12 * size_) continue;
      touched.push_back(k);
      normals.conservativeResize(D, normals.cols() + 1);
      normals.rightCols(1) = corner_.normals[k];
    }
    Eigen::VectorXd pressure(0);
    if (!touched.empty()) pressure = normals.completeOrthogonalDecomposition().solve(f);
    EXPECT_LT((normals * pressure - f).norm(), 1e-6 * largest_) << "no equilibrium at " << p;
    std::size_t pressed = 0;
    for (std::size_t k = 0; k < touched.size(); ++k) {
      EXPECT_GE(pressure[static_cast<Eigen::Index>(k)], -1e-6 * largest_);
      pressed += pressure[static_cast<Eigen::Index>(k)] > 1e-4 * largest_;
      total[touched[k]] += pressure[static_cast<Eigen::Index>(k)] * corner_.normals[touched[k]];
    }
    most_at_a_vertex = std::max(most_at_a_vertex, pressed);
  }

  Corner<D> corner_;
  Run<D, D> run_;
  std::vector<double> force_;  // of the obstacles on each vertex
  double size_ = 0, largest_ = 0;
};

std::string polygon(const std::vector<Eigen::Vector2d>& points) {
  std::string text = "shape = \"polygon\"\nsize = 0.5\npoints = [";
  for (const auto& p : points) text += fmt::format("[{:.17g}, {:.17g}],", p[0], p[1]);
  return text + "]";
}

/// A kite with the opening `inner` that stands with its corner in a groove with the opening `outer`, in degrees.
Corner<2> groove(double inner, double outer, double turn, const Eigen::Vector2d& load = {0, -0.05}) {
  const Eigen::Rotation2Dd R(turn);
  const double a = inner * pi / 360, o = outer * pi / 360;
  const Eigen::Vector2d left(-std::sin(a), std::cos(a)), right(std::sin(a), std::cos(a));
  return {polygon({Eigen::Vector2d::Zero(), R * right, R * Eigen::Vector2d(0, 1.5), R * left}),
          {R * Eigen::Vector2d(std::cos(o), std::sin(o)), R * Eigen::Vector2d(-std::cos(o), std::sin(o))},
          R * load};
}

TEST(Wedge, GroovesOfAllAngles) {
  for (const double turn : {0.0, 0.7, 2.5})
    for (const auto& [inner, outer] :
         {std::pair{70., 70.}, {60., 70.}, {20., 30.}, {80., 90.}, {100., 130.}, {120., 178.}})
      for (const int refinements : {2, 4}) {
        SCOPED_TRACE(fmt::format("{} in {} turned by {}, {} refinements", inner, outer, turn, refinements));
        Optimality<2>(groove(inner, outer, turn), {uniform(refinements)}).expect();
      }
}

TEST(Wedge, LoadedFromTheSide) {
  for (const double turn : {0.0, 1.1}) Optimality<2>(groove(110, 120, turn, {0.02, -0.05}), {uniform(4)}).expect();
}

/// The corner of a block among three planes oblique to its sides and to each other.
Corner<3> trihedral(double oblique, const Eigen::Vector3d& load) {
  Corner<3> corner{"shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [2, 2, 2]", {}, load};
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d n = Eigen::Vector3d::Constant(oblique);
    n[k] = 1;
    corner.normals.push_back(n.normalized());
  }
  return corner;
}

TEST(Wedge, TrihedralCorners) {
  for (const double oblique : {0.1, 0.3, 0.6})
    for (const Eigen::Vector3d& load : {Eigen::Vector3d(-0.02, -0.02, -0.02), Eigen::Vector3d(-0.02, -0.014, -0.016)}) {
      SCOPED_TRACE(fmt::format("{} under {}", oblique, load[1]));
      Optimality<3> optimality(trihedral(oblique, load), {uniform(2)});
      optimality.expect();
      EXPECT_EQ(optimality.most_at_a_vertex, 3u);
    }
}

// A third obstacle at a vertex is not part of the plane problem: it makes no difference where it holds by itself, and
// where it does not the result is no solution.
TEST(Wedge, ObstaclesBeyondTheDimensionAreChecked) {
  const auto judged = [](double floor) {
    Corner<2> corner = groove(60, 70, 0);
    corner.distance = 0.1 * std::sin(35 * pi / 180);  // it sinks by 0.1
    std::string scene = corner.scene();
    corner.normals = {Eigen::Vector2d::UnitY()};
    corner.distance = floor;
    const std::string third = corner.scene();
    const auto r = run<2, 2>(scene + third.substr(third.find("[[obstacle]]")), {uniform(2)});
    EXPECT_FALSE(r.solution.discretization.dropped.empty());
    return judge(r.mesh(), r.model, r.solution, r.u(), 1e-8);
  };
  EXPECT_EQ(judged(0.25).outcome, Outcome::converged);
  const Summary summary = judged(0.08);
  EXPECT_EQ(summary.outcome, Outcome::violated) << summary.reason;
  EXPECT_FALSE(summary.converged());
  EXPECT_NE(summary.reason.find("obstacle.2: this obstacle is violated"), std::string::npos) << summary.reason;
}

TEST(Wedge, GroovesOfUnequalSides) {
  Corner<2> corner = groove(70, 90, 0.4, {0.01, -0.05});
  corner.normals[1] = Eigen::Rotation2Dd(0.2) * corner.normals[1];
  Optimality<2>(corner, {uniform(3)}).expect();
}

/// Each vertex may touch all walls of the corner, and touches one of them at most.
TEST(Wedge, RoundBodiesInCorners) {
  Corner<2> disk = groove(70, 80, 0.3);
  disk.shape = "shape = \"disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.4";
  disk.distance = 1;
  Corner<3> ball = trihedral(0.2, {-0.02, -0.018, -0.022});
  ball.shape = "shape = \"ball\"\ncenter = [0, 0, 0]\nradius = 1\nsize = 0.7";
  ball.distance = 1;
  Optimality<2>(disk, {uniform(3)}).expect(1);
  Optimality<3>(ball, {uniform(1)}).expect(1);
}

}  // namespace
}  // namespace signorini::test
