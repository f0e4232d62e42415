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

/// The free memory that some messages tell changes from run to run.
std::string without_figures(std::string text) {
  std::erase_if(text, [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
  return text;
}

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
  const Ended checked = signorini({"check", "scene.toml"});
  EXPECT_EQ(checked.status, ended.status);
  EXPECT_EQ(without_figures(checked.err), without_figures(ended.err));
}

/// How often a text holds another one.
int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_P(BrokenScene, NamesItsPlaceOnce) {
  Broken broken = GetParam();
  write("scene.toml", broken.scene.replace(broken.scene.find(broken.from), broken.from.size(), broken.to));
  EXPECT_LE(count(signorini({"solve", "scene.toml"}).err, "scene.toml:"), 1);
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
        Broken{"ObstacleBeyondTheBoundary", membrane, "0.5 - x^2 - y^2", "0.5", 4, "obstacle.0"},
        Broken{"CrossedBounds", membrane, "lower = \"0.5 - x^2 - y^2\"", "lower = \"-x^2\"\nupper = \"-1-x^2\"", 4,
               "obstacle.0"},
        Broken{"UnknownSmoother", membrane, "[refine]", "[solver]\nsmoother = \"symetric\"\n[refine]", 2,
               "scene.toml:18: solver.smoother: there is no smoother 'symetric', did you mean 'symmetric'?"},
        Broken{"UnknownTransfer", membrane, "[refine]", "[solver]\ntransfer = \"minmerge\"\n[refine]", 2,
               "scene.toml:18: solver.transfer: there is no transfer 'minmerge', did you mean 'min_merge'?"},
        Broken{"UnknownCoarse", membrane, "[refine]", "[solver]\ncoarse = \"newtn\"\n[refine]", 2,
               "scene.toml:18: solver.coarse: there is no coarse 'newtn', did you mean 'newton'?"},
        Broken{"UnknownAggregates", membrane, "[refine]", "[solver]\naggregates = \"mets\"\n[refine]", 2,
               "scene.toml:18: solver.aggregates: there is no aggregates 'mets', did you mean 'metis'?"},
        Broken{"AggregatesOfClassicalLevels", membrane, "[refine]",
               "[solver]\ncoarsening = \"classical\"\naggregates = \"metis\"\n[refine]", 2,
               "scene.toml:19: solver.aggregates: found 'metis', expected 'greedy' with coarsening 'classical'"},
        Broken{"ModulusNegativeSomewhere", punch, "young = 1.0", "young = \"x - 0.5\"", 2,
               "scene.toml:9: body.0.young: "},
        Broken{"DiffusionNotFiniteSomewhere", membrane, "equation =", "diffusion = \"log(x + 0.5)\"\nequation =", 2,
               "scene.toml:8: body.0.diffusion: "},
        Broken{"NormalInsideTheBody", punch, "young = 1.0", "young = \"1 + nx\"", 2,
               "scene.toml:9: body.0.young: '1 + nx' uses nx, ny or nz"},
        Broken{"NormalInABodyForce", punch, "[refine]", "[[load]]\nbody = \"b\"\nvalue = [0, 0, \"nz\"]\n[refine]", 2,
               "load.0.value[2]: 'nz' uses nx, ny or nz"},
        Broken{"NormalInABoundInsideTheBody", membrane, "0.5 - x^2 - y^2", "nx - 2", 2,
               "obstacle.0.lower: 'nx - 2' uses nx, ny or nz"},
        Broken{"ObstacleThatTakesNoOther", punch, "\"contact\"", "\"contact\"\nother = \"block\"", 2,
               "obstacle.0.other: there is no body 'block'"},
        Broken{"ObstacleWithoutItsOther", punch, "\"contact\"", "\"elastic\"", 2, "obstacle.0: missing key 'other'"},
        Broken{"EmptyObstacleType", punch, "\"contact\"", "\"\"", 2, "obstacle.0.type: the type is empty"},
        Broken{"FixedBeyondTheObstacle", punch, "on = \"left\"\nvalue = [0, \"free\", \"free\"]",
               "on = \"top\"\nvalue = [0, 0, 0]", 4,
               "obstacle beyond the fixed boundary: the fixed value 0 lies below the obstacle's bound 0.01"},
        Broken{"HugeCoordinates", punch, "to = [1, 1, 1]", "to = [1e300, 1, 1]", 2,
               "scene.toml:2: body.0: too large a coordinate at ("},
        Broken{"NoPluginFolder", membrane, "[refine]", "[plugins]\npath = \"nowhere\"\n[refine]", 2,
               "scene.toml:18: plugins.path: there is no folder 'nowhere'"},
        Broken{"NarrowPolygon", membrane, "shape = \"rectangle\"\nfrom = [-1, -1]\nto = [1, 1]\ncells = [4, 4]",
               "shape = \"polygon\"\npoints = [[0, 0], [1, 0], [1, 1e-9]]\nsize = 0.3", 2,
               "scene.toml:6: body.0.size: the mesh does not come to an end: points[2] is 1e-09 away from edge0"},
        Broken{"CrossingPolygon", membrane, "shape = \"rectangle\"\nfrom = [-1, -1]\nto = [1, 1]\ncells = [4, 4]",
               "shape = \"polygon\"\npoints = [[0, 0], [1, 1], [1, 0], [0, 1]]\nsize = 0.3", 2,
               "scene.toml:5: body.0.points: edge0 and edge2 meet or cross"},
        Broken{"ShapeKeyBesideMesh", membrane, "shape = \"rectangle\"\nfrom = [-1, -1]\nto = [1, 1]\ncells = [4, 4]",
               "mesh = \"scene.toml\"\nradius = 1", 2,
               "body.0.radius: 'radius' is a key of shape 'disk' and has no meaning without 'shape'"},
        Broken{"NoFaceWhereAConstantHolds", membrane, "on = \"boundary\"", "where = \"1 - 1\"", 2,
               "fix.0.where: no boundary face has all its vertices where '0'"},
        Broken{"MissingObstacleShape", punch, "shape = \"plane\"\n", "", 2,
               "scene.toml:36: obstacle.0.point: missing key 'shape': 'point' is a key of shape 'plane'"},
        Broken{"UnknownOption", membrane, "lower =", "lowr =", 2, "lower"},
        Broken{"FrictionOfAnotherType", punch, "shape = \"plane\"", "shape = \"plane\"\nfriction = 0.3", 2,
               "scene.toml:37: obstacle.0.friction: obstacle 'contact' has no option 'friction', which is one of type "
               "'coulomb'"},
        Broken{"FrictionOfAnotherTypeBySymbol", punch, "shape = \"plane\"", "shape = \"plane\"\nmu = 0.3", 2,
               "obstacle 'contact' has no option 'mu', 'friction' is one of type 'coulomb'"},
        Broken{"FrictionBySymbol", punch, "type = \"contact\"", "type = \"coulomb\"\nmu = 0.3", 2,
               "obstacle 'coulomb' has no option 'mu', did you mean 'friction'?"},
        Broken{"LoadByForce", punch, "[refine]", "[[load]]\nbody = \"b\"\ntraction = [0, 0, 1]\n[refine]", 2,
               "unknown key 'traction', did you mean 'value'?"},
        Broken{"WrongPluginForElasticity", punch, "type = \"contact\"", "type = \"scalar\"", 2,
               "obstacle.0.type: the obstacle type 'scalar' is for scalar unknowns, and body 'b' has equation = "
               "'elasticity'; expected a type for elastic bodies, such as 'contact'"},
        Broken{"GoalOfAUniformMesh", membrane, "uniform = 3", "goal = 'force'", 2,
               "refine.goal: 'goal' has no meaning without adaptive = true"},
        Broken{"MisspeltMethod", membrane, "[refine]", "[solver]\nmethod = \"monotne\"\n[refine]", 2,
               "solver.method: expected one of auto | monotone | tnnmg | pgs | pdas | newton, found 'monotne', did you "
               "mean "
               "'monotone'?"},
        Broken{"MisspeltShortMethod", membrane, "[refine]", "[solver]\nmethod = \"tnmg\"\n[refine]", 2,
               "found 'tnmg', did you mean 'tnnmg'?"},
        Broken{"ProbeLittleOutside", membrane, "at = [0, 0]", "at = [0, 1.05]", 2,
               "probe.0.at: point (0, 1.05) lies outside the body; the nearest point of the body is (0, 1)"},
        Broken{"TransferNone", membrane, "[refine]", "[solver]\ntransfer = \"none\"\n[refine]", 2,
               "scene.toml:18: solver.transfer: found 'none', expected a monotone restriction, or method 'tnnmg'"},
        Broken{"StiffnessOverflows", membrane, "equation =", "diffusion = 1e308\nequation =", 2,
               "scene.toml:2: body.0: the stiffness overflows or vanishes by underflow at ("},
        Broken{"StiffnessUnderflows", punch, "young = 1.0", "young = 1e-320", 2,
               "scene.toml:2: body.0: the stiffness overflows or vanishes by underflow at ("},
        Broken{"LoadOverflows", membrane, "[refine]", "[[load]]\nbody = \"m\"\nvalue = 1e300\n[refine]", 2,
               "scene.toml:2: body.0: the energy of the load overflows at ("}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_F(Program, ABodyThatNothingHoldsHasNoSolution) {
  const std::string held = "[[fix]]\nbody = \"m\"\non = \"boundary\"\nvalue = [0]";
  std::string loose = membrane;
  loose.replace(loose.find(held), held.size(), "[[load]]\nbody = \"m\"\nvalue = [1]");
  write("scene.toml", loose);
  const Ended ended = signorini({"solve", "scene.toml"});
  EXPECT_EQ(ended.status, 4) << ended.err;
  EXPECT_THAT(ended.err, testing::HasSubstr("scene.toml:2: body.0: "));
  EXPECT_THAT(written(), testing::IsEmpty());
}

TEST_F(Program, AnElementWithoutAreaNamesItsBody) {
  write("scene.toml", membrane.substr(0, membrane.find("[[probe]]")));
  const Ended ended = signorini({"check", "scene.toml", "--set", "body.0.from=[0, 0]", "--set",
                                 "body.0.to=[1e-300, 1e-300]", "--set", "obstacle.0.lower=-1"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, testing::HasSubstr("scene.toml:2: body.0: element with area 0"));
}

TEST_F(Program, UnreadableSurfacesNameTheirLine) {
  write("nan.off", "OFF\n4 4 0\n0 0 0\n1 0 nan\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  std::string obstacle = punch;
  const std::string plane = "shape = \"plane\"\npoint = [0, 0, \"1 - 0.01 * t\"]\nnormal = [0, 0, -1]";
  obstacle.replace(obstacle.find(plane), plane.size(), "shape = \"surface\"\nfile = \"nan.off\"");
  write("obstacle.toml", obstacle);
  std::string body = punch;
  const std::string box = "shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [2, 2, 2]";
  body.replace(body.find(box), box.size(), "shape = \"solid\"\nfile = \"nan.off\"\nsize = 0.5");
  write("body.toml", body);
  for (const char* scene : {"obstacle.toml", "body.toml"}) {
    const Ended ended = signorini({"check", scene});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, testing::HasSubstr("line 4: found 'nan', expected z of vertex 1 of 4, a finite number"));
  }
}

TEST_F(Program, MissingSceneIsBadInput) {
  const Ended ended = signorini({"solve", "none.toml"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.err, testing::HasSubstr("none.toml"));
}

}  // namespace
}  // namespace signorini::test
