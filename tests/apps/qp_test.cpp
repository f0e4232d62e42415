// `signorini qp`: files in, files out, and what every way to fail says.
#include <fmt/format.h>

#include <cmath>

#include "core/io/matrix_market.hpp"
#include "program.hpp"

namespace signorini::test {
namespace {
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using testing::UnorderedElementsAre;

class Qp : public Program {
 protected:
  /// tridiag(-1, 2, -1), its corners as given.
  fs::path write_chain(Index n, double corner = 2) const {
    std::string text = fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{} {} {}\n", n, n, 2 * n - 1);
    for (Index i = 1; i <= n; ++i) {
      text += fmt::format("{} {} {}\n", i, i, i == 1 || i == n ? corner : 2.0);
      if (i < n) text += fmt::format("{} {} -1\n", i + 1, i);
    }
    return write("A.mtx", text);
  }

  fs::path write_constant(const std::string& name, Index n, double value) const {
    return write(name, matrix_market(std::vector<double>(static_cast<std::size_t>(n), value)));
  }

  std::vector<double> solution(Index n, const std::string& name = "x.mtx") const {
    return read_vector(folder_ / name, n, Infinities::refused);
  }

  nlohmann::json json(const std::string& name = "r.json") const { return nlohmann::json::parse(read(folder_ / name)); }

