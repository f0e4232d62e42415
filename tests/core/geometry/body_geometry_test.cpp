// What the boundaries of meshes from files are taken for: shapes that the program has meshed itself are found again.
#include "core/geometry/body_geometry.hpp"

#include "core/mesh/build.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/refine.hpp"
#include "core/mesh/separate.hpp"
#include "core/mesh/structured.hpp"
#include "geometry_checks.hpp"

namespace signorini {
namespace {

using geometry::give_geometry;
using geometry::Surfaces;

template <int D, class Shape>
Mesh<D> meshed(const Shape& shape, double size) {
  Mesh<D> mesh = geometry::engine<D>().mesh(shape, test::constant<D>(size));
  separate_curved_faces(mesh);
  return mesh;
}

/// As a file has it.
template <int D>
Mesh<D> without_geometry(Mesh<D> mesh) {
  mesh.curves.clear();
  for (Face<D>& face : mesh.boundary) face.curve = -1;
  return mesh;
}

template <int D>
std::multiset<std::string> kinds(const Mesh<D>& mesh) {
  std::multiset<std::string> out;
  for (const SurfacePiece& piece : mesh.pieces) out.insert(piece.kind);
  return out;
}

template <int D>
void expect_found_again(const Mesh<D>& known, const std::multiset<std::string>& expected) {
  Mesh<D> mesh = without_geometry(known);
  give_geometry(mesh, Surfaces::automatic);
  EXPECT_EQ(kinds(mesh), expected);
  const Mesh<D> a = hierarchy(known, 2).finest(), b = hierarchy(mesh, 2).finest();
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t v = 0; v < a.points.size(); ++v)
    EXPECT_LT(length<D>(difference<D>(a.points[v], b.points[v])), 1e-9) << "vertex " << v;
}

TEST(BodyGeometry, FindsTheShapesAgainThatTheProgramMeshes) {
  using Kinds = std::multiset<std::string>;
  expect_found_again(meshed<2>(geometry::Shape2(geometry::Disk{{1, -2}, 0.7}), 0.2), Kinds{"circle"});
  expect_found_again(meshed<2>(geometry::Shape2(geometry::Disk{{1, -2}, 0.7, true}), 0.2), Kinds{"circle", "line"});
  expect_found_again(meshed<3>(geometry::Shape3(geometry::Ball{{1, -2, 3}, 0.7}), 0.25), Kinds{"sphere"});
  expect_found_again(meshed<3>(geometry::Shape3(geometry::Ball{{1, -2, 3}, 0.7, true}), 0.25),
                     Kinds{"sphere", "plane"});
  expect_found_again(meshed<3>(geometry::Shape3(geometry::Cylinder{{1, -2, 3}, 0.7, 1.5}), 0.3),
                     Kinds{"cylinder", "plane", "plane"});
}

TEST(BodyGeometry, FacetsStayFacets) {
  const Mesh<3> ball = meshed<3>(geometry::Shape3(geometry::Ball{{0, 0, 0}, 1}), 0.3);
  Mesh<3> mesh = without_geometry(ball);
  give_geometry(mesh, Surfaces::facets);
  EXPECT_EQ(kinds(mesh), std::multiset<std::string>{"facets"});
  EXPECT_TRUE(mesh.curves.empty());
  EXPECT_GT(mesh.pieces[0].deviation, 1e-3);
}

/// The largest distance of the boundary's vertices from the unit sphere or circle after refinement.
template <int D>
double off_unit_sphere(const Mesh<D>& mesh) {
  const Mesh<D> fine = hierarchy(mesh, 2).finest();
  double most = 0;
  for (const Face<D>& face : fine.boundary)
    for (const Index v : face.vertices) most = std::max(most, std::abs(length<D>(fine.points[v]) - 1));
  return most;
}

TEST(BodyGeometry, SmoothSurfacesAreFarNearerThanFacets) {
  Mesh<3> mesh = without_geometry(meshed<3>(geometry::Shape3(geometry::Ball{{0, 0, 0}, 1}), 0.3));
  const double facets = off_unit_sphere(mesh);
  give_geometry(mesh, Surfaces::smooth);
  EXPECT_EQ(kinds(mesh), std::multiset<std::string>{"smooth"});
  EXPECT_LT(off_unit_sphere(mesh), facets / 20);
  test::expect_consistent(hierarchy(mesh, 2).finest());
}

/// What no shape fits: an ellipse or ellipsoid of a round body.
template <int D>
Mesh<D> stretched(Mesh<D> mesh) {
  mesh = without_geometry(std::move(mesh));
  for (Point<D>& x : mesh.points) {
    x[0] *= 1.5;
    x[1] *= 1.2;
  }
  return mesh;
}

template <int D>
Mesh<D> with_image(const Mesh<D>& mesh, const Mirror& mirror) {
  RawMesh<D> raw{.points = mesh.points, .elements = {mesh.elements.begin(), mesh.elements.end()}};
  std::vector<Index> image;
  for (const Point<D>& x : mesh.points) {
    image.push_back(static_cast<Index>(lies_on<D>(mirror, x) ? image.size() : raw.points.size()));
    if (!lies_on<D>(mirror, x)) raw.points.push_back(reflected<D>(mirror, x));
  }
  for (const auto& element : mesh.elements) {
    auto& there = raw.elements.emplace_back(element);
    for (Index& v : there) v = image[v];
  }
  return build_mesh<D>(std::move(raw), "test");
}

/// The part with the larger coordinates becomes what it is of the whole.
template <int D>
void expect_part_of_the_whole(Mesh<D> part, const std::vector<int>& axes) {
  part = stretched(std::move(part));
  Mesh<D> whole = part;
  for (const int axis : axes) whole = with_image(whole, {.axis = axis, .at = 0});
  give_geometry(whole, Surfaces::automatic);
  EXPECT_EQ(kinds(whole), std::multiset<std::string>{"smooth"});

  for (const int axis : axes) add_mirror(part, {.axis = axis, .at = 0}, "test");
  remove_faces_on_mirrors(part);
  give_geometry(part, Surfaces::automatic, geometry::default_crease, part.mirrors);
  EXPECT_EQ(kinds(part), kinds(whole));
  const Mesh<D> fine_part = hierarchy(part, 2).finest(), fine_whole = hierarchy(whole, 2).finest();
  for (const Face<D>& face : fine_part.boundary)
    for (const Index v : face.vertices) {
      double nearest = infinity;
      for (const Point<D>& x : fine_whole.points)
        nearest = std::min(nearest, length<D>(difference<D>(x, fine_part.points[v])));
      EXPECT_LT(nearest, 1e-12);
    }
}

TEST(BodyGeometry, SmoothSurfacesGoOnBeyondPlanesOfSymmetry) {
  const geometry::Shape2 quarter =
      geometry::Disk{.center = {0, 0}, .radius = 1, .right_half = true, .upper_half = true};
  expect_part_of_the_whole<2>(meshed<2>(quarter, 0.25), {0, 1});
  for (const int planes : {1, 2, 3}) {
    geometry::Halved halved{};
    std::vector<int> axes;
    for (int axis = 0; axis < planes; ++axis) {
      halved[axis] = true;
      axes.push_back(axis);
    }
    const geometry::Shape3 part = geometry::Ball{.center = {0, 0, 0}, .radius = 1, .halved = halved};
    expect_part_of_the_whole<3>(meshed<3>(part, 0.35), axes);
  }
}

/// A roof whose ridge, of 20 degrees, lies on the plane.
TEST(BodyGeometry, SmoothSurfacesAreBentOverPlanesOfSymmetry) {
  Mesh<2> half = rectangle({0, 0}, {1, 1}, {6, 3});
  for (Point<2>& x : half.points)
    if (x[1] > 0) x[1] *= 1 - std::tan(std::numbers::pi / 18) * x[0];
  Mesh<2> whole = with_image(half, {.axis = 0, .at = 0});
  give_geometry(whole, Surfaces::smooth);
  add_mirror(half, {.axis = 0, .at = 0}, "test");
  remove_faces_on_mirrors(half);
  give_geometry(half, Surfaces::smooth, geometry::default_crease, half.mirrors);
  double ridge = 0, ridge_of_half = 0;  // the highest vertex next to it
  for (const auto& [mesh, highest] : {std::pair{&whole, &ridge}, std::pair{&half, &ridge_of_half}}) {
    const Mesh<2> fine = hierarchy(*mesh, 2).finest();
    for (const Point<2>& x : fine.points)
      if (x[0] > 0 && x[0] < 0.05) *highest = std::max(*highest, x[1]);
  }
  EXPECT_NEAR(ridge_of_half, ridge, 1e-12);
}

TEST(BodyGeometry, RoundedDigitsAreFittedAutomaticallyRoughOnesOnRequest) {
  const Mesh<3> ball = without_geometry(meshed<3>(geometry::Shape3(geometry::Ball{{0, 0, 0}, 1}), 0.3));
  const auto rough = [&](double by) {
    Mesh<3> mesh = ball;
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      for (double& x : mesh.points[v]) x *= 1 + by * std::sin(7.0 * static_cast<double>(v));
    return mesh;
  };
  Mesh<3> rounded = rough(1e-7), off = rough(5e-4), fitted = rough(5e-4);
  give_geometry(rounded, Surfaces::automatic);
  EXPECT_EQ(kinds(rounded), std::multiset<std::string>{"sphere"});
  EXPECT_LT(off_unit_sphere(rounded), 1e-7);
  give_geometry(off, Surfaces::automatic);
  EXPECT_EQ(kinds(off), std::multiset<std::string>{"smooth"});
  give_geometry(fitted, Surfaces::fit);
  EXPECT_EQ(kinds(fitted), std::multiset<std::string>{"sphere"});
  EXPECT_NEAR(fitted.pieces[0].deviation, 5e-4, 1e-4);
  EXPECT_NEAR(fitted.pieces[0].radius, 1, 1e-4);
  const Mesh<3> fine = hierarchy(fitted, 1).finest();  // coarsest vertices have been moved onto it as well
  for (const Face<3>& face : fine.boundary)
    for (const Index v : face.vertices) EXPECT_NEAR(height<3>(fine.curves[0], fine.points[v])->distance, 0, 1e-12);
}

// The intersections with planes that are not perpendicular to the axis are ellipses.
TEST(BodyGeometry, MidpointsWhereShapesMeetAreOnBoth) {
  Mesh<3> mesh = without_geometry(meshed<3>(geometry::Shape3(geometry::Cylinder{{0, 0, 0}, 1, 2}), 0.4));
  for (Point<3>& p : mesh.points) p[2] += 0.4 * p[0];
  give_geometry(mesh, Surfaces::automatic);
  EXPECT_EQ(kinds(mesh), (std::multiset<std::string>{"cylinder", "plane", "plane"}));
  const Mesh<3> fine = hierarchy(mesh, 2).finest();
  int met = 0;
  for (const char* part : {"top", "side"})
    for (const Index f : faces_of(fine, part, "test"))
      for (const Index v : fine.boundary[f].vertices) {
        const Point<3>& p = fine.points[v];
        if (std::string(part) == "side") {
          EXPECT_NEAR(std::hypot(p[0], p[1]), 1, 1e-12);
          met += std::abs(p[2] - 0.4 * p[0] - 1) < 1e-12;
        } else {
          EXPECT_NEAR(p[2] - 0.4 * p[0], 1, 1e-12);
        }
      }
  EXPECT_GT(met, 50);
}

/// Between two concentric circles, polar cells cut into triangles.
Mesh<2> ring(int around, int across, double inner, double outer) {
  RawMesh<2> raw;
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around, r = inner + (outer - inner) * j / across;
      raw.points.push_back({r * std::cos(a), r * std::sin(a)});
    }
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < around; ++i) {
      const Index a = j * around + i, b = j * around + (i + 1) % around;
      raw.elements.push_back({a, a + around, b + around});
      raw.elements.push_back({a, b + around, b});
    }
  return build_mesh<2>(std::move(raw), "test");
}

