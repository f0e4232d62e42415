// Normals at nodes on and beside edges and vertices of surfaces, wherever these are: rounding decides nothing.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <random>

#include "core/geometry/faceted_distance.hpp"
#include "geometry_checks.hpp"
#include "surfaces.hpp"

namespace signorini {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::Surface;

constexpr double length = 9;
const std::vector<std::array<double, 2>> polygon{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};  // convex but for one
const std::vector<std::array<int, 3>> halves{{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}};

/// Where a surface and the points that ask are: scaled, turned, moved.
struct Place {
  double scale = 1;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vector3d shift{0, 0, 0};

  Vector3d at(const Vector3d& p) const { return scale * (turn * p) + shift; }
  Surface moved(Surface s) const {
    for (auto& p : s.points) {
      const Vector3d q = at({p[0], p[1], p[2]});
      p = {q[0], q[1], q[2]};
    }
    return s;
  }
};

std::vector<Place> places() {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  return {{},
          {1, Eigen::Matrix3d::Identity(), {300, -2700, 0}},
          {1, turn, {0, 0, 0}},
          {1, turn, {300, -2700, 40}},
          {1e-3, turn, {0.3, -2.7, 0.04}},
          {1e4, turn, {3e6, 0, -2.7e7}}};
}

/// The surface at a place, asked in its own coordinates.
class Placed {
 public:
  Placed(const Surface& surface, const Place& place)
      : place_(place),
        distance_(geometry::engine<3>().surface(test::TemporaryFile("placed.off", place.moved(surface).off()).path())) {
  }

  double value(const Vector3d& p) const { return at(p).value / place_.scale; }
  Vector3d normal(const Vector3d& p) const { return place_.turn.transpose() * Vector3d(at(p).normal); }

 private:
  Distance at(const Vector3d& p) const {
    const Vector3d q = place_.at(p);
    Status status;
    const double none[3] = {};
    const Distance d = distance_->at(q.data(), none, status);
    EXPECT_TRUE(status.ok()) << status.message;
    return d;
  }

  const Place& place_;
  std::unique_ptr<DistanceFunction> distance_;
};

double distance_to_segment(const Vector2d& q, const Vector2d& a, const Vector2d& b, Vector2d& nearest) {
  nearest = a + std::clamp((q - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0) * (b - a);
  return (q - nearest).norm();
}

bool inside(const Vector2d& q) { return q[0] > 0 && q[1] > 0 && q[0] < 2 && q[1] < 2 && (q[0] < 1 || q[1] < 1); }

/// The mean of the gradients towards the points of the polygon that are nearest to one beside it, as a unit vector, and
/// the signed distance along it; on the polygon the mean of the sides' outer normals.
std::pair<double, Vector2d> expected(const Vector2d& q) {
  double least = infinity;
  const auto each_side = [&](auto use) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2d a(polygon[i].data()), b(polygon[(i + 1) % polygon.size()].data());
      Vector2d nearest;
      const double d = distance_to_segment(q, a, b, nearest);
      use(d, nearest, Vector2d((b - a)[1], -(b - a)[0]).normalized());
    }
  };
  each_side([&](double d, const Vector2d&, const Vector2d&) { least = std::min(least, d); });
  const double sign = inside(q) ? -1 : 1;
  Vector2d sum{0, 0};
  double count = 0;
  std::vector<Vector2d> seen;
  each_side([&](double d, const Vector2d& nearest, const Vector2d& outer) {
    if (d > least + 1e-12) return;
    const bool known = std::ranges::any_of(seen, [&](const Vector2d& s) { return (s - nearest).norm() < 1e-9; });
    if (least < 1e-12)
      sum += outer;
    else if (!known)
      sum += sign * (q - nearest) / d, ++count;
    seen.push_back(nearest);
  });
  return {count > 0 ? sign * least * count / sum.norm() : 0, sum.normalized()};
}

/// On the sides and corners of the polygon, beside them by very different lengths, and on the bisectors at corners.
std::vector<Vector2d> points_around() {
  std::vector<Vector2d> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d a(polygon[i].data()), b(polygon[(i + 1) % polygon.size()].data()),
        c(polygon[(i + 2) % polygon.size()].data());
    const Vector2d along = (b - a).normalized(), on = (c - b).normalized(), bisector = (on - along).normalized();
    points.push_back(b);
    for (const double step : {1e-6, 1e-4, 1e-2, 0.1, 0.3})
      for (const double sign : {-1.0, 1.0}) {
        points.push_back(b + sign * step * along);
        points.push_back(b + sign * step * on);
        if (step > 1e-5) points.push_back(b + sign * step * bisector);
      }
  }
  return points;
}

