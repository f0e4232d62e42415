// Smooth surfaces through the vertices of flat faces: how near they are to the surfaces that they stand for.
#include "core/geometry/smooth_boundary.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <random>

#include "core/base/dot.hpp"
#include "core/geometry/flat_parts.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

using std::numbers::pi;

template <int D>
struct Facets {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D>> faces;
};

/// An irregular closed polygon on x(angle).
Facets<2> polygon(int n, const std::function<Point<2>(double)>& x) {
  Facets<2> out;
  for (int i = 0; i < n; ++i) {
    out.points.push_back(x(2 * pi * (i + 0.3 * std::sin(5.0 * i)) / n));
    out.faces.push_back({i, (i + 1) % n});
  }
  return out;
}

/// Irregular triangles on x(u, v), closed in u where `closed`.
Facets<3> grid(int n, int m, bool closed, const std::function<Point<3>(double, double)>& x) {
  Facets<3> out;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  const int columns = closed ? n : n + 1;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < columns; ++i) {
      const bool inner = j > 0 && j < m && (closed || (i > 0 && i < n));
      const double a = inner ? noise(random) : 0, b = inner ? noise(random) : 0;
      out.points.push_back(x((i + a) / n, (j + b) / m));
    }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = j * columns + i, b = j * columns + (i + 1) % columns, c = a + columns, d = b + columns;
      out.faces.push_back({a, b, d});
      out.faces.push_back({a, d, c});
    }
  return out;
}

/// The largest |off(x)| over points of all patches.
template <int D>
double largest(const SmoothBoundary<D>& smooth, const std::function<double(const Point<D>&)>& off) {
  double most = 0;
  for (const CubicPatch<D>& patch : smooth.patches)
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4 && (D == 3 || j == 0); ++j) {
        std::array<double, D> x{};
        x[0] = i / 4.0;
        x[D - 1] = j / 4.0;
        x[1] = D == 2 ? 1 - x[0] : 1 - x[0] - x[D - 1];
        most = std::max(most, std::abs(off(patch.at(x))));
      }
  return most;
}

template <int D>
SmoothBoundary<D> smooth(const Facets<D>& f, double crease = default_crease) {
  return smooth_boundary<D>(f.points, f.faces, crease);
}

/// Between discretisations of which each is twice as fine as the one before.
void expect_order(const std::vector<double>& errors, double order) {
  for (std::size_t k = 0; k + 1 < errors.size(); ++k)
    EXPECT_GT(std::log2(errors[k] / errors[k + 1]), order) << errors[k];
}

TEST(SmoothBoundary, OfAnEllipseConvergesByTheFourthOrder) {
  std::vector<double> errors;
  for (const int n : {40, 80, 160})
    errors.push_back(largest<2>(smooth(polygon(n,
                                               [](double a) {
                                                 return Point<2>{2 * std::cos(a), std::sin(a)};
                                               })),
                                [](const Point<2>& p) { return p[0] * p[0] / 4 + p[1] * p[1] - 1; }));
  EXPECT_LT(errors[0], 1e-3);
  expect_order(errors, 3.5);
}

TEST(SmoothBoundary, OfACircleIsFarNearerThanItsFacets) {
  const Facets<2> circle = polygon(24, [](double a) { return Point<2>{std::cos(a), std::sin(a)}; });
  const double off = largest<2>(smooth(circle), [](const Point<2>& p) { return length<2>(p) - 1; });
  EXPECT_LT(off, 1e-4);  // facets: 1e-2
}

TEST(SmoothBoundary, OfATorusAndAnEllipsoidConverges) {
  std::vector<double> torus, ellipsoid;
  for (const int n : {24, 48, 96}) {
    torus.push_back(largest<3>(smooth(grid(n, n / 2, true,
                                           [](double u, double v) {
                                             const double a = 2 * pi * u, b = pi * v, r = 2 + std::cos(b);
                                             return Point<3>{r * std::cos(a), r * std::sin(a), std::sin(b)};
                                           })),
                               [](const Point<3>& p) { return std::hypot(std::hypot(p[0], p[1]) - 2, p[2]) - 1; }));
    ellipsoid.push_back(largest<3>(
        smooth(grid(n, n / 2, true,
                    [](double u, double v) {
                      const double a = 2 * pi * u, b = 0.8 * pi * (v - 0.5);
                      return Point<3>{std::cos(a) * std::cos(b), 1.3 * std::sin(a) * std::cos(b), 0.8 * std::sin(b)};
                    })),
        [](const Point<3>& p) { return p[0] * p[0] + p[1] * p[1] / 1.69 + p[2] * p[2] / 0.64 - 1; }));
  }
  EXPECT_LT(torus[0], 1e-2);
  EXPECT_LT(ellipsoid[0], 5e-3);
  expect_order(torus, 2.5);  // borders and creases have neighbours on one side only
  expect_order(ellipsoid, 2.5);
}

