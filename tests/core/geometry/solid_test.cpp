#include <cstdlib>
#include <numbers>

#include "core/base/dot.hpp"
#include "geometry_checks.hpp"
#include "surfaces.hpp"
#include "tests/support/nightly.hpp"

namespace signorini {
namespace {

using geometry::engine;
using geometry::Solid;
using test::cube;
using test::Surface;
using test::TemporaryFile;
using testing::AllOf;
using testing::HasSubstr;

Mesh<3> mesh(const TemporaryFile& file, double h) {
  return engine<3>().mesh(geometry::Shape3(Solid{file.path()}), test::constant<3>(h));
}

std::string complaint(const TemporaryFile& file, double h = 0.3) {
  return test::input_error_of([&] { mesh(file, h); });
}

TEST(Solid, ACubeKeepsItsEdgesAndCorners) {
  const Mesh<3> m = mesh(TemporaryFile("cube.off", cube(0, 2).off()), 0.3);
  test::expect_consistent(m);
  EXPECT_NEAR(test::volume(m), 8, 1e-12);
  EXPECT_NEAR(test::area(m, "boundary"), 24, 1e-12);
  EXPECT_GT(test::smallest_angle(m), 8);
  EXPECT_NEAR(test::mean_edge(m), 0.3, 0.05);
  for (const auto& corner : cube(0, 2).points) EXPECT_THAT(m.points, testing::Contains(corner));
}

TEST(Solid, FormatsAndOrientationsAgree) {
  const Mesh<3> m = mesh(TemporaryFile("cube.off", cube(0, 1).off()), 0.4);
  for (const auto& [name, text] :
       {std::pair{"inward.off", cube(0, 1).reversed().off()}, {"soup.stl", cube(0, 1).stl()}}) {
    const Mesh<3> other = mesh(TemporaryFile(name, text), 0.4);
    test::expect_consistent(other);
    EXPECT_NEAR(test::volume(other), test::volume(m), 1e-12);
  }
}

TEST(Solid, FacesOfMoreThanThreeVerticesAreDivided) {
  const char* quads =
      "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
      "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  const Mesh<3> m = mesh(TemporaryFile("quads.off", quads), 0.4);
  test::expect_consistent(m);
  EXPECT_NEAR(test::volume(m), 1, 1e-12);
}

TEST(Solid, AHollowCubeIsMeshedAroundItsHole) {
  Surface hollow = cube(0, 3);
  hollow.add(cube(1, 2));
  const Mesh<3> m = mesh(TemporaryFile("hollow.off", hollow.off()), 0.4);
  test::expect_consistent(m);
  EXPECT_NEAR(test::volume(m), 26, 1e-10);
  EXPECT_NEAR(test::area(m, "boundary"), 54 + 6, 1e-10);
}

struct Named {
  const char* name;
  Surface surface;
  double volume;
};

std::vector<Named> solids_with_flat_faces() {
  const Surface tetrahedron{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  const Surface corner =
      test::prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1, {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}});
  const Surface notched = test::prism({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1.5}, {1, 1.5}, {1, 3}, {0, 3}}, 3,
                                      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 5}, {0, 5, 7}, {5, 6, 7}});
  return {{"hollow cube", cube(0, 3).add(cube(1, 2)), 26},
          {"plate", test::box({2, 2, 0.1}), 0.4},
          {"tetrahedron", tetrahedron, 8.0 / 6},
          {"corner", corner, 3},
          {"notched cube", notched, 22.5},
          {"cube with a slot inside", cube(0, 2).add(test::box({1.1, 1.1, 0.2}).moved(0.45)), 8 - 0.242}};
}

TEST(Solid, FlatFacesAreFilledAtAnySizeAndInAnyPosition) {
  for (const auto& [name, surface, volume] : solids_with_flat_faces())
    for (const bool turned : {false, true})
      for (const double h : {0.412, 0.388}) {
        if (!test::nightly() && turned != (h == 0.388)) continue;
        const Surface s = turned ? surface.turned(0.7, 0.3) : surface;
        SCOPED_TRACE(fmt::format("{}, size {}", name, h));
        const Mesh<3> m = mesh(TemporaryFile("solid.off", s.off()), h);
        test::expect_consistent(m);
        EXPECT_NEAR(test::volume(m), volume, 1e-9 * volume);
        EXPECT_GT(test::smallest_angle(m), 1);
      }
}

