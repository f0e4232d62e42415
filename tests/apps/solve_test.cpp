#include <fmt/format.h>

#include "apps/scenes/tables.hpp"
#include "program.hpp"

namespace signorini::test {
namespace {
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::StartsWith;
using testing::UnorderedElementsAre;

class Solve : public Program {};

TEST_F(Solve, WritesAllFilesIntoAFolderNamedAfterTheScene) {
  write("membrane.toml", membrane);
  const Ended ended = signorini({"solve", "membrane.toml"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(written(), UnorderedElementsAre("membrane"));
  EXPECT_THAT(written("membrane"), UnorderedElementsAre("report.json", "solution.vtu", "convergence.csv", "phases.csv",
                                                        "convergence.png", "result.png"));
  EXPECT_EQ(read(folder_ / "membrane/result.png").substr(1, 3), "PNG");
  EXPECT_EQ(read(folder_ / "membrane/convergence.png").substr(1, 3), "PNG");
}

TEST_F(Solve, PrintsTheConvergenceTableAndNothingWhenQuiet) {
  write("membrane.toml", membrane);
  const Ended ended = signorini({"solve", "membrane.toml"});
  EXPECT_THAT(ended.out, HasSubstr("iteration"));
  EXPECT_THAT(ended.out, HasSubstr("report.json"));
  EXPECT_EQ(ended.err, "");
  const Ended quiet = signorini({"solve", "membrane.toml", "--quiet"});
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Solve, SaysOnStandardErrorWhyThereIsNoSolution) {
  write("membrane.toml", membrane);
  const std::vector<std::string> limited{"solve", "membrane.toml",         "--set", "solver.max_iterations=1",
                                         "--set", "solver.method=monotone"};
  const Ended ended = signorini(limited);
  EXPECT_EQ(ended.status, 3);
  EXPECT_THAT(ended.out, HasSubstr("not solved: iteration limit 1"));
  EXPECT_THAT(ended.out, HasSubstr("report.json"));
  EXPECT_THAT(ended.err, StartsWith("signorini: error: not solved: iteration limit 1"));
  auto silent = limited;
  silent.push_back("--quiet");
  const Ended quiet = signorini(silent);
  EXPECT_EQ(quiet.status, 3);
  EXPECT_EQ(quiet.out, "");
  EXPECT_EQ(quiet.err, ended.err);
}

// Every outcome that is no solution: here a pushed block that friction does not hold.
TEST_F(Solve, SaysSoOfFrictionThatDoesNotHold) {
  write("block.toml", tables::block("b", "[0, 0]", "[2, 1]", "[8, 4]") + tables::load("b", "[0.0031, -0.01]") +
                          tables::plane("b", "bottom", "[0, 0]", "[0, 1]") + "[refine]\nuniform = 1\n");
  const Ended quiet = signorini(
      {"solve", "block.toml", "--quiet", "--set", "obstacle.0.type=coulomb", "--set", "obstacle.0.friction=0.2"});
  EXPECT_EQ(quiet.status, 4);
  EXPECT_EQ(quiet.out, "");
  EXPECT_THAT(quiet.err, StartsWith("signorini: error: block.toml:1: body.0: no solution: friction does not hold"));
}

TEST_F(Solve, ReportHoldsThePromisedKeysWithTheirTypes) {
  write("punch.toml", punch);
  ASSERT_EQ(signorini({"solve", "punch.toml", "--out", "o"}).status, 0);
  const auto r = report("o");
  EXPECT_EQ(r.at("title"), "punch");
  EXPECT_EQ(r.at("scene"), "punch.toml");
  EXPECT_EQ(r.at("dimension"), 3);
  EXPECT_EQ(r.at("converged"), true);
  EXPECT_EQ(r.at("limited_by_rounding").is_boolean(), true);
  for (const char* key : {"residual", "algebraic_error", "rounding_error", "energy", "peak_memory_mb"})
    EXPECT_TRUE(r.at(key).is_number_float()) << key;
  EXPECT_TRUE(r.at("rate").is_number_float() || r.at("rate").is_null());
  EXPECT_EQ(r.at("stages").front().at("iterations"), r.at("iterations"));
  EXPECT_EQ(r.at("stages").back().at("outcome"), "solved");
  for (const char* key : {"unknowns", "iterations", "linear_phase_from"})
    EXPECT_TRUE(r.at(key).is_number_integer()) << key;
  for (const char* key : {"mesh", "assemble", "setup", "solve", "output", "total"})
    EXPECT_GE(r.at("time").at(key).get<double>(), 0) << key;
  ASSERT_EQ(r.at("levels").size(), 2u);
  EXPECT_EQ(r.at("levels")[1].at("unknowns"), r.at("unknowns"));
  ASSERT_EQ(r.at("history").size(), r.at("iterations"));
  for (const char* key : {"iteration", "residual", "energy", "contact_nodes", "changed"})
    EXPECT_TRUE(r.at("history")[0].at(key).is_number()) << key;
  EXPECT_EQ(r.at("plugins")[0].at("id"), "contact");
  EXPECT_TRUE(fs::exists(r.at("plugins")[0].at("file").get<std::string>()));
  EXPECT_EQ(r.at("plugins")[0].at("licence"), "BSD-3-Clause");
  EXPECT_THAT(r.at("libraries")[0].at("file").get<std::string>(), HasSubstr("libsignorini_core.so"));
  for (const auto& library : r.at("libraries")) EXPECT_TRUE(library.at("licence").is_string()) << library;
  EXPECT_TRUE(r.at("estimate").is_null());
}

TEST_F(Solve, PeakMemoryIsThatOfTheRunAndNotOfWhatStartedIt) {
  write("membrane.toml", membrane);
  const std::vector<char> large(std::size_t{600} << 20, 'x');
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o", "--set", "output.pictures=false"}).status, 0);
  EXPECT_EQ(large.back(), 'x');
  const double peak = report("o").at("peak_memory_mb");
  EXPECT_GT(peak, 1);
  EXPECT_LT(peak, 400);
}

TEST_F(Solve, PhasesOfEveryLevelAreReported) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o"}).status, 0);
  const auto r = report("o");
  EXPECT_EQ(r.at("levels").front().at("level"), 0) << "the coarsest mesh";
  std::istringstream csv(read(folder_ / "o/phases.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "step,iteration,level,vectors,critical,contact_0,contact_1,contact_2,changed,renewed,seconds");
  for (const auto& record : r.at("history")) {
    const auto& levels = record.at("levels");
    ASSERT_EQ(levels.size(), r.at("levels").size());
    EXPECT_EQ(levels.front().at("level"), 0);
    EXPECT_EQ(levels.back().at("critical"), record.at("contact_nodes"));
    EXPECT_EQ(levels.back().at("contact")[0], record.at("contact_nodes")) << "one direction";
    EXPECT_EQ(levels.back().at("changed"), record.at("changed"));
    for (const auto& level : levels) {
      ASSERT_TRUE(std::getline(csv, line));
      EXPECT_THAT(line, HasSubstr(fmt::format(",{},{},{},", level.at("level").get<int>(),
                                              level.at("vectors").get<int>(), level.at("critical").get<int>())));
    }
  }
  EXPECT_FALSE(std::getline(csv, line));
}

TEST_F(Solve, LargeUnrefinedMeshesGetAlgebraicLevels) {
  write("membrane.toml", membrane);
  const std::vector<std::string> fine{"--set", "body.0.cells=[40, 40]", "--set", "refine.uniform=0"};
  const auto solved = [&](const std::string& algebraic) {
    std::vector<std::string> arguments{"solve", "membrane.toml", "--out",
                                       "o",     "--set",         "solver.algebraic=" + algebraic};
    arguments.insert(arguments.end(), fine.begin(), fine.end());
    const Ended ended = signorini(arguments);
    EXPECT_EQ(ended.status, 0) << ended.err;
    return report("o");
  };
  const auto with = solved("true"), without = solved("false");
  EXPECT_GE(with.at("levels").size(), 2u);
  EXPECT_EQ(without.at("levels").size(), 1u);
  EXPECT_EQ(without.at("levels").front().at("level"), 0);
  EXPECT_EQ(with.at("levels").back().at("level"), 0) << "the coarsest mesh";
  EXPECT_EQ(with.at("levels").front().at("level"), 1 - static_cast<int>(with.at("levels").size()));
  EXPECT_NEAR(with.at("energy").get<double>() / without.at("energy").get<double>(), 1, 1e-12);
  EXPECT_LE(with.at("iterations"), 25);
}

TEST_F(Solve, PunchGivesUniformPressureAndItsForce) {
  write("punch.toml", punch);
  ASSERT_EQ(signorini({"solve", "punch.toml", "--out", "o"}).status, 0);
  const auto r = report("o");
  const double pressure = 0.01 * 0.75 / (1.25 * 0.5);  // E (1 - nu) / ((1 + nu) (1 - 2 nu)) times the strain
  const auto contact = r.at("contact").at(0);
  EXPECT_EQ(contact.at("obstacle"), 0);
  EXPECT_EQ(contact.at("nodes"), 25);
  EXPECT_NEAR(contact.at("area"), 1, 1e-9);
  EXPECT_NEAR(contact.at("force").at(2), -pressure, 1e-9 * pressure);
  EXPECT_NEAR(contact.at("max_pressure"), pressure, 1e-9 * pressure);
  EXPECT_EQ(contact.at("slip_nodes"), 0);
  EXPECT_EQ(contact.at("stick_nodes"), 0);
  EXPECT_NEAR(r.at("energy"), 0.5 * 0.01 * pressure, 1e-9 * pressure);
  EXPECT_EQ(r.at("probes").at(0).at("name"), "top");
  EXPECT_NEAR(r.at("probes").at(0).at("displacement").at(2), -0.01, 1e-12);
}

TEST_F(Solve, EnergyCountsPrescribedValues) {
  std::string scene = membrane;
  scene.replace(scene.find("value = [0]"), 11, "value = [\"x\"]");
  write("linear.toml", scene);
  ASSERT_EQ(signorini({"solve", "linear.toml", "--out", "o", "--set", "obstacle.0.lower=-5"}).status, 0);
  EXPECT_NEAR(report("o").at("energy"), 2, 1e-9);  // 1/2 times the area, for u = x
}

TEST_F(Solve, ScalarProbeIsAValue) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o"}).status, 0);
  EXPECT_DOUBLE_EQ(report("o").at("probes").at(0).at("value").get<double>(), 0.5);  // the obstacle's top
}

TEST_F(Solve, SetOverridesTheScene) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--set", "refine.uniform=1", "--set", "solver.tolerance=1e-3", "--out",
                       "o", "--set", "obstacle.0.lower=-1"})
                .status,
            0);
  const auto r = report("o");
  EXPECT_EQ(r.at("unknowns"), 49);
  EXPECT_EQ(r.at("contact").at(0).at("nodes"), 0);
}