  void expect_failure(const std::vector<std::string>& arguments, int status, const std::string& message) const {
    const auto before = written();
    const Ended ended = signorini(arguments);
    EXPECT_EQ(ended.status, status) << ended.err;
    EXPECT_THAT(ended.err, AllOf(StartsWith("signorini: error: "), HasSubstr(message)));
    EXPECT_EQ(written().size(), before.size());
  }
};

// -x'' = 1 on nodes 1..n of a string, unbounded: x_i = i (n + 1 - i) / 2.
TEST_F(Qp, SolvesWithoutBounds) {
  constexpr Index n = 1500;
  write_chain(n);
  write_constant("b.mtx", n, 1);
  const Ended ended = signorini({"qp", "A.mtx", "b.mtx", "--out", "x.mtx", "--tol", "1e-11"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("iteration"), HasSubstr("solved"), HasSubstr("wrote x.mtx")));
  const auto x = solution(n);
  for (Index i = 1; i <= n; ++i) ASSERT_NEAR(x[i - 1], 0.5 * i * (n + 1 - i), 1e-6 * n * n) << i;
}

// Pulled down by 1 everywhere onto the bound -18: parabolas from the ends that touch it after six nodes.
TEST_F(Qp, SolvesWithinBoundsAndReports) {
  constexpr Index n = 50;
  write_chain(n);
  write_constant("b.mtx", n, -1);
  write_constant("l.mtx", n, -18);
  write(
      "u.mtx", "%%MatrixMarket matrix array real general\n50 1\n" + [] {
        std::string text;
        for (int i = 0; i < 50; ++i) text += i % 2 ? "inf\n" : "Infinity\n";
        return text;
      }());
  const Ended ended = signorini(
      {"qp", "A.mtx", "b.mtx", "--lower", "l.mtx", "--upper", "u.mtx", "--out", "x.mtx", "--report", "reports/r.json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const auto x = solution(n);
  Index touching = 0;
  for (Index i = 1; i <= n; ++i) {
    const double d = std::max(0.0, 6.0 - std::min(i, n + 1 - i));
    EXPECT_NEAR(x[i - 1], -18 + 0.5 * d * d, 1e-6) << i;
    touching += x[i - 1] == -18;
  }
  const auto r = json("reports/r.json");
  EXPECT_EQ(r.at("converged"), true);
  EXPECT_EQ(r.at("unknowns"), n);
  EXPECT_EQ(r.at("levels").back().at("unknowns"), n);
  EXPECT_EQ(r.at("levels").back().at("level"), 0) << "the matrix";
  EXPECT_EQ(r.at("active").at("lower"), touching);
  EXPECT_EQ(r.at("active").at("upper"), 0);
  for (const char* key : {"residual", "algebraic_error", "energy"}) EXPECT_TRUE(r.at(key).is_number_float()) << key;
  if (!r.at("rate").is_null()) EXPECT_LE(r.at("rate"), 1e-9) << "solved in one cycle, which the next one confirms";
  ASSERT_EQ(r.at("stages").size(), 1u);
  const auto& stage = r.at("stages").front();
  EXPECT_EQ(stage.at("iterations"), r.at("iterations"));
  EXPECT_EQ(stage.at("linear_solves"), 0);
  EXPECT_EQ(stage.at("factorisations"), 0);
  EXPECT_GE(stage.at("seconds").get<double>(), 0);
  EXPECT_EQ(stage.at("outcome"), "solved");
  EXPECT_EQ(stage.at("reason"), r.at("reason"));
  EXPECT_TRUE(r.at("iterations").is_number_integer());
  for (const char* key : {"read", "setup", "solve", "total"}) EXPECT_GE(r.at("time").at(key).get<double>(), 0) << key;
  EXPECT_LE(r.at("residual").get<double>(), 1e-8);
  ASSERT_EQ(r.at("history").size(), r.at("iterations"));
  const auto& finest = r.at("history").back().at("levels").back();
  EXPECT_EQ(finest.at("level"), 0);
  EXPECT_EQ(finest.at("vectors"), n);
  EXPECT_EQ(finest.at("critical"), touching);
  EXPECT_THAT(written("reports"), UnorderedElementsAre("r.json"));
  EXPECT_EQ(wrong_with({folder_ / "reports/r.json"}, "qp"), "") << "needs the package python3-jsonschema";
}

// Springs whose stiffness ranges over twelve decades: what rounding hides from the cycles is found and mended.
TEST_F(Qp, SolvesSpringsOfAnyStiffness) {
  constexpr Index n = 22;
  std::string text = fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{} {} {}\n", n, n, 2 * n - 1);
  const auto stiffness = [](Index i) { return i >= n ? 0 : std::ldexp(1, (i * 17) % 41); };
  for (Index i = 0; i < n; ++i) {
    text += fmt::format("{0} {0} {1:.17g}\n", i + 1, stiffness(i) + stiffness(i + 1));
    if (i + 1 < n) text += fmt::format("{} {} {:.17g}\n", i + 2, i + 1, -stiffness(i + 1));
  }
  write("A.mtx", text);
  write_constant("b.mtx", n, 1);
  const Ended ended = signorini({"qp", "A.mtx", "b.mtx", "--report", "r.json", "--out", "x.mtx"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const auto r = json();
  EXPECT_EQ(r.at("converged"), true);
  EXPECT_EQ(r.at("stages").back().at("method"), "refinement");
  const std::vector<double> x = solution(n);
  double way = 0;
  for (Index i = 0; i < n; ++i) {
    way += (n - i) / stiffness(i);  // the forces on all springs behind this one stretch it
    EXPECT_NEAR(x[i], way, 1e-12 * way) << i;
  }
}

TEST_F(Qp, WithoutOutPrintsASummaryOnly) {
  write_chain(10);
  write_constant("b.mtx", 10, 1);
  const Ended ended = signorini({"qp", "A.mtx", "b.mtx"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("10 unknowns"));
  EXPECT_THAT(written(), UnorderedElementsAre("A.mtx", "b.mtx"));
}

TEST_F(Qp, ADashIsStandardOutputAndTheSummaryMakesRoom) {
  write_chain(10);
  write_constant("b.mtx", 10, 1);
  const Ended reported = signorini({"qp", "A.mtx", "b.mtx", "--report", "-", "--out", "x.mtx"});
  EXPECT_EQ(reported.status, 0);
  EXPECT_EQ(nlohmann::json::parse(reported.out).at("unknowns"), 10);
  EXPECT_THAT(reported.err, AllOf(HasSubstr("10 unknowns"), HasSubstr("wrote x.mtx")));
  const Ended solved = signorini({"qp", "A.mtx", "b.mtx", "--out", "-"});
  EXPECT_EQ(solved.out, read(folder_ / "x.mtx"));
  EXPECT_THAT(solved.err, HasSubstr("10 unknowns"));
  expect_failure({"qp", "A.mtx", "b.mtx", "--out", "-", "--report", "-"}, 1, "both --out and --report");
  EXPECT_THAT(written(), UnorderedElementsAre("A.mtx", "b.mtx", "x.mtx"));
}

TEST_F(Qp, DevicesAreWrittenThroughAndInputsAndReadOnlyFilesRefused) {
  write_chain(10);
  write_constant("b.mtx", 10, 1);
  const std::string load = read(folder_ / "b.mtx");
  expect_failure({"qp", "A.mtx", "b.mtx", "--out", "/dev/full"}, 2, "/dev/full: cannot be written: No space left");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_EQ(signorini({"qp", "A.mtx", "b.mtx", "--out", "/dev/null", "--report", "/dev/null"}).status, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::create_symlink("b.mtx", folder_ / "link");
  for (const char* out : {"b.mtx", "link"})
    expect_failure({"qp", "A.mtx", "b.mtx", "--out", out}, 2, "is read by this run");
  write("x.mtx", "old");
  fs::permissions(folder_ / "x.mtx", fs::perms::owner_read);
  expect_failure({"qp", "A.mtx", "b.mtx", "--report", "x.mtx"}, 2, "x.mtx: is read-only");
  EXPECT_EQ(read(folder_ / "x.mtx"), "old");
  EXPECT_EQ(read(folder_ / "b.mtx"), load);
}

TEST_F(Qp, BlocksAndMethodsHaveTheSameSolution) {
  constexpr Index n = 60;
  write_chain(n);
  write_constant("b.mtx", n, -1);
  write_constant("l.mtx", n, -30);
  std::vector<std::vector<double>> found;
  for (const char* block : {"1", "2", "3"})
    for (const char* method : {"monotone", "tnnmg", "pgs"}) {
      ASSERT_EQ(signorini({"qp", "A.mtx", "b.mtx", "--lower", "l.mtx", "--block", block, "--method", method, "--out",
                           "x.mtx", "--start", "l.mtx"})
                    .status,
                0)
          << block << method;
      found.push_back(solution(n));
    }
  for (const auto& x : found)
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], found[0][i], 1e-5);
}

// Multigrid and conjugate directions or a truncated Newton method with the same algebraic levels.
TEST_F(Qp, SettingsOfTheSolverLeadToTheSameSolution) {
  constexpr Index n = 1500;
  write_chain(n);
  write_constant("b.mtx", n, -1);
  write_constant("l.mtx", n, -2000);
  std::vector<std::vector<double>> found;
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {},
           {"--set", "solver.krylov=false"},
           {"--method", "tnnmg"},
           {"--method", "tnnmg", "--set", "solver.krylov=false", "--set", "solver.cycle=W"},
           {"--set", "solver.reassemble=false"},
           {"--set", "solver.reach=twins"},
           {"--set", "solver.method=tnnmg", "--set", "solver.tolerance=1e-3", "--tol", "1e-8"}}) {
    std::vector<std::string> arguments{"qp",    "A.mtx", "b.mtx",    "--lower", "l.mtx",
                                       "--out", "x.mtx", "--report", "r.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = signorini(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_GE(json().at("levels").size(), 2u);
    EXPECT_LE(json().at("residual"), 1e-8);
    found.push_back(solution(n));
  }
  EXPECT_EQ(json().at("solver").at("method"), "tnnmg");
  for (const auto& x : found)
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], found[0][i], 1e-3);
}

TEST_F(Qp, AtTheIterationLimitTheResultIsWrittenAndMarked) {
  constexpr Index n = 4000;
  write_chain(n);
  write_constant("b.mtx", n, 1);
  const Ended ended = signorini({"qp", "A.mtx", "b.mtx", "--method", "pgs", "--out", "x.mtx", "--report", "r.json"});
  EXPECT_EQ(ended.status, 3) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("not solved: iteration limit"));
  EXPECT_THAT(ended.err, HasSubstr("signorini: error: not solved: iteration limit"));
  EXPECT_EQ(json().at("converged"), false);
  EXPECT_EQ(solution(n).size(), static_cast<std::size_t>(n));
}

TEST_F(Qp, BadInputIsNamedAndNothingIsWritten) {
  write_chain(3);
  write_constant("b.mtx", 3, 1);
  write_constant("b4.mtx", 4, 1);
  write_constant("inf.mtx", 3, infinity);
  const std::vector<std::string> outputs{"--out", "new/x.mtx", "--report", "r.json"};
  const auto fails = [&](std::vector<std::string> arguments, const std::string& message) {
    arguments.insert(arguments.begin(), "qp");
    arguments.insert(arguments.end(), outputs.begin(), outputs.end());
    expect_failure(arguments, 2, message);
  };
  fails({"none.mtx", "b.mtx"}, "none.mtx: no such Matrix Market file");
  fails({"A.mtx", "b.mtx", "--set", "solver.reach=some"}, "--set solver.reach=some");
  fails({"A.mtx", "b4.mtx"}, "b4.mtx:2: found 4 rows and 1 columns, expected a vector of 3 rows");
  fails({"A.mtx", "inf.mtx"}, "inf.mtx:3: found inf, expected a finite number");
  fails({"A.mtx", "b.mtx", "--start", "inf.mtx"}, "inf.mtx:3: found inf, expected a finite number");
  fails({"A.mtx", "b.mtx", "--lower", "b4.mtx"}, "b4.mtx:2: found 4 rows");
  fails({"A.mtx", "b.mtx", "--block", "2"}, "A.mtx: matrix: found 3 rows, expected a multiple of the block size 2");
  write("M.mtx", "%%MatrixMarket matrix coordinate real general\n0 0 0\n");
  fails({"M.mtx", "b.mtx"}, "M.mtx: found 0 rows and 0 columns, expected a square matrix of one row at least");
  const auto matrix = [&](const std::string& entries, const std::string& message) {
    write("M.mtx", "%%MatrixMarket matrix array real general\n3 3\n" + entries);
    fails({"M.mtx", "b.mtx"}, "M.mtx: matrix: " + message);
  };
  matrix("2\n-1\n0\n-2\n2\n0\n0\n0\n1\n",
         "not symmetric: the entry in row 1, column 2 is -2, the one in row 2, column 1 is -1");
  matrix("2\n0\n0\n0\n-1\n0\n0\n0\n1\n", "the diagonal entry of row 2 is -1, expected a positive one");
  matrix("1\n3\n0\n3\n2\n0\n0\n0\n1\n", "not positive semidefinite: the entry 3 in row 1, column 2");
  matrix("1\n-0.9\n-0.9\n-0.9\n1\n-0.9\n-0.9\n-0.9\n1\n", "indefinite: d'Ad is -");
}

TEST_F(Qp, OneTriangleInAGeneralFileHasToBeSaid) {
  write_constant("b.mtx", 3, 1);
  for (const char* entries : {"1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 2\n", "1 1 2\n1 2 -1\n2 2 2\n2 3 -1\n3 3 2\n"}) {
    write("A.mtx", std::string("%%MatrixMarket matrix coordinate real general\n3 3 5\n") + entries);
    expect_failure({"qp", "A.mtx", "b.mtx"}, 2, "one triangle is given, say so (signorini qp: --one-triangle, or 'sym");
    const Ended ended = signorini({"qp", "A.mtx", "b.mtx", "--one-triangle", "--out", "x.mtx"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::vector<double> x = solution(3), expected{1.5, 2, 1.5};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(x[i], expected[i], 1e-7);
  }
  write_chain(3);
  expect_failure({"qp", "A.mtx", "b.mtx", "--one-triangle"}, 2, "expected one triangle of a matrix alone");
}

TEST_F(Qp, WrongUsageIsStatusOneButForSet) {
  write_chain(3);
  write_constant("b.mtx", 3, 1);
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{"--block", "4"},
                                                                                    {"--tol", "0"},
                                                                                    {"--tol", "x"},
                                                                                    {"--method", "magic"},
                                                                                    {"--out", ""},
                                                                                    {"--uper", "b.mtx"}}) {
    std::vector<std::string> arguments{"qp", "A.mtx", "b.mtx"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_failure(arguments, 1, more[0]);
  }
  for (const char* set : {"solver.reech=all", "solver.start=zero", "refine.uniform=1", "title=x"})
    expect_failure({"qp", "A.mtx", "b.mtx", "--set", set}, 2, "--set");
  expect_failure({"qp", "A.mtx"}, 1, "LOAD");
  expect_failure({"qp", "A.mtx", "b.mtx", "--out", "x", "--report", "./x"}, 1, "both --out and --report");
}

TEST_F(Qp, OutputThatCannotBeWrittenIsSeenBeforeTheSolve) {
  write_chain(3);
  write_constant("b.mtx", 3, 1);
  expect_failure({"qp", "A.mtx", "b.mtx", "--out", "A.mtx/x"}, 2, "A.mtx");
  expect_failure({"qp", "A.mtx", "b.mtx", "--out", "."}, 2, "is a folder");
  expect_failure({"qp", "A.mtx", "b.mtx", "--report", "/proc/nowhere/r"}, 2, "/proc/nowhere");
}

TEST_F(Qp, WithoutSolutionIsStatusFour) {
  write_chain(3);
  write_constant("b.mtx", 3, 1);
  write("l.mtx", "%%MatrixMarket matrix array real general\n3 1\n0\n3\n-inf\n");
  write("u.mtx", "%%MatrixMarket matrix array real general\n3 1\n0\n2\ninf\n");
  expect_failure({"qp", "A.mtx", "b.mtx", "--lower", "l.mtx", "--upper", "u.mtx", "--out", "x.mtx"}, 4,
                 "infeasible bounds: no number lies between the lower and the upper bound in 1 row: row 2: 3 and 2");
  write_chain(600, 1);  // held at neither end
  write_constant("b.mtx", 600, 1);
  write_constant("l.mtx", 600, -1);
  expect_failure({"qp", "A.mtx", "b.mtx", "--out", "x.mtx"}, 4, "A.mtx: the energy is unbounded below");
  expect_failure({"qp", "A.mtx", "b.mtx", "--lower", "l.mtx"}, 4, "A.mtx: the energy is unbounded below");
  EXPECT_EQ(signorini({"qp", "A.mtx", "b.mtx", "--upper", "l.mtx"}).status, 0);
}

TEST_F(Qp, OutputThatIsLostIsAnErrorOnlyWhereNothingIsWritten) {
  write_chain(10);
  write_constant("b.mtx", 10, 1);
  const std::string program = "cd '" + folder_.string() + "' && " SIGNORINI_BINARY_DIR "/bin/signorini qp A.mtx b.mtx ";
  EXPECT_EQ(WEXITSTATUS(std::system((program + " > /dev/full 2> .err").c_str())), 2);
  EXPECT_THAT(read(folder_ / ".err"), StartsWith("signorini: error: standard output: cannot be written"));
  EXPECT_EQ(WEXITSTATUS(std::system((program + "--out x.mtx > /dev/full 2> .err").c_str())), 0);
  EXPECT_THAT(read(folder_ / ".err"), StartsWith("signorini: warning: standard output: cannot be written"));
  EXPECT_EQ(solution(10).size(), 10u);
}

// Of address space. OpenBLAS would ask for its 128 MB for ever.
TEST_F(Qp, TooLittleMemoryForADirectSolveIsAnErrorAtOnce) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer itself needs terabytes of address space";
#endif
  constexpr Index n = 3000;
  write_chain(n);
  write_constant("b.mtx", n, -1);
  write_constant("l.mtx", n, -500);
  const std::string program = "cd '" + folder_.string() + "' && ulimit -t 20 && ulimit -v LIMIT && " +
                              SIGNORINI_BINARY_DIR +
                              "/bin/signorini qp A.mtx b.mtx --lower l.mtx --method pdas --out x.mtx > .out 2> .err";
  const auto run = [&](const std::string& kilobytes) {
    std::string command = program;
    command.replace(command.find("LIMIT"), 5, kilobytes);
    return WEXITSTATUS(std::system(command.c_str()));
  };
  EXPECT_EQ(run("4000000"), 0) << read(folder_ / ".err");
  ASSERT_TRUE(fs::remove(folder_ / "x.mtx"));
  for (const char* kilobytes : {"45000", "60000", "120000", "160000", "200000"}) {
    EXPECT_EQ(run(kilobytes), 2) << kilobytes;
    EXPECT_THAT(read(folder_ / ".err"), HasSubstr("not enough memory")) << kilobytes;
    EXPECT_FALSE(fs::exists(folder_ / "x.mtx"));
  }
}

TEST_F(Qp, InterruptEndsCleanlyAndLeavesNothing) {
  constexpr Index n = 200000;
  write_chain(n);
  write_constant("b.mtx", n, 1);
  const pid_t child = start("signorini", {"qp", "A.mtx", "b.mtx", "--method", "pgs", "--out", "a/x.mtx"});
  wait_until(child, [&] { return fs::exists(folder_ / "a"); });  // made just before the set-up
  kill(child, SIGINT);
  const Ended ended = wait_for(child);
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_THAT(written(), UnorderedElementsAre("A.mtx", "b.mtx"));
}

}  // namespace
}  // namespace signorini::test
