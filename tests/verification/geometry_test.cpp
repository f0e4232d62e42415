// Bodies from meshes and obstacles from triangles: results converge to those of the true geometry.
#include <map>

#include "core/geometry/geometry.hpp"
#include "core/mesh/build.hpp"
#include "mesh_file.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

/// A quarter of a ring, radii 1 and 2, with cells of 15 degrees.
Mesh<2> quarter_ring() {
  constexpr Index around = 6, across = 4;
  RawMesh<2> raw;
  for (Index j = 0; j <= across; ++j)
    for (Index i = 0; i <= around; ++i) {
      const double a = pi / 2 * i / around, r = 1 + 1.0 * j / across;
      raw.points.push_back({i == around ? 0 : r * std::cos(a), r * std::sin(a)});
    }
  raw.groups = {{"inner", {}}, {"outer", {}}, {"bottom", {}}, {"left", {}}};
  const auto at = [&](Index i, Index j) { return j * (around + 1) + i; };
  for (Index j = 0; j < across; ++j)
    for (Index i = 0; i < around; ++i) {
      raw.elements.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      raw.elements.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  for (Index i = 0; i < around; ++i) {
    raw.groups[0].faces.push_back({at(i, 0), at(i + 1, 0)});
    raw.groups[1].faces.push_back({at(i, across), at(i + 1, across)});
  }
  for (Index j = 0; j < across; ++j) {
    raw.groups[2].faces.push_back({at(0, j), at(0, j + 1)});
    raw.groups[3].faces.push_back({at(around, j), at(around, j + 1)});
  }
  return build_mesh<2>(std::move(raw), "test");
}

/// Under an internal pressure of 0.01 in a rigid bore that leaves it some room.
SceneText ring_in_bore(const std::string& file, const std::string& keys, double room) {
  return {
      .body = fmt::format("mesh = \"{}\"\n{}young = 1\npoisson = 0.3\n{}", file,
                          keys.find("order") == std::string::npos ? "order = 1\n" : "", keys),
      .fixes = {"on = \"bottom\"\nvalue = [\"free\", 0]", "on = \"left\"\nvalue = [0, \"free\"]"},
      .loads = {"on = \"inner\"\nvalue = [\"-0.01*nx\", \"-0.01*ny\"]"},
      .obstacle = fmt::format("type = \"contact\"\non = \"outer\"\nshape = \"sphere\"\ncenter = [0, 0]\nradius = {}\n"
                              "inside = true",
                              2 + room)};
}

// Lame: sigma_rr = A - B / r^2, u = (1 + nu) ((1 - 2 nu) A r + B / r), which is the room at r = 2.
double bore_pressure(double room) { return (2.8 * 0.01 - 3 * room / 1.3) / 5.2; }

Errors errors_of_the_pressure(const std::string& file, const std::string& keys, int refinements, double room = 0) {
  Errors errors;
  for (int k = 1; k <= refinements; ++k) {
    const auto r = run<2, 2>(ring_in_bore(file, keys, room), {uniform(k)});
    const double off = r.contact().max_pressure / bore_pressure(room) - 1;
    errors.add(std::abs(off));
    show("{}, room {}: {} nodes, pressure {:+.2e} off, order {:.2f}\n", keys, room, r.nodes().size(), off,
         errors.last_order());
  }
  return errors;
}

// The largest pressure is that of the worst node: second order for quadratic elements. Linear ones are as good from the
// start as their meshes of the ring's ends allow.
TEST(Geometry, RingInABoreConvergesAtTheOrderOfItsElements) {
  const TemporaryFolder folder;
  const std::string file = folder.write("ring.msh", msh(quarter_ring()));
  const Errors facets = errors_of_the_pressure(file, "geometry = \"facets\"", 3);
  EXPECT_GT(facets.value.back(), 1);
  for (const char* geometry : {"auto", "fit", "smooth"}) {
    const Errors linear = errors_of_the_pressure(file, fmt::format("geometry = \"{}\"", geometry), 4);
    for (const double error : linear.value) EXPECT_LT(error, 0.0015);
    EXPECT_LT(linear.value.back(), 0.001);
    const Errors quadratic = errors_of_the_pressure(file, fmt::format("order = 2\ngeometry = \"{}\"", geometry), 3);
    EXPECT_LT(quadratic.value.back(), 2e-4);
    if (geometry != std::string("smooth")) {
      EXPECT_GT(quadratic.mean_order(), 1.9);
    }
  }
}

// What the ends of a curved edge move along their own normals is less along that of its midpoint.
TEST(Geometry, RingGrowsIntoItsBore) {
  const TemporaryFolder folder;
  const Errors errors = errors_of_the_pressure(folder.write("ring.msh", msh(quarter_ring())), "order = 2", 3, 0.005);
  EXPECT_GT(errors.mean_order(), 1.8);
  EXPECT_LT(errors.value.back(), 3e-5);
}

TEST(Geometry, AnImportedHalfBallIsTheOneThatTheProgramMeshes) {
  const TemporaryFolder folder;
  const Mesh<3> mesh = geometry::engine<3>().mesh(geometry::Shape3(geometry::Ball{{0, 0, 0}, 1, true}),
                                                  [](const Point<3>&) { return 0.3; });
  const std::string rest = "order = 1\nyoung = 1\npoisson = 0.3\n";
  SceneText scene{.body = "shape = \"half_ball\"\ncenter = [0, 0, 0]\nradius = 1\nsize = 0.3\n" + rest,
                  .fixes = {"on = \"flat\"\nvalue = [0, 0, -0.02]"},
                  .obstacle =
                      "type = \"contact\"\non = \"curved\"\nshape = \"plane\"\npoint = [0, 0, -1]\n"
                      "normal = [0, 0, 1]"};
  const auto meshed = run<3, 3>(scene, {uniform(2)});
  const std::string from_file = fmt::format("mesh = \"{}\"\n", folder.write("ball.msh", msh(mesh))) + rest;
  const double pressure = meshed.contact().max_pressure, force = meshed.contact().force[2];
  const auto off = [&](const std::string& geometry) {
    scene.body = from_file + "geometry = \"" + geometry + "\"\n";
    const auto imported = run<3, 3>(scene, {uniform(2)});
    show("{}: pressure {:+.2e}, force {:+.2e}\n", geometry, imported.contact().max_pressure / pressure - 1,
         imported.contact().force[2] / force - 1);
    return std::max(std::abs(imported.contact().max_pressure / pressure - 1),
                    std::abs(imported.contact().force[2] / force - 1));
  };
  EXPECT_LT(off("auto"), 1e-6);
  EXPECT_LT(off("fit"), 1e-6);
  EXPECT_LT(off("smooth"), 0.02);
  EXPECT_GT(off("facets"), 0.1);
}

/// A sphere of radius 1 around (0, 0, -1), by divisions of an octahedron: edges of about 1.6 / 2^divisions.
std::string sphere_off(int divisions) {
  std::vector<Point<3>> points;
  std::map<std::array<long, 3>, std::size_t> number;
  const auto vertex = [&](Point<3> p) {
    const double l = norm<3>(p);
    for (double& x : p) x /= l;
    const auto [entry, fresh] =
        number.try_emplace({std::lround(1e9 * p[0]), std::lround(1e9 * p[1]), std::lround(1e9 * p[2])}, points.size());
    if (fresh) points.push_back({p[0], p[1], p[2] - 1});
    return entry->second;
  };
  std::string faces;
  int count = 0;
  const int n = 1 << divisions;
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-1.0, 1.0})
      for (const double sz : {-1.0, 1.0})
        for (int i = 0; i < n; ++i)
          for (int j = 0; i + j < n; ++j)
            for (int kind = 0; kind < (i + j + 1 < n ? 2 : 1); ++kind) {
              const auto at = [&](int a, int b) {
                // Turned, for no vertex is to be where the sphere is touched.
                const double x = sx * a, y = sy * b, z = sz * (n - a - b), c = std::cos(0.4), s = std::sin(0.4);
                return vertex({x, c * y - s * z, s * y + c * z});
              };
              std::array<std::size_t, 3> t = kind == 0 ? std::array{at(i, j), at(i + 1, j), at(i, j + 1)}
                                                       : std::array{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
              if (sx * sy * sz < 0) std::swap(t[1], t[2]);
              faces += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
              ++count;
            }
  std::string out = fmt::format("OFF\n{} {} 0\n", points.size(), count);
  for (const Point<3>& p : points) out += fmt::format("{:.17g} {:.17g} {:.17g}\n", p[0], p[1], p[2]);
  return out + faces;
}