TEST_F(Solve, OutputSwitchesLeaveFilesOut) {
  write("membrane.toml", membrane + "[output]\nvtu = false\npictures = false\nconvergence = false\n");
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o"}).status, 0);
  EXPECT_THAT(written("o"), UnorderedElementsAre("report.json"));
}

TEST_F(Solve, StepsWriteASeriesAndEndWhereOneStepDoes) {
  write("punch.toml", punch + "[steps]\ncount = 3\n");
  ASSERT_EQ(signorini({"solve", "punch.toml", "--out", "o"}).status, 0);
  EXPECT_THAT(written("o"), IsSupersetOf({"solution_001.vtu", "solution_002.vtu", "solution_003.vtu", "solution.pvd"}));
  EXPECT_FALSE(fs::exists(folder_ / "o/solution.vtu"));
  EXPECT_THAT(read(folder_ / "o/solution.pvd"), HasSubstr("solution_003.vtu"));
  const auto r = report("o");
  ASSERT_EQ(r.at("steps").size(), 3u);
  EXPECT_NEAR(r.at("steps")[0].at("probes").at(0).at("displacement").at(2), -0.01 / 3, 1e-12);
  EXPECT_NEAR(r.at("probes").at(0).at("displacement").at(2), -0.01, 1e-12);
}

