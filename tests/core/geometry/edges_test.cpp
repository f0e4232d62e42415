// Edges of bodies, told from joints between flat faces that stand for a round surface.
#include "core/geometry/edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/base/dot.hpp"
#include "core/geometry/smooth_boundary.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

using std::numbers::pi;

template <int D>
struct Facets {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D>> faces;
};

/// How many joints are edges, and how many are none.
struct Count {
  int sharp = 0, smooth = 0;
};

/// @param least angle in degrees from which on joints count
template <int D>
Count count(const Facets<D>& facets, double least = 1e-3) {
  const Joints<D> joints = find_joints<D>(static_cast<Index>(facets.points.size()), facets.faces);
  const Edges edges = find_edges<D>(facets.points, facets.faces, joints, default_crease);
  Count out;
  for (std::size_t i = 0; i < joints.beyond.size(); ++i)
    if (joints.beyond[i] > static_cast<Index>(i) && edges.angle[i] > least * pi / 180)
      ++(edges.sharp[joints.number[i]] != 0 ? out.sharp : out.smooth);
  return out;
}

/// A side of a polygon, and the angle in degrees at its end.
struct Leg {
  double length, turn;
};

std::vector<Point<2>> path(const std::vector<Leg>& legs) {
  std::vector<Point<2>> out{{0, 0}};
  double angle = 0;
  for (const Leg& leg : legs) {
    const Point<2> last = out.back();
    out.push_back({last[0] + leg.length * std::cos(angle), last[1] + leg.length * std::sin(angle)});
    angle -= leg.turn * pi / 180;
  }
  return out;
}

Facets<2> line(const std::vector<Leg>& legs) {
  Facets<2> out;
  out.points = path(legs);
  for (Index i = 0; i + 1 < static_cast<Index>(out.points.size()); ++i) out.faces.push_back({i + 1, i});
  return out;
}

/// The same with some depth, cut into so many rows.
Facets<3> strip(const std::vector<Leg>& legs, int rows) {
  Facets<3> out;
  const std::vector<Point<2>> section = path(legs);
  const auto n = static_cast<Index>(section.size());
  for (int j = 0; j <= rows; ++j)
    for (const Point<2>& p : section) out.points.push_back({p[0], 2.0 * j / rows, p[1]});
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = j * n + i, b = a + 1, c = a + n, d = b + n;
      out.faces.push_back({a, b, d});
      out.faces.push_back({a, d, c});
    }
  return out;
}

/// Turned, scaled and moved.
Facets<3> moved(Facets<3> facets) {
  for (Point<3>& p : facets.points) {
    const double c = std::cos(0.7), s = std::sin(0.7), x = c * p[0] - s * p[1], y = s * p[0] + c * p[1];
    p = {40 * x + 300, 40 * (c * y - s * p[2]) - 20, 40 * (s * y + c * p[2])};
  }
  return facets;
}

TEST(Edges, BetweenFlatFacesStaySharpAtAnyAngle) {
  for (const double angle : {2.0, 10.0, 20.0, 30.0}) {
    const std::vector<Leg> die{{1.2, angle}, {1, angle}, {1.2, 0}};
    const std::vector<Leg> chamfer{{0.5, 0}, {0.5, angle}, {0.4, 90 - angle}, {0.5, 0}, {0.5, 0}};
    const std::vector<Leg> divided{{0.5, 0}, {0.5, angle}, {0.2, 0}, {0.2, angle}, {0.4, 0}, {0.3, 0}};
    for (const auto& legs : {die, chamfer, divided}) {
      EXPECT_EQ(count(line(legs)).sharp, 2) << angle;
      EXPECT_EQ(count(line(legs)).smooth, 0) << angle;
      for (const int rows : {1, 4})
        for (const auto& facets : {strip(legs, rows), moved(strip(legs, rows))}) {
          EXPECT_EQ(count(facets).sharp, 2 * rows) << angle;
          EXPECT_EQ(count(facets).smooth, 0) << angle;
        }
    }
  }
}

// The eight corners of the frustum of a pyramid are on a sphere.
TEST(Edges, OfAFrustumStaySharp) {
  for (const double angle : {10.0, 20.0, 30.0}) {
    Facets<3> frustum;
    for (const double r : {0.5, 1.0})
      for (int i = 0; i < 4; ++i)
        frustum.points.push_back({i == 0 || i == 3 ? -r : r, i < 2 ? -r : r, -(r - 0.5) * std::tan(angle * pi / 180)});
    frustum.faces = {{0, 1, 2}, {0, 2, 3}};
    for (Index i = 0; i < 4; ++i) {
      const Index j = (i + 1) % 4;
      frustum.faces.push_back({j, i, j + 4});
      frustum.faces.push_back({i, i + 4, j + 4});
    }
    EXPECT_EQ(count(frustum).sharp, 8) << angle;
    EXPECT_EQ(count(frustum).smooth, 0) << angle;
  }
}

/// Of revolution about z, from points (r, z).
Facets<3> revolved(const std::vector<Point<2>>& section, Index around) {
  Facets<3> out;
  for (const Point<2>& p : section)
    for (Index i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around;
      out.points.push_back({p[0] * std::cos(a), p[0] * std::sin(a), p[1]});
    }
  for (Index j = 0; j + 1 < static_cast<Index>(section.size()); ++j)
    for (Index i = 0; i < around; ++i) {
      const Index a = j * around + i, b = j * around + (i + 1) % around, c = a + around, d = b + around;
      out.faces.push_back({a, b, c});
      out.faces.push_back({b, d, c});
    }
  return out;
}

