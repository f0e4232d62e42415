// What the program writes of several steps.
#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <sstream>

#include "apps/scenes/tables.hpp"
#include "apps/signorini/show_steps.hpp"
#include "driver/driver.hpp"
#include "program.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class Steps : public Program {
 protected:
  /// The cells of a table, by the names of its columns.
  std::vector<std::map<std::string, std::string>> table(const std::string& file) const {
    std::istringstream text(read(folder_ / file));
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;
    for (std::string line; std::getline(text, line);) {
      std::istringstream cells(line + ',');
      std::vector<std::string> row;
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
      if (names.empty()) {
        names = row;
        continue;
      }
      EXPECT_EQ(row.size(), names.size()) << line;
      auto& entry = rows.emplace_back();
      for (std::size_t k = 0; k < names.size(); ++k) entry[names[k]] = row.at(k);
    }
    return rows;
  }
};

/// A block pushed along a plane and back.
const std::string block =
    "title = 'block'\n" + tables::block("block", "[0, 0]", "[2, 1]", "[8, 4]") +
    tables::fix("block", "top", "['t <= 0.5 ? 0.06 * t : 0.06 * (1 - t)', -0.03]") +
    "[[obstacle]]\ntype = 'tresca'\nbound = 0.004\nbody = 'block'\non = 'bottom'\nshape = 'plane'\n"
    "point = [0.5, 0]\nnormal = [0, 1]\n" +
    tables::probe("corner", "block", "[2, 1]") + "[refine]\nuniform = 1\n[steps]\nat = [0.1, 0.5, 0.75, 1]\n";

TEST_F(Steps, TableHasWhatTheReportSays) {
  write("block.toml", block);
  const Ended ended = signorini({"solve", "block.toml", "--out", "o"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("step 4 of 4, to t = 1, the last of 4 solves"));
  EXPECT_THAT(ended.out, HasSubstr("friction: "));
  EXPECT_THAT(written("o"), IsSupersetOf({"steps.csv", "steps.png", "solution_004.vtu", "solution.pvd"}));
  const auto rows = table("o/steps.csv");
  const auto steps = report("o").at("steps");
  ASSERT_EQ(rows.size(), 4u);
  ASSERT_EQ(steps.size(), 4u);
  double dissipated = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto number = [&](const std::string& column) { return std::stod(rows[k].at(column)); };
    const auto& contact = steps[k].at("contact").at(0);
    EXPECT_EQ(number("step"), k + 1.0);
    EXPECT_EQ(number("t"), steps[k].at("t"));
    EXPECT_EQ(number("converged"), 1);
    for (const char* key :
         {"obstacle", "nodes", "open_nodes", "slip_nodes", "stick_nodes", "dissipated_in_step", "dissipated"})
      EXPECT_EQ(number(key), contact.at(key)) << key;
    for (int i = 0; i < 2; ++i)
      for (const char* key : {"normal_force", "tangential_force", "moment_about", "displacement", "motion"})
        EXPECT_EQ(number(std::string(key) + "_" + "xy"[i]), contact.at(key).at(i)) << key;
    EXPECT_EQ(number("moment_z"), contact.at("moment").at(0));
    EXPECT_EQ(number("corner_x"), steps[k].at("probes").at(0).at("displacement").at(0));
    EXPECT_EQ(contact.at("nodes").get<int>() + contact.at("open_nodes").get<int>(), 17);
    EXPECT_EQ(contact.at("nodes").get<int>(),
              contact.at("slip_nodes").get<int>() + contact.at("stick_nodes").get<int>());
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(contact.at("normal_force").at(i).get<double>() + contact.at("tangential_force").at(i).get<double>(),
                  contact.at("force").at(i), 1e-15);
    dissipated += contact.at("dissipated_in_step").get<double>();
    EXPECT_NEAR(contact.at("dissipated"), dissipated, 1e-15);
  }
  EXPECT_GT(dissipated, 0);
}

TEST_F(Steps, SeriesListsFilesThatHoldTractions) {
  write("block.toml", block);
  ASSERT_EQ(signorini({"solve", "block.toml", "--out", "o"}).status, 0);
  const std::string series = read(folder_ / "o/solution.pvd");
  const std::regex entry("<DataSet timestep=\"([^\"]*)\" part=\"0\" file=\"([^\"]*)\"/>");
  std::vector<double> times;
  for (auto found = std::sregex_iterator(series.begin(), series.end(), entry); found != std::sregex_iterator();
       ++found) {
    times.push_back(std::stod((*found)[1]));
    const std::string file = read(folder_ / "o" / (*found)[2].str());
    for (const char* name : {"contact", "normal_traction", "tangential_traction", "contact_pressure"})
      EXPECT_THAT(file, HasSubstr(std::string("Name=\"") + name + "\"")) << (*found)[2];
  }
  EXPECT_THAT(times, testing::ElementsAre(0.1, 0.5, 0.75, 1));
}