TEST(BodyGeometry, CornersByTheirAngle) {
  Mesh<2> sixteen = ring(16, 2, 1, 2), eight = ring(8, 2, 1, 2), rounded = ring(8, 2, 1, 2);
  give_geometry(sixteen, Surfaces::automatic);
  EXPECT_EQ(kinds(sixteen), (std::multiset<std::string>{"circle", "circle"}));
  give_geometry(eight, Surfaces::automatic);  // 45 degrees
  EXPECT_EQ(kinds(eight).count("line"), 16u);
  give_geometry(rounded, Surfaces::automatic, 50 * std::numbers::pi / 180);
  EXPECT_EQ(kinds(rounded), (std::multiset<std::string>{"circle", "circle"}));
}

// A quarter of an octagon has but three vertices, its circle eight.
TEST(BodyGeometry, ShapesAreFoundWithTheirImages) {
  const double c = std::sqrt(0.5);
  RawMesh<2> raw;
  raw.points = {{0, 0}, {1, 0}, {c, c}, {0, 1}};
  raw.elements = {{0, 1, 2}, {0, 2, 3}};
  Mesh<2> quarter = build_mesh<2>(std::move(raw), "test");
  for (const int axis : {0, 1}) add_mirror(quarter, {.axis = axis, .at = 0}, "test");
  remove_faces_on_mirrors(quarter);
  give_geometry(quarter, Surfaces::automatic, 50 * std::numbers::pi / 180, quarter.mirrors);
  EXPECT_EQ(kinds(quarter), std::multiset<std::string>{"circle"});
  EXPECT_LT(off_unit_sphere(quarter), 1e-12);
}

