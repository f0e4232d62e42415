#include "core/mesh/structured.hpp"

#include "mesh_checks.hpp"

namespace signorini {
namespace {

using test::area;
using test::input_error_of;
using testing::AllOf;
using testing::HasSubstr;

TEST(Structured, RectangleOfOneCellIsCutByTheRightDiagonal) {
  const Mesh<2> mesh = rectangle({0, 0}, {2, 1}, {1, 1});
  EXPECT_EQ(mesh.points, (std::vector<Point<2>>{{0, 0}, {2, 0}, {0, 1}, {2, 1}}));
  ASSERT_EQ(mesh.elements.size(), 2u);
  for (const auto& element : mesh.elements) {
    EXPECT_THAT(element, testing::Contains(0));
    EXPECT_THAT(element, testing::Contains(3));
  }
}

TEST(Structured, RectangleHasCountsVolumeAndParts) {
  const Mesh<2> mesh = rectangle({-1, 2}, {2, 4}, {5, 3});
  test::expect_consistent(mesh);
  EXPECT_EQ(mesh.points.size(), 6u * 4u);
  EXPECT_EQ(mesh.elements.size(), 2u * 15u);
  EXPECT_EQ(mesh.boundary.size(), 16u);
  EXPECT_NEAR(test::volume(mesh), 6, 1e-13);
  EXPECT_NEAR(area(mesh, "left"), 2, 1e-13);
  EXPECT_NEAR(area(mesh, "right"), 2, 1e-13);
  EXPECT_NEAR(area(mesh, "bottom"), 3, 1e-13);
  EXPECT_NEAR(area(mesh, "top"), 3, 1e-13);
}

TEST(Structured, BoxHasCountsVolumeAndParts) {
  const Mesh<3> mesh = box({0, 0, 0}, {2, 3, 5}, {2, 3, 4});
  test::expect_consistent(mesh);
  EXPECT_EQ(mesh.points.size(), 3u * 4u * 5u);
  EXPECT_EQ(mesh.elements.size(), 6u * 24u);
  EXPECT_EQ(mesh.boundary.size(), 4u * (6u + 8u + 12u));
  EXPECT_NEAR(test::volume(mesh), 30, 1e-12);
  for (const auto& [name, direction, at, measure] : {std::tuple{"left", 0, 0.0, 15.0},
                                                     {"right", 0, 2.0, 15.0},
                                                     {"front", 1, 0.0, 10.0},
                                                     {"back", 1, 3.0, 10.0},
                                                     {"bottom", 2, 0.0, 6.0},
                                                     {"top", 2, 5.0, 6.0}}) {
    EXPECT_NEAR(area(mesh, name), measure, 1e-12) << name;
    for (const Index f : faces_of(mesh, name, "test"))
      for (const Index v : mesh.boundary[f].vertices) EXPECT_EQ(mesh.points[v][direction], at) << name;
  }
}

TEST(Structured, VerticesAreNumberedLexicographically) {
  const Mesh<3> mesh = box({0, 0, 0}, {1, 1, 1}, {2, 3, 4});
  EXPECT_TRUE(std::ranges::is_sorted(mesh.points, [](const Point<3>& a, const Point<3>& b) {
    return std::tuple(a[2], a[1], a[0]) < std::tuple(b[2], b[1], b[0]);
  }));
}

TEST(Structured, EndsAreMetExactly) {
  const Mesh<2> mesh = rectangle({0.1, 0.1}, {0.7, 0.9}, {7, 3});
  EXPECT_EQ(mesh.points.front(), (Point<2>{0.1, 0.1}));
  EXPECT_EQ(mesh.points.back(), (Point<2>{0.7, 0.9}));
}

TEST(Structured, BadInputNamesTheKeyAndTheValue) {
  const double nan = std::nan("");
  EXPECT_THAT(input_error_of([] {
                rectangle({0, 0}, {1, 0}, {1, 1});
              }),
              AllOf(HasSubstr("'from'"), HasSubstr("[1, 0]")));
  EXPECT_THAT(input_error_of([&] { rectangle({nan, 0}, {1, 1}, {1, 1}); }), HasSubstr("nan"));
  EXPECT_THAT(input_error_of([] { rectangle({0, 0}, {infinity, 1}, {1, 1}); }), HasSubstr("inf"));
  EXPECT_THAT(input_error_of([] {
                box({0, 0, 0}, {1, 1, 1}, {1, 0, 1});
              }),
              AllOf(HasSubstr("cells"), HasSubstr("[1, 0, 1]")));
  EXPECT_THAT(input_error_of([] { box({0, 0, 0}, {1, 1, 1}, {2000, 2000, 2000}); }), HasSubstr("numbered"));
  EXPECT_THAT(input_error_of([] { rectangle({1, 0}, {1 + 1e-15, 1}, {100, 1}); }), HasSubstr("rounding"));
}

}  // namespace
}  // namespace signorini