TEST_F(Solve, StartFromZeroGivesTheSameSolution) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "nested"}).status, 0);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "zero", "--set", "solver.start=zero"}).status, 0);
  const double energy = report("nested").at("energy");
  EXPECT_NEAR(report("zero").at("energy"), energy, 1e-10 * std::abs(energy));
}

TEST_F(Solve, IterationLimitWritesResultsMarkedAsNotConverged) {
  write("membrane.toml", membrane);
  EXPECT_EQ(signorini({"solve", "membrane.toml", "--out", "o", "--set", "solver.max_iterations=1", "--set",
                       "solver.tolerance=1e-12"})
                .status,
            3);
  EXPECT_EQ(report("o").at("converged"), false);
  EXPECT_TRUE(fs::exists(folder_ / "o/solution.vtu"));
}

/// A block that slides along walls, pressed on a plane under it.
const std::string block_on_plane =
    tables::block("b", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 2]", "order = 1\nyoung = 1.0\npoisson = 0.25\n") + R"(
[[fix]]
body = "b"
where = "x == 0 || x == 1"
value = [0, "free", "free"]
[[fix]]
body = "b"
where = "y == 0 || y == 1"
value = ["free", 0, "free"]
)" + tables::load("b", "[0, 0, -0.01]", "top") +
    tables::plane("b", "bottom", "[0, 0, 0]", "[0, 0, 1]");