// A straight and a round side that run into each other smoothly are one smooth piece, but two groups.
TEST(BodyGeometry, GroupsThatAreShapesAreFittedOneByOne) {
  RawMesh<2> raw;
  const int n = 8;
  std::vector<Point<2>> outline{{-1, 1}};
  for (int i = 0; i <= n; ++i) {
    const double a = std::numbers::pi / 2 * (1 - 2.0 * i / n);
    outline.push_back({std::cos(a), std::sin(a)});
  }
  outline.push_back({-1, -1});
  raw.points = outline;
  raw.points.push_back({-0.2, 0});
  const auto last = static_cast<Index>(outline.size());
  FaceGroup<2> bow{"bow", {}}, sides{"sides", {}};
  for (Index i = 0; i < last; ++i) {
    const Index next = (i + 1) % last;
    raw.elements.push_back({last, next, i});
    if (next != 0) (i == 0 || next == last - 1 ? sides : bow).faces.push_back({i, next});
  }
  raw.groups = {bow, sides};
  Mesh<2> mesh = build_mesh<2>(raw, "test"), alone = mesh;
  give_geometry(mesh, Surfaces::automatic);
  EXPECT_EQ(kinds(mesh), (std::multiset<std::string>{"circle", "line", "line", "line"}));
  for (const SurfacePiece& piece : mesh.pieces)
    if (piece.kind == "circle") {
      EXPECT_NEAR(piece.radius, 1, 1e-12);
    }
  alone.parts.clear();
  give_geometry(alone, Surfaces::automatic);  // a single edge may be part of anything
  EXPECT_EQ(kinds(alone), (std::multiset<std::string>{"circle", "smooth", "line"}));
}