TEST(SurfaceNormals, OnAndBesideEdgesOfAConvexAndConcaveSolidAnywhere) {
  const Surface prism = test::prism(polygon, length, halves);
  for (const Place& place : places()) {
    const Placed surface(prism, place);
    // Lengths near 1e-2 along slanted directions carry a rounding of the place's coordinates.
    const double rounding = 1e-15 * (1 + place.shift.norm() / place.scale);
    for (const Vector2d& q : points_around()) {
      const auto [d, n] = expected(q);
      // z = length / 2 on the sides lies on their diagonals where a side ends.
      for (const double z : {3.1, length / 2, 5.7}) {
        EXPECT_NEAR(surface.value({q[0], q[1], z}), d, 8 * rounding);
        const double off = std::abs(d) > 1e-9 ? 16 * rounding / std::abs(d) : 0;
        EXPECT_LE((surface.normal({q[0], q[1], z}) - Vector3d(n[0], n[1], 0)).norm(), 1e-12 + off)
            << "at " << q.transpose() << ", distance " << d;
      }
    }
  }
}

TEST(SurfaceNormals, OfAFlatFaceOnAndAboveItsDiagonalsAreExact) {
  for (const Place& place : places()) {
    const Placed surface(test::cube(-1, 1), place);
    for (int i = -9; i <= 9; ++i)
      for (const double height : {0.0, 1e-7, 1e-3, 0.2})
        for (const double s : {0.1 * i, -0.1 * i})
          EXPECT_LE((surface.normal({0.1 * i, s, 1 + height}) - Vector3d::UnitZ()).norm(), 1e-12);
  }
}

/// A pyramid of `sides` faces that point at its tip; a pit when depth is negative. Open, faces oriented upwards.
Surface pyramid(int sides, double height) {
  Surface s;
  for (int i = 0; i < sides; ++i)
    s.points.push_back({std::cos(2 * std::numbers::pi * i / sides), std::sin(2 * std::numbers::pi * i / sides), 0});
  s.points.push_back({0, 0, height});
  for (int i = 0; i < sides; ++i) s.triangles.push_back({i, (i + 1) % sides, sides});
  return s;
}

TEST(SurfaceNormals, OnTipsAndInPitsAreAlongTheAxisAndOnTheirEdgesMeansOfTwoFaces) {
  for (const Place& place : places())
    for (const int sides : {3, 4, 7})
      for (const double height : {0.3, 2.0, -0.3, -2.0}) {
        const Placed surface(pyramid(sides, height), place);
        EXPECT_LE((surface.normal({0, 0, height}) - Vector3d::UnitZ()).norm(), 1e-12);
        for (int i = 0; i < sides; ++i) {
          const double angle = 2 * std::numbers::pi * i / sides;
          const Vector3d foot(std::cos(angle), std::sin(angle), 0), tip(0, 0, height);
          // Upwards, and perpendicular to the edge and to the horizontal direction across it.
          const Vector3d mean = foot.cross(Vector3d::UnitZ()).cross(tip - foot).normalized();
          for (double s = 0.05; s < 1; s += 0.05)
            EXPECT_LE((surface.normal(foot + s * (tip - foot)) - (mean[2] < 0 ? -mean : mean)).norm(), 1e-12)
                << sides << " sides, height " << height;
        }
      }
}

// A body may fall to the bottom of a valley, not only as far as its sides are away.
TEST(SurfaceNormals, AboveAPitSeenFromItsAxisAreAlongItAndItsBottomIsTheDistance) {
  for (const Place& place : places())
    for (const int sides : {3, 4, 7}) {
      const Placed surface(pyramid(sides, -1), place);
      for (const double z : {-0.9, -0.6, -0.3}) {
        EXPECT_NEAR(surface.value({0, 0, z}), z + 1, 2e-14 + 4e-15 * place.shift.norm() / place.scale);
        EXPECT_LE((surface.normal({0, 0, z}) - Vector3d::UnitZ()).norm(),
                  1e-12 + 1e-14 * place.shift.norm() / place.scale);
      }
    }
}

TEST(SurfaceNormals, FacetsOfACylinderAreOffItByTheirSagittaAndThoseOfACubeByNone) {
  const auto sagitta = [](const Surface& surface, const Vector3d& p) {
    const auto distance = geometry::engine<3>().surface(test::TemporaryFile("facets.off", surface.off()).path());
    return dynamic_cast<const geometry::FacetedDistance&>(*distance).sagitta_at(p.data());
  };
  for (const int sides : {16, 40}) {
    std::vector<std::array<double, 2>> circle;
    std::vector<std::array<int, 3>> fan;
    for (int i = 0; i < sides; ++i)
      circle.push_back({std::cos(2 * std::numbers::pi * i / sides), std::sin(2 * std::numbers::pi * i / sides)});
    for (int i = 1; i + 1 < sides; ++i) fan.push_back({0, i, i + 1});
    const double exact = 1 - std::cos(std::numbers::pi / sides);
    EXPECT_NEAR(sagitta(test::prism(circle, 3, fan), {1.2, 0.3, 1.7}), exact, 0.02 * exact);
  }
  EXPECT_EQ(sagitta(test::cube(-1, 1), {0.2, 0.3, 1.1}), 0);
}

}  // namespace
}  // namespace signorini
