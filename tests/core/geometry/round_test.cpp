#include "geometry_checks.hpp"

namespace signorini {
namespace {

using geometry::Ball;
using geometry::Cylinder;
using geometry::engine;
using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;

Mesh<3> mesh(const geometry::Shape3& shape, double h) { return engine<3>().mesh(shape, test::constant<3>(h)); }

std::string complaint(const geometry::Shape3& shape, double h = 0.1) {
  return test::input_error_of([&] { mesh(shape, h); });
}

const std::vector<geometry::Shape3> shapes{Ball{{1, 2, 3}, 1}, Ball{{1, 2, 3}, 1, true}, Cylinder{{1, 2, 3}, 1, 1.5}};

TEST(Round, MeshesAreConsistentAndWellShaped) {
  for (const auto& shape : shapes)
    for (const double h : {0.5, 0.2}) {
      const Mesh<3> m = mesh(shape, h);
      test::expect_consistent(m);
      test::expect_on_curves(m);
      EXPECT_GT(test::smallest_angle(m), 8);
      EXPECT_NEAR(test::mean_edge(m), h, 0.15 * h);
    }
}

TEST(Round, VolumesConvergeWithSecondOrder) {
  const double exact[] = {4 * pi / 3, 2 * pi / 3, 1.5 * pi};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    double first = 0, last = 0;
    for (const double h : {0.5, 0.25, 0.125}) {
      last = exact[k] - test::volume(mesh(shapes[k], h));
      EXPECT_GT(last, 0);
      if (first == 0) first = last;
    }
    EXPECT_NEAR(std::log2(first / last) / 2, 2, 0.3);
  }
}

TEST(Round, ABallIsAllCurved) {
  const Mesh<3> m = mesh(Ball{{0, 0, 0}, 2}, 0.5);
  for (const auto& face : m.boundary) EXPECT_EQ(face.curve, 0);
  EXPECT_NEAR(test::area(m, "boundary"), 16 * pi, 0.03 * 16 * pi);
}

TEST(Round, AHalfBallIsTheLowerHalfWithItsParts) {
  const Mesh<3> m = mesh(Ball{{0.1, 0.2, 0.3}, 1, true}, 0.1);
  test::expect_parts_cover(m);
  test::expect_flat(m, "flat", 2, 0.3);
  EXPECT_NEAR(test::area(m, "flat"), pi, 0.01 * pi);
  EXPECT_NEAR(test::area(m, "curved"), 2 * pi, 0.01 * 2 * pi);
  for (const Index f : faces_of(m, "curved", "test")) EXPECT_EQ(m.boundary[f].curve, 0);
  for (const auto& p : m.points) EXPECT_LE(p[2], 0.3);
}

TEST(Round, ACylinderHasItsThreeParts) {
  const Mesh<3> m = mesh(Cylinder{{0, 0, 0.5}, 1, 3}, 0.15);
  test::expect_parts_cover(m);
  test::expect_flat(m, "bottom", 2, -1);
  test::expect_flat(m, "top", 2, 2);
  EXPECT_NEAR(test::area(m, "bottom"), pi, 0.01 * pi);
  EXPECT_NEAR(test::area(m, "top"), pi, 0.01 * pi);
  EXPECT_NEAR(test::area(m, "side"), 6 * pi, 0.01 * 6 * pi);
  for (const Index f : faces_of(m, "side", "test")) EXPECT_EQ(m.boundary[f].curve, 0);
}

TEST(Round, RimsAreChainsOfVerticesOnBothSurfaces) {
  const Mesh<3> m = mesh(Ball{{0, 0, 0}, 1, true}, 0.2);
  std::set<Index> flat, curved, rim;
  for (const Index f : faces_of(m, "flat", "test"))
    flat.insert(m.boundary[f].vertices.begin(), m.boundary[f].vertices.end());
  for (const Index f : faces_of(m, "curved", "test"))
    curved.insert(m.boundary[f].vertices.begin(), m.boundary[f].vertices.end());
  std::ranges::set_intersection(flat, curved, std::inserter(rim, rim.end()));
  EXPECT_GT(rim.size(), 2 * pi / 0.3);
  for (const Index v : rim) {
    EXPECT_EQ(m.points[v][2], 0);
    EXPECT_NEAR(std::hypot(m.points[v][0], m.points[v][1]), 1, 1e-14);
  }
}

TEST(Round, FlatAndSlenderCylindersAreFilled) {
  for (const auto& cylinder : {Cylinder{{0, 0, 0}, 1, 0.1}, Cylinder{{0, 0, 0}, 0.05, 1}}) {
    const Mesh<3> m = mesh(cylinder, 0.2);
    test::expect_consistent(m);
    const double exact = pi * cylinder.radius * cylinder.radius * cylinder.height;
    EXPECT_NEAR(test::volume(m), exact, 0.25 * exact);
    test::expect_parts_cover(m);
  }
}

TEST(Round, TheSizeFieldGradesTheMesh) {
  const auto distance = [](const Point<3>& p) { return std::hypot(p[0], p[1], p[2] + 1); };
  const auto size = [=](const Point<3>& p) { return 0.02 + 0.2 * distance(p); };
  const Mesh<3> m = engine<3>().mesh(geometry::Shape3(Ball{{0, 0, 0}, 1, true}), size);
  test::expect_consistent(m);
  test::expect_on_curves(m);
  const auto shell = [=](double from, double to) {
    return [=](const Point<3>& p) { return from < distance(p) && distance(p) < to; };
  };
  EXPECT_NEAR(test::mean_edge(m, shell(0, 0.1)), 0.03, 0.01);
  EXPECT_NEAR(test::mean_edge(m, shell(0.6, 1)), 0.18, 0.05);
}

TEST(Round, SizesBeyondTheRadiusGiveACoarseMesh) {
  for (const auto& shape : shapes) {
    const Mesh<3> m = mesh(shape, 100);
    test::expect_consistent(m);
    EXPECT_LT(m.elements.size(), 300u);
  }
}

TEST(Round, TheSameInputGivesTheSameMesh) {
  const auto size = [](const Point<3>& p) { return 0.2 + 0.1 * std::abs(p[0] - 1); };
  for (const auto& shape : shapes)
    EXPECT_TRUE(test::equal(engine<3>().mesh(shape, size), engine<3>().mesh(shape, size)));
}

TEST(RoundErrors, NameWhatIsWrongWithTheShape) {
  EXPECT_THAT(complaint(Ball{{0, 0, 0}, 0}), HasSubstr("ball: radius: found 0"));
  EXPECT_THAT(complaint(Ball{{0, std::nan(""), 0}, 1, true}), HasSubstr("half_ball: center"));
  EXPECT_THAT(complaint(Cylinder{{0, 0, 0}, 1, -2}), HasSubstr("cylinder: height: found -2"));
}

TEST(RoundErrors, NameWhatIsWrongWithTheSize) {
  for (const auto& shape : shapes)
    for (const double h : {0.0, -1.0, std::nan(""), infinity})
      EXPECT_THAT(complaint(shape, h), AllOf(HasSubstr("size"), HasSubstr("positive")));
  EXPECT_THAT(complaint(Ball{{0, 0, 0}, 1}, 1e-3), HasSubstr("elements"));
  EXPECT_THAT(complaint(Ball{{0, 0, 0}, 1}, 1e-7), HasSubstr("too small for this shape"));
}

TEST(RoundErrors, TellOfASizeBelowTheSpacingOfNumbers) {
  for (const double far : {3e15, 1e20, 1e300})
    for (const geometry::Shape3& shape :
         {geometry::Shape3(Ball{{far, 0, 0}, 1}), geometry::Shape3(Ball{{0, 0, -far}, 1, true}),
          geometry::Shape3(Cylinder{{0, far, far}, 1, 2})})
      EXPECT_THAT(complaint(shape, 0.25), AllOf(HasSubstr("size: found 0.25 at"), HasSubstr("apart")));
}

TEST(RoundErrors, TellOfAShapeTooThinForItsSize) {
  EXPECT_THAT(complaint(Cylinder{{0, 0, 0}, 100, 0.1}, 50),
              AllOf(HasSubstr("cylinder: size: "), HasSubstr("only 0.1 thick"), HasSubstr("3e+07 elements"),
                    HasSubstr("least size is 50")));
}

TEST(RoundErrors, OfTheSizeComeThrough) {
  for (const auto& shape : shapes) {
    const auto size = [](const Point<3>& p) -> double {
      if (p[0] > 1.7) input_error("scene.toml:3", "no size here");
      return 0.2;
    };
    EXPECT_EQ(test::input_error_of([&] { engine<3>().mesh(shape, size); }), "scene.toml:3: no size here");
  }
}

}  // namespace
}  // namespace signorini