// Lines and bows of a stadium run into each other smoothly; lines of several edges tell them apart.
TEST(BodyGeometry, LinesThatRunIntoBowsAreFound) {
  RawMesh<2> raw;
  std::vector<Point<2>>& p = raw.points;
  const int n = 10;
  for (const double side : {1.0, -1.0}) {
    for (int i = 0; i < n; ++i) {
      const double a = std::numbers::pi * (i / double(n) - 0.5);
      p.push_back({side * (2 + std::cos(a)), side * std::sin(a)});
    }
    for (int i = 0; i < 4; ++i) p.push_back({side * (2 - i), side});
  }
  const auto last = static_cast<Index>(p.size());
  p.push_back({0, 0});
  for (Index i = 0; i < last; ++i) raw.elements.push_back({last, i, (i + 1) % last});
  Mesh<2> mesh = build_mesh<2>(raw, "test");
  give_geometry(mesh, Surfaces::automatic);
  EXPECT_EQ(kinds(mesh), (std::multiset<std::string>{"circle", "circle", "line", "line"}));
  const Mesh<2> fine = hierarchy(mesh, 2).finest();
  for (const Face<2>& face : fine.boundary)
    for (const Index v : face.vertices) {
      const Point<2>& x = fine.points[v];
      const double off = std::abs(x[0]) <= 2 ? std::abs(x[1]) : std::hypot(std::abs(x[0]) - 2, x[1]);
      EXPECT_NEAR(off, 1, 1e-14);
    }
}

