#include <cmath>
#include <numbers>

#include "program.hpp"

namespace signorini::test {
namespace {
using std::numbers::pi;

const fs::path scenes = fs::path(SIGNORINI_SOURCE_DIR) / "apps/scenes";

/// The scenes that are shipped, against the formulas in their comments.
class Scenes : public Program {
 protected:
  nlohmann::json solve(const std::string& scene, const std::vector<std::string>& overrides) const {
    std::vector<std::string> arguments{"solve", (scenes / scene).string(), "--out", "o", "--quiet",
                                       "--set", "output.pictures=false"};
    for (const auto& override : overrides) arguments.insert(arguments.end(), {"--set", override});
    const Ended ended = signorini(arguments);
    EXPECT_EQ(ended.status, 0) << scene << ": " << ended.err;
    return ended.status == 0 ? report("o") : nlohmann::json();
  }

  /// The numbers of signorini_hertz beside Hertz's, for the same force.
  void expect_hertz(const char* scene, double within) {
    const Ended ended = wait_for(start("signorini_hertz", {"o/report.json", scenes / scene}));
    ASSERT_EQ(ended.status, 0) << ended.err;
    for (const char* row : {"half width", "peak pressure"}) {
      const std::size_t at = ended.out.find(row);
      ASSERT_NE(at, std::string::npos) << ended.out;
      double computed, hertz, difference;
      ASSERT_EQ(
          std::sscanf(ended.out.c_str() + at + std::string(row).size(), "%lf %lf %lf", &computed, &hertz, &difference),
          3);
      EXPECT_NEAR(computed, hertz, within * hertz) << row;
      EXPECT_NEAR(difference, 100 * (computed / hertz - 1), 0.01);
    }
  }
};

TEST_F(Scenes, AllAreSolvedOnTheirCoarsestMeshesAndReportsAgreeWithTheSchema) {
  std::vector<fs::path> reports;
  for (const auto& entry : fs::directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    std::vector<std::string> coarse{"refine.uniform=0"};
    // Its coarsest mesh is a fine one.
    if (entry.path().stem() == "partial_slip_3d")
      coarse.emplace_back("body.0.size=0.07 + 0.5 * max(0, sqrt(x^2 + y^2 + z^2) - 0.11)");
    solve(entry.path().filename(), coarse);
    reports.push_back(folder_ / entry.path().stem().replace_extension(".json"));
    fs::rename(folder_ / "o/report.json", reports.back());
  }
  EXPECT_GE(reports.size(), 10u);
  EXPECT_EQ(wrong_with(reports), "") << "needs the package python3-jsonschema";
}

// Active sets know bounds alone: what check announces is what can happen.
TEST_F(Scenes, CheckAnnouncesNoActiveSetsForFriction) {
  const auto announced = [&](const char* scene) {
    const Ended ended = signorini({"check", (scenes / scene).string(), "--set", "refine.uniform=1"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.out;
  };
  EXPECT_EQ(announced("block_with_friction_2d.toml").find("pdas"), std::string::npos);
  EXPECT_NE(announced("signorini_elastic_2d.toml").find("pdas"), std::string::npos);
}

TEST_F(Scenes, RadialObstacle2D) {
  const auto r = solve("obstacle_radial_2d.toml", {});
  EXPECT_NEAR(r.at("probes")[0].at("value"), 0.471519893402112, 1e-4);
  const double mesh_width = 4.0 / (8 << 5);
  EXPECT_NEAR(r.at("contact")[0].at("radius"), 0.697965148223374, mesh_width);
  EXPECT_NEAR(r.at("contact")[0].at("area"), pi * std::pow(r.at("contact")[0].at("radius").get<double>(), 2), 1e-12);
}

TEST_F(Scenes, RadialObstacle3D) {
  const auto r = solve("obstacle_radial_3d.toml", {});
  EXPECT_NEAR(r.at("probes")[0].at("value"), 0.400294310624527, 4e-3);
}

TEST_F(Scenes, HemisphereInACube) {
  const auto r = solve("obstacle_cube_3d.toml", {});
  EXPECT_NEAR(r.at("probes")[0].at("value"), 0.5, 5e-3);
}

TEST_F(Scenes, CubeOnABump) {
  const auto r = solve("cube_on_bump.toml", {"refine.uniform=1"});
  EXPECT_GT(r.at("contact")[0].at("force")[2], 0) << "the bump carries";
  // u >= -gap touches at most where the gap is below what the top is pushed down by.
  EXPECT_LT(r.at("contact")[0].at("area").get<double>(), pi * 0.03 / 0.5);
}

TEST_F(Scenes, TorsionOfARoundBar) {
  const auto r = solve("obstacle_torsion_disk.toml", {});
  EXPECT_NEAR(r.at("probes")[0].at("value"), 0.75, 1e-3);
}

TEST_F(Scenes, DegenerateObstacle) {
  const auto r = solve("obstacle_degenerate.toml", {});
  EXPECT_NEAR(r.at("probes")[0].at("value"), -1, 1e-3);
}

TEST_F(Scenes, ElasticSignorini) {
  const auto r = solve("signorini_elastic_2d.toml", {});
  const double gap = 0.7 * std::pow(0.5, 1.5);  // (1 - nu) |x|^(3/2) / mu at x = -1/2
  EXPECT_NEAR(r.at("probes")[0].at("displacement")[1], gap, 0.01 * gap);
  EXPECT_NEAR(r.at("contact")[0].at("force")[1], 1, 0.03);  // integral of 1.5 sqrt(x)
}

TEST_F(Scenes, PunchIsUniform) {
  const auto r = solve("punch.toml", {"solver.tolerance=1e-11"});
  const double pressure = 0.01 * 0.7 / (1.3 * 0.4);
  EXPECT_NEAR(r.at("contact")[0].at("max_pressure"), pressure, 1e-9 * pressure);
  EXPECT_NEAR(r.at("contact")[0].at("force")[2], -pressure, 1e-9 * pressure);
}

TEST_F(Scenes, HertzProgramComparesACylinderWithinThreePercent) {
  solve("cylinder_on_plane_2d.toml", {});
  expect_hertz("cylinder_on_plane_2d.toml", 0.03);
}

TEST_F(Scenes, ARubberCylinderIsWithinOnePercentOfHertz) {
  const auto r = solve("rubber_cylinder_2d.toml", {});
  expect_hertz("rubber_cylinder_2d.toml", 0.01);
  EXPECT_LE(r.at("iterations"), 18);
  EXPECT_TRUE(r.at("warnings").empty());
}

}  // namespace
}  // namespace signorini::test
