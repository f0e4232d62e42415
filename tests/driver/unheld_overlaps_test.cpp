#include "driver/warnings/unheld_overlaps.hpp"

#include "tests/driver/warned.hpp"

namespace signorini::test {
namespace {

using tables::block, tables::fix;

const auto told = Contains(AllOf(HasSubstr("'left' and 'right' have moved into each other, by 0.3")));

/// Two blocks half apart, of which the left one is moved by 0.8.
std::string blocks(const std::string& more = "") {
  return block("left", "[0, 0]", "[1, 1]", "[2, 2]") + block("right", "[1.5, 0]", "[2.5, 1]", "[2, 2]") +
         block("third", "[1.5, 1]", "[2.5, 2]", "[2, 2]") + fix("left", "boundary", "[0.8, 0]") +
         fix("right", "boundary", "[0, 0]") + fix("third", "boundary", "[0, 0]") + more;
}

std::string between(const std::string& type, const std::string& a, const std::string& on, const std::string& b,
                    const std::string& other_on) {
  return "[[obstacle]]\ntype = '" + type + "'\nbody = '" + a + "'\non = '" + on + "'\nother = '" + b +
         "'\nother_on = '" + other_on + "'\n";
}

TEST(UnheldOverlaps, OfBodiesWithoutAnObstacleBetweenThem) {
  EXPECT_THAT(warnings(blocks()), told);
  EXPECT_THAT(warnings(blocks(between("tied", "right", "top", "third", "bottom"))), told);  // on one mesh with a third
  EXPECT_THAT(warnings(block("left", "[0, 0]", "[1, 1]", "[2, 2]") + block("right", "[0.7, 0]", "[2.5, 1]", "[2, 2]") +
                       fix("left", "boundary", "[0.01, 0]") + fix("right", "boundary", "[0, 0]")),
              Not(Contains(HasSubstr("into each other"))));  // they were so from the start
}

}  // namespace
}  // namespace signorini::test