TEST_F(Solve, SaysThatABodyStartsInsideAnObstacle) {
  write("block.toml", block_on_plane);
  ASSERT_EQ(signorini({"solve", "block.toml", "--out", "o"}).status, 0);
  EXPECT_EQ(report("o").at("warnings").dump(), "[]");
  ASSERT_EQ(signorini({"solve", "block.toml", "--out", "p", "--set", "obstacle.0.point=[0, 0, 0.5]"}).status, 0);
  EXPECT_THAT(report("p").at("warnings").dump(),
              HasSubstr("starts inside the obstacle: it reaches 0.5 deep, and is 1 thick along"));
}

TEST_F(Solve, NamesAReversedNormalWhereItLeavesNoSolution) {
  write("block.toml", block_on_plane);
  const auto ended = signorini({"solve", "block.toml", "--out", "o", "--set", "obstacle.0.normal=[0, 0, -1]"});
  EXPECT_EQ(ended.status, 4);
  EXPECT_THAT(ended.err, HasSubstr("starts completely inside the obstacle: it reaches 1 deep, and is 1 thick along"));
  EXPECT_THAT(ended.err, HasSubstr("on the wrong side ('normal', 'inside')?"));
}

TEST_F(Solve, MeasuresTheTrueGapOfTheDeformedBody) {
  write("block.toml", block_on_plane);
  ASSERT_EQ(signorini({"solve", "block.toml", "--out", "o"}).status, 0);
  const auto flat = report("o").at("contact").at(0);
  EXPECT_LE(flat.at("largest_penetration"), 1e-12);
  EXPECT_LE(flat.at("largest_penetration_between_nodes"), 1e-12);
  EXPECT_LE(flat.at("largest_opening"), 1e-12);
  EXPECT_EQ(flat.at("undetermined_nodes"), 0);
  // A small ball that the block is pressed far onto.
  std::string text = block_on_plane;
  text.replace(text.find("shape = \"plane\""), std::string::npos,
               "shape = \"sphere\"\ncenter = [0.6, 0.5, -0.5]\nradius = 0.5\nrenew = false\n");
  write("ball.toml", text);
  ASSERT_EQ(
      signorini({"solve", "ball.toml", "--out", "r", "--set", "refine.uniform=1", "--set", "load.0.value=[0, 0, -0.1]"})
          .status,
      0);
  const auto round = report("r").at("contact").at(0);
  EXPECT_GT(std::max(round.at("largest_penetration").get<double>(), round.at("largest_opening").get<double>()), 1e-3);
  EXPECT_THAT(report("r").at("warnings").dump(), HasSubstr("contact is linear in the displacements"));
}

TEST_F(Solve, SaysWhereTooFewNodesTouch) {
  std::string text = block_on_plane;
  text.replace(text.find("shape = \"plane\""), std::string::npos,
               "shape = \"sphere\"\ncenter = [0.5, 0.5, -0.1]\nradius = 0.1\n");
  write("ball.toml", text);
  ASSERT_EQ(signorini({"solve", "ball.toml", "--out", "o"}).status, 0);
  EXPECT_EQ(report("o").at("contact").at(0).at("resolved"), false);
  EXPECT_THAT(report("o").at("warnings").dump(), HasSubstr("too few of them have contact all around"));
  write("block.toml", block_on_plane);
  ASSERT_EQ(signorini({"solve", "block.toml", "--out", "q"}).status, 0);
  EXPECT_EQ(report("q").at("contact").at(0).at("resolved"), true);
  EXPECT_EQ(report("q").at("warnings").dump(), "[]");
}

