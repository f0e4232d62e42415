// From shapes and files of a scene to coarsest meshes, their symmetry, and what is odd about them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/refine.hpp"
#include "driver/scene/coarse_mesh.hpp"
#include "driver/scene/halved_shape.hpp"
#include "driver/scene/mesh_warnings.hpp"
#include "driver/scene/symmetry.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// What a refusal says; empty: none.
template <class Work>
std::string complaint(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml", "."); }

/// A scene whose bodies are symmetric about these planes.
Scene symmetric(std::vector<Mirror> planes, Scene::BodyShape shape) {
  Scene out;
  out.bodies.emplace_back().name = "body";
  out.bodies[0].shape = std::move(shape);
  out.symmetry.planes = std::move(planes);
  out.symmetry.source.table = "symmetry";
  return out;
}
template <class Shape>
Shape halved(const Shape& shape, std::vector<Mirror> planes) {
  const Scene scene = symmetric(std::move(planes), shape);
  return std::get<Shape>(halved_shape(scene, scene.bodies[0]));
}

TEST(HalvedShape, OfABlockIsTheSideOfTheLargerCoordinates) {
  const Scene::Block<3> block{{-1, 2, 0}, {3, 6, 1}, {5, 4, 2}};
  const auto half = halved(block, {{0, 1}, {1, 4}});
  EXPECT_EQ(half.from, (Point<3>{1, 4, 0}));
  EXPECT_EQ(half.to, block.to);
  EXPECT_EQ(half.cells, (std::array<Index, 3>{3, 2, 2}));  // no larger ones
  EXPECT_EQ(halved(block, {{0, 3}}).from, block.from);     // it is on one side already
  EXPECT_EQ(halved(block, {{0, -1}}).from, block.from);
  EXPECT_THAT(complaint([&] {
                halved(block, {{0, 0}});
              }),
              AllOf(HasSubstr("symmetry"), HasSubstr("'body'"), HasSubstr("x = 1")));
}

TEST(HalvedShape, OfRoundShapesIsCutAtTheCentre) {
  const geometry::Disk disk = halved(geometry::Disk{{1, 2}, 0.5}, {{0, 1}, {1, 2}});
  EXPECT_TRUE(disk.right_half && disk.upper_half && !disk.lower_half);
  const geometry::Disk lower = halved(geometry::Disk{{1, 2}, 0.5, true}, {{1, 2}});
  EXPECT_TRUE(lower.lower_half && !lower.upper_half);  // on one side already
  const geometry::Ball ball = halved(geometry::Ball{{0, 0, 3}, 1}, {{0, 0}, {2, 3}});
  EXPECT_EQ(ball.halved, (geometry::Halved{true, false, true}));
  const geometry::Cylinder cylinder = halved(geometry::Cylinder{{0, 0, 0}, 1, 4}, {{1, 0}, {2, 2}});
  EXPECT_EQ(cylinder.halved, (geometry::Halved{false, true, false}));
  EXPECT_NE(complaint([] { halved(geometry::Cylinder{{0, 0, 0}, 1, 4}, {{2, 1}}); }), "");
  EXPECT_NE(complaint([] { halved(geometry::Disk{{1, 2}, 0.5}, {{0, 1.1}}); }), "");
}

double area(const geometry::Polygon& polygon) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.points.size(); ++k) {
    const Point<2>&a = polygon.points[k], &b = polygon.points[(k + 1) % polygon.points.size()];
    sum += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return sum;
}

