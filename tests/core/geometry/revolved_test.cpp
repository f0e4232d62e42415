// Parts turned about an axis, exported with a few long facets: cones, cylinders and what they meet, against their
// profiles. The surface of the patches is compared with the profile that the vertices were taken from.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/base/dot.hpp"
#include "core/geometry/body_geometry.hpp"
#include "core/geometry/recognise.hpp"
#include "core/geometry/smooth_boundary.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

using Profile = std::vector<Point<2>>;  // radius and height

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Straight lines between corners, each divided into so many.
Profile divided(const Profile& corners, const std::vector<int>& rows) {
  Profile out{corners[0]};
  for (std::size_t k = 0; k + 1 < corners.size(); ++k)
    for (int i = 1; i <= rows[k]; ++i) {
      const double t = static_cast<double>(i) / rows[k];
      out.push_back({corners[k][0] + t * (corners[k + 1][0] - corners[k][0]),
                     corners[k][1] + t * (corners[k + 1][1] - corners[k][1])});
    }
  return out;
}

struct Turned {
  std::vector<Point<3>> points;
  std::vector<std::array<Index, 3>> faces;
};

/// About the z axis, from the bottom up, by quadrangles cut in two.
Turned turned(const Profile& profile, int sides) {
  Turned out;
  std::vector<std::vector<Index>> ring;
  for (const auto& [r, z] : profile) {
    auto& at = ring.emplace_back(static_cast<std::size_t>(sides), static_cast<Index>(out.points.size()));
    for (int i = 0; i < (r > 0 ? sides : 1); ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      at[i] = static_cast<Index>(out.points.size());
      out.points.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  }
  for (std::size_t k = 0; k + 1 < profile.size(); ++k)
    for (int i = 0; i < sides; ++i) {
      const int j = (i + 1) % sides;
      const Index a = ring[k][i], b = ring[k][j], c = ring[k + 1][j], d = ring[k + 1][i];
      if (profile[k][0] > 0) out.faces.push_back({a, b, profile[k + 1][0] > 0 ? c : d});
      if (profile[k + 1][0] > 0) out.faces.push_back({a, c, d});
    }
  return out;
}

/// Another position, unit and number of digits.
struct Place {
  bool askew = false;
  double unit = 1;
  int digits = 17;

  Point<3> to(const Point<3>& p) const {
    const Point<3> q = askew ? rotated(p, 0.7, 0.4) : p;
    Point<3> out;
    for (int k = 0; k < 3; ++k) {
      char text[40];
      std::snprintf(text, sizeof text, "%.*g", digits, q[k] * unit);
      out[k] = std::strtod(text, nullptr);
    }
    return out;
  }
  Point<3> back(Point<3> p) const {
    for (double& x : p) x /= unit;
    if (!askew) return p;
    const Point<3> q{p[0], std::cos(0.4) * p[1] + std::sin(0.4) * p[2], -std::sin(0.4) * p[1] + std::cos(0.4) * p[2]};
    return {std::cos(0.7) * q[0] + std::sin(0.7) * q[1], -std::sin(0.7) * q[0] + std::cos(0.7) * q[1], q[2]};
  }
  static Point<3> rotated(const Point<3>& p, double about_z, double about_x) {
    const Point<3> q{std::cos(about_z) * p[0] - std::sin(about_z) * p[1],
                     std::sin(about_z) * p[0] + std::cos(about_z) * p[1], p[2]};
    return {q[0], std::cos(about_x) * q[1] - std::sin(about_x) * q[2],
            std::sin(about_x) * q[1] + std::cos(about_x) * q[2]};
  }
};

double distance(const Profile& profile, const Point<3>& p) {
  const Point<2> at{std::hypot(p[0], p[1]), p[2]};
  double least = infinity;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const Point<2> along = difference<2>(profile[k + 1], profile[k]), to = difference<2>(at, profile[k]);
    const double t = std::clamp(dot(to, along) / dot(along, along), 0.0, 1.0);
    least = std::min(least, std::hypot(to[0] - t * along[0], to[1] - t * along[1]));
  }
  return least;
}

struct Off {
  double smooth = 0, facets = 0;  // the largest distances from the profile, turned
};

Off off(const Profile& profile, int sides, const Place& place, const Profile& truth) {
  Turned part = turned(profile, sides);
  for (Point<3>& p : part.points) p = place.to(p);
  const auto smooth = geometry::smooth_boundary<3>(part.points, part.faces, geometry::default_crease);
  Off out;
  constexpr int n = 6;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    std::array<Point<3>, 3> corner;
    for (int i = 0; i < 3; ++i) corner[i] = part.points[part.faces[f][i]];
    const CubicPatch<3> flat = flat_patch<3>(corner);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const std::array<double, 3> at{1 - (i + j) / double(n), i / double(n), j / double(n)};
        out.smooth = std::max(out.smooth, distance(truth, place.back(smooth.patches[f].at(at))));
        out.facets = std::max(out.facets, distance(truth, place.back(flat.at(at))));
      }
  }
  return out;
}

void expect_round(const std::string& name, const Profile& profile, int sides, const Profile& truth = {},
                  double share = 0.3) {
  for (const Place& place : {Place{}, Place{true, 1000}, Place{true, 1, 6}}) {
    const Off found = off(profile, sides, place, truth.empty() ? profile : truth);
    EXPECT_LT(found.smooth, share * found.facets + 1e-5)
        << name << ", " << sides << " facets around, unit " << place.unit << ", " << place.digits << " digits";
  }
}