Surface octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// The hull of the middles of a cube's edges. Its faces meet at 54.7 degrees.
Surface cuboctahedron() {
  Surface s;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      s.points.push_back({a, b, 0});
      s.points.push_back({a, 0, b});
      s.points.push_back({0, a, b});
    }
  const auto plane = [&](const std::array<double, 3>& n, double distance) {
    std::vector<int> face;
    for (int v = 0; v < 12; ++v)
      if (std::abs(n[0] * s.points[v][0] + n[1] * s.points[v][1] + n[2] * s.points[v][2] - distance) < 1e-12)
        face.push_back(v);
    return face;
  };
  const auto add = [&](int a, int b, int c, const std::array<double, 3>& n) {
    const auto &p = s.points[a], &q = s.points[b], &r = s.points[c];
    const Point<3> normal = cross({q[0] - p[0], q[1] - p[1], q[2] - p[2]}, {r[0] - p[0], r[1] - p[1], r[2] - p[2]});
    s.triangles.push_back(dot(n, normal) > 0 ? std::array{a, b, c} : std::array{a, c, b});
  };
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      std::array<double, 3> n{};
      n[k] = sign;
      const auto f = plane(n, 1);  // a square: the vertex opposite to the first one is the one farthest from it
      int opposite = 1;
      for (int i = 1; i < 4; ++i) {
        const auto &p = s.points[f[0]], &q = s.points[f[i]];
        if (std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) > 1.9) opposite = i;
      }
      for (int i = 1; i < 4; ++i)
        if (i != opposite) add(f[0], f[i], f[opposite], n);
    }
  for (int k = 0; k < 8; ++k) {
    const std::array<double, 3> n{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0};
    const auto f = plane(n, 2);
    add(f[0], f[1], f[2], n);
  }
  return s;
}

void expect_filled(const Surface& surface, double volume, double h) {
  const Mesh<3> m = mesh(TemporaryFile("solid.off", surface.off()), h);
  test::expect_consistent(m);
  EXPECT_NEAR(test::volume(m), volume, 1e-9 * volume);
}

// Their vertices lie on one sphere, and four at a time in planes.
TEST(Solid, SymmetricSolidsAreFilledAtAnySize) {
  Surface bipyramid = octahedron();
  for (auto& p : bipyramid.points) p[2] *= 0.5;
  for (const auto& [name, surface, volume] : {Named{"octahedron", octahedron(), 4.0 / 3},
                                              {"cuboctahedron", cuboctahedron(), 20.0 / 3},
                                              {"bipyramid", bipyramid, 2.0 / 3},
                                              {"cube", cube(-1, 1), 8}})
    for (const Surface& s : {surface, surface.turned(0.7, 0.3)})
      for (const double h : test::nightly<std::vector<double>>({3.0, 1.5, 1.0, 0.7, 0.5, 0.35}, {3.0, 1.5, 1.0, 0.6})) {
        SCOPED_TRACE(fmt::format("{}, size {}", name, h));
        const Mesh<3> m = mesh(TemporaryFile("solid.off", s.off()), h);
        test::expect_consistent(m);
        EXPECT_NEAR(test::volume(m), volume, 1e-9 * volume);
        EXPECT_GT(test::smallest_angle(m), 1);
      }
}

// An octahedron with a vertex pulled out: its faces meet in angles of 8 degrees there.
TEST(Solid, FarCornersAreFilled) {
  Surface s = octahedron();
  s.points[0] = {1.1, 0.07, 0};
  s.points[1] = {-1, 4, 0};
  for (const Surface& t : {s, s.turned(0.7, 0.3).moved(100)})
    for (const double h : {3.0, 0.7, 0.25}) {
      SCOPED_TRACE(fmt::format("size {}", h));
      expect_filled(t, 1.4, h);
    }
  EXPECT_GT(test::smallest_angle(mesh(TemporaryFile("far.off", s.off()), 0.7)), 1);
}

// A prism over a sharp triangle, and the notch that such a prism leaves.
TEST(Solid, SharpAnglesAndNarrowNotchesAreFilled) {
  for (const double degrees : {12.0, 6.0}) {
    SCOPED_TRACE(degrees);
    const double t = degrees * std::numbers::pi / 180, w = 1.5 * std::tan(t / 2);
    const Surface wedge = test::prism({{0, 0}, {2, 0}, {2 * std::cos(t), 2 * std::sin(t)}}, 1, {{0, 1, 2}});
    const Surface notched = test::prism({{-2, 0}, {2, 0}, {2, 2}, {w, 2}, {0, 0.5}, {-w, 2}, {-2, 2}}, 1,
                                        {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {4, 5, 6}, {4, 6, 0}});
    for (const double h : {1.5, 0.4}) expect_filled(wedge, 2 * std::sin(t), h);
    expect_filled(wedge.turned(0.7, 0.3), 2 * std::sin(t), 0.4);
    expect_filled(notched, 8 - 1.5 * w, 0.7);
  }
}

