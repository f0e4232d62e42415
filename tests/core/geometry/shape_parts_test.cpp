// What belongs to a shape, where edges have been found that are none.
#include "core/geometry/shape_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace signorini::geometry {
namespace {

constexpr double crease = 35 * std::numbers::pi / 180;

/// A closed curve of edges with its vertices at these angles, in degrees, on a circle.
struct Ring {
  std::vector<Point<2>> points;
  std::vector<std::array<Index, 2>> faces;
  std::vector<Index> beyond;

  explicit Ring(const std::vector<double>& angles) {
    const auto n = static_cast<Index>(angles.size());
    for (Index k = 0; k < n; ++k) {
      const double angle = angles[static_cast<std::size_t>(k)] * std::numbers::pi / 180;
      points.push_back({0.3 + 2 * std::cos(angle), 2 * std::sin(angle) - 0.1});
      faces.push_back({k, (k + 1) % n});
      beyond.push_back(2 * ((k + 1) % n) + 1);  // opposite to the first corner lies the second one
      beyond.push_back(2 * ((k + n - 1) % n));
    }
  }
  /// The parts, with edges of the body at both ends of one face.
  std::vector<Index> parts_without(Index face) const {
    std::vector<Index> across = beyond;
    for (const Index i : {2 * face, 2 * face + 1}) {
      across[static_cast<std::size_t>(beyond[static_cast<std::size_t>(i)])] = -1;
      across[static_cast<std::size_t>(i)] = -1;
    }
    FlatParts<2> flats = find_flat_parts<2>(points, faces, across);
    EXPECT_GE(flats.part[static_cast<std::size_t>(face)], 0) << "nothing to be taken in";
    std::vector<Index> parts = find_shape_parts<2>(points, faces, across, beyond, flats, crease).part;
    EXPECT_NE(flats.part[static_cast<std::size_t>(face)] < 0, parts[static_cast<std::size_t>(face)] < 0);
    return parts;
  }
};

TEST(ShapeParts, TakeInFacesThatOnlyEdgesPartFromThem) {
  std::vector<double> angles;
  for (int k = 0; k < 24; ++k) angles.push_back(15 * k + (k % 3) * 1.5);
  const std::vector<Index> parts = Ring(angles).parts_without(5);
  EXPECT_THAT(parts, testing::Each(parts[0]));
  EXPECT_GE(parts[0], 0);
}

// Its end points are on the circle, too.
TEST(ShapeParts, LeaveAFlatBesideAnArc) {
  std::vector<double> angles;
  for (int k = 0; k <= 33; ++k) angles.push_back(10 * k);  // from 330 degrees on there is a chord
  const std::vector<Index> parts = Ring(angles).parts_without(33);
  EXPECT_EQ(parts[33], -1);
  EXPECT_EQ(std::ranges::count(parts, parts[0]), 33);
}

}  // namespace
}  // namespace signorini::geometry