/// The unit cube, with each face cut into n x n x 2 triangles; vertices are not shared across its edges by number but
/// by place, as merged here.
Facets<3> cube(int n) {
  Facets<3> out;
  std::map<std::array<long, 3>, Index> number;
  const auto vertex = [&](const Point<3>& p) {
    const auto [entry, fresh] =
        number.try_emplace({std::lround(1e6 * p[0]), std::lround(1e6 * p[1]), std::lround(1e6 * p[2])},
                           static_cast<Index>(out.points.size()));
    if (fresh) out.points.push_back(p);
    return entry->second;
  };
  for (int k = 0; k < 3; ++k)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int a, int b) {
            Point<3> p{};
            p[k] = side;
            p[(k + 1) % 3] = a / double(n);
            p[(k + 2) % 3] = b / double(n);
            return vertex(p);
          };
          std::array<Index, 3> one{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
              two{at(i, j), at(i + 1, j + 1), at(i, j + 1)};
          if (side == 0) std::swap(one[1], one[2]), std::swap(two[1], two[2]);
          out.faces.push_back(one);
          out.faces.push_back(two);
        }
  return out;
}

TEST(SmoothBoundary, OfACubeKeepsItsEdgesAndIsFlat) {
  const auto found = smooth(cube(3));
  EXPECT_EQ(found.pieces, 6);
  for (const auto& patch : found.patches) EXPECT_LT(bulge<3>(patch), 1e-14);
}

// The sides of an octagonal prism meet at 45 degrees.
TEST(SmoothBoundary, WithALargerAngleRoundsTheEdgesOff) {
  Facets<3> facets;
  for (const double z : {0.0, 2.0})
    for (int i = 0; i < 8; ++i) facets.points.push_back({std::cos(i * pi / 4), std::sin(i * pi / 4), z});
  for (Index i = 0; i < 8; ++i) {
    const Index j = (i + 1) % 8;
    facets.faces.push_back({i, j, j + 8});
    facets.faces.push_back({i, j + 8, i + 8});
  }
  EXPECT_EQ(smooth(facets).pieces, 8);
  const auto found = smooth(facets, 50 * pi / 180);
  EXPECT_EQ(found.pieces, 1);
  EXPECT_LT(largest<3>(found, [](const Point<3>& p) { return std::hypot(p[0], p[1]) - 1; }), 0.01);  // facets: 0.08
}

TEST(SmoothBoundary, PlanesThatRunIntoFilletsStayFlat) {
  const double r = 0.3;  // of the fillet, between z = 0 for x < 0 and x = r for z < -r
  const auto off = [&](const Point<3>& p) {
    if (p[0] <= 0) return p[2];
    if (p[2] <= -r) return p[0] - r;
    return std::hypot(p[0], p[2] + r) - r;
  };
  const auto x = [&](double u, double v) {
    const double s = 3 * u;
    if (s <= 1) return Point<3>{s - 1, v, 0};
    if (s >= 2) return Point<3>{r, v, -r - (s - 2)};
    return Point<3>{r * std::sin(pi / 2 * (s - 1)), v, r * std::cos(pi / 2 * (s - 1)) - r};
  };
  Facets<3> facets;
  const int n = 24, m = 6;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) facets.points.push_back(x(i / double(n), j / double(m)));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = b + n + 1;
      facets.faces.push_back({a, b, d});
      facets.faces.push_back({a, d, c});
    }
  const auto found = smooth(facets);
  EXPECT_EQ(found.pieces, 1);
  for (std::size_t f = 0; f < facets.faces.size(); ++f) {
    const bool flat = std::ranges::all_of(facets.faces[f], [&](Index v) { return facets.points[v][0] <= 0; });
    if (flat) {
      EXPECT_LT(bulge<3>(found.patches[f]), 1e-14);
    }
  }
  EXPECT_LT(largest<3>(found, off), 1e-4);  // facets: 1.4e-3
}

