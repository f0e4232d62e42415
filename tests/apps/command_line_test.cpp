#include "program.hpp"

#include <fmt/format.h>
#include <pty.h>
#include <sys/stat.h>

#include <algorithm>
#include <regex>

namespace signorini::test {
namespace {
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class CommandLine : public Program {};

/// What a terminal shows in the end of what was written to it.
std::string shown(const std::string& written) {
  const std::string erase = "\r\x1b[K";
  std::string screen;
  for (std::size_t at = 0; at < written.size(); ++at)
    if (written.compare(at, erase.size(), erase) == 0) {
      screen.erase(screen.rfind('\n') + 1);
      at += erase.size() - 1;
    } else {
      screen += written[at];
    }
  return screen;
}

/// Rows of convergence tables: a number, three in exponential form, two more.
std::ptrdiff_t count_rows(const std::string& text) {
  static const std::regex row(R"(\d+ +\d\.\d+e\S+ +\d\.\d+e\S+ +-?\d\.\d+e\S+ +\d+ +\d+)");
  return std::distance(std::sregex_iterator(text.begin(), text.end(), row), std::sregex_iterator());
}

TEST_F(CommandLine, HelpNamesAllCommandsAndEndsWell) {
  const Ended ended = signorini({"--help"});
  EXPECT_EQ(ended.status, 0);
  for (const char* command : {"solve", "check", "qp", "list", "Exit status"})
    EXPECT_THAT(ended.out, HasSubstr(command));
  const Ended solve = signorini({"solve", "--help"});
  EXPECT_EQ(solve.status, 0);
  for (const char* option : {"--out", "--set", "--quiet", "SCENE", "Exit status", "iteration limit"})
    EXPECT_THAT(solve.out, HasSubstr(option));
  EXPECT_THAT(signorini({"check", "--help"}).out,
              testing::AllOf(HasSubstr("Exit status"), testing::Not(HasSubstr("iteration limit"))));
}

TEST_F(CommandLine, VersionIsPrinted) {
  const Ended ended = signorini({"--version"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_THAT(ended.out, StartsWith("signorini 0."));
}

TEST_F(CommandLine, WrongUsageIsStatusOneWithAMessage) {
  const std::vector<std::vector<std::string>> wrong = {{},
                                                       {"sovle"},
                                                       {"solve"},
                                                       {"solve", "a.toml", "b.toml"},
                                                       {"solve", "a.toml", "--nonsense"},
                                                       {"list", "nothing"},
                                                       {"solve", "a.toml", "--out"},
                                                       {"solve", "a.toml", "--out", ""}};
  for (const auto& arguments : wrong) {
    const Ended ended = signorini(arguments);
    EXPECT_EQ(ended.status, 1) << testing::PrintToString(arguments);
    EXPECT_THAT(ended.err, StartsWith("signorini: error: "));
  }
}

TEST_F(CommandLine, NamesTheNearestCommand) {
  EXPECT_THAT(signorini({"lst"}).err, HasSubstr("there is no command 'lst', did you mean 'list'?"));
}

TEST_F(CommandLine, NamesTheNearestOptionAndValue) {
  struct {
    std::vector<std::string> arguments;
    const char* message;
  } cases[] = {
      {{"list", "obstcles"}, "found 'obstcles', expected one of solver | libraries | obstacles | "},
      {{"list", "obstcles"}, ", did you mean 'obstacles'?"},
      {{"qp", "A.mtx", "b.mtx", "--method", "monotne"}, ", did you mean 'monotone'?"},
      {{"solve", "a.toml", "--oot", "o"}, "there is no option '--oot', did you mean '--out'?"},
      {{"solve", "--quite", "a.toml"}, "there is no option '--quite', did you mean '--quiet'?"},
      {{"qp", "A.mtx", "b.mtx", "--uper=u.mtx"}, "there is no option '--uper', did you mean '--upper'?"},
      {{"--versoin"}, "there is no option '--versoin', did you mean '--version'?"},
  };
  for (const auto& [arguments, message] : cases) {
    const Ended ended = signorini(arguments);
    EXPECT_EQ(ended.status, 1) << message;
    EXPECT_THAT(ended.err, HasSubstr(message));
  }
}

TEST_F(CommandLine, AnUnknownPathOfSetIsBadInputAsAWrongValueIs) {
  write("membrane.toml", membrane);
  const Ended ended = signorini({"solve", "membrane.toml", "--set", "solver.tolerence=1e-3"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("tolerance"));
  EXPECT_THAT(written(), IsEmpty());
}

TEST_F(CommandLine, ListShowsComponentsWithOptionsAndFiles) {
  const Ended all = signorini({"list"});
  EXPECT_EQ(all.status, 0) << all.err;
  for (const char* word :
       {"scalar", "contact", "symmetric", "min_merge", "newton", "libsignorini_obstacle_contact.so", "body", "lower"})
    EXPECT_THAT(all.out, HasSubstr(word));
  const Ended smoothers = signorini({"list", "smoothers"});
  EXPECT_THAT(smoothers.out, HasSubstr("symmetric"));
  EXPECT_THAT(smoothers.out, testing::Not(HasSubstr("contact")));
  EXPECT_THAT(
      signorini({"list", "solver"}).out,
      AllOf(HasSubstr("krylov          accelerate the cycles while the phases rest (true or false, default true)"),
            HasSubstr("(text in V | W | F, default V)"), HasSubstr("whole number in [1, 1000000], default 200")));
  const Ended amg = signorini({"list", "amg"});
  for (const char* text : {"classical ", "aggregation ", "(text in auto | classical | aggregation, default auto)",
                           "all | twins", "global | local", "(true or false, default true)"})
    EXPECT_THAT(amg.out, HasSubstr(text));
  EXPECT_THAT(amg.out, HasSubstr("`signorini list aggregates` (text, default greedy)"));
  EXPECT_THAT(signorini({"list", "unsymmetric"}).out, HasSubstr("umfpack "));
  const Ended libraries = signorini({"list", "libraries"});
  EXPECT_THAT(libraries.out, AllOf(HasSubstr("libsignorini_core.so"), HasSubstr("licence: BSD-3-Clause\n"),
                                   HasSubstr("libsignorini_plane.so"), HasSubstr("libsignorini_geometry.so"),
                                   HasSubstr("licence: GPL-3.0-or-later"), HasSubstr("licence: GPL-2.0-or-later"),
                                   HasSubstr("LGPL-2.1-only OR MPL-1.1")));
  EXPECT_THAT(signorini({"list", "obstacles"}).out,
              AllOf(HasSubstr("licence: BSD-3-Clause"), HasSubstr("from libsignorini_obstacle_coulomb.so"),
                    HasSubstr("\n  in " SIGNORINI_BINARY_DIR "/lib/signorini/plugins\n")));
  EXPECT_THAT(signorini({"list", "aggregates"}).out, AllOf(HasSubstr("greedy "), HasSubstr("metis ")));
  EXPECT_THAT(amg.out, HasSubstr("from " SIGNORINI_BINARY_DIR "/bin/signorini"));
}

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return longest;
}

// But for names of files, which have no spaces.
TEST_F(CommandLine, TextFitsTheTerminalAndEightyColumnsElsewhere) {
  write("punch.toml", punch);
  const std::vector<std::vector<std::string>> all{
      {"--help"},      {"solve", "--help"},       {"qp", "--help"},     {"list", "--help"},     {"list", "solver"},
      {"list", "amg"}, {"help", "solver.method"}, {"help", "obstacle"}, {"check", "punch.toml"}};
  for (const auto& [columns, width] : {std::pair("", 80u), std::pair("60", 60u), std::pair("132", 132u)}) {
    columns_ = columns;
    for (const auto& arguments : all) {
      const Ended ended = signorini(arguments);
      EXPECT_EQ(ended.status, 0) << ended.err;
      const std::string text = std::regex_replace(ended.out, std::regex("/\\S+"), "/");
      EXPECT_LE(longest_line(text), width) << testing::PrintToString(arguments) << "\n" << ended.out;
    }
  }
}

TEST_F(CommandLine, ListBeginsWithTheKeysThatMatter) {
  const std::string out = signorini({"list", "solver"}).out;
  const auto at = [&](const char* key) { return out.find(std::string("\n      ") + key + ' '); };
  for (const char* first :
       {"tolerance", "max_iterations", "method", "threads", "cycle", "pre", "post", "coarse", "smoother", "krylov"})
    for (const char* later : {"truncate", "reach", "interpolate", "aggregates", "hierarchy"}) {
      ASSERT_NE(at(later), std::string::npos) << later;
      EXPECT_LT(at(first), at(later)) << first << " " << later;
    }
}

TEST_F(CommandLine, HelpHasAPageOnEachKey) {
  const Ended key = signorini({"help", "solver.tolerance"});
  EXPECT_EQ(key.status, 0) << key.err;
  EXPECT_THAT(key.out, AllOf(HasSubstr("a key of [solver]"), HasSubstr("(0, 1)"), HasSubstr("1e-8"),
                             HasSubstr("tolerance = 1e-10"), HasSubstr("--set solver.tolerance=1e-10")));
  EXPECT_THAT(signorini({"help", "radius"}).out,
              AllOf(HasSubstr("Keys of the same name:"), HasSubstr("obstacle.sphere.radius")));
  EXPECT_THAT(signorini({"help", "obstacle.friction"}).out,
              AllOf(HasSubstr("obstacle.coulomb.friction"), HasSubstr("coefficient of friction"),
                    HasSubstr("type = \"coulomb\"\n  friction = 0.3")));
  EXPECT_EQ(signorini({"help", "obstacle.0.friction"}).out, signorini({"help", "obstacle.friction"}).out);
  EXPECT_EQ(signorini({"help", "fix.1.value.0"}).out, signorini({"help", "fix.value"}).out);
  EXPECT_THAT(signorini({"help", "coulomb"}).out,
              AllOf(StartsWith("coulomb: a type of [[obstacle]]"), HasSubstr("coefficient of friction"),
                    HasSubstr("type = \"coulomb\"\n  friction = 0.3")));
  EXPECT_THAT(signorini({"help", "gap"}).out, HasSubstr("gap = -0.01 "));
  EXPECT_THAT(signorini({"help", "body"}).out,
              AllOf(StartsWith("[[body]]"), HasSubstr("poisson"), HasSubstr("half_ball")));
  EXPECT_EQ(signorini({"help", "qp"}).out, signorini({"qp", "--help"}).out);
  EXPECT_EQ(signorini({"help"}).out, signorini({"--help"}).out);
  const Ended wrong = signorini({"help", "tolerence"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.err, HasSubstr("there is no command, table or key 'tolerence', did you mean 'tolerance'?"));
}

// To renew it, copy the file that this names.
TEST_F(CommandLine, TheManualPageIsWhatTheProgramSays) {
  const std::string page = signorini({"help", "--manual"}).out;
  EXPECT_THAT(page, HasSubstr(".TH SIGNORINI 1"));
  if (read(SIGNORINI_SOURCE_DIR "/apps/signorini/signorini.1") == page) return;
  const std::string renewed = testing::TempDir() + "signorini.1";
  std::ofstream(renewed) << page;
  ADD_FAILURE() << "apps/signorini/signorini.1 is not what the program says; the right text is in " << renewed;
}

TEST_F(CommandLine, CheckSaysWhatWouldBeSolvedAndWritesNothing) {
  write("punch.toml", punch);
  const Ended ended = signorini({"check", "punch.toml"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* text : {"dimension: 3", "equation: elasticity", "libsignorini_obstacle_contact.so", "top",
                           "25 candidate contact vertices"})
    EXPECT_THAT(ended.out, HasSubstr(text));
  EXPECT_THAT(written(), IsEmpty());
  ASSERT_EQ(signorini({"solve", "punch.toml", "--quiet", "--out", "o"}).status, 0);
  EXPECT_THAT(ended.out, HasSubstr(report("o").at("unknowns").dump() + " unknowns"));
}

TEST_F(CommandLine, CheckSolveAndReportSayWhichElementsThereAre) {
  write("punch.toml", punch);
  for (const auto& [given, order, by, text] :
       {std::tuple("1", 1, "scene", "linear (order 1)"), std::tuple("2", 2, "scene", "quadratic (order 2)"),
        std::tuple("auto", 2, "auto", "quadratic (order 2, chosen by auto)")}) {
    const std::string set = std::string("body.0.order=") + given;
    EXPECT_THAT(signorini({"check", "punch.toml", "--set", set}).out, HasSubstr(std::string("elements: ") + text));
    const Ended solved = signorini({"solve", "punch.toml", "--out", "o", "--set", set});
    EXPECT_THAT(solved.out, HasSubstr(std::string("elements: ") + text));
    EXPECT_EQ(report("o").at("bodies").at(0).at("order"), order);
    EXPECT_EQ(report("o").at("bodies").at(0).at("order_by"), by);
  }
}

TEST_F(CommandLine, CheckPrintsTheRulesThatAreInForce) {
  write("membrane.toml", membrane);
  const auto checked = [&](const char* option) {
    const Ended ended = signorini({"check", "membrane.toml", "--set", option});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.out;
  };
  EXPECT_THAT(checked("solver.method=auto"),
              AllOf(HasSubstr("auto: monotone, tnnmg"), HasSubstr("; pdas with amg_cg, else cholmod after")));
  EXPECT_THAT(checked("solver.truncate=none"), testing::Not(HasSubstr("tnnmg")));
  EXPECT_THAT(checked("solver.method=pgs"), testing::Not(HasSubstr("V-cycle")));
  write("punch.toml", punch);
  EXPECT_THAT(signorini({"check", "punch.toml", "--set", "body.0.cells=[10, 10, 10]", "--set", "refine.uniform=0",
                         "--set", "solver.aggregates=metis"})
                  .out,
              HasSubstr("levels below the coarsest mesh by aggregation, aggregates metis"));
}

TEST_F(CommandLine, APipeIsNoScene) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const Ended ended = signorini({"check", "pipe"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, HasSubstr("'pipe' is a pipe or a device, expected a regular file"));
}

TEST_F(CommandLine, InterruptEndsCleanlyAndLeavesNothing) {
  write("membrane.toml", membrane);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = start("signorini", {"solve", "membrane.toml", "--out", "a/b", "--set", "refine.uniform=8"});
    wait_until(child, [&] { return megabytes(child) > 200; });  // of a matrix or a mesh
    kill(child, signal);
    const Ended ended = wait_for(child);
    EXPECT_EQ(ended.status, 130) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("interrupted"));
    EXPECT_THAT(written(), IsEmpty());
  }
}

TEST_F(CommandLine, StepsThatAreFinishedOutliveAnInterrupt) {
  write("membrane.toml", membrane + "[steps]\ncount = 100000\n");
  const pid_t child = start("signorini", {"solve", "membrane.toml", "--out", "o"});
  const auto third_step_is_staged = [&] {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder_ / "o", none))
      if (fs::exists(entry.path() / "solution_003.vtu")) return true;
    return false;
  };
  wait_until(child, third_step_is_staged);
  kill(child, SIGINT);
  const Ended ended = wait_for(child);
  EXPECT_EQ(ended.status, 130);
  EXPECT_THAT(ended.err, HasSubstr("of 100000 steps were finished and are written"));
  const auto r = report("o");
  EXPECT_EQ(r.at("interrupted"), true);
  EXPECT_EQ(r.at("converged"), false);
  const auto& steps = r.at("steps");
  ASSERT_GE(steps.size(), 2u);
  EXPECT_EQ(steps.back().at("converged"), true);
  std::size_t solutions = 0;
  for (const std::string& name : CommandLine::written("o")) solutions += name.starts_with("solution_");
  EXPECT_EQ(solutions, steps.size());
  EXPECT_THAT(read(folder_ / "o/solution.pvd"), HasSubstr("solution_002.vtu"));
}

// By a method that takes for ever, once its table has begun.
TEST_F(CommandLine, AnInterruptedSolveKeepsItsLastIterateMarked) {
  write("membrane.toml", membrane);
  const std::vector<std::string> slowly{"--set", "refine.uniform=5",       "--set", "solver.method=pgs",
                                        "--set", "solver.tolerance=1e-13", "--set", "solver.max_iterations=1000000",
                                        "--set", "output.pictures=false"};
  std::vector<std::string> arguments{"solve", "membrane.toml", "--out", "o"};
  arguments.insert(arguments.end(), slowly.begin(), slowly.end());
  const pid_t child = start("signorini", arguments);
  wait_until(child, [&] { return count_rows(read(folder_ / ".out")) > 3; });
  kill(child, SIGINT);
  const Ended ended = wait_for(child);
  EXPECT_EQ(ended.status, 130);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("interrupted after "),
                               HasSubstr("the last iterate is written, marked \"converged\": false")));
  const auto r = report("o");
  EXPECT_EQ(r.at("interrupted"), true);
  EXPECT_EQ(r.at("converged"), false);
  EXPECT_THAT(r.at("reason").get<std::string>(), StartsWith("interrupted after "));
  EXPECT_THAT(r.at("warnings").dump(), HasSubstr("no solution"));
  EXPECT_GT(r.at("history").size(), 3u);
  EXPECT_GE(r.at("probes")[0].at("value").get<double>(), 0.5 - 1e-12) << "admissible";
  EXPECT_GT(r.at("contact")[0].at("nodes"), 0);
  EXPECT_EQ(wrong_with({folder_ / "o/report.json"}), "");
  const std::regex mark("Name=\"converged\"[^>]*>([01])<");
  std::smatch found;
  std::string vtu = read(folder_ / "o/solution.vtu");
  ASSERT_TRUE(std::regex_search(vtu, found, mark));
  EXPECT_EQ(found[1], "0");
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o", "--quiet"}).status, 0);
  vtu = read(folder_ / "o/solution.vtu");
  ASSERT_TRUE(std::regex_search(vtu, found, mark));
  EXPECT_EQ(found[1], "1");
}