TEST_F(Solve, WarnsWhereLinearElementsLock) {
  write("punch.toml", punch);
  ASSERT_EQ(signorini({"solve", "punch.toml", "--out", "o", "--set", "body.0.poisson=0.49", "--set", "body.0.order=1"})
                .status,
            0);
  EXPECT_THAT(report("o").at("warnings").dump(),
              HasSubstr("linear elements are too stiff for nearly incompressible material"));
  EXPECT_THAT(report("o").at("warnings").dump(), HasSubstr("43 % at 0.49"));
  ASSERT_EQ(signorini({"solve", "punch.toml", "--out", "q", "--set", "body.0.poisson=0.45"}).status, 0);
  EXPECT_THAT(report("q").at("warnings").dump(), HasSubstr("7 % off at 0.45"));
  EXPECT_THAT(report("o").at("warnings").dump(), HasSubstr("here 49; order = 2 does not lock"));
  ASSERT_EQ(signorini({"solve", "punch.toml", "--out", "s", "--set", "body.0.poisson=0.4999", "--set",
                       "body.0.pressure=none", "--set", "body.0.order=2"})
                .status,
            0);
  EXPECT_THAT(report("s").at("warnings").dump(), HasSubstr("quadratic elements of displacements alone"));
  for (const char* poisson : {"body.0.poisson=0.3", "body.0.poisson=0.4999"}) {
    ASSERT_EQ(signorini({"solve", "punch.toml", "--out", "p", "--set", poisson, "--set", "body.0.order=auto"}).status,
              0);
    EXPECT_TRUE(report("p").at("warnings").empty()) << poisson;
  }
}

TEST_F(Solve, WithoutTheLibraryForPicturesThereIsANote) {
  write("membrane.toml", membrane);
  const fs::path libraries = fs::path(SIGNORINI_BINARY_DIR) / "lib";
  for (const auto& entry : fs::directory_iterator(libraries))  // alone
    if (entry.path().filename().string().starts_with("libsignorini_core.so"))
      fs::copy(entry.path(), folder_ / entry.path().filename(), fs::copy_options::copy_symlinks);
  setenv("LD_LIBRARY_PATH", folder_.c_str(), 1);
  setenv("SIGNORINI_PLUGIN_PATH", (libraries / "signorini/plugins").c_str(), 1);
  const Ended ended = signorini({"solve", "membrane.toml", "--out", "o"});
  unsetenv("LD_LIBRARY_PATH");
  unsetenv("SIGNORINI_PLUGIN_PATH");
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.err, HasSubstr("no pictures were drawn"));
  EXPECT_THAT(ended.err, HasSubstr("libsignorini_pictures.so"));
  EXPECT_THAT(written("o"), UnorderedElementsAre("report.json", "solution.vtu", "convergence.csv", "phases.csv"));
}

TEST_F(Solve, DrawsAResidualThatIsZero) {
  write("membrane.toml", membrane);
  const Ended ended = signorini({"solve", "membrane.toml", "--out", "o", "--set", "obstacle.0.lower=-1"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.err, testing::HasSubstr("never touch"));
  EXPECT_TRUE(fs::exists(folder_ / "o/convergence.png"));
}

TEST_F(Solve, ConvergenceCsvRepeatsTheHistoryInFullPrecision) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o"}).status, 0);
  std::istringstream csv(read(folder_ / "o/convergence.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "step,iteration,residual,algebraic_error,energy,contact_nodes,changed");
  const auto history = report("o").at("history");
  for (const auto& record : history) {
    std::getline(csv, line);
    int step, iteration;
    double residual;
    ASSERT_EQ(std::sscanf(line.c_str(), "%d,%d,%lf", &step, &iteration, &residual), 3);
    EXPECT_EQ(iteration, record.at("iteration"));
    EXPECT_EQ(residual, record.at("residual").get<double>());
  }
  EXPECT_FALSE(std::getline(csv, line));
}

TEST_F(Solve, VtkReadsTheSolution) {
  if (std::getenv("SIGNORINI_SKIP_VTK")) GTEST_SKIP();
  write("punch.toml", punch);
  ASSERT_EQ(signorini({"solve", "punch.toml", "--out", "o"}).status, 0);
  const std::string command = "/usr/bin/python3 '" SIGNORINI_SOURCE_DIR "/tests/core/io/vtk_dump.py' '" +
                              (folder_ / "o/solution.vtu").string() + "' > '" + (folder_ / "dump").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0) << "needs the package python3-vtk9";
  const std::string dump = read(folder_ / "dump");
  EXPECT_THAT(dump, HasSubstr("points 125\ncells 384\n"));
  for (const char* array : {"displacement 3", "stress 9", "von_mises 1", "gap 1", "contact_pressure 1",
                            "tangential_traction 3", "contact 1"})
    EXPECT_THAT(dump, HasSubstr(std::string("\npoint ") + array + " "));
  std::istringstream lines(dump);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind, name, components, number;
    words >> kind >> name >> components;
    int numbers = 0;
    while (words >> number) numbers += number != "nan";
    if (name == "gap")
      EXPECT_EQ(numbers, 25) << "the vertices of the top";
    else
      EXPECT_THAT(line, testing::Not(HasSubstr("nan")));
  }
}

