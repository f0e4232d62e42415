#include "apps/signorini/text.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace signorini {
namespace {

TEST(Text, ThatFitsStaysAsItIs) {
  for (const char* text : {"", "\n", "a  b\n\n  c\n", "no end"}) EXPECT_EQ(fitted(text, 40), text);
}

TEST(Text, GoesOnBelowWhatItSays) {
  EXPECT_EQ(fitted("  name    one two three four\n", 20), "  name    one two\n          three four\n")
      << "behind the gap";
  EXPECT_EQ(fitted("solver: method auto: monotone\n", 20), "solver: method auto:\n        monotone\n")
      << "behind a label";
  EXPECT_EQ(fitted("one two three four five six", 20), "one two three four\nfive six") << "below its beginning";
  EXPECT_EQ(fitted("    one two three four", 20), "    one two three\n    four");
}

TEST(Text, WordsAreNotBroken) {
  EXPECT_EQ(fitted("  file    /a/very/long/path/without/spaces and so on", 20),
            "  file    /a/very/long/path/without/spaces\n          and so on");
}

TEST(Text, CountsCharactersAndNotBytes) { EXPECT_EQ(fitted("Gauß–Seidel Gauß–Seidel", 23), "Gauß–Seidel Gauß–Seidel"); }

TEST(Text, NoLineIsLongerThanItIsToldTo) {
  std::string text;
  for (int k = 0; k < 60; ++k)
    text += std::string(k % 5, ' ') + "word" + std::string(1 + k % 3, ' ') + "and more of them ";
  for (int width = 40; width < 100; width += 7) {
    std::istringstream lines(fitted(text, width));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), static_cast<std::size_t>(width));
  }
}

}  // namespace
}  // namespace signorini
