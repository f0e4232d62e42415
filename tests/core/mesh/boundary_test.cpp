#include "core/mesh/boundary.hpp"

#include "core/mesh/structured.hpp"
#include "mesh_checks.hpp"

namespace signorini {
namespace {

using test::input_error_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Boundary, NormalsOfABoxPointOutwards) {
  const Mesh<3> mesh = box({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  int k = 0;
  for (const char* name : {"left", "right", "front", "back", "bottom", "top"}) {
    for (const Index f : faces_of(mesh, name, "test")) {
      const Point<3> n = test::area_vector(mesh, mesh.boundary[f]);
      EXPECT_DOUBLE_EQ(n[k / 2], k % 2 == 0 ? -0.125 : 0.125) << name;
    }
    ++k;
  }
}

TEST(Boundary, IsTheHoleToo) {
  std::vector<std::array<Index, 3>> ring;  // around a triangular hole
  for (Index i = 0; i < 3; ++i) {
    const Index j = (i + 1) % 3;
    ring.push_back({i, 3 + i, 3 + j});
    ring.push_back({i, 3 + j, j});
  }
  EXPECT_EQ(find_boundary<2>(6, ring).size(), 6u);
}

TEST(Boundary, GroupsBecomePartsWhateverTheOrderOfTheirVertices) {
  Mesh<3> mesh = box({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  mesh.parts.clear();
  FaceGroup<3> top{"lid", {}}, inner{"inner", {{0, 1, 7}}};
  for (const Face<3>& face : mesh.boundary)
    if (std::ranges::all_of(face.vertices, [](Index v) { return v >= 4; }))
      top.faces.push_back({face.vertices[2], face.vertices[0], face.vertices[1]});
  top.faces.push_back(top.faces[0]);  // twice
  top.faces.push_back({0, 1, 7});     // inside
  attach_parts(mesh, {top, inner});
  ASSERT_EQ(mesh.parts.size(), 1u);
  EXPECT_EQ(mesh.parts[0].name, "lid");
  EXPECT_EQ(mesh.parts[0].faces.size(), 2u);
  EXPECT_DOUBLE_EQ(test::area(mesh, "lid"), 1);
}

TEST(Boundary, GroupsOfOneNameAreJoined) {
  Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {1, 1});
  mesh.parts.clear();
  attach_parts<2>(mesh, {{"a", {{0, 1}}}, {"b", {{1, 3}}}, {"a", {{2, 0}}}});
  ASSERT_EQ(mesh.parts.size(), 2u);
  EXPECT_EQ(mesh.parts[0].faces.size(), 2u);
}

TEST(Boundary, AllFacesAnswerToBoundaryUnlessAPartHasThatName) {
  Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {1, 1});
  EXPECT_THAT(faces_of(mesh, "boundary", "test"), ElementsAre(0, 1, 2, 3));
  mesh.parts.push_back({"boundary", {2}});
  EXPECT_THAT(faces_of(mesh, "boundary", "test"), ElementsAre(2));
}

TEST(Boundary, UnknownPartNamesTheNearestAndAll) {
  const Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {1, 1});
  EXPECT_THAT(input_error_of([&] { faces_of(mesh, "botom", "scene.toml:3: fix.0.on"); }),
              AllOf(HasSubstr("scene.toml:3: fix.0.on"), HasSubstr("did you mean 'bottom'"),
                    HasSubstr("boundary, left, right, bottom, top")));
}

}  // namespace
}  // namespace signorini
