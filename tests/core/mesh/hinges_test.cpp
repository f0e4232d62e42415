#include "core/mesh/hinges.hpp"
#include "core/mesh/hanging.hpp"

#include "core/mesh/build.hpp"
#include "core/mesh/structured.hpp"
#include "mesh_checks.hpp"

namespace signorini {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

template <int D>
Mesh<D> mesh_of(std::vector<Point<D>> points, std::vector<Simplex<D>> elements) {
  for (auto& e : elements)
    if (relative_volume<D>(corners<D>(points, e)) < 0) flip<D>(e);
  return build_mesh<D>(
      {.points = std::move(points), .elements = std::move(elements), .middle = {}, .label = {}, .groups = {}}, "test");
}

/// Numbers of hanging vertices.
template <int D>
std::vector<Index> hanging(const Mesh<D>& mesh) {
  std::vector<Index> numbers;
  for (const HangingVertex& h : find_hanging_vertices(mesh)) numbers.push_back(h.vertex);
  return numbers;
}

template <int D>
void expect_sound(const Mesh<D>& mesh) {
  EXPECT_THAT(find_hinges(mesh).vertices, IsEmpty());
  EXPECT_THAT(find_hinges(mesh).edges, IsEmpty());
  EXPECT_THAT(hanging(mesh), IsEmpty());
}

TEST(Joints, SoundMeshesHaveNeitherHingesNorHangingVertices) {
  for (const double size : {1e-150, 1.0, 1e150}) {
    expect_sound(rectangle({0, 0}, {size, 2 * size}, {5, 3}));
    expect_sound(box({0, 0, 0}, {size, size, size}, {3, 2, 4}));
  }
}

TEST(Joints, TrianglesThatShareAVertexOnlyHaveAHinge) {
  const Mesh<2> mesh = mesh_of<2>({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}}, {{0, 1, 2}, {2, 3, 4}});
  EXPECT_THAT(find_hinges(mesh).vertices, ElementsAre(2));
  EXPECT_THAT(hanging(mesh), IsEmpty());
}

TEST(Joints, TetrahedraThatShareAVertexOrAnEdgeOnlyHaveAHinge) {
  const std::vector<Point<3>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {-1, -1, 0}, {-1, 0, -1}};
  const Hinges vertex = find_hinges(mesh_of<3>(points, {{0, 1, 2, 3}, {0, 4, 5, 6}}));
  EXPECT_THAT(vertex.vertices, ElementsAre(0));
  EXPECT_THAT(vertex.edges, IsEmpty());
  const Hinges edge = find_hinges(mesh_of<3>({points.begin(), points.begin() + 6}, {{0, 1, 2, 3}, {0, 3, 4, 5}}));
  EXPECT_THAT(edge.vertices, IsEmpty());
  EXPECT_THAT(edge.edges, ElementsAre(std::array<Index, 2>{0, 3}));
}

/// Two pyramids of removed tetrahedra meet at the centre of a cube: its boundary touches itself, its elements do not
/// hang by the vertex.
TEST(Joints, CavitiesThatMeetAtAVertexAreNoHinge) {
  Mesh<3> cube = box({-1, -1, -1}, {1, 1, 1}, {2, 2, 2});
  const auto centre = static_cast<Index>(std::ranges::find(cube.points, Point<3>{}) - cube.points.begin());
  ASSERT_LT(centre, cube.vertices());
  const auto tip = [&](const Simplex<3>& e, double sign) {
    double x = 0;
    for (const Index v : e) x += sign * (cube.points[v][0] + 0.4 * cube.points[v][1] + 0.2 * cube.points[v][2]);
    return std::ranges::count(e, centre) ? x : -1;
  };
  for (const double sign : {1.0, -1.0}) {
    const auto farthest = std::ranges::max_element(cube.elements, {}, [&](const auto& e) { return tip(e, sign); });
    cube.elements.erase(farthest);
  }
  expect_sound(mesh_of<3>(cube.points, cube.elements));
}

TEST(Joints, AVertexInsideAnEdgeHangs) {
  const Mesh<2> mesh = mesh_of<2>({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}}, {{0, 1, 2}, {0, 4, 3}, {4, 2, 3}});
  ASSERT_THAT(hanging(mesh), ElementsAre(4));
  const HangingVertex found = find_hanging_vertices(mesh)[0];
  EXPECT_THAT(mesh.boundary[found.face].vertices, testing::UnorderedElementsAre(0, 2));
}

TEST(Joints, AVertexNearAnEdgeHangsWithinRoundingOnly) {
  for (const double size : {1e-150, 1.0, 1e150})
    for (const double gap : {0.0, 1e-10, -1e-10, 1e-7}) {
      const double s = size, m = size * (0.3 + gap);
      const Mesh<2> mesh =
          mesh_of<2>({{0, 0}, {s, 0}, {s, s}, {0, s}, {0.3 * s, m}}, {{0, 1, 2}, {0, 4, 3}, {4, 2, 3}});
      EXPECT_EQ(hanging(mesh).size(), gap == 1e-7 ? 0 : 1) << size << ' ' << gap;
    }
}

/// A large tetrahedron on a face that the other side has divided into three, or along an edge into two.
TEST(Joints, AVertexInsideAFaceOrOnItsEdgeHangs) {
  const Point<3> a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, below{0.2, 0.2, -1}, above{0.3, 0.3, 1};
  const Mesh<3> inside =
      mesh_of<3>({a, b, c, below, above, {0.25, 0.5, 0}}, {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 5, 4}, {2, 0, 5, 4}});
  EXPECT_THAT(hanging(inside), ElementsAre(5));
  const Mesh<3> on_edge =
      mesh_of<3>({a, b, c, below, above, {0.5, 0.5, 0}}, {{0, 1, 2, 3}, {0, 1, 5, 4}, {2, 0, 5, 4}});
  EXPECT_THAT(hanging(on_edge), ElementsAre(5));
}

/// The two sides of a slit have vertices in the same places: nothing hangs.
TEST(Joints, ASlitIsNoTear) {
  const Mesh<2> mesh = mesh_of<2>(
      {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 0}, {0, -1}, {2, 1}, {2, -1}, {-1, 0}, {3, 0}},
      {{0, 1, 3}, {0, 5, 4}, {1, 2, 6}, {1, 6, 3}, {4, 7, 2}, {4, 5, 7}, {8, 5, 0}, {8, 0, 3}, {2, 7, 9}, {2, 9, 6}});
  expect_sound(mesh);
}

}  // namespace
}  // namespace signorini