// Springs in a row, from zero.
TEST_F(CommandLine, AnInterruptedMatrixSolveKeepsItsLastIterateMarked) {
  constexpr int n = 1000;
  std::string A = fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n", n, 2 * n - 1);
  std::string b = fmt::format("%%MatrixMarket matrix array real general\n{} 1\n", n), zero = b;
  for (int i = 1; i <= n; ++i) {
    A += fmt::format("{0} {0} 2\n", i);
    if (i < n) A += fmt::format("{} {} -1\n", i + 1, i);
    b += "1\n";
    zero += "0\n";
  }
  write("A.mtx", A);
  write("b.mtx", b);
  write("start.mtx", zero);
  const pid_t child =
      start("signorini", {"qp", "A.mtx", "b.mtx", "--start", "start.mtx", "--method", "pgs", "--tol", "1e-13", "--set",
                          "solver.max_iterations=1000000", "--out", "x.mtx", "--report", "r.json"});
  wait_until(child, [&] { return count_rows(read(folder_ / ".out")) > 3; });
  kill(child, SIGINT);
  const Ended ended = wait_for(child);
  EXPECT_EQ(ended.status, 130);
  EXPECT_THAT(ended.err, HasSubstr("interrupted after "));
  EXPECT_THAT(ended.out, HasSubstr("not solved: interrupted after "));
  EXPECT_EQ(nlohmann::json::parse(read(folder_ / "r.json")).at("converged"), false);
  EXPECT_EQ(wrong_with({folder_ / "r.json"}, "qp"), "");
  const std::string x = read(folder_ / "x.mtx");
  EXPECT_EQ(std::count(x.begin(), x.end(), '\n'), n + 2);
}

