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

TEST_F(Bodies, CheckRefusesWhatTurnsDoNotKnow) {
  write("turns.toml", tables::block("lower", "[0, 0]", "[1, 1]", "[4, 4]") +
                          tables::block("upper", "[0, 1]", "[1, 1.5]", "[4, 4]") +
                          tables::fix("lower", "bottom", "[0, 0]") + tables::fix("upper", "top", "[0, -0.01]") +
                          "[[obstacle]]\ntype = 'elastic_coulomb'\nfriction = 0.1\nbody = 'upper'\non = 'bottom'\n"
                          "other = 'lower'\nother_on = 'top'\n[solver]\nbodies = 'dirichlet-neumann'\n");
  const Ended checked = signorini({"check", "turns.toml"});
  EXPECT_EQ(checked.status, 2);
  EXPECT_THAT(checked.err, HasSubstr("friction between bodies is not available"));
}

TEST_F(Bodies, WhichIsTheSlaveIsPrintedAndReported) {
  write("press.toml",
        "title = 'press'\n" + tables::block("lower", "[0, 0]", "[1, 1]", "[4, 4]") +
            tables::block("upper", "[0, 1]", "[1, 1.5]", "[4, 4]", "order = 1\nyoung = 5\npoisson = 0.3\n") +
            tables::fix("lower", "bottom", "[0, 0]") + tables::fix("upper", "top", "[0, -0.01]") +
            "[[obstacle]]\ntype = 'elastic'\nbody = 'upper'\non = 'bottom'\nother = 'lower'\n"
            "other_on = 'top'\n");
  const Ended checked = signorini({"check", "press.toml"});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("the slave is lower (softer: modulus 1 beside 5)"));
  const Ended solved = signorini({"solve", "press.toml", "--out", "o"});
  ASSERT_EQ(solved.status, 0) << solved.err;
  EXPECT_THAT(solved.out, HasSubstr("force on upper; the slave is lower (softer: modulus 1 beside 5)"));
  const auto contact = report("o").at("contact")[0];
  EXPECT_EQ(contact.at("body"), "upper");
  EXPECT_GT(contact.at("force")[1], 0);
  const auto& pair = contact.at("pair");
  EXPECT_EQ(pair.at("slave"), "lower");
  EXPECT_EQ(pair.at("master"), "upper");
  EXPECT_EQ(pair.at("reason"), "softer: modulus 1 beside 5");
  EXPECT_NEAR(contact.at("other_force")[1].get<double>(), -contact.at("force")[1].get<double>(), 1e-15);
  EXPECT_EQ(contact.at("other_moment").size(), 1u);
}

}  // namespace
}  // namespace signorini::test
