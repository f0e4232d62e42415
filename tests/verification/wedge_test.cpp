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
  double distance = 0;            ///< of the planes from the origin, against their normals
  std::vector<double> distances;  ///< of each of them, where they differ

  double distance_of(std::size_t k) const { return distances.empty() ? distance : distances[k]; }

  std::string scene() const {
    const auto list = [](const Vector& v) { return fmt::format("{:.17g}", fmt::join(v.data(), v.data() + D, ", ")); };
    std::string text =
        "title = \"corner\"\n[[body]]\nname = \"b\"\n" + shape + "\norder = 1\nyoung = 1\npoisson = 0.3\n";
    text += "[[load]]\nbody = \"b\"\nvalue = [" + list(load) + "]\n";
    for (std::size_t k = 0; k < normals.size(); ++k)
      text += fmt::format(
          "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\nwhere = \"1\"\nshape = \"plane\"\npoint = [{}]\nnormal = "
          "[{}]\n",
          list(-distance_of(k) * normals[k]), list(normals[k]));
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
    Vector all = Vector::Zero(), claimed = all;
    for (std::size_t k = 0; k < total.size(); ++k) {
      all += total[k];
      claimed += vector(k);
      EXPECT_GE(vector(k).dot(corner_.normals[k]), (1 - 1e-12) * vector(k).norm()) << "force of obstacle " << k;
      if (unique_) {
        EXPECT_LT((total[k] - vector(k)).norm(), 1e-6 * total[k].norm() + 1e-6 * largest_) << "force of obstacle " << k;
      }
    }
    EXPECT_LT((all - claimed).norm(), 1e-6 * all.norm());
    Index undetermined = 0;
    for (std::size_t k = 0; k < total.size(); ++k) undetermined += run_.contact(static_cast<int>(k)).undetermined_nodes;
    EXPECT_EQ(undetermined == 0, unique_);
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
      const double gap = (x + u).dot(corner_.normals[k]) + corner_.distance_of(k);
      EXPECT_GE(gap, -1e-12 * size_);
      if (gap > 1e-12 * size_) continue;
      if (normals.cols() > 0 && (normals.colwise() - corner_.normals[k]).colwise().norm().minCoeff() < 1e-10) continue;
      touched.push_back(k);
      normals.conservativeResize(D, normals.cols() + 1);
      normals.rightCols(1) = corner_.normals[k];
    }
    const auto [pressure, ways] = divided(normals, f);
    unique_ = unique_ && ways < 2;
    EXPECT_LT((normals * pressure - f).norm(), 1e-6 * largest_) << "no equilibrium at " << p;
    std::size_t pressed = 0;
    for (std::size_t k = 0; k < touched.size(); ++k) {
      EXPECT_GE(pressure[static_cast<Eigen::Index>(k)], -1e-6 * largest_);
      pressed += pressure[static_cast<Eigen::Index>(k)] > 1e-4 * largest_;
      total[touched[k]] += pressure[static_cast<Eigen::Index>(k)] * corner_.normals[touched[k]];
    }
    most_at_a_vertex = std::max(most_at_a_vertex, pressed);
  }

  /// Nonnegative parts along the normals that are next to f, of the last of all sets of up to D that balance it; and
  /// the number of these sets.
  std::pair<Eigen::VectorXd, int> divided(const Eigen::Matrix<double, D, Eigen::Dynamic>& normals, const Vector& f) {
    Eigen::VectorXd best = Eigen::VectorXd::Zero(normals.cols());
    int ways = 0;
    for (unsigned set = 1; set < 1u << normals.cols() && f.norm() > 1e-7 * largest_; ++set) {
      std::vector<Eigen::Index> chosen;
      for (Eigen::Index k = 0; k < normals.cols(); ++k)
        if (set >> k & 1u) chosen.push_back(k);
      if (chosen.size() > D) continue;
      const Eigen::Matrix<double, D, Eigen::Dynamic> N = normals(Eigen::all, chosen);
      const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, D, Eigen::Dynamic>> qr(N);
      const Eigen::VectorXd part = qr.solve(f);
      if (qr.rank() < N.cols() || part.minCoeff() < 1e-9 * f.norm() || (N * part - f).norm() > 1e-7 * largest_)
        continue;
      best.setZero();
      for (std::size_t k = 0; k < chosen.size(); ++k) best[chosen[k]] = part[static_cast<Eigen::Index>(k)];
      ++ways;
    }
    return {best, ways};
  }

  bool unique_ = true;  // the way forces divide, at all vertices
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