TEST_F(CommandLine, AReaderWhoHasSeenEnoughEndsNoSolve) {
  write("membrane.toml", membrane);
  const std::string program = "cd '" + folder_.string() + "' && " SIGNORINI_BINARY_DIR "/bin/signorini ";
  ASSERT_EQ(std::system((program + "solve membrane.toml --set refine.uniform=5 2> .err | head -n 1 > .out").c_str()),
            0);
  EXPECT_EQ(read(folder_ / ".out"), "membrane\n");
  EXPECT_EQ(report("membrane").at("converged"), true) << read(folder_ / ".err");
}

TEST_F(CommandLine, StepsHaveATableThatIsMadeAsTheyAre) {
  write("membrane.toml", membrane + "[steps]\ncount = 3\n");
  const Ended ended = signorini({"solve", "membrane.toml", "--out", "o"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out,
              StartsWith("membrane\n     step          t iterations    residual  contact   seconds\n   1 of 3 "));
  EXPECT_THAT(ended.out, HasSubstr("\n   3 of 3           1 "));
}

TEST_F(CommandLine, WhatNohupStartsOutlivesItsTerminal) {
  write("membrane.toml", membrane);
  const auto old = std::signal(SIGHUP, SIG_IGN);
  const pid_t child = start("signorini", {"solve", "membrane.toml", "--out", "o", "--set", "refine.uniform=6"});
  std::signal(SIGHUP, old);
  wait_until(child, [&] { return fs::exists(folder_ / "o"); });
  kill(child, SIGHUP);
  EXPECT_EQ(wait_for(child).status, 0);
}

// Of meshes of some million elements, which would take gigabytes.
TEST_F(CommandLine, InterruptEndsTheMeshing) {
  const long idle = signorini({"--version"}).megabytes;
  for (const char* shape : {"disk\"\ncenter = [0, 0]", "ball\"\ncenter = [0, 0, 0]"}) {
    write("round.toml", fmt::format("[[body]]\nname = \"b\"\nshape = \"{}\nradius = 1\nsize = \"x < 2 ? {} : 1\"\n"
                                    "equation = \"diffusion\"\n[[fix]]\nbody = \"b\"\non = \"boundary\"\nvalue = 0\n",
                                    shape, shape[0] == 'd' ? 1e-3 : 0.02));
    const pid_t child = start("signorini", {"check", "round.toml"});
    wait_until(child, [&] { return megabytes(child) > idle + 20; });
    kill(child, SIGINT);
    const Ended ended = wait_for(child);
    EXPECT_EQ(ended.status, 130);
    EXPECT_THAT(ended.err, HasSubstr("interrupted"));
    EXPECT_LT(ended.megabytes, idle + 350) << "it went on";
  }
}

TEST_F(CommandLine, SecondRunReplacesTheFirstResults) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o", "--set", "refine.uniform=1"}).status, 0);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o", "--set", "refine.uniform=2"}).status, 0);
  EXPECT_EQ(report("o").at("unknowns"), 225);
  EXPECT_EQ(written("o").size(), 6u);
}