// What geometry/edges.hpp tells to be an edge is one, whatever its angle: here 20 degrees.
TEST(Solid, ShallowEdgesAreKept) {
  const double rise = 0.8 * std::tan(20 * std::numbers::pi / 180);
  const Surface die = test::prism({{0, 0}, {3, 0}, {3, 1}, {2.2, 1 + rise}, {0.8, 1 + rise}, {0, 1}}, 1.5,
                                  {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  for (const Surface& s : {die, die.turned(0.7, 0.3)})
    for (const double h : {1.5, 0.4}) expect_filled(s, 1.5 * (3 + 2.2 * rise), h);
}

/// Over a regular polygon, to an apex at the height `high`, or a prism of that height.
Surface over_polygon(int n, double high, bool pointed) {
  Surface s;
  const auto ring = [&](double z) {
    for (int i = 0; i < n; ++i)
      s.points.push_back({std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n), z});
  };
  ring(0);
  if (!pointed) ring(high);
  if (pointed) s.points.push_back({0, 0, high});
  for (int i = 2; i < n; ++i) {
    s.triangles.push_back({0, i, i - 1});
    if (!pointed) s.triangles.push_back({n, n + i - 1, n + i});
  }
  for (int i = 0; i < n; ++i) {
    const int k = (i + 1) % n;
    if (pointed) {
      s.triangles.push_back({i, k, n});
    } else {
      s.triangles.push_back({i, k, k + n});
      s.triangles.push_back({i, k + n, i + n});
    }
  }
  return s;
}

// The 32 edges of its side are none of a cylinder: elements have the size asked for.
TEST(Solid, RoundSidesAreSmooth) {
  const double area = 16 * std::sin(std::numbers::pi / 16);
  for (const double h : {0.7, 0.4}) {
    SCOPED_TRACE(h);
    const Mesh<3> m = mesh(TemporaryFile("cylinder.stl", over_polygon(32, 2, false).stl()), h);
    test::expect_consistent(m);
    EXPECT_NEAR(test::volume(m), 2 * area, h * h / 12 * 2 * area);  // what chords of such a length leave
    EXPECT_GT(test::mean_edge(m), 0.85 * h);
  }
}

TEST(Solid, TheTipOfAConeIsThere) {
  for (const double h : {1.5, 0.4}) {
    const Mesh<3> m = mesh(TemporaryFile("cone.off", over_polygon(32, 4, true).off()), h);
    test::expect_consistent(m);
    double top = 0;
    for (const Point<3>& p : m.points) top = std::max(top, p[2]);
    EXPECT_EQ(top, 4) << h;
  }
}

TEST(Solid, RealSurfacesAreFilled) {
  const char* folder = std::getenv("SIGNORINI_MESHES");
  if (!folder) GTEST_SKIP() << "SIGNORINI_MESHES does not name a folder with spot.obj, fandisk.obj and rocker-arm.obj";
  for (const char* name : {"spot.obj", "fandisk.obj", "rocker-arm.obj"}) {
    const std::string file = std::string(folder) + "/" + name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
    const auto surface = engine<3>().surface(file);
    double extent = 0;  // of the bounding box, from the file's own vertices
    Point<3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);)
      if (Point<3> p; std::sscanf(line.c_str(), "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3)
        for (int k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], p[k]);
          high[k] = std::max(high[k], p[k]);
        }
    extent = length<3>(difference<3>(high, low));
    const Mesh<3> m = engine<3>().mesh(geometry::Shape3(Solid{file}), test::constant<3>(0.04 * extent));
    test::expect_consistent(m);
    EXPECT_GT(test::smallest_angle(m), 1) << name;
    for (const Face<3>& face : m.boundary)
      for (const Index v : face.vertices) {
        Status status;
        const double none[3] = {};
        EXPECT_NEAR(surface->at(m.points[v].data(), none, status).value, 0, 1e-6 * extent) << name;
      }
  }
}

TEST(SolidErrors, NameWhatIsWrongWithTheFile) {
  EXPECT_THAT(
      test::input_error_of([] { engine<3>().mesh(geometry::Shape3(Solid{"/none.off"}), test::constant<3>(1)); }),
      HasSubstr("/none.off: no such surface file"));
  EXPECT_THAT(complaint(TemporaryFile("text.off", "no surface")), HasSubstr("line 1: found 'no', expected 'OFF'"));
  EXPECT_THAT(complaint(TemporaryFile("cube.xyz", cube(0, 1).off())), HasSubstr("expected OFF, OBJ, STL or PLY"));
  EXPECT_THAT(complaint(TemporaryFile("empty.off", "OFF\n0 0 0\n")), HasSubstr("expected"));
  EXPECT_THAT(complaint(TemporaryFile("line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n2 0 1\n")),
              HasSubstr("face 0 has 2 vertices"));
  EXPECT_THAT(complaint(TemporaryFile("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")), HasSubstr("expected"));
}

