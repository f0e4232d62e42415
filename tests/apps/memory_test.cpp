// The largest memory of whole runs, files and pictures included.
#include "tests/apps/program.hpp"

namespace signorini::test {
namespace {

class Memory : public Program {
 protected:
  /// Bytes per free unknown, beside those of the same on the coarsest mesh: code that runs counts as memory, too.
  double bytes_per_unknown(const std::string& scene, int refinements) const {
    const Size fine = size_of(scene, refinements), coarse = size_of(scene, 0);
    return 1e6 * (fine.megabytes - coarse.megabytes) / (fine.unknowns - coarse.unknowns);
  }

 private:
  struct Size {
    double megabytes, unknowns;
  };

  Size size_of(const std::string& scene, int refinements) const {
    const Ended ended = signorini({"solve", SIGNORINI_SOURCE_DIR "/apps/scenes/" + scene, "--out", "o", "--set",
                                   "refine.uniform=" + std::to_string(refinements), "--set", "body.0.order=1"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return {static_cast<double>(ended.megabytes), report("o").at("unknowns")};
  }
};

#ifndef __SANITIZE_ADDRESS__  // which takes memory of its own

TEST_F(Memory, OfAMembraneIsFewTimesItsMatrix) { EXPECT_LT(bytes_per_unknown("obstacle_radial_2d.toml", 6), 450); }

// Most of it is the mesh, and the contact at each of its nodes.
TEST_F(Memory, OfAMembraneInSpaceFitsBesideItsResults) {
  EXPECT_LT(bytes_per_unknown("obstacle_cube_3d.toml", 4), 500);
}

TEST_F(Memory, OfAnElasticBodyIsMostlyThatOfItsMatrix) { EXPECT_LT(bytes_per_unknown("cube_on_bump.toml", 3), 670); }

#endif

}  // namespace
}  // namespace signorini::test
