// The parts of a level keep to each other: what does not interpolate is what is off or truncated.
#include "core/solver/level.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace signorini::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Level<2> level_of(std::vector<Flags> off) {
  Level<2> level;
  level.vectors = static_cast<Index>(off.size());
  level.off = std::move(off);
  level.clear_phases();
  return level;
}

TEST(Level, ListsEveryChangeOfTruncationOnce) {
  Level<2> level = level_of({0, 1, 0});
  EXPECT_TRUE(level.truncate(0, 2));
  EXPECT_FALSE(level.truncate(0, 2)) << "the same again";
  EXPECT_FALSE(level.truncate(1, 1)) << "is off already";
  EXPECT_TRUE(level.truncate(2, 3));
  EXPECT_TRUE(level.truncate(2, 0));
  EXPECT_THAT(level.outdated.changed, ElementsAre(0, 2, 2));
  EXPECT_THAT(level.phases.removed, ElementsAre(2, 1, 0));
  level.outdated.clear();
  EXPECT_THAT(level.outdated.changed, IsEmpty());
}

// A component that was lost and comes back interpolates again, unless it was truncated beside.
TEST(Level, ComponentsThatComeBackInterpolate) {
  Level<2> level = level_of({0, 0, 3});
  level.truncate(0, 2);
  level.off = {1, 1, 0};
  level.renew({0, 2});
  EXPECT_THAT(level.phases.removed, ElementsAre(3, 0, 0)) << "vector 1 was not recomputed";
  EXPECT_THAT(level.outdated.renewed, ElementsAre(0, 2));
  level.off = {0, 1, 0};
  level.renew({0, 1});
  EXPECT_THAT(level.phases.removed, ElementsAre(2, 1, 0));
  EXPECT_THAT(level.outdated.renewed, ElementsAre(0, 2, 0, 1));
}

}  // namespace
}  // namespace signorini::test