/// A block pressed on a ball from above.
SceneText block_on(const std::string& obstacle) {
  return {.body =
              "shape = \"box\"\nfrom = [-0.24, -0.24, 0]\nto = [0.24, 0.24, 0.24]\ncells = [4, 4, 2]\norder = 1\nyoung "
              "= 1\n"
              "poisson = 0.3",
          .fixes = {"on = \"top\"\nvalue = [0, 0, -0.01]"},
          .obstacle = "type = \"contact\"\non = \"bottom\"\n" + obstacle,
          .refinements = 3};
}

TEST(Geometry, ATriangulatedSphereIsASphere) {
  const TemporaryFolder folder;
  const std::string file = folder.write("sphere.off", sphere_off(5));
  const auto exact = run<3, 3>(block_on("shape = \"sphere\"\ncenter = [0, 0, -1]\nradius = 1"));
  const auto smooth = run<3, 3>(block_on(fmt::format("shape = \"surface\"\nfile = \"{}\"", file)));
  const auto facets =
      run<3, 3>(block_on(fmt::format("shape = \"surface\"\nfile = \"{}\"\ngeometry = \"facets\"", file)));
  const auto off = [&](const auto& r) { return r.contact().max_pressure / exact.contact().max_pressure - 1; };
  show("smooth {:+.2e}, facets {:+.2e}, force {:+.2e}, {:+.2e}\n", off(smooth), off(facets),
       smooth.contact().force[2] / exact.contact().force[2] - 1,
       facets.contact().force[2] / exact.contact().force[2] - 1);
  const double force = exact.contact().force[2];
  EXPECT_LT(std::abs(off(smooth)), 1e-3);
  EXPECT_NEAR(smooth.contact().force[2], force, 1e-4 * force);
  EXPECT_GT(std::abs(facets.contact().force[2] - force), 0.02 * force);
}

