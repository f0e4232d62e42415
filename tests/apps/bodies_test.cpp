#include <gmock/gmock.h>

#include "apps/scenes/tables.hpp"
#include "program.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

class Bodies : public Program {};

/// A membrane and an elastic sheet beside it.
const std::string two =
    "title = 'two'\n" + tables::block("membrane", "[0, 0]", "[1, 1]", "[4, 4]", "equation = 'diffusion'\n") +
    tables::fix("membrane", "boundary", "0") + tables::load("membrane", "'-8 * t'") +
    tables::floor("membrane", "-0.2") + tables::block("sheet", "[2, 0]", "[3, 1]", "[4, 4]") +
    tables::fix("sheet", "top", "[0, '-0.01 * t']") + tables::plane("sheet", "bottom", "[0, 0]", "[0, 1]") +
    tables::probe("side", "sheet", "[3, 0.5]");

TEST_F(Bodies, EachHasFilesOfItsOwnThatAreListedTogether) {
  write("two.toml", two);
  ASSERT_EQ(signorini({"solve", "two.toml", "--out", "o"}).status, 0);
  EXPECT_THAT(written("o"), UnorderedElementsAre("report.json", "solution.pvd", "solution_body0.vtu",
                                                 "solution_body1.vtu", "convergence.csv", "phases.csv",
                                                 "convergence.png", "result_body0.png", "result_body1.png"));
  EXPECT_THAT(read(folder_ / "o/solution.pvd"), HasSubstr("part=\"1\" file=\"solution_body1.vtu\""));
  const auto r = report("o");
  ASSERT_EQ(r.at("bodies").size(), 2u);
  EXPECT_EQ(r.at("bodies")[1].at("name"), "sheet");
  EXPECT_EQ(r.at("unknowns"),
            r.at("bodies")[0].at("unknowns").get<int>() + r.at("bodies")[1].at("unknowns").get<int>());
  EXPECT_EQ(r.at("contact")[0].at("force").size(), 1u);
  EXPECT_EQ(r.at("contact")[1].at("force").size(), 2u);
  EXPECT_EQ(r.at("balance")[1].at("body"), "sheet");
}

TEST_F(Bodies, StepsAreListedByTimeAndReplaceAnEarlierRun) {
  write("two.toml", two);
  ASSERT_EQ(signorini({"solve", "two.toml", "--out", "o"}).status, 0);
  ASSERT_EQ(signorini({"solve", "two.toml", "--out", "o", "--set", "steps.count=2", "--set", "output.pictures=false",
                       "--set", "output.convergence=false"})
                .status,
            0);
  EXPECT_THAT(written("o"),
              UnorderedElementsAre("report.json", "solution.pvd", "solution_body0_001.vtu", "solution_body1_001.vtu",
                                   "solution_body0_002.vtu", "solution_body1_002.vtu"));
  EXPECT_THAT(read(folder_ / "o/solution.pvd"),
              HasSubstr("timestep=\"0.5\" part=\"1\" file=\"solution_body1_001.vtu\""));
}

TEST_F(Bodies, AreCheckedOneByOne) {
  write("two.toml", two);
  const Ended ended = signorini({"check", "two.toml"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("body 'membrane'\nequation: diffusion"));
  EXPECT_THAT(ended.out, HasSubstr("body 'sheet'\nequation: elasticity"));
  EXPECT_THAT(ended.out, HasSubstr("obstacle 1: contact, 5 candidate"));
}

}  // namespace
}  // namespace signorini::test
