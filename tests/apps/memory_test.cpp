// The largest memory of whole runs, files and pictures included.
#include "tests/apps/program.hpp"

namespace signorini::test {
namespace {

class Memory : public Program {
 protected:
  /// Bytes per free unknown, beside what the program takes that solves nothing.
  double bytes_per_unknown(const std::string& scene, const std::vector<std::string>& settings) const {
    std::vector<std::string> arguments{"solve", std::string(SIGNORINI_SOURCE_DIR "/apps/scenes/") + scene, "--out",
                                       "o"};
    for (const std::string& setting : settings) arguments.insert(arguments.end(), {"--set", setting});
    const Ended ended = signorini(arguments);
    EXPECT_EQ(ended.status, 0) << ended.err;
    const double unknowns = report("o").at("unknowns");
    return 1e6 * static_cast<double>(ended.megabytes - signorini({"list"}).megabytes) / unknowns;
  }
};

#ifndef __SANITIZE_ADDRESS__  // which takes memory of its own

TEST_F(Memory, OfAMembraneIsFewTimesItsMatrix) {
  EXPECT_LT(bytes_per_unknown("obstacle_radial_2d.toml", {"refine.uniform=6"}), 610);
}

// Most of it is the mesh, and the contact at each of its nodes.
TEST_F(Memory, OfAMembraneInSpaceFitsBesideItsResults) {
  EXPECT_LT(bytes_per_unknown("obstacle_cube_3d.toml", {"refine.uniform=4"}), 548);
}

TEST_F(Memory, OfAnElasticBodyIsMostlyThatOfItsMatrix) {
  EXPECT_LT(bytes_per_unknown("cube_on_bump.toml", {"body.0.order=1", "refine.uniform=3"}), 800);
}

#endif

}  // namespace
}  // namespace signorini::test
