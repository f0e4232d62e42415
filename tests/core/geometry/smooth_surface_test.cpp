// Distances to smooth surfaces through the vertices of triangles, against spheres and cylinders in closed form.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <numbers>
#include <random>

#include "core/geometry/smooth_boundary.hpp"
#include "geometry_checks.hpp"
#include "surfaces.hpp"

namespace signorini {
namespace {

using Eigen::Vector3d;
using test::Surface;

/// A unit sphere by so many divisions of an icosahedron.
Surface sphere(int divisions) {
  Surface s;
  const double g = (1 + std::sqrt(5)) / 2;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g})
      for (int k = 0; k < 3; ++k) {
        std::array<double, 3> p{};
        p[(k + 1) % 3] = a;
        p[(k + 2) % 3] = b;
        s.points.push_back(p);
      }
  const auto at = [&](int v) { return Vector3d(s.points[v].data()); };
  for (int a = 0; a < 12; ++a)
    for (int b = 0; b < 12; ++b)
      for (int c = 0; c < 12; ++c) {
        const auto near = [&](int v, int w) { return (at(v) - at(w)).norm() < 2.1; };
        if (a < b && a < c && b != c && near(a, b) && near(b, c) && near(c, a) &&
            (at(b) - at(a)).cross(at(c) - at(a)).dot(at(a)) > 0)
          s.triangles.push_back({a, b, c});
      }
  for (int k = 0; k < divisions; ++k) {
    std::map<std::pair<int, int>, int> middle;
    std::vector<std::array<int, 3>> finer;
    const auto between = [&](int a, int b) {
      const auto [entry, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<int>(s.points.size()));
      if (fresh) {
        const Vector3d m = (at(a) / at(a).norm() + at(b) / at(b).norm()).normalized();
        s.points.push_back({m[0], m[1], m[2]});
      }
      return entry->second;
    };
    for (const auto& [a, b, c] : s.triangles) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s.triangles = finer;
  }
  for (auto& p : s.points) {
    const double l = Vector3d(p.data()).norm();
    for (double& x : p) x /= l;
  }
  return s;
}

Distance at(const DistanceFunction& shape, const Vector3d& p) {
  Status status;
  const double none[3] = {};
  const Distance d = shape.at(p.data(), none, status);
  EXPECT_TRUE(status.ok()) << status.message;
  return d;
}

std::unique_ptr<DistanceFunction> smooth(const Surface& surface, double crease = geometry::default_crease) {
  return geometry::engine<3>().surface(test::TemporaryFile("smooth.off", surface.off()).path(), crease);
}

TEST(SmoothSurface, OfASphereIsTheSphere) {
  std::mt19937 random(5);
  std::normal_distribution<double> number;
  const auto shape = smooth(sphere(2));
  for (int i = 0; i < 200; ++i) {
    const Vector3d n = Vector3d(number(random), number(random), number(random)).normalized();
    for (const double r : {0.8, 0.99, 1.0, 1.01, 1.5}) {
      const Distance d = at(*shape, r * n);
      EXPECT_NEAR(d.value, r - 1, 1e-12);  // facets: 1.4e-2
      EXPECT_LT((Vector3d(d.normal) - n).norm(), r == 1 ? 1e-8 : 1e-10);
    }
  }
}

/// An ellipsoid, which is no shape that is recognised: points and normals of the surface itself, and off it.
TEST(SmoothSurface, OfAnEllipsoidConvergesInDistanceAndNormal) {
  const Vector3d axes(1, 1.2, 0.9);
  std::mt19937 random(5);
  std::normal_distribution<double> number;
  std::vector<Vector3d> directions;
  directions.reserve(200);
  for (int i = 0; i < 200; ++i)
    directions.push_back(Vector3d(number(random), number(random), number(random)).normalized());
  std::vector<double> distances, normals;
  for (const int divisions : {2, 3, 4}) {
    Surface surface = sphere(divisions);
    for (auto& p : surface.points)
      for (int k = 0; k < 3; ++k) p[k] *= axes[k];
    const auto shape = smooth(surface);
    double off = 0, turned = 0;
    for (const Vector3d& e : directions)
      for (const double by : {-0.2, -0.01, 0.0, 0.01, 0.5}) {
        const Vector3d n = e.cwiseQuotient(axes).normalized();
        const Distance d = at(*shape, e.cwiseProduct(axes) + by * n);
        off = std::max(off, std::abs(d.value - by));
        turned = std::max(turned, (Vector3d(d.normal) - n).norm());
      }
    distances.push_back(off);
    normals.push_back(turned);
  }
  EXPECT_LT(distances[0], 2e-3);
  EXPECT_LT(distances[2], 2e-5);
  EXPECT_LT(normals[2], 2e-3);
  EXPECT_GT(std::log2(distances[1] / distances[2]), 3);
  EXPECT_GT(std::log2(normals[1] / normals[2]), 2);
}

TEST(SmoothSurface, ACubeKeepsEdgesAndCornersAndItsDistanceIsThatOfTheTriangles) {
  const auto shape = smooth(test::cube(-1, 1)),
             facets = geometry::engine<3>().surface(test::TemporaryFile("cube.off", test::cube(-1, 1).off()).path());
  std::mt19937 random(9);
  std::uniform_real_distribution<double> number(-1.6, 1.6);
  for (int i = 0; i < 500; ++i) {
    const Vector3d p(number(random), number(random), number(random));
    const Distance a = at(*shape, p), b = at(*facets, p);
    EXPECT_NEAR(a.value, b.value, 1e-13);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a.normal[k], b.normal[k], 1e-10);
  }
}