TEST_F(CommandLine, ARunRemovesWhatAnEarlierOneWroteAndNothingElse) {
  write("membrane.toml", membrane);
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o", "--set", "steps.count=2"}).status, 0);
  write("o/solution_x.vtu", "");
  write("o/notes", "");
  const pid_t ended = start("signorini", {"--version"});
  wait_for(ended);
  fs::create_directory(folder_ / "o" / fmt::format(".signorini-{}", ended));  // as a killed run leaves it
  ASSERT_EQ(signorini({"solve", "membrane.toml", "--out", "o", "--set", "output.pictures=false"}).status, 0);
  EXPECT_THAT(written("o"), testing::UnorderedElementsAre("report.json", "solution.vtu", "convergence.csv",
                                                          "phases.csv", "solution_x.vtu", "notes"));
}

TEST_F(CommandLine, FixesThatContradictEachOtherAreAWarning) {
  write("membrane.toml", membrane + "[[fix]]\nbody = \"m\"\non = \"left\"\nvalue = [1]\n");
  const char* warning = "membrane.toml:23: fix.1: prescribes other values than membrane.toml:9: fix.0 at 33 vertices";
  EXPECT_THAT(signorini({"check", "membrane.toml"}).err, HasSubstr(warning));
  EXPECT_THAT(signorini({"solve", "membrane.toml", "--out", "o"}).err, HasSubstr(warning));
  EXPECT_THAT(report("o").at("warnings").dump(), HasSubstr("33 vertices"));
  write("membrane.toml", membrane + "[[fix]]\nbody = \"m\"\non = \"left\"\nvalue = [\"1e-15 * y - 1\"]\n");
  EXPECT_EQ(signorini({"check", "membrane.toml", "--set", "fix.0.value=x", "--set", "obstacle.0.lower=-2"}).err, "");
}

