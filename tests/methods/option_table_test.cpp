// One table knows the options: whatever is in it can be given, is checked, and means what it is called.
#include "core/solver/option_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "core/base/error.hpp"
#include "core/input/range.hpp"
#include "core/scene/solver_keys.hpp"
#include "core/scene/solver_options.hpp"
#include "methods/configuration.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;

std::string refusal(const SolverOptions& options) {
  try {
    check_options(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

/// The options with one set to a text, as the command line sets them.
SolverOptions with(const std::string& name, const std::string& value) {
  const std::vector<std::string> assignments = {"solver." + name + "=" + value};
  return solver_options(assignments);
}

TEST(OptionTable, DefaultsAreThoseOfTheStruct) {
  const SolverOptions read = solver_options({}), fresh;
  for (const auto& row : option_table())
    std::visit([&](auto member) { EXPECT_EQ(read.*member, fresh.*member) << row.name; }, row.member);
  EXPECT_EQ(refusal(fresh), "");
  EXPECT_STREQ(find_key(solver_keys(), "tolerance")->fallback, "1e-8");
}

struct Anything {
  template <class T>
  operator T() const;
};

template <class Struct, class... Members>
constexpr std::size_t members() {
  if constexpr (requires { Struct{Members{}..., Anything{}}; })
    return members<Struct, Members..., Anything>();
  else
    return sizeof...(Members);
}

TEST(OptionTable, HasEveryOptionOnce) {
  EXPECT_EQ(option_table().size(), members<SolverOptions>());
  for (const auto& row : option_table())
    for (const auto& other : option_table())
      EXPECT_EQ(row.member == other.member, &row == &other) << row.name << ", " << other.name;
}

TEST(OptionTable, EveryValueOutsideItsRangeIsRefusedByName) {
  for (const auto& row : option_table()) {
    const Range range(row.range);
    SolverOptions options;
    if (const auto* text = std::get_if<std::string SolverOptions::*>(&row.member)) {
      if (range.choices().empty()) continue;
      options.** text = "nonsense";
    } else if (const auto* number = std::get_if<double SolverOptions::*>(&row.member)) {
      options.** number = std::numeric_limits<double>::quiet_NaN();
    } else if (const auto* integer = std::get_if<int SolverOptions::*>(&row.member)) {
      options.** integer = -1;
    } else {
      continue;
    }
    EXPECT_THAT(refusal(options), HasSubstr(fmt::format("solver.{}: found ", row.name)));
    EXPECT_THAT(refusal(options), HasSubstr(row.range));
  }
}

TEST(OptionTable, EnumeratorsAreInTheOrderOfTheChoices) {
  EXPECT_EQ(check_options(with("method", "auto")), Method::automatic);
  EXPECT_EQ(check_options(with("method", "monotone")), Method::monotone);
  EXPECT_EQ(check_options(with("method", "tnnmg")), Method::tnnmg);
  EXPECT_EQ(check_options(with("method", "pgs")), Method::pgs);
  EXPECT_EQ(check_options(with("method", "pdas")), Method::pdas);
  EXPECT_EQ(check_options(with("method", "newton")), Method::newton);
  EXPECT_EQ(coarsening_of(with("coarsening", "auto")), Coarsening::automatic);
  EXPECT_EQ(coarsening_of(with("coarsening", "classical")), Coarsening::classical);
  EXPECT_EQ(coarsening_of(with("coarsening", "aggregation")), Coarsening::aggregation);
  EXPECT_EQ(settings_of<1>(with("cycle", "V")).cycle, Cycle::V);
  EXPECT_EQ(settings_of<1>(with("cycle", "W")).cycle, Cycle::W);
  EXPECT_EQ(settings_of<1>(with("cycle", "F")).cycle, Cycle::F);
  EXPECT_EQ(settings_of<1>(with("truncate", "none")).truncate, Truncation::none);
  EXPECT_EQ(settings_of<1>(with("truncate", "normal")).truncate, Truncation::normal);
  EXPECT_EQ(settings_of<1>(with("truncate", "tangential")).truncate, Truncation::tangential);
  EXPECT_EQ(settings_of<1>(with("rotate", "all")).rotate, Rotate::all);
  EXPECT_EQ(settings_of<1>(with("rotate", "not_coarsest")).rotate, Rotate::not_coarsest);
  EXPECT_EQ(settings_of<1>(with("rotate", "meshes")).rotate, Rotate::meshes);
  EXPECT_EQ(settings_of<1>(with("rotate", "none")).rotate, Rotate::none);
  EXPECT_FALSE(algebraic_settings(with("reach", "all")).only_twins);
  EXPECT_TRUE(algebraic_settings(with("reach", "twins")).only_twins);
  EXPECT_FALSE(algebraic_settings(with("interpolate", "global")).local);
  EXPECT_TRUE(algebraic_settings(with("interpolate", "local")).local);
}

// To renew docs/solver_options.md after a change of the table, copy the file that this test names.
TEST(OptionTable, IsWrittenIntoTheDocumentation) {
  constexpr std::string_view begin = "up to the next mark. -->\n\n", end = "<!-- End of what is written. -->";
  std::ifstream file(SIGNORINI_SOURCE_DIR "/docs/solver_options.md");
  std::ostringstream text;
  text << file.rdbuf();
  const std::string page = text.str();
  const std::size_t first = page.find(begin), last = page.find(end);
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(last, std::string::npos);
  const std::size_t table = first + begin.size();
  const std::string expected = page.substr(0, table) + solver_options_page() + "\n" + page.substr(last);
  if (page == expected) return;
  const std::string renewed = testing::TempDir() + "solver_options.md";
  std::ofstream(renewed) << expected;
  ADD_FAILURE() << "docs/solver_options.md is not what the table of options says; the right text is in " << renewed;
}

}  // namespace
}  // namespace signorini::test
