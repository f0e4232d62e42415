#include "core/mesh/validate.hpp"

#include "core/mesh/build.hpp"
#include "core/mesh/structured.hpp"
#include "mesh_checks.hpp"

namespace signorini {
namespace {

using test::input_error_of;
using testing::AllOf;
using testing::HasSubstr;

template <int D>
std::string complaint(const Mesh<D>& mesh) {
  return input_error_of([&] { validate(mesh, "file.msh"); });
}

Mesh<2> square() { return rectangle({0, 0}, {1, 1}, {2, 2}); }
Mesh<3> cube() { return box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}); }

TEST(Validate, AcceptsGoodMeshesOfAnySize) {
  EXPECT_NO_THROW(validate(square(), "test"));
  EXPECT_NO_THROW(validate(cube(), "test"));
  EXPECT_NO_THROW(validate(box({0, 0, 0}, {1e-200, 1e-200, 1e-200}, {2, 1, 1}), "test"));
  EXPECT_NO_THROW(validate(box({0, 0, 0}, {1e200, 1e200, 1e200}, {2, 1, 1}), "test"));
}

TEST(Validate, RejectsAnEmptyMesh) { EXPECT_THAT(complaint(Mesh<3>{}), HasSubstr("no tetrahedra")); }

TEST(Validate, NamesVerticesThatAreNotFinite) {
  Mesh<2> mesh = square();
  mesh.points[5][1] = std::nan("");
  EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("file.msh"), HasSubstr("vertex 5"), HasSubstr("nan")));
}

TEST(Validate, NamesElementsWithUnknownOrRepeatedVertices) {
  Mesh<2> mesh = square();
  mesh.elements[3][1] = 9;
  EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("element 3"), HasSubstr("vertex 9")));
  mesh.elements[3][1] = mesh.elements[3][0];
  EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("element 3"), HasSubstr("twice")));
}

TEST(Validate, NamesDegenerateElements) {
  Mesh<3> mesh = cube();
  mesh.points[7] = {0.5, 0.5, 0};
  EXPECT_THAT(complaint(mesh), HasSubstr("is degenerate"));
  Mesh<2> needle = rectangle({0, 0}, {1, 1e-10}, {1, 1});
  EXPECT_NO_THROW(validate(needle, "test"));
  needle = rectangle({0, 0}, {1, 1e-15}, {1, 1});
  EXPECT_THAT(complaint(needle), AllOf(HasSubstr("element 0"), HasSubstr("degenerate")));
}

TEST(Validate, NamesInvertedElements) {
  Mesh<2> mesh = square();
  mesh.points[4] = {1.2, 0.9};  // the inner vertex, out of its star
  EXPECT_THAT(complaint(mesh), HasSubstr("is inverted"));
}

TEST(Validate, NamesFacesOfThreeElements) {
  Mesh<2> mesh;
  mesh.points = {{0, 0}, {1, 0}, {0, 1}, {0, -1}, {0.5, 2}};
  mesh.elements = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("element 2"), HasSubstr("more than two")));
}

TEST(Validate, NamesElementsThatOverlap) {
  Mesh<2> mesh;
  mesh.points = {{0, 0}, {1, 0}, {0, 1}, {0.5, 2}};
  mesh.elements = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("0 and 1"), HasSubstr("same side")));
}

TEST(Validate, CountsThePiecesOfADisconnectedMesh) {
  Mesh<2> mesh = square();
  for (int copy = 1; copy <= 2; ++copy) {
    const Index n = mesh.vertices();
    const Mesh<2> other = rectangle({2.0 * copy, 0}, {2.0 * copy + 1, 1}, {1, 1});
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const auto& e : other.elements) mesh.elements.push_back({e[0] + n, e[1] + n, e[2] + n});
  }
  EXPECT_THAT(complaint(mesh), AllOf(HasSubstr("disconnected"), HasSubstr("3 pieces")));
}

TEST(Validate, NamesUnusedVertices) {
  Mesh<2> mesh = square();
  mesh.points.push_back({5, 5});
  EXPECT_THAT(complaint(mesh), HasSubstr("vertex 9 belongs to no element"));
}

RawMesh<2> raw_square() {
  const Mesh<2> mesh = square();
  return {.points = mesh.points, .elements = mesh.elements, .middle = {}, .label = {}, .groups = {}};
}

TEST(Build, DropsUnusedVerticesAndKeepsGroups) {
  RawMesh<2> raw = raw_square();
  raw.points.insert(raw.points.begin() + 1, Point<2>{7, 7});
  for (auto& e : raw.elements)
    for (Index& v : e) v += v >= 1;
  raw.groups = {{"foot", {{0, 2}, {2, 3}}}, {"loose", {{0, 1}}}};
  const Mesh<2> mesh = build_mesh(raw, "test");
  test::expect_consistent(mesh);
  EXPECT_EQ(mesh.points, square().points);
  ASSERT_EQ(mesh.parts.size(), 1u);
  EXPECT_DOUBLE_EQ(test::area(mesh, "foot"), 1);
}

TEST(Build, TurnsAMeshThatIsNegativeAsAWhole) {
  RawMesh<2> raw = raw_square();
  for (auto& e : raw.elements) flip<2>(e);
  test::expect_consistent(build_mesh(raw, "test"));
}

TEST(Build, TurnsElementsOneByOne) {
  RawMesh<2> raw = raw_square();
  for (int e = 2; e < 6; ++e) flip<2>(raw.elements[e]);
  const Mesh<2> mesh = build_mesh(raw, "test");
  test::expect_consistent(mesh);
  EXPECT_DOUBLE_EQ(test::area(mesh, "boundary"), test::area(build_mesh(raw_square(), "test"), "boundary"));
}

// Turning it would not take it off its neighbours.
TEST(Build, DoesNotMendAnElementTurnedInsideOut) {
  RawMesh<2> raw = raw_square();
  raw.points[4] = {1.2, 0.9};  // the inner vertex, out of its star
  EXPECT_THAT(input_error_of([&] { build_mesh(raw, "test"); }), HasSubstr("overlap"));
}

}  // namespace
}  // namespace signorini