TEST(BodyGeometry, SecondOrderElementsAreTheGeometryUnlessToldOtherwise) {
  RawMesh<2> raw{.points = {{0, 0}, {1, 0}, {0, 1}, {std::sqrt(0.5), std::sqrt(0.5)}},
                 .elements = {{0, 1, 2}},
                 .middle = {{-1, -1, 3}},
                 .label = {},
                 .groups = {}};
  Mesh<2> mesh = build_mesh<2>(raw, "test"), facets = mesh;
  give_geometry(mesh, Surfaces::automatic);
  EXPECT_EQ(kinds(mesh), (std::multiset<std::string>{"second order", "line", "line"}));  // three points are no circle
  EXPECT_EQ(std::ranges::count(hierarchy(mesh, 1).finest().points, raw.points[3]), 1);
  give_geometry(facets, Surfaces::facets);
  EXPECT_EQ(std::ranges::count(hierarchy(facets, 1).finest().points, raw.points[3]), 0);
}

enum class Middles { none, straight, on_circle };

/// A fan of n triangles around the middle of a unit circle.
/// @param middles where outer edges have a node between their ends
Mesh<2> fan(Index n, Middles middles) {
  RawMesh<2> raw;
  const auto on_circle = [n](double i) {
    const double angle = 2 * std::numbers::pi * i / n;
    return Point<2>{std::cos(angle), std::sin(angle)};
  };
  for (Index i = 0; i < n; ++i) raw.points.push_back(on_circle(i));
  raw.points.push_back({0, 0});
  for (Index i = 0; i < n; ++i) {
    raw.elements.push_back({n, i, (i + 1) % n});
    if (middles == Middles::none) continue;
    auto& middle = raw.middle.emplace_back();
    middle.fill(-1);
    for (std::size_t k = 0; k < 3; ++k)
      if (simplex_edges<2>()[k] == std::array{1, 2}) middle[k] = static_cast<Index>(raw.points.size());
    raw.points.push_back(middles == Middles::on_circle ? on_circle(i + 0.5)
                                                       : midpoint<2>(on_circle(i), on_circle((i + 1) % n)));
  }
  return build_mesh<2>(raw, "test");
}

// However long its elements are, a circle is one where they bend along it; polygons keep their corners.
TEST(BodyGeometry, LongSecondOrderElementsOnACircleStandForIt) {
  for (const Index n : {4, 5, 6, 8, 10, 12}) {
    Mesh<2> circle = fan(n, Middles::on_circle), polygon = fan(n, Middles::straight), flat = fan(n, Middles::none);
    give_geometry(circle, Surfaces::automatic);
    EXPECT_EQ(kinds(circle), std::multiset<std::string>{"circle"}) << n;
    EXPECT_LT(off_unit_sphere(circle), 1e-14) << n;
    give_geometry(polygon, Surfaces::automatic);
    EXPECT_EQ(kinds(polygon).count("line"), static_cast<std::size_t>(n));
    EXPECT_TRUE(polygon.bends.empty() && polygon.curves.empty());
    give_geometry(flat, Surfaces::automatic);
    EXPECT_EQ(kinds(flat).count("line"), n > 10 ? 0u : static_cast<std::size_t>(n));  // more than 35 degrees
  }
}