/// A flat foot of half width 1 with a chamfer of so many degrees, 0.4 long, beside it.
Mesh<2> foot(double angle) {
  RawMesh<2> raw;
  const double wide = 0.4 * std::cos(angle), high = 0.4 * std::sin(angle);
  constexpr Index columns = 6, rows = 3;
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i <= columns; ++i) {
      const double x = i <= 4 ? 0.25 * i : 1 + wide * (i - 4) / 2, low = i <= 4 ? 0 : high * (i - 4) / 2;
      raw.points.push_back({x, low + (1 - low) * j / rows});
    }
  raw.groups = {{"left", {}}, {"top", {}}, {"bottom", {}}};
  const auto at = [&](Index i, Index j) { return j * (columns + 1) + i; };
  for (Index j = 0; j < rows; ++j) {
    raw.groups[0].faces.push_back({at(0, j), at(0, j + 1)});
    for (Index i = 0; i < columns; ++i) {
      raw.elements.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      raw.elements.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  for (Index i = 0; i < columns; ++i) {
    raw.groups[1].faces.push_back({at(i, rows), at(i + 1, rows)});
    raw.groups[2].faces.push_back({at(i, 0), at(i + 1, 0)});
  }
  return build_mesh<2>(std::move(raw), "test");
}

// Rounded off, the chamfer carries: 5.2e-3 in place of 1.4e-3 at 30 degrees.
TEST(Geometry, AChamferedFootStandsOnItsFlatFace) {
  const TemporaryFolder folder;
  for (const double degrees : {10.0, 20.0, 30.0}) {
    const std::string file = folder.write("foot.msh", msh(foot(degrees * pi / 180)));
    const auto force = [&](const std::string& geometry) {
      const auto r = run<2, 2>(SceneText{
          .body = fmt::format("mesh = \"{}\"\ngeometry = \"{}\"\nyoung = 1\npoisson = 0.3\norder = 2", file, geometry),
          .fixes = {"on = \"left\"\nvalue = [0, \"free\"]", "on = \"top\"\nvalue = [0, -0.001]"},
          .obstacle = "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\n"
                      "normal = [0, 1]",
          .refinements = 1});
      return r.contact().force[1];
    };
    const double exact = force("facets");
    EXPECT_NEAR(force("auto"), exact, 1e-6 * exact) << degrees;
    EXPECT_NEAR(force("smooth"), exact, 1e-6 * exact) << degrees;
  }
}

TEST(Geometry, ADieOfFlatFacesKeepsItsEdges) {
  const TemporaryFolder folder;
  for (const double degrees : {10.0, 20.0, 30.0}) {
    const double low = -1.1 * std::tan(degrees * pi / 180);
    std::string off = "OFF\n8 6 0\n";
    for (const double y : {-1.5, 1.5})
      for (const double x : {-1.6, -0.5, 0.5, 1.6})
        off += fmt::format("{} {} {:.17g}\n", x, y, std::abs(x) > 1 ? low : 0);
    for (int i = 0; i < 3; ++i) off += fmt::format("3 {} {} {}\n3 {} {} {}\n", i, i + 1, i + 5, i, i + 5, i + 4);
    const std::string file = folder.write("die.off", off);
    const auto force = [&](const std::string& geometry) {
      return run<3, 3>(
                 SceneText{.body =
                               "shape = \"box\"\nfrom = [-1, -0.5, 0]\nto = [1, 0.5, 1]\ncells = [8, 2, 4]\nyoung = 1\n"
                               "poisson = 0.3",
                           .fixes = {"on = \"top\"\nvalue = [0, 0, -0.005]"},
                           .obstacle = fmt::format("type = \"contact\"\non = \"bottom\"\nshape = \"surface\"\n"
                                                   "file = \"{}\"\ngeometry = \"{}\"",
                                                   file, geometry)})
          .contact()
          .force[2];
    };
    const double exact = force("facets");
    EXPECT_NEAR(force("smooth"), exact, 1e-6 * exact) << degrees;
  }
}

/// An eighth of a shell, radii 0.6 and 1, with n cells along each edge and two across.
Mesh<3> shell(Index n) {
  constexpr Index layers = 2;
  constexpr double inner = 0.6;
  RawMesh<3> raw;
  raw.groups = {{"outer", {}}};
  std::map<std::array<Index, 3>, Index> number;
  const auto at = [&](std::array<Index, 2> ij, Index layer) {
    const auto [found, fresh] = number.try_emplace({ij[0], ij[1], layer}, static_cast<Index>(raw.points.size()));
    if (fresh) {
      const Point<3> way{double(ij[0]), double(ij[1]), double(n - ij[0] - ij[1])};
      const double factor = (inner + (1 - inner) * layer / layers) / norm<3>(way);
      raw.points.push_back({factor * way[0], factor * way[1], factor * way[2]});
    }
    return found->second;
  };
  const auto add_prisms = [&](const std::array<std::array<Index, 2>, 3>& p) {  // in ascending order
    for (Index k = 0; k < layers; ++k) {
      raw.elements.push_back({at(p[0], k), at(p[1], k), at(p[2], k), at(p[2], k + 1)});
      raw.elements.push_back({at(p[0], k), at(p[1], k), at(p[1], k + 1), at(p[2], k + 1)});
      raw.elements.push_back({at(p[0], k), at(p[0], k + 1), at(p[1], k + 1), at(p[2], k + 1)});
    }
    raw.groups[0].faces.push_back({at(p[0], layers), at(p[1], layers), at(p[2], layers)});
  };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; i + j < n; ++j) {
      add_prisms({{{i, j}, {i, j + 1}, {i + 1, j}}});
      if (i + j + 1 < n) add_prisms({{{i, j + 1}, {i + 1, j}, {i + 1, j + 1}}});
    }
  return build_mesh<3>(std::move(raw), "test");
}