TEST_F(Steps, WhatFailsInItsSmallestPartEndsTheRun) {
  write("block.toml", block);
  const Ended ended = signorini({"solve", "block.toml", "--out", "o", "--set", "solver.max_iterations=2", "--set",
                                 "steps.at=[0.5, 1]", "--set", "steps.halvings=2"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.err, HasSubstr("warning: step 1: from t = 0 to 0.5 no solution was found, and it was cut in two"));
  EXPECT_THAT(ended.err, HasSubstr("warning: step 1: from t = 0 to 0.25 no solution was found"));
  EXPECT_THAT(ended.out, HasSubstr("not solved: iteration limit 2"));
  EXPECT_THAT(ended.out, HasSubstr("the part from t = 0 to 0.125 of a step that was cut in two 2 times"));
  const auto r = report("o");
  EXPECT_EQ(r.at("converged"), false);
  ASSERT_EQ(r.at("steps").size(), 1u);
  EXPECT_EQ(r.at("steps")[0].at("t"), 0.125);
  EXPECT_EQ(r.at("steps")[0].at("halvings"), 2);
  EXPECT_EQ(r.at("steps")[0].at("converged"), false);
  ASSERT_EQ(r.at("failed_steps").size(), 2u);
  EXPECT_EQ(r.at("failed_steps")[1].at("t"), 0.25);
  EXPECT_EQ(r.at("failed_steps")[1].at("iterations"), 2);
  const auto rows = table("o/steps.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("converged"), "0");
  EXPECT_THAT(written("o"), IsSupersetOf({"solution_001.vtu", "solution.pvd"}));
}

TEST_F(Steps, AnErrorKeepsTheStepsThatWereFinished) {
  write("block.toml", block);
  const Ended ended = signorini({"solve", "block.toml", "--out", "o", "--set", "steps.at=[0.5, 1]", "--set",
                                 "obstacle.0.bound='0.01 - 0.012 * t'"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("obstacle.0.bound"), HasSubstr("1 of 2 steps were finished and are written")));
  const auto r = report("o");
  EXPECT_EQ(r.at("converged"), false);
  EXPECT_THAT(r.at("reason").get<std::string>(), HasSubstr("obstacle.0.bound"));
  ASSERT_EQ(r.at("steps").size(), 1u);
  EXPECT_EQ(r.at("steps")[0].at("converged"), true);
  EXPECT_THAT(written("o"), IsSupersetOf({"solution_001.vtu", "solution.pvd", "steps.csv"}));
}

TEST_F(Steps, WhatFailsAsAWholeIsSolvedInParts) {
  write("block.toml", block);
  const Ended ended =
      signorini({"solve", "block.toml", "--out", "o", "--set", "solver.max_iterations=16", "--set", "solver.method=pgs",
                 "--set", "solver.tolerance=1e-7", "--set", "refine.uniform=2", "--set", "steps.at=[0.5, 1]", "--set",
                 "obstacle.0.bound=0.01", "--set", "fix.0.value=['0.02 * t', -0.03]"});
  EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("warning: step 2: from t = 0.5 to 1 no solution was found, and it was cut in two"));
  EXPECT_THAT(ended.out, HasSubstr("more failed and were cut in two"));
  const auto r = report("o");
  EXPECT_EQ(r.at("converged"), true);
  const auto& steps = r.at("steps");
  ASSERT_GE(steps.size(), 3u);
  EXPECT_EQ(steps.size(), r.at("failed_steps").size() + 2) << "each makes two of one";
  EXPECT_EQ(table("o/steps.csv").size(), steps.size());
  EXPECT_EQ(wrong_with({folder_ / "o/report.json"}), "");
  std::size_t files = 0;
  for (const std::string& name : written("o")) files += name.starts_with("solution_");
  EXPECT_EQ(files, steps.size());
  double from = 0;
  for (const auto& step : steps) {
    EXPECT_EQ(step.at("from"), from);
    from = step.at("t");
  }
  EXPECT_EQ(from, 1);
}

// Without friction, or where nothing depends on t, a part is no easier than the whole.
TEST_F(Steps, WhatPartsDoNotHelpIsNotCut) {
  write("block.toml", block);
  const std::vector<std::string> limited = {"solve", "block.toml", "--out", "o", "--set", "solver.max_iterations=2"};
  auto still = limited;
  std::string scene = block;
  const std::string friction = "type = 'tresca'\nbound = 0.004";
  scene.replace(scene.find(friction), friction.size(), "type = 'contact'");
  write("block.toml", scene);
  EXPECT_EQ(signorini(limited).status, 3);
  EXPECT_EQ(report("o").at("failed_steps").size(), 0u);
  EXPECT_EQ(report("o").at("steps").size(), 4u) << "each is a problem of its own";
  write("block.toml", block);
  still.insert(still.end(), {"--set", "fix.0.value=[0.03, -0.03]"});
  EXPECT_EQ(signorini(still).status, 3);
  EXPECT_EQ(report("o").at("failed_steps").size(), 0u);
  EXPECT_EQ(report("o").at("steps").size(), 1u) << "the next one would start from it";
}

TEST_F(Steps, OneStepHasNoTable) {
  write("block.toml", block);
  const Ended ended = signorini({"solve", "block.toml", "--out", "o", "--set", "steps.at=[1]"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(written("o"), Not(testing::Contains("steps.csv")));
  EXPECT_THAT(written("o"), Not(testing::Contains("steps.png")));
  EXPECT_TRUE(fs::exists(folder_ / "o/solution.vtu"));
  EXPECT_THAT(ended.out, Not(HasSubstr("the last of")));
  const auto r = report("o");
  ASSERT_EQ(r.at("steps").size(), 1u);
  EXPECT_EQ(r.at("steps")[0].at("contact"), r.at("contact"));
}

TEST_F(Steps, BothWaysToListThemAreRefused) {
  write("block.toml", block);
  const Ended ended = signorini({"solve", "block.toml", "--set", "steps.count=2"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("block.toml:30: steps.at: both 'at' and 'count' (--set steps.count=2)"));
}

// A force that turns round is seen to do so, one that turns sideways has its size.
TEST(StepsPanels, HaveForcesWithTheirSigns) {
  Report report;
  report.dimension = 2;
  const double along[] = {0.5, -2, 1}, across[] = {0, 0, 3};
  for (std::size_t k = 0; k < 3; ++k) {
    StepReport& step = report.steps.emplace_back();
    step.t = (static_cast<double>(k) + 1) / 3;
    ContactReport& contact = step.contact.emplace_back();
    contact.slip_nodes = 1;
    contact.normal_force = {across[k], 4};
    contact.tangential_force = {along[k], 0};
    contact.motion = contact.displacement = {0, 0};
  }
  const std::vector<Panel> panels = steps_panels(report);
  ASSERT_EQ(panels.size(), 2u);
  ASSERT_EQ(panels[0].lines.size(), 2u);
  const Line &normal = panels[0].lines[0], &tangential = panels[0].lines[1];
  ASSERT_EQ(tangential.points.size(), 4u);
  const double expected[] = {0, -0.5, 2, -1};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(tangential.points[k][1], expected[k]);
  EXPECT_EQ(tangential.name, "tangential");
  EXPECT_EQ(normal.points.back()[1], 5);
  EXPECT_EQ(normal.name, "normal, size");
}

/// All steps of a scene without probes.
Report solved(const fs::path& file, const std::vector<std::string>& overrides) {
  Scene scene = read_scene(file, overrides);
  scene.probes.clear();
  Driver driver(std::move(scene));
  return driver.solve();
}

std::vector<std::array<double, 2>> force_over_displacement(const Report& report) {
  return steps_panels(report).at(1).lines.at(0).points;
}

// It begins at t = 0 and not at the first step, which here is a third of the way.
TEST_F(Steps, ForceOverDisplacementIsThatOfTheWayAlongTheObstacle) {
  const fs::path file = write("block.toml", block);
  const std::string steps = "steps.at=[0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1]";
  const Report pushed = solved(file, {steps, "fix.0.value=['-0.1 * t', -0.03]"});
  const Report dragged = solved(file, {steps, "fix.0.value=[0, -0.03]", "obstacle.0.point=['0.5 + 0.1 * t', 0]"});
  const auto top = force_over_displacement(pushed), plane = force_over_displacement(dragged);
  const double dissipated = dragged.last().contact[0].dissipated;
  ASSERT_EQ(top.size(), 9u);
  ASSERT_EQ(plane.size(), 9u);
  for (std::size_t k = 0; k < top.size(); ++k) {
    EXPECT_NEAR(plane[k][0], top[k][0], 1e-8) << k;
    EXPECT_NEAR(plane[k][1], top[k][1], 1e-8) << k;
    EXPECT_GE(plane[k][0], k == 0 ? 0 : plane[k - 1][0]) << "it moves one way";
  }
  double area = 0;
  for (std::size_t k = 1; k < plane.size(); ++k) area += plane[k][1] * (plane[k][0] - plane[k - 1][0]);
  EXPECT_NEAR(area / dissipated, 1, 0.02) << "force times way";
}

TEST_F(Steps, CheckLooksAtAllOfThem) {
  const auto with = [](const std::string& friction) {
    std::string scene = block;
    scene.replace(scene.find("type = 'tresca'"), 29, "type = 'coulomb'\nfriction = '" + friction + "'");
    return scene;
  };
  write("block.toml", with("0.3"));
  EXPECT_EQ(signorini({"check", "block.toml"}).status, 0);
  write("block.toml", with("abs(t - 0.5) < 0.1 ? -1 : 0.3"));
  const Ended wrong = signorini({"check", "block.toml"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("obstacle.0.friction"));
  EXPECT_THAT(wrong.err, HasSubstr("at t = 0.5"));
}

TEST_F(Steps, CheckRefusesMethodsThatKnowNoFriction) {
  write("block.toml", block);
  for (const char* command : {"check", "solve"}) {
    const Ended ended = signorini({command, "block.toml", "--set", "solver.method=pdas"});
    EXPECT_EQ(ended.status, 2) << command;
    EXPECT_THAT(ended.err, HasSubstr("body.0: solver.method: 'pdas' treats bounds alone")) << command;
  }
  EXPECT_EQ(signorini({"check", "block.toml", "--set", "solver.method=newton"}).status, 0);
}

}  // namespace
}  // namespace signorini::test