TEST(Revolved, ConesOnAFlatTip) {
  for (const double slope : {5.0, 12.0, 20.0, 34.0})
    for (const int sides : {12, 24, 48})
      for (const int rows : {1, 2, 4}) {
        const double rise = 0.35 * std::tan(radians(slope));
        expect_round("slope " + std::to_string(slope),
                     divided({{0, 0}, {0.05, 0}, {0.4, rise}, {0.4, 0.4}, {0, 0.4}}, {1, rows, 1, 1}), sides);
      }
}

TEST(Revolved, FullConesHoweverFlat) {
  for (const double half : {20.0, 45.0, 60.0, 70.0, 75.0, 80.0, 85.0})
    for (const int sides : {12, 14, 16, 24})
      for (const int rows : {1, 2, 3}) {
        const double height = 0.3;
        expect_round("half angle " + std::to_string(half) + ", rows " + std::to_string(rows),
                     divided({{0, 0}, {height * std::tan(radians(half)), height}, {0, height}}, {rows, 1}), sides);
      }
}

TEST(Revolved, CylindersThatRunIntoConesKeepTheEdge) {
  for (const double angle : {5.0, 12.0, 30.0})
    for (const int sides : {12, 16, 24})
      for (const std::array<int, 3> rows : {std::array{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {2, 4, 2}, {4, 2, 4}}) {
        const double t = std::tan(radians(angle)), end = 0.5 - 0.4 * t;
        expect_round(
            "edges of " + std::to_string(angle),
            divided({{0, 0}, {0.5, 0}, {0.5, 0.6}, {end, 1}, {end, 1.5}, {0, 1.5}}, {1, rows[0], rows[1], rows[2], 1}),
            sides);
      }
}

TEST(Revolved, PencilsBarrelsAndDoubleCones) {
  for (const double angle : {5.0, 20.0})
    for (const int sides : {12, 24})
      for (const int rows : {1, 2, 3}) {
        const double t = std::tan(radians(angle)), u = std::tan(radians(2 * angle));
        const std::string name = std::to_string(angle) + " degrees, rows " + std::to_string(rows);
        expect_round("pencil, " + name, divided({{0, 0}, {0.3 * t, 0.3}, {0.3 * t, 1.5}, {0, 1.5}}, {rows, rows, 1}),
                     sides);
        expect_round("barrel, " + name,
                     divided({{0, 0}, {0.3, 0}, {0.3 + 0.4 * t, 0.4}, {0.3, 0.8}, {0, 0.8}}, {1, rows, rows, 1}),
                     sides);
        expect_round(
            "two slopes, " + name,
            divided({{0, 0}, {0.06, 0.06 * t}, {0.12, 0.06 * (t + u)}, {0.12, 0.3}, {0, 0.3}}, {rows, rows, 1, 1}),
            sides);
      }
}

/// A ball that runs into a cone smoothly, and a sphere by circles of latitude.
TEST(Revolved, BallNosesAndSpheres) {
  const auto nose = [](double half, int rings, int rows) {
    const double h = radians(half);
    Profile out;
    for (int i = 0; i <= rings; ++i) {
      const double a = (std::numbers::pi / 2 - h) * i / rings;
      out.push_back({0.1 * std::sin(a), 0.1 - 0.1 * std::cos(a)});
    }
    const auto [r, z] = out.back();
    const Profile rest =
        divided({{r, z}, {r + 0.3 * std::sin(h), z + 0.3 * std::cos(h)}, {0, z + 0.3 * std::cos(h)}}, {rows, 1});
    out.insert(out.end(), rest.begin() + 1, rest.end());
    return out;
  };
  for (const double half : {20.0, 60.0, 75.0})
    for (const int sides : {16, 24, 32})
      for (const int rows : {1, 3})
        expect_round("nose of " + std::to_string(half), nose(half, 4, rows), sides, nose(half, 200, 1), 0.7);
  const auto sphere = [](int rings) {
    Profile out;
    for (int i = 0; i <= rings; ++i) {
      const double a = std::numbers::pi * i / rings;
      out.push_back({i == rings ? 0 : std::sin(a), -std::cos(a)});
    }
    return out;
  };
  expect_round("sphere", sphere(8), 24, sphere(400));
}

/// One point more or less on the rim does not turn a flat cone into something else; its tip is the point there.
TEST(Revolved, AFlatConeIsRecognisedByAFanOfTriangles) {
  for (const double half : {70.0, 75.0, 80.0, 85.0})
    for (const int sides : {12, 14, 16, 24}) {
      const double r = std::tan(radians(half)), c = std::cos(radians(half)), s = std::sin(radians(half));
      std::vector<Point<3>> points{{0, 0, 0}}, normals{{0, 0, -1}};
      for (int i = 0; i < sides; ++i) {
        const double a = 2 * std::numbers::pi * i / sides;
        points.push_back({r * std::cos(a), r * std::sin(a), 1});
        normals.push_back({c * std::cos(a), c * std::sin(a), -s});
      }
      const auto found = geometry::recognise<3>(points, normals, 1e-6, 1e-6);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->curve.kind, CurveKind::cone);
      EXPECT_NEAR(found->curve.second, radians(half), 1e-12);
      EXPECT_LT(length<3>(found->curve.center), 1e-12);
    }
}

}  // namespace
}  // namespace signorini
