#include "core/input/field.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/error.hpp"

namespace signorini {
namespace {

TEST(Field, ANumberIsConstant) {
  const Field field = 2.5;
  EXPECT_EQ(field(Site{}), 2.5);
  EXPECT_EQ(field.constant(), 2.5);
  EXPECT_EQ(field.text(), "2.5");
}

TEST(Field, AnExpressionSeesPositionNormalAndStep) {
  const Field field([](const Site& s) { return s.x[0] + 10 * s.n[1] + 100 * s.t; }, "x + 10 ny + 100 t", "here");
  EXPECT_EQ(field(Site{{1, 0, 0}, {0, 2, 0}, 3}), 321);
  EXPECT_FALSE(field.constant());
}

TEST(Field, AValueThatIsNotFiniteNamesOriginTextAndPosition) {
  const Field field([](const Site& s) { return std::log(s.x[0]); }, "log(x)", "scene.toml:7: load.0.value[1]");
  EXPECT_EQ(field(Site{{1, 0, 0}}), 0);
  try {
    field(Site{{-2, 3, 0.5}});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    for (const char* part : {"scene.toml:7: load.0.value[1]", "log(x)", "-2, 3, 0.5"})
      EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
}

TEST(Field, WhereThereIsNoNormalNoneIsUsed) {
  const Field field([](const Site& s) { return s.n[0]; }, "nx", "here", true);
  EXPECT_EQ(field(Site{{0, 0, 0}, {1, 0, 0}}), 1);
  EXPECT_THROW(field(Site{{1, 0, 0}}), Error);
}

TEST(Field, ANumberThatIsNotFiniteIsAnErrorToo) { EXPECT_THROW(Field(std::nan(""))(Site{}), Error); }

}  // namespace
}  // namespace signorini