TEST(SolidErrors, APlyFileWithAPropertyBeforeItsElement) {
  EXPECT_THAT(complaint(TemporaryFile("crash.ply",
                                      "ply\nformat ascii 1.0\nproperty float x\nelement face 1\n"
                                      "property list uchar int vertex_indices\nend_header\n3 0 1 2\n")),
              HasSubstr("line 3: a property before any element"));
}

TEST(SolidErrors, NameCountsThatTheFileCannotHold) {
  for (const char* header : {"OFF\n2000000000 1", "COFF\n# a\n\n1 2000000000"})
    EXPECT_THAT(complaint(TemporaryFile("counts.off", header + std::string(" 0\n0 0 0\n"))),
                HasSubstr("bytes of the file can hold"));
}

TEST(SolidErrors, NameWhatIsWrongWithTheSurface) {
  Surface open = cube(0, 1);
  open.triangles.pop_back();
  EXPECT_THAT(complaint(TemporaryFile("open.off", open.off())), AllOf(HasSubstr("not closed"), HasSubstr("3 border")));
  Surface two = cube(0, 1);
  two.add(cube(2, 3));
  EXPECT_THAT(complaint(TemporaryFile("two.off", two.off())), HasSubstr("2 components"));
  Surface crossing = cube(0, 1);
  crossing.add(cube(0.5, 1.7));
  EXPECT_THAT(complaint(TemporaryFile("crossing.off", crossing.off())), HasSubstr("intersects itself"));
}

TEST(SolidErrors, AnInterruptEndsTheMeshingInItsQueriesToo) {
  const TemporaryFile file("cube.off", cube(0, 1).off());
  // Between the sizes at points of their own, the last one is asked for again: to see whether to go on.
  const auto repetitions = [&](int last) {
    Point<3> before{infinity, infinity, infinity};
    int count = 0;
    const auto size = [&](const Point<3>& p) {
      count += p == std::exchange(before, p);
      if (count > last) throw Error(Exit::interrupted, "interrupted");
      return 0.2;
    };
    engine<3>().mesh(geometry::Shape3(Solid{file.path()}), size);
    return count;
  };
  const int all = repetitions(std::numeric_limits<int>::max());
  EXPECT_GT(all, 100);
  for (const int last : {0, all / 2, all - 1}) {
    try {
      repetitions(last);
      ADD_FAILURE() << "not interrupted after " << last << " of " << all;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::interrupted);
    }
  }
}

Surface walls(double thickness) { return cube(0, 1).add(cube(thickness, 1 - thickness)); }

Surface needle(double thickness) {
  return {{{0, 0, 0}, {1, 0, 0}, {0, thickness, 0}, {0, 0, thickness}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

TEST(Solid, SharpEdgesMayBeMuchCloserThanTheSize) {
  for (const auto& [name, surface, volume] :
       {Named{"walls", walls(0.05), 1 - 0.729}, Named{"needle", needle(0.04), 0.0016 / 6}}) {
    SCOPED_TRACE(name);
    const Mesh<3> m = mesh(TemporaryFile("close.off", surface.off()), 0.3);
    test::expect_consistent(m);
    EXPECT_NEAR(test::volume(m), volume, 1e-9 * volume);
  }
}

TEST(SolidErrors, TellOfSharpEdgesTooCloseForTheSize) {
  for (const double thickness : {1e-3, 1e-4, 1e-7}) {
    const std::string found = fmt::format("{:.3g} apart", std::sqrt(2) * thickness);  // of the nearest parallel edges
    EXPECT_THAT(complaint(TemporaryFile("walls.off", walls(thickness).off())),
                AllOf(HasSubstr("walls.off"), HasSubstr(found), HasSubstr("where the size is 0.3; expected")));
  }
  EXPECT_THAT(complaint(TemporaryFile("needle.off", needle(1e-3).off())),
              AllOf(HasSubstr("needle.off"), HasSubstr("apart near"), HasSubstr("where the size is 0.3; expected")));
}

TEST(SolidErrors, AnInterruptEndsTheProtectionOfSharpEdges) {
  const TemporaryFile file("needle.off", needle(0.016).off());
  constexpr long enough = 5000;
  long asked = 0, after = 0;
  const auto size = [&](const Point<3>&) {
    after += asked >= enough;
    if (++asked >= enough) throw Error(Exit::interrupted, "interrupted");
    return 0.3;
  };
  try {
    engine<3>().mesh(geometry::Shape3(Solid{file.path()}), size);
    ADD_FAILURE() << "not interrupted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::interrupted);
  }
  EXPECT_EQ(after, 0) << "it went on";
}

}  // namespace
}  // namespace signorini
