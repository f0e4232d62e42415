// What `signorini chart` draws, and whether `signorini solve --accuracy` keeps its word.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "apps/signorini/chart/page.hpp"
#include "apps/signorini/chart/reference.hpp"
#include "apps/signorini/chart/search.hpp"
#include "apps/signorini/console.hpp"
#include "driver/driver.hpp"
#include "tests/apps/program.hpp"
#include "tests/support/nightly.hpp"

namespace signorini::test {
namespace {

class Chart : public Program {
 protected:
  Ended chart(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"chart", "scene.toml", "--out", "c"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return signorini(arguments);
  }

  /// The errors in chart.csv, per setting as they come; NaN where there is none.
  std::map<std::string, std::vector<double>> errors() const {
    std::istringstream in(read(folder_ / "c/chart.csv"));
    std::map<std::string, std::vector<double>> out;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      const std::string error = line.substr(line.rfind(',') + 1);
      out[line.substr(1, line.find('"', 1) - 1)].push_back(error.empty() ? std::nan("") : std::stod(error));
    }
    return out;
  }
};

TEST_F(Chart, ErrorsFallAndFilesNeedNoOthers) {
  write("scene.toml", membrane);
  const Ended ended = chart({"--seconds", "1"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(written("c"), testing::UnorderedElementsAre("chart.csv", "chart.html", "chart.png", "chart.svg"));
  auto of = errors();
  ASSERT_GE(of["linear elements"].size(), 4U);
  ASSERT_GE(of["quadratic elements"].size(), 3U);
  const std::vector<double>& linear = of["linear elements"];
  for (std::size_t k = 1; k < linear.size(); ++k)
    if (std::isfinite(linear[k])) EXPECT_LT(linear[k], 0.75 * linear[k - 1]) << k;
  EXPECT_TRUE(std::isnan(of["quadratic elements"].back())) << "it is what others are compared with";
  EXPECT_THAT(ended.out, testing::AllOf(testing::HasSubstr("which is off by about"), testing::HasSubstr("guaranteed"),
                                        testing::HasSubstr("left out: linear elements")));

  std::string page = read(folder_ / "c/chart.html");
  for (const std::string known : {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"})
    for (std::size_t at; (at = page.find(known)) != std::string::npos;) page.erase(at, known.size());
  EXPECT_THAT(page, testing::Not(testing::AnyOf(testing::HasSubstr("http:"), testing::HasSubstr("https:"),
                                                testing::HasSubstr("src="), testing::HasSubstr("<link"))));
  EXPECT_THAT(page, testing::AllOf(testing::HasSubstr("<svg"), testing::HasSubstr("const flat = false, solution = ["),
                                   testing::HasSubstr("would take about")));
}

// The membrane rests on the top of its obstacle, at 0.5. What is said to be exact is believed.
TEST_F(Chart, AnExactValueIsComparedWith) {
  write("scene.toml", membrane);
  const Ended ended = chart({"--seconds", "0.2", "--of", "probe centre", "--exact", "1", "--against", "unknowns"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_THAT(ended.out, testing::HasSubstr("compared with the exact value"));
  const auto of = errors();
  for (const double error : of.at("linear elements")) EXPECT_NEAR(error, 0.5, 1e-6);
}

TEST_F(Chart, TheCheapestKeysSolveTheSceneAsSaid) {
  write("scene.toml", membrane);
  const Ended ended = chart({"--seconds", "0.5", "--accuracy", "0.05", "--of", "energy"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const std::string said = ended.out.substr(ended.out.find("signorini solve scene.toml"));
  std::vector<std::string> arguments{"solve", "scene.toml", "--quiet", "--out", "again"};
  std::istringstream words(said);
  std::string word;
  while (words >> word)
    if (word == "--set") {
      words >> word;
      arguments.insert(arguments.end(), {"--set", word});
    }
  EXPECT_EQ(signorini(arguments).status, 0);
}

TEST_F(Chart, WhatCannotBeDrawnIsSaid) {
  write("scene.toml", membrane);
  EXPECT_THAT(chart({"--of", "probe center"}).err,
              testing::HasSubstr("expected one of energy | force | pressure | area | probe centre, did you mean 'probe "
                                 "centre'?"));
  EXPECT_EQ(chart({"--of", "probe center"}).status, 1);
  const Ended late = chart({"--seconds", "1e-6"});
  EXPECT_EQ(late.status, 2);
  EXPECT_THAT(late.out, testing::HasSubstr("not ready after"));
  EXPECT_EQ(chart({"--seconds", "0.2", "--exact", "1,2"}).status, 1);
  EXPECT_FALSE(fs::exists(folder_ / "c")) << "nothing is left where nothing is drawn";
}

TEST(ChartErrors, WhatIsLeftFollowsFromDifferences) {
  using chart::error_left;
  EXPECT_NEAR(error_left("force", {{1 + 0.16}, {1 + 0.08}, {1 + 0.04}}), 0.04 / 1.04, 1e-12);
  EXPECT_NEAR(error_left("force", {{4}, {2}}), 1, 1e-12);
  EXPECT_NEAR(error_left("energy", {{1.16}, {1.08}, {1.04}}), std::sqrt(0.04 / 1.04), 1e-12);
  EXPECT_NEAR(error_left("force", {{1.3}, {1}, {1}}), 0.08, 1e-12) << "the last difference may be small by chance";
  EXPECT_EQ(error_left("force", {{1, 2}, {1, 2}, {1, 2}}), 0);
  EXPECT_GT(error_left("force", {{2}, {1.01}, {1}}), 0.003) << "one fast step is no promise";
}

// --- the promise of --accuracy

/// A number of a table, in TOML.
std::string number(double x) { return fmt::format("{:.6g}", x); }

/// Membranes over obstacles, blocks and disks on rigid spheres and planes, and at night cubes.
std::string random_scene(std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double poisson = between(0, 0.4), push = between(0.005, 0.03), size = between(0.15, 0.4);
  switch (std::uniform_int_distribution<int>(0, nightly(3, 2))(random)) {
    case 0:
      return fmt::format(
          "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [{}, 1]\ncells = [4, 4]\nequation = "
          "\"diffusion\"\n[[fix]]\nbody = \"b\"\non = \"boundary\"\nvalue = [0]\n[[load]]\nbody = \"b\"\nvalue = [{}]\n"
          "[[obstacle]]\ntype = \"scalar\"\nbody = \"b\"\nlower = \"{}\"\n",
          number(between(0.7, 2)), number(-between(3, 12)), number(-between(0.05, 0.15)));
    case 1:
      return fmt::format(
          "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [-1, 0]\nto = [1, 1]\ncells = [6, 3]\nyoung = 1\n"
          "poisson = {}\n[[fix]]\nbody = \"b\"\non = \"top\"\nvalue = [0, {}]\n[[obstacle]]\ntype = \"contact\"\nbody "
          "= \"b\"\non = \"bottom\"\nshape = \"sphere\"\ncenter = [{}, {}]\nradius = {}\n",
          number(poisson), number(-push), number(between(-0.3, 0.3)), "-3", "3");
    case 2:
      return fmt::format(
          "[[body]]\nname = \"b\"\nshape = \"disk\"\ncenter = [0, 0]\nradius = 1\nsize = {}\nyoung = 1\npoisson = {}\n"
          "[[fix]]\nbody = \"b\"\nwhere = \"y > 0.3\"\nvalue = [0, {}]\n[[obstacle]]\ntype = \"contact\"\nbody = "
          "\"b\"\nwhere = \"y < -0.3\"\nshape = \"plane\"\npoint = [0, -1]\nnormal = [0, 1]\n",
          number(size), number(poisson), number(-push));
    default:
      return fmt::format(
          "[[body]]\nname = \"b\"\nshape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, {}]\ncells = [2, 2, 2]\nyoung = 1\n"
          "poisson = {}\n[[fix]]\nbody = \"b\"\non = \"top\"\nvalue = [0, 0, {}]\n[[obstacle]]\ntype = \"contact\"\n"
          "body = \"b\"\non = \"bottom\"\nshape = \"sphere\"\ncenter = [0.5, 0.5, -5]\nradius = 5\n",
          number(between(0.5, 1.5)), number(poisson), number(-push));
  }
}

std::vector<double> solved(const fs::path& scene, std::vector<std::string> keys, int refined, const std::string& of) {
  keys.push_back(fmt::format("refine.uniform={}", refined));
  const Console quiet(true);
  Driver driver(read_scene(scene, keys), quiet);
  return chart::quantity(to_json(driver.solve()), of).value();
}

using Accuracy = Folder;

const char* const pressed =
    "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\nyoung = 1\npoisson = "
    "0.3\n[[fix]]\nbody = \"b\"\non = \"left\"\nvalue = [0, \"free\"]\n[[obstacle]]\ntype = \"contact\"\nbody = "
    "\"b\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0.01]\nnormal = [0, 1]\n";

TEST_F(Accuracy, OfTheDisplacementOfAPoint) {
  const fs::path scene = folder_ / "scene.toml";
  std::ofstream(scene) << pressed
                       << "[[fix]]\nbody = \"b\"\non = \"top\"\nvalue = [\"free\", 0]\n[[probe]]\nname = "
                          "\"corner\"\nbody = \"b\"\nat = [1, 1]\n";
  const chart::Found found = chart::search(scene, {}, "probe corner", 0.01, [](const std::string&) {});
  EXPECT_LE(found.error, 0.01);
}

// A round hole presses a disk from all sides.
TEST_F(Accuracy, OfASumThatIsZeroSaysNothing) {
  const fs::path scene = folder_ / "scene.toml";
  std::ofstream(scene)
      << "[[body]]\nname = \"b\"\nshape = \"disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.4\nyoung = 1\npoisson = "
         "0.3\n[symmetry]\nx = 0\ny = 0\n[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\non = \"boundary\"\nshape = "
         "\"expression\"\ndistance = \"0.97 - sqrt(x^2 + y^2)\"\nnormal = [\"-x / sqrt(x^2 + y^2)\", \"-y / sqrt(x^2 + "
         "y^2)\"]\n";
  try {
    chart::search(scene, {}, "force", 0.01, [](const std::string&) {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("adds up to zero"));
  }
}

// Under the corners of a punch pressures have no limit.
TEST_F(Accuracy, OfWhatGrowsForEverHasAnEnd) {
  const fs::path scene = folder_ / "scene.toml";
  std::ofstream(scene)
      << "[[body]]\nname = \"base\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [4, 2]\ncells = [8, 4]\nyoung = "
         "1000\npoisson = 0.3\n[[body]]\nname = \"punch\"\nshape = \"rectangle\"\nfrom = [1, 2]\nto = [3, 3]\ncells = "
         "[5, 3]\nyoung = 2000\npoisson = 0.3\n[[fix]]\nbody = \"base\"\non = \"bottom\"\nvalue = [0, "
         "0]\n[[fix]]\nbody = "
         "\"punch\"\non = \"top\"\nvalue = [0, -0.01]\n[[obstacle]]\ntype = \"elastic\"\nbody = \"punch\"\non = "
         "\"bottom\"\nother = \"base\"\nother_on = \"top\"\n";
  try {
    chart::search(scene, {}, "pressure", 0.01, [](const std::string&) {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("seems to have no limit"));
  }
}

TEST_F(Accuracy, IsKept) {
  const int scenes = nightly(200, 4);
  int kept = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const fs::path scene = folder_ / "scene.toml";
    std::ofstream(scene) << random_scene(random);
    const std::string of = seed % 2 ? "energy" : "force";
    const double wanted = seed % 4 < 2 ? 0.05 : 0.02;
    const chart::Found found = chart::search(scene, {}, of, wanted, [](const std::string&) {});
    const bool in_space = read_scene(scene).dimension == 3;
    const int refined = std::stoi(found.keys.back().substr(found.keys.back().find('=') + 1));
    const auto value = solved(scene, found.keys, refined, of),
               finer = solved(scene, found.keys, refined + (in_space ? 1 : 2), of);
    const double error = chart::relative_error(of, value, finer);
    kept += error <= wanted;
    if (error > wanted)
      fmt::print("seed {}: {} wanted {}, is {:.3g}, said {:.3g}\n", seed, of, wanted, error, found.error);
  }
  EXPECT_GE(kept, std::ceil(0.95 * scenes)) << "of " << scenes;
}

}  // namespace
}  // namespace signorini::test
