#include "core/input/values.hpp"

#include <gmock/gmock.h>

#include "core/base/error.hpp"

namespace signorini {
namespace {

constexpr const char* not_negative = "[0, inf)";

Field field_of(const char* text, const char* range = not_negative) {
  return to_field({std::string(text), "here"}, range);
}

double at(const char* text, Site site, const char* range = not_negative) { return field_of(text, range)(site); }

TEST(ExpressionInARange, IsRefusedOutside) {
  EXPECT_EQ(at("0.3 - 0.2 * x", {{1, 0, 0}}), 0.3 - 0.2);
  try {
    at("0.3 - 0.2 * x", {{1.6, 0, 0}});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    EXPECT_THAT(error.what(), testing::HasSubstr("expression '0.3 - 0.2 * x' is -0.02"));
  }
}

// 0.3 - 0.2 * 1.5 is -5.6e-17.
TEST(ExpressionInARange, IsItsEndWhereRoundingTakesItBeyond) {
  ASSERT_LT(0.3 - 0.2 * 1.5, 0);
  EXPECT_EQ(at("0.3 - 0.2 * x", {{1.5, 0, 0}}), 0);
  EXPECT_EQ(at("1e9 * (0.3 - 0.2 * x)", {{1.5, 0, 0}}), 0) << "in small units";
  EXPECT_EQ(at("x", {{-1e-17, 1, 0}}), 0) << "a vertex on the axis but for rounding";
  EXPECT_EQ(at("0.3 - 0.2 * t", {{0, 0, 0}, {0, 0, 0}, 1.5}), 0);
  EXPECT_EQ(at("x^2 - 2.2 * x + 1.21", {{1.1, 0, 0}}), 0) << "flat there";
  EXPECT_EQ(at("0.1 * x + 0.2 * x", {{1, 0, 0}}, "[0, 0.3]"), 0.3) << "the upper end";
  EXPECT_EQ(field_of("0.3 - 3 * 0.1").constant(), 0);
  EXPECT_EQ(to_number({std::string("0.3 - 3 * 0.1"), "here"}, not_negative), 0);
}

TEST(ExpressionInARange, IsRefusedWhereThatIsMoreThanRounding) {
  EXPECT_THROW(at("0.3 - 0.2 * x", {{1.5 + 1e-10, 0, 0}}), Error);
  EXPECT_THROW(at("x < 1.5 ? 0.3 : -0.1", {{1.5, 0, 0}}), Error) << "at a jump";
  EXPECT_THROW(at("x - 1.5", {{1.5, 0, 0}}, "(0, inf)"), Error) << "an end that is not in the range";
  EXPECT_THROW(field_of("-1e-9"), Error);
}

TEST(NumberInARange, IsTakenAsItIs) { EXPECT_THROW(to_field({-1e-17, "here"}, not_negative), Error); }

}  // namespace
}  // namespace signorini