/// Tetrahedra between the axis and a surface of revolution: from points (r, z), the first and the last one on the axis.
Mesh<3> turned(const std::vector<Point<2>>& section, Index around) {
  RawMesh<3> raw;
  const auto rows = static_cast<Index>(section.size());
  const auto at = [&](Index j, Index i) { return 1 + j * around + i % around; };
  double middle = 0;
  for (const Point<2>& p : section) middle += p[1] / rows;
  raw.points.push_back({0, 0, middle});
  for (const Point<2>& p : section)
    for (Index i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around;
      raw.points.push_back({p[0] * std::cos(a), p[0] * std::sin(a), p[1]});
    }
  for (Index j = 0; j + 1 < rows; ++j)
    for (Index i = 0; i < around; ++i) {
      const Index a = section[j][0] == 0 ? at(j, 0) : at(j, i), b = section[j][0] == 0 ? a : at(j, i + 1),
                  c = section[j + 1][0] == 0 ? at(j + 1, 0) : at(j + 1, i),
                  d = section[j + 1][0] == 0 ? c : at(j + 1, i + 1);
      if (a != b) raw.elements.push_back({0, a, b, c});
      if (c != d) raw.elements.push_back({0, b, d, c});
    }
  return build_mesh<3>(std::move(raw), "test");
}

// A pin with a conical end, whose edge is one of 30 degrees; and a cone with its tip.
TEST(BodyGeometry, ConesAreFoundBesideCylindersAndWithTheirTips) {
  const double slope = std::tan(std::numbers::pi / 6);
  Mesh<3> pin = turned({{0, -0.6}, {0.5, -0.6}, {0.5, -0.3}, {0.5, 0}, {0.5 - 0.2 * slope, 0.2}, {0, 0.2}}, 24);
  give_geometry(pin, Surfaces::automatic);
  EXPECT_EQ(kinds(pin), (std::multiset<std::string>{"plane", "cylinder", "cone", "plane"}));
  Mesh<3> cone = turned({{0, 0}, {1, 0}, {0.6, 0.8}, {0.3, 1.4}, {0, 2}}, 20);
  give_geometry(cone, Surfaces::automatic);
  EXPECT_EQ(kinds(cone), (std::multiset<std::string>{"plane", "cone"}));
  const Mesh<3> fine = hierarchy(cone, 2).finest();
  for (const Face<3>& face : fine.boundary)
    for (const Index v : face.vertices) {
      const Point<3>& p = fine.points[v];
      EXPECT_NEAR(std::min(p[2], (2 - p[2]) / 2 - std::hypot(p[0], p[1])), 0, 1e-12);
    }
}

// Cylinder and sphere run into each other without an edge.
TEST(BodyGeometry, ShapesThatRunIntoEachOtherAreToldApart) {
  std::vector<Point<2>> section{{0, -1}, {1, -1}, {1, -0.7}, {1, -0.4}};
  for (int k = 0; k < 6; ++k)
    section.push_back({std::cos(k * std::numbers::pi / 12), std::sin(k * std::numbers::pi / 12)});
  section.push_back({0, 1});
  Mesh<3> mesh = turned(section, 24);
  give_geometry(mesh, Surfaces::automatic);
  EXPECT_EQ(kinds(mesh), (std::multiset<std::string>{"plane", "cylinder", "sphere"}));
}

// What is round between two materials is round as a surface is.
TEST(BodyGeometry, FacesBetweenMaterialsAreSmooth) {
  Mesh<2> mesh = ring(24, 2, 1, 2);
  for (const auto& element : mesh.elements) {
    double r = 0;
    for (const Index v : element) r += length<2>(mesh.points[v]) / 3;
    mesh.region.push_back(r < 1.5 ? -1 : 0);
  }
  give_geometry(mesh, Surfaces::automatic);
  EXPECT_EQ(kinds(mesh), (std::multiset<std::string>{"circle", "circle", "inner circle"}));
  const Mesh<2> fine = hierarchy(mesh, 3).finest();
  double area = 0;
  for (std::size_t e = 0; e < fine.elements.size(); ++e)
    if (fine.region[e] < 0) area += signed_volume<2>(corners<2>(fine.points, fine.elements[e]));
  const double exact = std::numbers::pi * 1.25;
  EXPECT_NEAR(area, exact, 3e-4 * exact);  // flat faces between the materials: 2e-2
}