// Two of the hexagon's corners are on one plane, two edges across the other; edges keep the numbers of their names.
TEST(HalvedShape, OfAPolygonHasHalfItsAreaAndTheNamesOfItsEdges) {
  geometry::Polygon hexagon;
  for (int k = 0; k < 6; ++k)
    hexagon.points.push_back({std::cos(k * std::numbers::pi / 3), std::sin(k * std::numbers::pi / 3)});
  for (const int axis : {0, 1}) {
    const geometry::Polygon half = halved(hexagon, {{axis, 0}});
    EXPECT_NEAR(area(half), area(hexagon) / 2, 1e-14);
    EXPECT_EQ(half.points.size(), axis == 0 ? 5u : 4u);
    EXPECT_EQ(std::ranges::count(half.edges, -1), 1);  // that on the plane has no name
    for (std::size_t k = 0; k < half.points.size(); ++k) {
      EXPECT_GE(half.points[k][axis], 0);
      if (half.edges[k] < 0) continue;
      const Point<2>&a = hexagon.points[half.edges[k]], &b = hexagon.points[(half.edges[k] + 1) % 6];
      const Point<2>& p = half.points[k];
      EXPECT_NEAR((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]), 0, 1e-14) << "off its edge";
    }
  }
  hexagon.points[1][0] += 0.1;
  EXPECT_NE(complaint([&] { halved(hexagon, {{1, 0}}); }), "");
}

TEST(CoarseMesh, KnowsItsDimension) {
  EXPECT_EQ(
      dimension_of(scene_of(tables::block("b", "[0, 0]", "[1, 1]", "[1, 1]") + tables::fix("b", "top", "[0, 0]"))), 2);
  EXPECT_EQ(dimension_of(scene_of(tables::block("b", "[0, 0, 0]", "[1, 1, 1]", "[1, 1, 1]") +
                                  tables::fix("b", "top", "[0, 0, 0]"))),
            3);
}

TEST(CoarseMesh, IsStructuredForBlocksAndHalvedBySymmetry) {
  const std::string text = tables::block("b", "[-1, 0]", "[1, 3]", "[4, 6]") + tables::fix("b", "top", "[0, 0]");
  const Progress quiet;
  const Mesh<2> whole = coarsest_mesh<2>(scene_of(text), 0, 2, nullptr, quiet);
  EXPECT_EQ(whole.elements.size(), 48u);
  EXPECT_TRUE(whole.mirrors.empty());
  const Mesh<2> half = coarsest_mesh<2>(scene_of(text + "[symmetry]\nx = 0\n"), 0, 2, nullptr, quiet);
  EXPECT_EQ(half.elements.size(), 24u);
  ASSERT_EQ(half.mirrors.size(), 1u);
  EXPECT_EQ(half.mirrors[0].axis, 0);
  for (const Point<2>& x : half.points) EXPECT_GE(x[0], 0);
  for (const Face<2>& face : half.boundary)  // the body goes on beyond the plane
    EXPECT_FALSE(half.points[face.vertices[0]][0] == 0 && half.points[face.vertices[1]][0] == 0);
}

class MeshFiles : public Folder {
 protected:
  /// Four triangles of a square: groups of elements and of faces.
  std::string mesh() {
    const auto file = folder_ / "square.msh";
    std::ofstream(file) << R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
1 1 "ground"
1 2 "inner"
2 3 "hard"
2 4 "soft"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0.5 0.5 0
$EndNodes
$Elements
6
1 1 2 1 1 1 2
2 1 2 2 1 1 5
3 2 2 3 1 1 2 5
4 2 2 4 1 2 3 5
5 2 2 4 1 3 4 5
6 2 2 3 1 4 1 5
$EndElements
)";
    return "[[body]]\nname = \"b\"\nmesh = \"" + file.string() + "\"\norder = 1\nyoung = 1\npoisson = 0.3\n";
  }
};

TEST_F(MeshFiles, GiveMeshesWithMaterialsAndWarnings) {
  const Scene scene = scene_of(mesh() + "[[material]]\nbody = \"b\"\nvolume = \"soft\"\nyoung = 7\npoisson = 0.2\n" +
                               tables::fix("b", "ground", "[0, 0]"));
  Warnings warnings;
  const Mesh<2> found = coarsest_mesh<2>(scene, 0, 2, &warnings, Progress());
  EXPECT_EQ(found.elements.size(), 4u);
  EXPECT_EQ(std::ranges::count(found.region, 0), 2);
  EXPECT_EQ(std::ranges::count(found.region, -1), 2);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].id, "group-inside");
  EXPECT_THAT(warnings[0].text, HasSubstr("'inner'"));
}