TEST(Edges, BetweenCylinderAndConeStaySharp) {
  for (const double angle : {10.0, 20.0, 30.0})
    for (const int rows : {1, 4}) {
      std::vector<Point<2>> section;
      for (int j = -rows; j <= rows; ++j) {
        const double z = 0.8 * j / rows;
        section.push_back({0.5 - (z > 0 ? z * std::tan(angle * pi / 180) / 2 : 0), z / (z > 0 ? 2 : 1)});
      }
      const Count found = count(revolved(section, 24));
      EXPECT_EQ(found.sharp, 24) << angle;
      EXPECT_EQ(found.smooth, 2 * rows * 24) << angle;
    }
}

TEST(Edges, OfRoundSurfacesAreNone) {
  for (const Index around : {12, 16, 32}) {
    EXPECT_EQ(count(revolved({{1, 0}, {1, 5}}, around)).sharp, 0) << around;
    EXPECT_EQ(count(revolved({{0.4, 0}, {1, 2}}, around)).sharp, 0) << around;
  }
  for (const int pieces : {3, 4, 6}) {  // of a fillet between planes
    std::vector<Leg> legs{{1, 0}, {1, 45.0 / pieces}};
    for (int k = 0; k < pieces; ++k)
      legs.push_back({2 * std::sin(pi / 4 / pieces), (k + 1 < pieces ? 90.0 : 45.0) / pieces});
    legs.insert(legs.end(), {{1, 0}, {1, 0}});
    EXPECT_EQ(count(line(legs)).sharp, 0) << pieces;
    for (const int rows : {1, 3}) EXPECT_EQ(count(strip(legs, rows)).sharp, 0) << pieces;
  }
}

// Three cells of one length at one angle, as of a quarter of a ring, are those of an arc; of others nothing tells that.
TEST(Edges, BetweenThreeCellsOfAnArcAreNone) {
  for (const double angle : {5.0, 15.0, 30.0}) {
    const std::vector<Leg> arc{{1, angle}, {1, angle}, {1, 90}, {2, 0}},
        longer{{1, angle}, {1.01, angle}, {1, 90}, {2, 0}}, turned{{1, angle}, {1, 1.1 * angle}, {1, 90}, {2, 0}},
        waved{{1, angle}, {1, -angle}, {1, 90}, {2, 0}};
    EXPECT_EQ(count(line(arc)).smooth, 2) << angle;
    for (const int rows : {1, 3})
      for (const auto& facets : {strip(arc, rows), moved(strip(arc, rows))})
        EXPECT_EQ(count(facets).smooth, 2 * rows) << angle;
    for (const auto& legs : {longer, turned, waved}) {
      EXPECT_EQ(count(line(legs)).smooth, 0) << angle;
      EXPECT_EQ(count(strip(legs, 3)).smooth, 0) << angle;
    }
  }
}

Facets<3> pyramid(Index sides, double height) {
  Facets<3> out{{{0, 0, height}}, {}};
  for (Index i = 0; i < sides; ++i) {
    out.points.push_back({2 * std::cos(2 * pi * i / sides), 2 * std::sin(2 * pi * i / sides), 0});
    out.faces.push_back({0, 1 + i, 1 + (i + 1) % sides});
  }
  return out;
}

TEST(Edges, OfPyramidsAreNoneFromSevenSidesOnHoweverFlat) {
  for (const double height : {0.1, 0.3, 0.6, 1.0, 1.3}) {
    for (const Index sides : {7, 8, 9, 10, 11, 13}) EXPECT_EQ(count(pyramid(sides, height)).sharp, 0) << sides;
    for (const Index sides : {3, 4, 5, 6}) EXPECT_EQ(count(pyramid(sides, height)).smooth, 0) << sides;
  }
}

/// Irregular triangles on x(u, v), closed in u where `closed`.
template <class X>
Facets<3> grid(int n, int m, bool closed, const X& x) {
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

TEST(Edges, OfIrregularTrianglesOnSmoothSurfacesAreNone) {
  const auto torus = [](double u, double v) {
    const double a = 2 * pi * u, b = pi * v, r = 2 + std::cos(b);
    return Point<3>{r * std::cos(a), r * std::sin(a), std::sin(b)};
  };
  const auto ellipsoid = [](double u, double v) {
    const double a = 2 * pi * u, b = 0.8 * pi * (v - 0.5);
    return Point<3>{std::cos(a) * std::cos(b), 1.3 * std::sin(a) * std::cos(b), 0.8 * std::sin(b)};
  };
  const auto saddle = [](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1;
    return Point<3>{x, y, 0.4 * (x * x - y * y)};
  };
  const auto wave = [](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1;
    return Point<3>{x, y, 0.15 * std::sin(4 * x) * std::cos(3 * y)};
  };
  const auto cylinder = [](double u, double v) { return Point<3>{std::cos(2 * pi * u), std::sin(2 * pi * u), 2 * v}; };
  for (const int n : {24, 48}) {
    EXPECT_EQ(count(grid(n, n / 2, true, torus)).sharp, 0) << n;
    EXPECT_EQ(count(grid(n, n / 2, true, ellipsoid)).sharp, 0) << n;
    EXPECT_EQ(count(grid(n, n / 3, true, cylinder)).sharp, 0) << n;
    EXPECT_EQ(count(grid(n, n, false, saddle)).sharp, 0) << n;
    EXPECT_EQ(count(grid(n, n, false, wave)).sharp, 0) << n;
  }
}

}  // namespace
}  // namespace signorini::geometry
