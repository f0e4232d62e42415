// Shapes in other units and elsewhere: the same mesh, scaled and moved.
#include "geometry_checks.hpp"
#include "surfaces.hpp"
#include "tests/support/nightly.hpp"

namespace signorini {
namespace {

using geometry::engine;

const double factors[] = {1e-6, 1e-3, 25.4, 1e3, 1e6};

/// Meshes a shape of lengths in multiples of l, moved by `shift`, with a size that varies.
template <int D>
using Mesher = std::function<Mesh<D>(double l, const Point<D>& shift)>;

template <int D>
geometry::Size<D> graded(double least, double l, const Point<D>& shift) {
  return [=](const Point<D>& p) { return least * l + 0.2 * length<D>(difference<D>(p, shift)); };
}

template <int D>
void expect_same(const Mesher<D>& mesher, const Point<D>& place) {
  const Mesh<D> one = mesher(1, {});
  test::expect_consistent(one);
  const auto expect_like_one = [&](double l, const Point<D>& shift, double tolerance) {
    SCOPED_TRACE(l);
    const Mesh<D> other = mesher(l, shift);
    ASSERT_TRUE(other.elements == one.elements);
    for (std::size_t p = 0; p < one.points.size(); ++p)
      for (std::size_t k = 0; k < D; ++k)
        ASSERT_NEAR(other.points[p][k], l * one.points[p][k] + shift[k], tolerance * l);
    for (std::size_t f = 0; f < one.boundary.size(); ++f) ASSERT_EQ(other.boundary[f].curve, one.boundary[f].curve);
    for (std::size_t i = 0; i < one.parts.size(); ++i) ASSERT_EQ(other.parts[i].faces, one.parts[i].faces);
  };
  for (const double l : factors) expect_like_one(l, {}, 1e-14);
  expect_like_one(1, place, 1e-13);
}

TEST(Units, OfRoundShapesInThePlane) {
  for (const bool half : {false, true})
    for (const double h : {0.1, 0.03})
      expect_same<2>(
          [=](double l, const Point<2>& shift) {
            return engine<2>().mesh(geometry::Shape2(geometry::Disk{shift, 0.7 * l, half}), graded<2>(h, l, shift));
          },
          {3.3, -2.1});
}

TEST(Units, OfPolygons) {
  for (const double h : {0.1, 0.03})
    expect_same<2>(
        [=](double l, const Point<2>& shift) {
          geometry::Polygon polygon{{{-0.9, -0.7}, {1.1, -0.7}, {1.3, 0.2}, {-0.7, 0.9}}};
          for (auto& p : polygon.points)
            for (std::size_t k = 0; k < 2; ++k) p[k] = shift[k] + l * p[k];
          return engine<2>().mesh(geometry::Shape2(polygon), graded<2>(h, l, shift));
        },
        {3.3, -2.1});
}

TEST(Units, OfBalls) {
  for (const bool half : {false, true})
    for (const double h : {0.2, test::nightly(0.05, 0.1)})
      expect_same<3>(
          [=](double l, const Point<3>& shift) {
            return engine<3>().mesh(geometry::Shape3(geometry::Ball{shift, 0.7 * l, half}), graded<3>(h, l, shift));
          },
          {3.3, -2.1, 0.6});
}

TEST(Units, OfCylinders) {
  expect_same<3>(
      [=](double l, const Point<3>& shift) {
        return engine<3>().mesh(geometry::Shape3(geometry::Cylinder{shift, 0.7 * l, 1.9 * l}),
                                graded<3>(0.1, l, shift));
      },
      {3.3, -2.1, 0.6});
}

TEST(Units, OfSolids) {
  for (const auto& surface :
       {test::cube(-0.3, 0.8), test::cube(0, 3).add(test::cube(1, 2)).turned(0.7, 0.3), test::box({2.2, 1.9, 0.3})})
    expect_same<3>(
        [=](double l, const Point<3>& shift) {
          test::Surface moved = surface;
          for (auto& p : moved.points)
            for (std::size_t k = 0; k < 3; ++k) p[k] = shift[k] + l * p[k];
          const test::TemporaryFile file("solid.off", moved.off());
          return engine<3>().mesh(geometry::Shape3(geometry::Solid{file.path()}), graded<3>(0.2, l, shift));
        },
        {3.3, -2.1, 0.6});
}

}  // namespace
}  // namespace signorini