/// A drum: the edges of its ends are circles and stay sharp.
TEST(SmoothSurface, ADrumIsRoundAndItsEdgesAreSharp) {
  constexpr int sides = 48;
  std::vector<std::array<double, 2>> circle;
  circle.reserve(sides);
  std::vector<std::array<int, 3>> fan;
  for (int i = 0; i < sides; ++i)
    circle.push_back({std::cos(2 * std::numbers::pi * i / sides), std::sin(2 * std::numbers::pi * i / sides)});
  for (int i = 1; i + 1 < sides; ++i) fan.push_back({0, i, i + 1});
  const auto shape = smooth(test::prism(circle, 1, fan));
  for (double angle = 0.01; angle < 6.28; angle += 0.037)
    for (const double z : {0.2, 0.5, 0.93}) {
      const Vector3d out(std::cos(angle), std::sin(angle), 0);
      EXPECT_NEAR(at(*shape, 1.1 * out + Vector3d(0, 0, z)).value, 0.1, 1e-12);  // facets: 2e-3
      EXPECT_NEAR(at(*shape, 0.95 * out + Vector3d(0, 0, z)).value, -std::min({0.05, z, 1 - z}), 1e-5);
      EXPECT_NEAR(at(*shape, 1.3 * out + Vector3d(0, 0, 1.4)).value, 0.5, 1e-5);  // from the edge
      EXPECT_NEAR(at(*shape, 0.7 * out + Vector3d(0, 0, 1.2)).normal[2], 1, 1e-12);
    }
}

/// A cone with its tip at the origin and its base, of radius 1, at z = -height; `rings` of triangles around the tip.
Surface cone(double height, int sides, int rings) {
  Surface s{{{0, 0, 0}, {0, 0, -height}}, {}};
  const auto at_ring = [&](int ring, int i) { return 2 + (ring - 1) * sides + i % sides; };
  for (int ring = 1; ring <= rings; ++ring)
    for (int i = 0; i < sides; ++i) {
      const double r = static_cast<double>(ring) / rings, angle = 2 * std::numbers::pi * i / sides;
      s.points.push_back({r * std::cos(angle), r * std::sin(angle), -r * height});
    }
  for (int i = 0; i < sides; ++i) {
    s.triangles.push_back({0, at_ring(1, i), at_ring(1, i + 1)});
    s.triangles.push_back({1, at_ring(rings, i + 1), at_ring(rings, i)});
    for (int ring = 1; ring < rings; ++ring) {
      s.triangles.push_back({at_ring(ring, i), at_ring(ring + 1, i), at_ring(ring + 1, i + 1)});
      s.triangles.push_back({at_ring(ring, i), at_ring(ring + 1, i + 1), at_ring(ring, i + 1)});
    }
  }
  return s;
}

struct Placed {
  double scale, about_x, about_z;
  Vector3d shift;

  Eigen::Matrix3d turn() const {
    return (Eigen::AngleAxisd(about_z, Vector3d::UnitZ()) * Eigen::AngleAxisd(about_x, Vector3d::UnitX()))
        .toRotationMatrix();
  }
  Vector3d operator()(const Vector3d& p) const { return scale * (turn() * p + shift); }
  Surface operator()(Surface s) const {
    for (auto& p : s.points) {
      const Vector3d q = (*this)(Vector3d(p.data()));
      p = {q[0], q[1], q[2]};
    }
    return s;
  }
};

const std::vector<Placed> places{{1, 0, 0, Vector3d::Zero()},
                                 {1, 0.7, -1.3, {0.3, -2, 1.1}},
                                 {1e-3, -0.4, 2.1, {1, 0.2, -0.6}},
                                 {1e3, 2.5, 0.3, {-0.1, 0.9, 0.4}}};

/// Against the closed form, everywhere up to the tip: in place, moved, turned and in other units; as a body and as a
/// cavity.
TEST(SmoothSurface, AConeIsExactUpToItsTip) {
  for (const auto& [height, sides, rings] : {std::tuple{0.5, 32, 6}, {2.0, 20, 1}, {1.0, 12, 2}})
    for (const Placed& place : places)
      for (const bool cavity : {false, true}) {
        Surface surface = place(cone(height, sides, rings));
        if (cavity) {  // without a base
          std::erase_if(surface.triangles, [](const auto& t) { return std::ranges::count(t, 1) > 0; });
          surface = surface.reversed();
        }
        const auto shape = smooth(surface);
        const double s = height / std::hypot(1, height), c = 1 / std::hypot(1, height), side = cavity ? -1 : 1;
        for (double angle = 0.01; angle < 6.28; angle += 0.83)
          for (const double r : {1e-4, 0.003, 0.02, 0.08, 0.13, 0.3, 0.55})
            for (const double off : {-0.1 * r, 0.0, 0.2 * r, r, 0.03}) {
              const Vector3d out(std::cos(angle), std::sin(angle), 0), up = s * out + c * Vector3d::UnitZ();
              const Vector3d p = r * out - Vector3d(0, 0, r * height) + off * up;
              const Distance d = at(*shape, place(p));
              EXPECT_NEAR(d.value / place.scale, side * off, 1e-10)
                  << height << " " << place.scale << " " << cavity << " " << angle << " " << r << " " << off;
              if (off == 0) continue;
              EXPECT_LT((Vector3d(d.normal) - side * place.turn() * up).norm(), 1e-6) << r << " " << off;
            }
        for (const double z : {1e-3, 0.1}) {
          const Distance d = at(*shape, place({0.05 * z, -0.08 * z, z}));
          EXPECT_NEAR(d.value / place.scale, side * z * std::hypot(1, 0.05, 0.08), 1e-10);
        }
      }
}

}  // namespace
}  // namespace signorini
