#include "core/io/report.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "core/io/report_page.hpp"

namespace signorini {
namespace {

/// To renew a file after a change of the tables, copy the one that this names.
void expect_file(const std::string& name, const std::string& expected) {
  std::ifstream file(SIGNORINI_SOURCE_DIR "/docs/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  if (text.str() == expected) return;
  const std::string renewed = testing::TempDir() + name;
  std::ofstream(renewed) << expected;
  ADD_FAILURE() << "docs/" << name << " is not what the tables of the report say; the right text is in " << renewed;
}

TEST(ReportPage, IsTheFileInTheDocumentation) { expect_file("report.md", report_page()); }

TEST(ReportPage, SchemaIsTheFileInTheDocumentation) { expect_file("report.schema.json", report_schema()); }

Report small_report() {
  Report report;
  StepReport& step = report.steps.emplace_back();
  step.summary.level_unknowns = {3, 12};
  step.summary.finest_level = 1;
  step.summary.history.push_back({1, 0.5, std::numeric_limits<double>::infinity(), -1, 4, 2, {{}, {}}, 0});
  step.contact.emplace_back().force = {0, 0, 2.5};
  return report;
}

std::vector<std::string> keys_of(const nlohmann::ordered_json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  return keys;
}

TEST(Report, ResultsComeBeforeWhatTheSolverDid) {
  const auto json = to_json(small_report());
  const std::vector<std::string> keys = keys_of(json);
  const auto place = [&](const char* key) { return std::find(keys.begin(), keys.end(), key) - keys.begin(); };
  EXPECT_EQ(keys.back(), "history");
  for (const char* result : {"converged", "reason", "contact", "probes", "balance", "warnings", "energy", "steps"})
    for (const char* work : {"levels", "solver", "stages", "plugins", "libraries", "history"})
      EXPECT_LT(place(result), place(work)) << result << " " << work;
  EXPECT_LT(place("contact"), 10) << "found without scrolling";
  const std::vector<std::string> of_step = keys_of(json.at("steps").at(0));
  EXPECT_LT(std::find(of_step.begin(), of_step.end(), "contact"), std::find(of_step.begin(), of_step.end(), "stages"));
}

TEST(Report, LevelsHaveTheirNumbersAndWhatIsNotFiniteIsNull) {
  const auto json = to_json(small_report());
  EXPECT_EQ(json.at("unknowns"), 12);
  EXPECT_EQ(json.at("levels").at(0).at("level"), 0);
  EXPECT_EQ(json.at("history").at(0).at("levels").at(1).at("level"), 1);
  EXPECT_TRUE(json.at("history").at(0).at("algebraic_error").is_null());
  EXPECT_EQ(json.at("contact").at(0).at("force").at(2), 2.5);
  EXPECT_FALSE(json.at("contact").at(0).contains("other_force")) << "no second body";
}

TEST(Report, OfTwoBodiesHasWhatActsOnTheOther) {
  Report report = small_report();
  report.steps.front().contact.front().pair = PairReport{"a", "b", "finer", {0, 0, -2.5}, {}};
  const auto contact = to_json(report).at("contact").at(0);
  EXPECT_EQ(contact.at("pair").at("slave"), "a");
  EXPECT_EQ(contact.at("other_force").at(2), -2.5);
}

}  // namespace
}  // namespace signorini
