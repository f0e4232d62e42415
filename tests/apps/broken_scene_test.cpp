#include "program.hpp"

namespace signorini::test {
namespace {

/// A good scene in which `from` is replaced by `to`, and how the program must answer.
struct Broken {
  const char* name;
  std::string scene, from, to;
  int status;
  const char* message;  ///< part of it
};

void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

class BrokenScene : public Program, public testing::WithParamInterface<Broken> {};

TEST_P(BrokenScene, EndsWithItsStatusNamesThePlaceAndWritesNothing) {
  Broken broken = GetParam();
  const std::size_t at = broken.scene.find(broken.from);
  ASSERT_NE(at, std::string::npos);
  write("scene.toml", broken.scene.replace(at, broken.from.size(), broken.to));
  const Ended ended = signorini({"solve", "scene.toml"});
  EXPECT_EQ(ended.status, broken.status) << ended.err;
  EXPECT_THAT(ended.err, testing::StartsWith("signorini: error: "));
  EXPECT_THAT(ended.err, testing::HasSubstr(broken.message));
  EXPECT_EQ(ended.out, "");
  EXPECT_THAT(written(), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    All, BrokenScene,
    testing::Values(
        Broken{"Syntax", membrane, "cells = [4, 4]", "cells = [4, 4", 2, "scene.toml"},
        Broken{"UnknownKey", membrane, "cells =", "cels =", 2, "cells"},
        Broken{"UnknownTable", membrane, "[refine]", "[refin]", 2, "refine"},
        Broken{"UnknownPlugin", membrane, "type = \"scalar\"", "type = \"scalr\"", 5, "scalar"},
        Broken{"UnknownPart", membrane, "on = \"boundary\"", "on = \"bondary\"", 2, "bondary"},
        Broken{"EmptySelection", membrane, "on = \"boundary\"", "where = \"x > 7\"", 2, "fix.0"},
        Broken{"NotFinite", membrane, "0.5 - x^2 - y^2", "log(x)", 2, "log(x)"},
        Broken{"BadExpression", membrane, "0.5 - x^2 - y^2", "0.5 - foo", 2, "foo"},
        Broken{"NegativeModulus", punch, "young = 1.0", "young = -1.0", 2, "young"},
        Broken{"Incompressible", punch, "poisson = 0.25", "poisson = 0.5", 2, "poisson"},
        Broken{"MissingMesh", membrane, "shape = \"rectangle\"\nfrom = [-1, -1]\nto = [1, 1]\ncells = [4, 4]",
               "mesh = \"none.msh\"", 2, "none.msh"},
        Broken{"HugeRefinement", membrane, "uniform = 3", "uniform = 20", 2, "unknowns"},
        Broken{"CellsBeyondMemory", membrane, "cells = [4, 4]", "cells = [14000, 14000]", 2, "unknowns"},
        Broken{"TooManyCells", membrane, "cells = [4, 4]", "cells = [1000000, 1000000]", 2, "cells"},
        Broken{"ProbeOutside", membrane, "at = [0, 0]", "at = [5, 0]", 2, "probe.0"},
        Broken{"NothingHolds", membrane, "[[fix]]\nbody = \"m\"\non = \"boundary\"\nvalue = [0]",
               "[[load]]\nbody = \"m\"\nvalue = [1]", 4, "signorini"},
        Broken{"ObstacleBeyondTheBoundary", membrane, "0.5 - x^2 - y^2", "0.5", 4, "obstacle.0"},
        Broken{"CrossedBounds", membrane, "lower = \"0.5 - x^2 - y^2\"", "lower = \"-x^2\"\nupper = \"-1-x^2\"", 4,
               "obstacle.0"},
        Broken{"UnknownSmoother", membrane, "[refine]", "[solver]\nsmoother = \"symetric\"\n[refine]", 2, "symmetric"},
        Broken{"UnknownOption", membrane, "lower =", "lowr =", 2, "lower"},
        Broken{"WrongPluginForElasticity", punch, "type = \"contact\"", "type = \"scalar\"", 2, "obstacle.0"},
        Broken{"Adaptive", membrane, "uniform = 3", "adaptive = true", 2, "not available in this version"},
        Broken{"Quadratic", punch, "young = 1.0", "young = 1.0\norder = 2", 2, "not available in this version"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_F(Program, MissingSceneIsBadInput) {
  const Ended ended = signorini({"solve", "none.toml"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, testing::HasSubstr("none.toml"));
}

}  // namespace
}  // namespace signorini::test
