#include "core/io/warning_kinds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "core/io/report.hpp"

namespace signorini {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Warning, HasTheIdOfItsKindAndItsTextWithTheValues) {
  const Warning one = warning<"tied-apart">("obstacle.0", 0.12345);
  EXPECT_EQ(one.id, "tied-apart");
  EXPECT_EQ(
      one.text,
      "obstacle.0: the bodies do not touch exactly: they are up to 0.123 apart, or overlap by as much. They are tied "
      "as they are: the tie carries forces across this distance as if it were zero");
  EXPECT_EQ(one, warning<"tied-apart">("obstacle.0", 0.12345));
}

TEST(Warning, IsInTheReportWithItsIdBesideIt) {
  Report report;
  report.steps.emplace_back();
  report.warnings = {warning<"interrupted">(), warning<"no-pictures">("none")};
  const auto json = to_json(report);
  EXPECT_EQ(json.at("warnings").at(1), "no pictures were drawn: none");
  EXPECT_EQ(json.at("warning_ids").dump(), "[\"interrupted\",\"no-pictures\"]");
}

/// Ids are read by programs.
TEST(Warning, IdsAreShortAndUnique) {
  std::set<std::string> ids;
  for (const WarningKind& kind : warning_kinds) {
    EXPECT_TRUE(std::regex_match(kind.id, std::regex("[a-z]+(-[a-z]+){0,2}"))) << kind.id;
    EXPECT_TRUE(ids.insert(kind.id).second) << kind.id;
  }
}

/// A kind that nothing gives any more leaves the table.
TEST(Warning, EveryKindIsGivenSomewhere) {
  std::string sources;
  for (const char* folder : {"driver", "apps/signorini"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(SIGNORINI_SOURCE_DIR) / folder))
      if (entry.is_regular_file()) sources += content(entry.path());
  for (const WarningKind& kind : warning_kinds)
    EXPECT_THAT(sources, testing::HasSubstr(fmt::format("warning<\"{}\">", kind.id)));
}

// To renew docs/warnings.md after a change of the table, copy the file that this names.
TEST(Warning, PageIsInTheDocumentation) {
  const std::string page = content(SIGNORINI_SOURCE_DIR "/docs/warnings.md"), mark = "from here on. -->\n\n";
  const std::size_t begin = page.find(mark);
  ASSERT_NE(begin, std::string::npos);
  const std::string expected = page.substr(0, begin + mark.size()) + warnings_page();
  if (page == expected) return;
  const std::string renewed = testing::TempDir() + "warnings.md";
  std::ofstream(renewed) << expected;
  ADD_FAILURE() << "docs/warnings.md is not what the table of warnings says; the right text is in " << renewed;
}

}  // namespace
}  // namespace signorini