// Refinement then goes on along the circle, not along the parabolas of the elements.
TEST(BodyGeometry, SecondOrderElementsWhoseNodesAreOnAShapeStandForIt) {
  const Mesh<2> flat = without_geometry(meshed<2>(geometry::Shape2(geometry::Disk{{0, 0}, 1}), 0.5));
  RawMesh<2> raw;
  raw.points = flat.points;
  raw.elements = flat.elements;
  raw.middle.assign(flat.elements.size(), {-1, -1, -1});
  for (const Face<2>& face : flat.boundary)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = simplex_edges<2>()[k];
      const Simplex<2>& e = flat.elements[face.element];
      if (sorted(std::array{e[i], e[j]}) != sorted(face.vertices)) continue;
      Point<2> m = midpoint<2>(flat.points[e[i]], flat.points[e[j]]);
      const double l = length<2>(m);
      raw.middle[face.element][k] = static_cast<Index>(raw.points.size());
      raw.points.push_back({m[0] / l, m[1] / l});
    }
  Mesh<2> mesh = build_mesh<2>(raw, "test"), elements = mesh;
  EXPECT_GT(off_unit_sphere(elements), 1e-5);
  give_geometry(mesh, Surfaces::automatic);
  EXPECT_EQ(kinds(mesh), std::multiset<std::string>{"circle"});
  EXPECT_LT(off_unit_sphere(mesh), 1e-14);
}

/// A bar of revolution of second order, with a bore.
/// @param radius where the outside is, from 0 to 1 along the axis
template <class Radius>
Mesh<3> turned(std::array<Index, 3> cells, const Radius& radius) {
  const Mesh<3> grid = box({0, 0, 0}, {1, 1, 1}, cells);
  RawMesh<3> raw;
  std::map<std::array<std::int64_t, 3>, Index> number;  // of a point, where the ends of the grid meet
  const auto add = [&](const Point<3>& at) {
    const double angle = 2 * std::numbers::pi * at[1], r = 0.4 + (radius(at[2]) - 0.4) * at[0];
    const Point<3> p{r * std::cos(angle), r * std::sin(angle), at[2]};
    std::array<std::int64_t, 3> key;
    for (int k = 0; k < 3; ++k) key[k] = std::llround(1e7 * p[k]);
    const auto [found, is_new] = number.try_emplace(key, static_cast<Index>(raw.points.size()));
    if (is_new) raw.points.push_back(p);
    return found->second;
  };
  for (const Simplex<3>& element : grid.elements) {
    auto& vertices = raw.elements.emplace_back();
    auto& middle = raw.middle.emplace_back();
    for (int i = 0; i < 4; ++i) vertices[i] = add(grid.points[element[i]]);
    for (std::size_t k = 0; k < middle.size(); ++k) {
      const auto [a, b] = simplex_edges<3>()[k];
      middle[k] = add(midpoint<3>(grid.points[element[a]], grid.points[element[b]]));
    }
  }
  return build_mesh<3>(std::move(raw), "test");
}

TEST(BodyGeometry, CylindersThatRunIntoConesAreFoundInSecondOrderFiles) {
  for (const Index around : {4, 6, 12}) {
    Mesh<3> mesh = turned({1, around, 4}, [](double z) { return z < 0.5 ? 1 : 1 + 0.2 * (z - 0.5); });
    give_geometry(mesh, Surfaces::automatic);
    EXPECT_EQ(kinds(mesh), (std::multiset<std::string>{"cone", "cylinder", "cylinder", "plane", "plane"})) << around;
  }
}

}  // namespace
}  // namespace signorini
