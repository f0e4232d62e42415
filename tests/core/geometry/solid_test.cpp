#include <cstdlib>

#include "geometry_checks.hpp"
#include "surfaces.hpp"

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
  return engine().mesh(geometry::Shape3(Solid{file.path()}), test::constant<3>(h));
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
    for (const Surface& s : {surface, surface.turned(0.7, 0.3)})
      for (const double h : {0.412, 0.388}) {
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

// Their vertices lie on one sphere, and four at a time in planes.
TEST(Solid, SymmetricSolidsAreFilledAtAnySize) {
  for (const auto& [name, surface, volume] : {Named{"octahedron", octahedron(), 4.0 / 3}, {"cube", cube(-1, 1), 8}})
    for (const Surface& s : {surface, surface.turned(0.7, 0.3)})
      for (const double h : {3.0, 1.5, 1.0, 0.7, 0.5, 0.35}) {
        SCOPED_TRACE(fmt::format("{}, size {}", name, h));
        const Mesh<3> m = mesh(TemporaryFile("solid.off", s.off()), h);
        test::expect_consistent(m);
        EXPECT_NEAR(test::volume(m), volume, 1e-9 * volume);
        EXPECT_GT(test::smallest_angle(m), 1);
      }
}

TEST(Solid, RealSurfacesAreFilled) {
  const char* folder = std::getenv("SIGNORINI_MESHES");
  if (!folder) GTEST_SKIP() << "SIGNORINI_MESHES does not name a folder with spot.obj, fandisk.obj and rocker-arm.obj";
  for (const char* name : {"spot.obj", "fandisk.obj", "rocker-arm.obj"}) {
    const std::string file = std::string(folder) + "/" + name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
    const auto surface = engine().surface(file);
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
    const Mesh<3> m = engine().mesh(geometry::Shape3(Solid{file}), test::constant<3>(0.04 * extent));
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
  EXPECT_THAT(test::input_error_of([] { engine().mesh(geometry::Shape3(Solid{"/none.off"}), test::constant<3>(1)); }),
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
    engine().mesh(geometry::Shape3(Solid{file.path()}), size);
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
    engine().mesh(geometry::Shape3(Solid{file.path()}), size);
    ADD_FAILURE() << "not interrupted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::interrupted);
  }
  EXPECT_EQ(after, 0) << "it went on";
}

}  // namespace
}  // namespace signorini