/// A prism over a regular polygon, its ends fans of triangles without a vertex inside; turned about an axis of no
/// special direction.
Facets<3> turned_prism(int sides) {
  Facets<3> facets;
  for (const double z : {0.0, 1.0})
    for (int i = 0; i < sides; ++i)
      facets.points.push_back({2 * std::cos(2 * pi * i / sides), 2 * std::sin(2 * pi * i / sides), z});
  for (Index i = 0; i < sides; ++i) {
    const Index j = (i + 1) % sides;
    facets.faces.push_back({i, j, j + sides});
    facets.faces.push_back({i, j + sides, i + sides});
    if (i > 0 && j > 0) {
      facets.faces.push_back({0, j, i});
      facets.faces.push_back({Index(sides), i + sides, j + sides});
    }
  }
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (Point<3>& p : facets.points)
    Eigen::Map<Eigen::Vector3d>(p.data()) = turn * Eigen::Map<Eigen::Vector3d>(p.data());
  return facets;
}

// What surface files hold. Vertices on a circle leave a quadric one term that rounding alone would decide.
TEST(SmoothBoundary, FlatEndsStayFlatInSinglePrecision) {
  for (const int sides : {5, 8, 24, 48}) {
    Facets<3> facets = turned_prism(sides);
    for (Point<3>& p : facets.points)
      for (double& x : p) x = static_cast<float>(x);
    const auto found = smooth(facets);
    for (std::size_t f = 0; f < facets.faces.size(); ++f) {
      const auto& [a, b, c] = facets.faces[f];
      if ((a < sides) != (b < sides) || (b < sides) != (c < sides)) continue;
      const auto at = [&](Index v) { return Eigen::Vector3d(facets.points[v].data()); };
      const Eigen::Vector3d up = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
      for (const Point<3>& p : found.patches[f].control)  // along the rim they are bent within the plane
        EXPECT_LT(std::abs(up.dot(Eigen::Vector3d(p.data()) - at(a))), 5e-6) << sides;
    }
  }
}

TEST(RoundedAway, TellsTheDigitsOfAFile) {
  const Facets<3> exact = turned_prism(7);
  const auto rounded = [&](const std::function<double(double)>& round) {
    std::vector<Point<3>> points = exact.points;
    for (Point<3>& p : points)
      for (double& x : p) x = round(x);
    return rounded_away<3>(points);
  };
  EXPECT_LT(rounded([](double x) { return x; }), 1e-14);
  EXPECT_NEAR(rounded([](double x) { return double(float(x)); }), 1.2e-7, 0.3e-7);
  EXPECT_NEAR(rounded([](double x) { return std::stod(fmt::format("{:.7g}", x)); }), 1e-6, 0.3e-6);
  EXPECT_LT(rounded([](double x) { return std::stod(fmt::format("{:.12g}", x)); }), 1e-14);
}

/// How far the smooth surface of a fine cylinder is off it, whose axis goes through (x, 0).
double off_cylinder(double x) {
  Facets<3> facets;
  const int n = 400;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < n; ++i)
      facets.points.push_back({x + std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0.3 * j / 7.0});
  for (Index j = 0; j < 3; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * n + i, b = j * n + (i + 1) % n;
      facets.faces.push_back({a, b, b + n});
      facets.faces.push_back({a, b + n, a + n});
    }
  return largest<3>(smooth(facets), [x](const Point<3>& p) { return std::hypot(p[0] - x, p[1]) - 1; });
}

// Coordinates with all their digits lose none of the shape far from the origin.
TEST(SmoothBoundary, OfAFineCylinderFarAwayStaysRound) {
  EXPECT_LT(off_cylinder(0), 2e-8);
  EXPECT_NEAR(off_cylinder(1000), off_cylinder(0), 1e-10);
}

}  // namespace
}  // namespace signorini::geometry