TEST_F(MeshFiles, RefuseGroupsThatAreNoBoundary) {
  const auto told = [&](const std::string& part) {
    const Scene scene = scene_of(mesh() + tables::fix("b", part, "[0, 0]"));
    return complaint([&] { coarsest_mesh<2>(scene, 0, 2, nullptr, Progress()); });
  };
  EXPECT_EQ(told("ground"), "");
  EXPECT_THAT(told("soft"), AllOf(HasSubstr("fix"), HasSubstr("group of triangles"), HasSubstr("ground")));
  EXPECT_THAT(told("inner"), HasSubstr("on the boundary"));
}

/// Their kinds and texts.
template <int D>
std::vector<std::string> told(const Mesh<D>& mesh) {
  std::vector<std::string> out;
  for (const Warning& w : mesh_warnings(mesh, {}, "scene.toml:2: body.0"))
    out.push_back(std::string(w.id) + "|" + w.text);
  return out;
}

TEST(MeshWarnings, TellHingesAndTears) {
  EXPECT_TRUE(told(cube<2>(0, 1, 2)).empty());
  EXPECT_TRUE(told(cube<3>(0, 1, 2)).empty());
  Mesh<2> hinge;  // two triangles that share a corner
  hinge.points = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  hinge.elements = {{0, 1, 2}, {0, 3, 4}};
  for (Index e = 0; e < 2; ++e)
    for (int k = 0; k < 3; ++k) hinge.boundary.push_back({outward_face<2>(hinge.elements[e], k), e});
  EXPECT_THAT(told(hinge), testing::ElementsAre(AllOf(testing::StartsWith("hinge|scene.toml:2: body.0"),
                                                      HasSubstr("vertex at (0, 0)"))));
  Mesh<2> torn;  // the vertex 4 lies in the middle of an edge of the first triangle
  torn.points = {{0, 0}, {1, 0}, {0.5, 1}, {0.5, -1}, {0.5, 0}};
  torn.elements = {{0, 1, 2}, {0, 3, 4}, {3, 1, 4}};
  torn.boundary = {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 0}, 0}, {{0, 3}, 1}, {{3, 1}, 2}, {{1, 4}, 2}, {{4, 0}, 1}};
  EXPECT_THAT(told(torn), testing::Contains(AllOf(testing::StartsWith("torn|"), HasSubstr("(0.5, 0)"))));
}

/// The right half of [-1, 1] x [0, 1].
Mesh<2> right_half() {
  Mesh<2> out = rectangle({0, 0}, {1, 1}, {2, 2});
  add_mirror(out, {0, 0}, "symmetry");
  remove_faces_on_mirrors(out);
  return out;
}

Selection where(std::function<double(const double*)> f, std::optional<std::string> part = {}) {
  return {std::move(part), field(std::move(f)), "fix.0"};
}

TEST(Symmetry, ConditionsGoOnBeyondPlanesTheyTouch) {
  const Mesh<2> mesh = right_half();
  Model<2> model;
  model.fixes = {{on("top"), {Field(0), Field(0)}},
                 {on("right"), {Field(0), Field(0)}},
                 {where([](const double* x) { return x[1] == 1; }), {Field(0), Field(0)}},
                 {where([](const double* x) { return x[0] == 1; }), {Field(0), Field(0)}}};
  model.loads = {{{}, {Field(0), Field(-1)}}};
  const ConditionsAcross across = conditions_across<2, 2>(Nodes<2>(mesh), model);
  EXPECT_EQ(across.fixes, (std::vector<Planes>{1, 0, 1, 0}));
  EXPECT_EQ(across.loads, std::vector<Planes>{1});
  // An expression that holds at the images, too.
  model.fixes[2].on = where([](const double* x) { return x[1] == 1; }, "boundary");
  model.fixes[3].on = where([](const double* x) { return x[1] == 1 && x[0] > -0.6; });
  EXPECT_THAT(complaint([&] { conditions_across<2, 2>(Nodes<2>(mesh), model); }), HasSubstr("x = 0"));
  model.fixes.pop_back();
  EXPECT_EQ((conditions_across<2, 2>(Nodes<2>(mesh), model).fixes), (std::vector<Planes>{1, 0, 1}));
  EXPECT_EQ(all_planes(mesh), 1u);
  EXPECT_EQ(all_planes(rectangle({0, 0}, {1, 1}, {1, 1})), 0u);
}