/// Three triangles of a square, one of which has a vertex in the middle of another's edge.
const std::string torn = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0.5 0.5 0
$EndNodes
$Elements
3
1 2 2 1 1 1 2 3
2 2 2 1 1 1 5 4
3 2 2 1 1 5 3 4
$EndElements
)";

TEST_F(CommandLine, TornMeshesAndHingesAreAWarning) {
  write("torn.msh", torn);
  write("torn.toml",
        "[[body]]\nname = \"m\"\nmesh = \"torn.msh\"\nequation = \"diffusion\"\n"
        "[[fix]]\nbody = \"m\"\non = \"boundary\"\nvalue = 0\n[refine]\nuniform = 1\n");
  const char* tear = "torn.toml:3: body.0.mesh: the vertex at (0.5, 0.5) lies inside the edge (";
  const char* hinge = "torn.toml:3: body.0.mesh: elements hang together only by the vertex at (0, 0), and at 1 more";
  for (const Ended& ended : {signorini({"check", "torn.toml"}), signorini({"solve", "torn.toml", "--out", "o"})}) {
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, testing::AllOf(HasSubstr(tear), HasSubstr(hinge)));
  }
  EXPECT_THAT(report("o").at("warnings").dump(), testing::AllOf(HasSubstr(tear), HasSubstr(hinge)));
}