/// A groove with a floor at this depth below where the corner of the kite would stand.
Corner<2> groove_with_floor(double floor, double tilt, double turn) {
  Corner<2> corner = groove(60, 70, turn);
  const Eigen::Rotation2Dd R(turn);
  corner.normals.push_back(R * Eigen::Vector2d(std::sin(tilt), std::cos(tilt)));
  const double sunk = 0.1 * std::sin(35 * pi / 180);  // the corner may sink by 0.1 between the sides
  corner.distances = {sunk, sunk, floor};
  return corner;
}

TEST(Wedge, GroovesWithAFloor) {
  for (const double turn : {0.0, 0.8})
    for (const double tilt : {0.0, 0.2})
      for (const double floor : {0.25, 0.1 * std::cos(tilt), 0.098, 0.08}) {
        SCOPED_TRACE(fmt::format("floor {} deep, tilted by {}, turned by {}", floor, tilt, turn));
        Optimality<2>(groove_with_floor(floor, tilt, turn), {uniform(3)}).expect(1);
      }
}

// Planes at angles down to nothing, pressed by a block that slides on them.
TEST(Wedge, NearlyParallelPlanes) {
  for (const double angle : {1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 0.0}) {
    SCOPED_TRACE(angle);
    Corner<2> corner{"shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]",
                     {Eigen::Vector2d(0, 1), Eigen::Vector2d(-std::sin(angle), std::cos(angle)),
                      Eigen::Vector2d(std::sqrt(0.5), std::sqrt(0.5))},
                     {-0.02, -0.05}};
    Optimality<2>(corner, {uniform(3)}).expect(1);
  }
}

TEST(Wedge, FourPlanesInSpace) {
  for (const double apart : {0.5, 0.05, 1e-3, 1e-6, 1e-9}) {
    SCOPED_TRACE(apart);
    Corner<3> corner = trihedral(0.3, {-0.02, -0.014, -0.016});
    corner.normals.push_back((corner.normals[0] + apart * Eigen::Vector3d(0.3, 1, -0.4)).normalized());
    corner.normals.push_back(corner.normals[1]);
    Optimality<3>(corner, {uniform(2)}).expect();
  }
}

// Turned, in other units, and with each plane given twice it is the same problem.
TEST(Wedge, CyclesStayTheSame) {
  const auto cycles = [](const Corner<2>& corner) {
    return run<2, 2>(corner.scene(), {uniform(4)}).summary().iterations;
  };
  const Corner<2> two = groove(60, 70, 0);
  Corner<2> twice = two;
  twice.normals.insert(twice.normals.end(), two.normals.begin(), two.normals.end());
  EXPECT_EQ(cycles(twice), cycles(two));
  for (const double floor : {0.25, 0.098, 0.08}) {
    const int level = cycles(groove_with_floor(floor, 0.1, 0));
    EXPECT_LE(level, cycles(two) + 3) << floor;
    EXPECT_LE(cycles(groove_with_floor(floor, 0.1, 0.7)), cycles(two) + 4) << floor;  // one more or less by rounding
    Corner<2> small = groove_with_floor(1e-3 * floor, 0.1, 0);
    small.distances[0] = small.distances[1] *= 1e-3;
    small.load *= 1e-3;
    EXPECT_LE(cycles(small), cycles(two) + 3) << floor;
  }
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