TEST(Symmetry, AsymmetricConditionsAreRefused) {
  const MeshHierarchy<2> meshes = hierarchy(right_half(), 1);
  Model<2> model;
  model.young = field([](const double* x) { return 1 + x[0] * x[0]; });
  model.loads = {
      {on("top"), {field([](const double* x) { return x[0]; }), field([](const double* x) { return -x[0] * x[0]; })}}};
  EXPECT_EQ(complaint([&] { check_symmetry<2, 2>(meshes, model); }), "");
  Model<2> other = model;
  other.young = field([](const double* x) { return 2 + x[0]; });
  EXPECT_NE(complaint([&] { check_symmetry<2, 2>(meshes, other); }), "");
  other = model;
  other.loads[0].value[0] = 1;  // to the right on both sides
  EXPECT_NE(complaint([&] { check_symmetry<2, 2>(meshes, other); }), "");
  other.loads[0].on = on("right");  // which does not go on: there is one on the left
  EXPECT_EQ(complaint([&] { check_symmetry<2, 2>(meshes, other); }), "");
  other = model;
  other.obstacles = {{plane<2>({}, {0, 1}), on("bottom"), "obstacle.0"}};
  EXPECT_EQ(complaint([&] { check_symmetry<2, 2>(meshes, other); }), "");
  other.obstacles = {{plane<2>({}, {0.6, 0.8}), on("bottom"), "obstacle.0"}};
  EXPECT_THAT(complaint([&] { check_symmetry<2, 2>(meshes, other); }), HasSubstr("obstacle.0"));
  const ConditionsAcross across = conditions_across<2, 2>(Nodes<2>(meshes.finest()), other);
  EXPECT_NE(complaint([&] { refuse_asymmetric<2, 2>(meshes.finest(), other, across); }), "");
  EXPECT_EQ(complaint([&] { check_symmetry<2, 2>(hierarchy(rectangle({0, 0}, {1, 1}, {2, 2}), 1), other); }), "");
}

TEST(Symmetry, TotalsOfTheWholeCancelAcrossPlanes) {
  const std::vector<Mirror> mirrors{{0, 0}, {2, 1}};
  const Whole all(mirrors, 3), one(mirrors, 2), none(mirrors, 0);
  EXPECT_EQ(all.copies(), 4);
  EXPECT_EQ(one.copies(), 2);
  EXPECT_EQ(none.copies(), 1);
  EXPECT_TRUE(all.cancels(0) && !all.cancels(1) && all.cancels(2));
  EXPECT_FALSE(one.cancels(0));
  EXPECT_EQ(all.total(std::array<double, 3>{1, 2, 3}), (std::array<double, 3>{0, 8, 0}));
  EXPECT_EQ(one.total(std::array<double, 3>{1, 2, 3}), (std::array<double, 3>{2, 4, 0}));
  EXPECT_EQ(all.total(std::array<double, 1>{5}), (std::array<double, 1>{20}));  // a scalar knows no axes
  EXPECT_EQ(none.total(std::array<double, 3>{1, 2, 3}), (std::array<double, 3>{1, 2, 3}));
}

}  // namespace
}  // namespace signorini::test
