#include <fmt/format.h>

#include "geometry_checks.hpp"
#include "tests/support/nightly.hpp"

namespace signorini {
namespace {

using geometry::Disk;
using geometry::engine;
using geometry::Polygon;
using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;

Mesh<2> mesh(const geometry::Shape2& shape, double h) { return engine<2>().mesh(shape, test::constant<2>(h)); }

std::string complaint(const geometry::Shape2& shape, double h = 0.1) {
  return test::input_error_of([&] { mesh(shape, h); });
}

const Polygon l_shape{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};

TEST(Planar, MeshesAreConsistentAndWellShaped) {
  for (const geometry::Shape2& shape :
       {geometry::Shape2(Disk{{1, 2}, 0.7}), geometry::Shape2(Disk{{1, 2}, 0.7, true}), geometry::Shape2(l_shape)})
    for (const double h : {0.3, 0.05, 0.02}) {
      const Mesh<2> m = mesh(shape, h);
      test::expect_consistent(m);
      test::expect_on_curves(m);
      EXPECT_GT(test::smallest_angle(m), 20);
      EXPECT_NEAR(test::mean_edge(m), h, 0.15 * h);
    }
}

TEST(Planar, AreaOfDisksConvergesWithSecondOrder) {
  for (const bool half : {false, true}) {
    const double exact = pi / (half ? 2 : 1);
    double before = 0;
    for (const double h : {0.2, 0.1, 0.05}) {
      const double error = exact - test::volume(mesh(Disk{{3, -1}, 1, half}, h));
      EXPECT_GT(error, 0);
      if (before > 0) {
        EXPECT_NEAR(std::log2(before / error), 2, 0.15);
      }
      before = error;
    }
  }
}

TEST(Planar, ADiskIsAllCurved) {
  const Mesh<2> m = mesh(Disk{{0, 0}, 2}, 0.3);
  for (const auto& face : m.boundary) EXPECT_EQ(face.curve, 0);
  EXPECT_EQ(faces_of(m, "boundary", "test").size(), m.boundary.size());
}

TEST(Planar, AHalfDiskIsTheLowerHalfWithItsParts) {
  const Mesh<2> m = mesh(Disk{{0.1, 0.3}, 2, true}, 0.11);
  test::expect_parts_cover(m);
  test::expect_flat(m, "flat", 1, 0.3);
  EXPECT_NEAR(test::area(m, "flat"), 4, 1e-14);
  EXPECT_NEAR(test::area(m, "curved"), 2 * pi, 0.01);
  for (const Index f : faces_of(m, "curved", "test")) EXPECT_EQ(m.boundary[f].curve, 0);
  for (const auto& p : m.points) EXPECT_LE(p[1], 0.3);
}

TEST(Planar, PolygonsKeepTheirSidesHoweverTheyTurn) {
  Polygon clockwise = l_shape;
  std::ranges::reverse(clockwise.points);
  for (const Polygon& polygon : {l_shape, clockwise}) {
    const Mesh<2> m = mesh(polygon, 0.13);
    test::expect_parts_cover(m);
    EXPECT_NEAR(test::volume(m), 3, 1e-13);
    const std::size_t n = polygon.points.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto &a = polygon.points[i], &b = polygon.points[(i + 1) % n];
      const std::string part = "edge" + std::to_string(i);
      EXPECT_NEAR(test::area(m, part.c_str()), length<2>(difference<2>(a, b)), 1e-13);
      for (const Index f : faces_of(m, part, "test"))
        for (const Index v : m.boundary[f].vertices)
          EXPECT_NEAR(determinant<2>({difference<2>(b, a), difference<2>(m.points[v], a)}), 0, 1e-14);
    }
  }
}

TEST(Planar, SharpAnglesAndThinSidesComeToAnEnd) {
  const Mesh<2> m = mesh(Polygon{{{0, 0}, {1, 0}, {1, 0.02}}}, 0.1);
  test::expect_consistent(m);
  EXPECT_NEAR(test::volume(m), 0.01, 1e-15);
}

TEST(Planar, TheSizeFieldGradesTheMesh) {
  const auto size = [](const Point<2>& p) { return 0.01 + 0.1 * std::hypot(p[0], p[1] + 1); };
  const Mesh<2> m = engine<2>().mesh(geometry::Shape2(Disk{{0, 0}, 1}), size);
  test::expect_consistent(m);
  const auto ring = [](double from, double to) {
    return [=](const Point<2>& p) {
      const double r = std::hypot(p[0], p[1] + 1);
      return from < r && r < to;
    };
  };
  EXPECT_NEAR(test::mean_edge(m, ring(0, 0.1)), 0.015, 0.005);
  EXPECT_NEAR(test::mean_edge(m, ring(0.9, 1.1)), 0.11, 0.03);
  EXPECT_NEAR(test::mean_edge(m, ring(1.5, 2)), 0.18, 0.05);
}

TEST(Planar, SizesBeyondTheRadiusGiveTheCoarsestMesh) {
  const Mesh<2> m = mesh(Disk{{0, 0}, 1}, 100);
  test::expect_consistent(m);
  EXPECT_EQ(m.boundary.size(), 6u);
}

TEST(Planar, TheSameInputGivesTheSameMesh) {
  const auto size = [](const Point<2>& p) { return 0.02 + 0.1 * std::abs(p[0]); };
  const geometry::Shape2 shape = l_shape;
  EXPECT_TRUE(test::equal(engine<2>().mesh(shape, size), engine<2>().mesh(shape, size)));
}

TEST(Planar, AChangeOfUnitsScalesTheMesh) {
  const Mesh<2> one = mesh(Disk{{1, 2}, 1, true}, 0.1), big = mesh(Disk{{1024, 2048}, 1024, true}, 102.4);
  ASSERT_EQ(one.elements, big.elements);
}

TEST(PlanarErrors, NameWhatIsWrongWithAPolygon) {
  EXPECT_THAT(complaint(Polygon{{{0, 0}, {1, 0}}}), AllOf(HasSubstr("found 2"), HasSubstr("at least 3")));
  EXPECT_THAT(complaint(Polygon{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}), HasSubstr("edge0 and edge2 meet or cross"));
  EXPECT_THAT(complaint(Polygon{{{0, 0}, {1, 0}, {2, 0}}}), HasSubstr("one line"));
  EXPECT_THAT(complaint(Polygon{{{0, 0}, {1, 0}, {1, 1}, {1, 0}, {0, 1}}}), HasSubstr("points[1] and points[3]"));
  EXPECT_THAT(complaint(Polygon{{{0, 0}, {2, 0}, {1, 0}, {1, 1}}}), HasSubstr("edge0 and edge1 meet or cross"));
  EXPECT_THAT(complaint(Polygon{{{0, 0}, {1, 0}, {std::nan(""), 1}}}), HasSubstr("points[2]"));
}

TEST(PlanarErrors, NameWhatIsWrongWithADisk) {
  EXPECT_THAT(complaint(Disk{{0, 0}, -1}), HasSubstr("disk: radius: found -1"));
  EXPECT_THAT(complaint(Disk{{0, infinity}, 1, true}), HasSubstr("half_disk: center"));
}

TEST(PlanarErrors, NameWhatIsWrongWithTheSize) {
  for (const double h : {0.0, -1.0, std::nan(""), infinity})
    EXPECT_THAT(complaint(Disk{{0, 0}, 1}, h), AllOf(HasSubstr("size"), HasSubstr("positive")));
  EXPECT_THAT(complaint(Disk{{0, 0}, 1}, 1e-4), HasSubstr("elements"));
  EXPECT_THAT(complaint(Disk{{0, 0}, 1}, 1e-9), HasSubstr("too small for this shape"));
}

TEST(PlanarErrors, NameTheNarrowestPlaceOfAPolygonWithoutAMesh) {
  for (const double width : {1e-7, 1e-9}) {
    const std::string place = fmt::format(" is {:.3g} away from edge", 20 * width);
    for (const Polygon& narrow :
         {Polygon{{{0, 0}, {20, 0}, {20, 20 * width}}}, Polygon{{{0, 0}, {20, 0}, {20, 20 * width}, {0, 20 * width}}}})
      if (test::nightly() || (narrow.points.size() == 3) == (width == 1e-7))
        EXPECT_THAT(complaint(narrow, 6),
                    AllOf(HasSubstr("polygon: size: "), HasSubstr("come to an end: points["), HasSubstr(place)));
  }
}

TEST(Planar, ShortSidesAreNoNarrowPlaces) {
  test::expect_consistent(mesh(Polygon{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {-1e-7, 1 - 1e-7}}}, 0.3));
}

TEST(PlanarErrors, OfTheSizeComeThrough) {
  int calls = 0;
  const auto size = [&](const Point<2>&) -> double {
    if (++calls > 300) input_error("scene.toml:3", "no size here");
    return 0.05;
  };
  const auto message = test::input_error_of([&] { engine<2>().mesh(geometry::Shape2(Disk{{0, 0}, 1}), size); });
  EXPECT_EQ(message, "scene.toml:3: no size here");
}

}  // namespace
}  // namespace signorini