/// Two triangles; the diagonal between them is a group, as are they.
const std::string grouped = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "rim"
1 2 "diagonal"
2 3 "plate"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
5
1 1 2 1 1 1 2
2 1 2 1 1 1 3
3 1 2 2 2 1 3
4 2 2 3 1 1 2 3
5 2 2 3 1 1 3 4
$EndElements
)";

TEST_F(CommandLine, GroupsOffTheBoundaryAreAWarningAndNoParts) {
  write("grouped.msh", grouped);
  write("grouped.toml",
        "[[body]]\nname = \"m\"\nmesh = \"grouped.msh\"\nequation = \"diffusion\"\n"
        "[[fix]]\nbody = \"m\"\non = \"rim\"\nvalue = 0\n[refine]\nuniform = 1\n");
  const std::string place = "grouped.toml:3: body.0.mesh: ";
  const Ended ended = signorini({"solve", "grouped.toml", "--out", "o"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr(place + "1 of the 2 edges of the physical group 'rim' are not on the boundary"));
  EXPECT_THAT(ended.err,
              HasSubstr(place + "1 of the 1 edges of the physical group 'diagonal' are not on the boundary"));
  EXPECT_EQ(report("o").at("warnings").size(), 2u);
  const Ended plate = signorini({"check", "grouped.toml", "--set", "fix.0.on=plate"});
  EXPECT_EQ(plate.status, 2);
  EXPECT_THAT(plate.err, HasSubstr("fix.0.on=plate: 'plate' is a physical group of triangles, expected one of boundary "
                                   "edges (the parts are: boundary, rim)"));
  const Ended diagonal = signorini({"check", "grouped.toml", "--set", "fix.0.on=diagonal"});
  EXPECT_EQ(diagonal.status, 2);
  EXPECT_THAT(diagonal.err, HasSubstr("no edge of the physical group 'diagonal' is on the boundary"));
}

TEST_F(CommandLine, ATerminalShowsProgressInALineAndEveryCycleOnce) {
  write("membrane.toml", membrane);
  const std::string program = SIGNORINI_BINARY_DIR "/bin/signorini";
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    if (chdir(folder_.c_str()) == 0) execl(program.c_str(), program.c_str(), "solve", "membrane.toml", nullptr);
    _exit(127);
  }
  std::string written;
  char chunk[4096];
  for (ssize_t n; (n = ::read(terminal, chunk, sizeof chunk)) > 0;) written.append(chunk, n);
  close(terminal);
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  const std::string screen = shown(written);
  EXPECT_THAT(written, HasSubstr("level 3: 1089 vertices; iteration 1, residual "));
  EXPECT_THAT(screen, AllOf(testing::Not(HasSubstr("so far")), testing::Not(HasSubstr("level 3: 1089"))))
      << "one line, rewritten";
  EXPECT_LT(written.find("iteration    residual"), written.find("\r\x1b[Kwriting"))
      << "the table is made as the solve goes on";
  const std::string csv = read(folder_ / "membrane/convergence.csv");
  EXPECT_EQ(count_rows(screen), std::count(csv.begin(), csv.end(), '\n') - 1);
}

}  // namespace
}  // namespace signorini::test