TEST_F(Solve, ContactFieldsAreLeftOutWithoutObstacles) {
  std::string scene = membrane;
  scene.erase(scene.find("[[obstacle]]"), scene.find("[refine]") - scene.find("[[obstacle]]"));
  write("membrane.toml", scene);
  const Ended ended = signorini({"solve", "membrane.toml", "--out", "o"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  const std::string solution = read(folder_ / "o/solution.vtu");
  EXPECT_THAT(solution, HasSubstr("Name=\"u\""));
  for (const char* name : {"gap", "contact_pressure", "contact"})
    EXPECT_THAT(solution, testing::Not(HasSubstr(fmt::format("Name=\"{}\"", name))));
}

TEST_F(Solve, ErrorsNameTheStep) {
  write("membrane.toml", membrane + "[steps]\ncount = 4\n");
  struct {
    const char *lower, *message;
    int status;
  } cases[] = {{"1.5 * t - x^2 - y^2 ", "beyond the fixed boundary", 4}, {"log(0.6 - t)", "'log(0.6 - t)'", 2}};
  for (const auto& [lower, message, status] : cases) {
    const std::string set = fmt::format("obstacle.0.lower={}", lower);
    const Ended ended = signorini({"solve", "membrane.toml", "--set", set}),
                checked = signorini({"check", "membrane.toml", "--set", set});
    EXPECT_EQ(ended.status, status);
    EXPECT_THAT(ended.err,
                testing::AllOf(HasSubstr(message),
                               testing::HasSubstr(", at t = 0.75; 2 of 4 steps were finished and are written")));
    EXPECT_EQ(checked.status, status);
    EXPECT_THAT(checked.err, testing::AllOf(HasSubstr(message), testing::EndsWith(", at t = 0.75\n")));
    EXPECT_THAT(signorini({"solve", "membrane.toml", "--set", set, "--set", "steps.count=1"}).err,
                testing::Not(HasSubstr("at t =")));
  }
}

TEST_F(Solve, ProbesOutsideABallAreRefused) {
  write("ball.toml", R"([[body]]
name = "b"
shape = "ball"
center = [0, 0, 0]
radius = 2
size = 1
equation = "diffusion"
[[fix]]
body = "b"
on = "boundary"
value = [0]
[[probe]]
name = "p"
body = "b"
at = [0, 1.2, -1.6]
)");
  EXPECT_EQ(signorini({"check", "ball.toml"}).err, "");
  const Ended ended = signorini({"check", "ball.toml", "--set", "probe.0.at=[0, 1.5, -2]"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("point (0, 1.5, -2) lies outside the body"));
}

// A report that is there after a run is that of the run.
TEST_F(Solve, TheReportOfAnEarlierRunIsSetAside) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o"}).status, 0);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o", "--set", "refine.uniforn=1"}).status, 2);
  EXPECT_FALSE(fs::exists(folder_ / "o/report.json"));
  EXPECT_TRUE(fs::exists(folder_ / "o/report.old.json"));
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o"}).status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "o/report.json"));
  EXPECT_FALSE(fs::exists(folder_ / "o/report.old.json"));
}

TEST_F(Solve, AListThatIsNoneIsRefusedAsOne) {
  write("membrane.toml", membrane);
  EXPECT_THAT(signorini({"check", "membrane.toml", "--set", "fix.0.value=[1,"}).err,
              HasSubstr("found '[1,', expected a list as [0, -0.05]"));
}

}  // namespace
}  // namespace signorini::test