std::string with_octant(const SceneText& scene) { return std::string(scene) + "[symmetry]\nx = 0\ny = 0\nz = 0\n"; }

// Lame's: u = A r + B / r^2 = -0.01 at r = 1, and no stress at r = 0.6.
TEST(Geometry, AShellThatTouchesItsBoreAllOverWantsTheTrueSphere) {
  constexpr double ratio = 0.216 * 1.3 / 0.8, A = -0.01 / (1 + ratio), exact = -A / 0.4 + 2 * A * ratio / 1.3;
  const TemporaryFolder folder;
  const auto off = [&](Index cells, const std::string& geometry, int refinements) {
    const std::string file = folder.write("shell.msh", msh(shell(cells)));
    const auto r = run<3, 3>(with_octant(
        {.body = fmt::format("mesh = \"{}\"\ngeometry = \"{}\"\norder = 1\nyoung = 1\npoisson = 0.3", file, geometry),
         .obstacle = "type = \"contact\"\non = \"outer\"\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.99\n"
                     "inside = true",
         .refinements = refinements}));
    const double out = r.contact().max_pressure / exact - 1;
    show("{} cells, {}, {} refinements: {:+.2e}\n", cells, geometry, refinements, out);
    return std::abs(out);
  };
  for (const int refinements : {1, 2}) {
    EXPECT_LT(off(3, "auto", refinements), 0.025);
    EXPECT_LT(off(6, "auto", refinements), 0.03);
    EXPECT_LT(off(3, "smooth", refinements), 0.03) << "its vertices lie on a sphere";
    EXPECT_LT(off(6, "smooth", refinements), 0.03);
  }
}

TEST(Geometry, PressureAndAreaOfCurvedElementsAreThoseOfTheirFaces) {
  for (const int refinements : {0, 1}) {
    const auto r = run<3, 3>(with_octant(
        {.body = "shape = \"ball\"\ncenter = [0, 0, 0]\nradius = 1\nsize = 0.5\norder = 2\nyoung = 1\npoisson = 0.3",
         .obstacle = "type = \"contact\"\non = \"boundary\"\nshape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.99\n"
                     "inside = true",
         .refinements = refinements}));
    constexpr double exact = 0.01 / 0.4;
    show("pressure {:+.2e}, area {:+.2e}\n", r.contact().max_pressure / exact - 1, r.contact().area / (pi / 2) - 1);
    EXPECT_NEAR(r.contact().max_pressure, exact, (refinements == 0 ? 5e-3 : 1e-3) * exact);
    EXPECT_NEAR(r.contact().area, pi / 2, (refinements == 0 ? 5e-4 : 5e-5) * pi / 2);
    EXPECT_TRUE(r.contact().resolved) << "all nodes are inside";
  }
}

}  // namespace
}  // namespace signorini::test
