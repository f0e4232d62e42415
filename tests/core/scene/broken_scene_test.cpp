#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/scene.hpp"
#include "core/scene/specs.hpp"
#include "scenes.hpp"

namespace signorini {
namespace {

using test::ball;
using test::membrane;
using test::with;
using testing::HasSubstr;

/// A scene broken by one replacement, and what its message must contain: place, what is wrong, what would be right.
struct Broken {
  const std::string& scene;
  const char* from;
  const char* to;
  std::vector<const char*> message;
};

const std::vector<Broken> broken = {
    // TOML
    {ball, "title = ", "title ", {"scene.toml:1:7:"}},
    {ball, "title = ", "title = \xff", {"scene.toml:1:"}},
    {ball, "title = ", "title = \"\"\ntitle = ", {"scene.toml:2:", "title"}},
    {ball, "[[fix]]", "[[fix]", {"scene.toml:14:"}},
    {ball, "= 2\n", "= \xd1\xa2\n", {"scene.toml:35:", "ASCII"}},
    {ball, "title = ", "title = \"\"\"a \\\xef\xbb\xbb\"\"\" #", {"scene.toml:1:", "ASCII"}},
    {ball, "title = ", "title = \"\"\"\na\\ \n \xc3\xa9\"\"\" #", {"scene.toml:2:", "ASCII"}},
    {ball, "title = ", "title = \"\"\"\na\\\n  b\"\"\" #\nx = \xc3\xa9\n", {"scene.toml:4:", "ASCII"}},
    {ball, "= [0, 0, 0]\nradius", "= [0, }\nradius", {"scene.toml:6:", "expected ']', found '}'"}},
    {ball, "= 2\n", "= 2]\n", {"scene.toml:35:", "closes nothing"}},
    {ball, "[0, 0, 0]\nradius", "[0, 0, 0\nradius", {"scene.toml:6:", "'[' in this line is not closed", "in line 7"}},
    {ball, "[0, 0, -0.02]", "[0, 0, -0.02", {"scene.toml:17:", "'[' in this line is not closed: expected ']'"}},
    {ball, "at   = [0, 0, -1]", "at = [0, [0], -1", {"scene.toml:40:", "not closed: expected ']' before the end"}},
    {ball, "young    = 1.0", "young = {a = [1, b = 2}", {"scene.toml:10:", "'[' in this line is not closed"}},
    {ball, "= 2\n", "= 2[\"\xd2\x96\"]\n", {"scene.toml:35:", "in the middle of a value"}},
    {ball, "= 2\n", "= 2.\"\xd2\x96\"\n", {"scene.toml:35:", "in the middle of a value"}},
    {ball, "= 2\n", "= 2=\"\xd2\x96\"\n", {"scene.toml:35:", "a second '='"}},
    {ball, "= 2\n", "= 2'\xd2\x96'\n", {"scene.toml:35:", "in the middle of a value"}},
    {ball, "[solver]", "[>solver\"]", {"scene.toml:31:", "the name of a table"}},
    {ball, "[[fix]]", "  [[ ?]]", {"scene.toml:14:", "the name of a table"}},
    {ball, "1.0\nsize", "inf\nsize", {"scene.toml:7: body.0.radius", "finite"}},
    {ball, "1.0\npoisson", "nan\npoisson", {"scene.toml:10: body.0.young", "finite"}},
    {ball, "title = ", "title = 1979-05-27 #", {"scene.toml:1: title", "date"}},
    {ball, "young    = 1.0", "young = {a = 1}", {"scene.toml:10: body.0.young", "a table cannot stand here"}},
    // names of tables and keys
    {ball, "[solver]", "[slover]", {"scene.toml:31:", "unknown table 'slover', did you mean 'solver'?"}},
    {ball, "[[fix]]", "[fix]", {"scene.toml:14:", "[[fix]]"}},
    {ball, "[solver]", "[[solver]]", {"scene.toml:31:", "[solver]"}},
    {ball, "title", "titel", {"scene.toml:1:", "unknown key 'titel', did you mean 'title'?"}},
    {ball, "title = ", "output = ", {"scene.toml:1: output", "expected a table, written [output]"}},
    {membrane, "[[body]]", "load = 3\n[[body]]", {"scene.toml:1: load", "expected a table, written [[load]]"}},
    {ball, "young ", "E", {"scene.toml:10: body.0.E", "did you mean 'young'?"}},
    {ball, "poisson ", "Poisson_ratio", {"scene.toml:11: body.0.Poisson_ratio", "did you mean 'poisson'?"}},
    {ball, "value = [0, 0, 0]", "traction = [0, 0, 0]", {"scene.toml:21: load.0.traction", "did you mean 'value'?"}},
    {ball, "poisson ", "poison", {"scene.toml:11: body.0.poison", "did you mean 'poisson'?"}},
    {ball, "tolerance", "tolerence", {"scene.toml:32: solver.tolerence", "did you mean 'tolerance'?"}},
    {ball, "uniform", "unifrom", {"scene.toml:35: refine.unifrom", "did you mean 'uniform'?"}},
    {ball, "tolerance = 1e-8", "max_iter = 3", {"scene.toml:32: solver.max_iter", "did you mean 'max_iterations'?"}},
    {ball, "at   =", "point =", {"scene.toml:40: probe.0.point", "unknown key 'point'"}},
    {ball, "radius   = 1.0", "cells = [1, 1, 1]", {"scene.toml:7:", "no key of shape 'ball'", "center, radius"}},
    // bodies
    {ball,
     "shape    = \"ball\"",
     "shape = \"bal\"",
     {"scene.toml:5: body.0.shape", "did you mean 'ball'?", "half_disk"}},
    {ball, "shape    = \"ball\"", "", {"scene.toml:3: body.0", "neither 'shape' nor 'mesh'"}},
    {ball, "shape    = ", "mesh = \"a.msh\"\nshape = ", {"scene.toml:3: body.0", "both 'shape' and 'mesh'"}},
    {ball, "radius   = 1.0", "", {"scene.toml:3: body.0", "missing key 'radius' of shape 'ball'"}},
    {ball, "radius   = 1.0", "radius = 0", {"scene.toml:7: body.0.radius", "(0, inf)", "found 0"}},
    {ball, "radius   = 1.0", "radius = \"x\"", {"scene.toml:7: body.0.radius", "'x'", "has variables"}},
    {ball, "radius   = 1.0", "radius = true", {"scene.toml:7: body.0.radius", "expected a number", "found true"}},
    {ball, "center   = [0, 0, 0]", "center = [0, 0]", {"scene.toml:6: body.0.center", "expected 3", "found 2"}},
    {ball, "center   = [0, 0, 0]", "center = 0", {"scene.toml:6: body.0.center", "a list of numbers", "found 0"}},
    {ball, "size     = 0.25", "", {"scene.toml:3: body.0", "missing key 'size'"}},
    {ball, "0.25", "-0.25", {"scene.toml:8: body.0.size", "(0, inf)", "-0.25"}},
    {ball, "young    = 1.0", "", {"scene.toml:3: body.0", "missing key 'young'"}},
    {ball, "young    = 1.0", "young = -1", {"scene.toml:10: body.0.young", "(0, inf)", "found -1"}},
    {ball, "young    = 1.0", "young = \"1 - 2\"", {"scene.toml:10: body.0.young", "(0, inf)", "text '1 - 2'"}},
    {ball, "young    = 1.0", "young = [1]", {"scene.toml:10: body.0.young", "a number or an expression", "list of 1"}},
    {ball, "0.3", "0.5", {"scene.toml:11: body.0.poisson", "(-1, 0.5)", "found 0.5"}},
    {ball, "0.3", "-1", {"scene.toml:11: body.0.poisson", "(-1, 0.5)", "found -1"}},
    {ball, "\"elasticity\"", "\"elastic\"", {"scene.toml:9: body.0.equation", "did you mean 'elasticity'?"}},
    {ball, "order    = 1", "order = 3", {"scene.toml:12: body.0.order", "one of auto | 1 | 2", "found 3"}},
    {ball,
     "order    = 1",
     "order = 1\npressure = \"linear\"",
     {"scene.toml:13: body.0.pressure", "for quadratic elements", "expected order = 2"}},
    {ball, "order    = 1", "pressure = \"cubic\"", {"scene.toml:12: body.0.pressure", "auto", "constant", "cubic"}},
    {membrane,
     "cells = [2, 2]",
     "cells = [2, 2]\npressure = \"none\"",
     {"scene.toml:7: body.0.pressure", "no meaning"}},
    {ball, "order    = 1", "geometry = \"fit\"", {"scene.toml:12:", "'geometry' has no meaning beside 'shape'"}},
    {ball, "order    = 1", "crease = 30", {"scene.toml:12:", "'crease' has no meaning beside 'shape'"}},
    {ball, "order    = 1", "temperature = 1", {"scene.toml:3: body.0", "missing key 'expansion'", "'temperature'"}},
    {ball, "order    = 1", "expansion = \"w\"", {"scene.toml:12: body.0.expansion", "'w'"}},
    {membrane, "cells = [2, 2]", "cells = [2, 2]\ntemperature = 1", {"body.0.temperature", "no meaning", "diffusion"}},
    {ball, "order    = 1", "diffusion = 1", {"scene.toml:12:", "'diffusion' has no meaning", "elasticity"}},
    {ball, "order    = 1", "plane = \"stress\"", {"scene.toml:12: body.0.plane", "2D"}},
    {ball, "name     = \"ball\"", "name = \"\"", {"scene.toml:4: body.0.name", "empty"}},
    {membrane, "cells = [2, 2]", "cells = [2, 0]", {"scene.toml:6: body.0.cells[1]", "[1, 1000000]", "found 0"}},
    {membrane, "cells = [2, 2]", "cells = [2, 2.5]", {"scene.toml:6: body.0.cells[1]", "whole number", "2.5"}},
    {membrane, "cells = [2, 2]", "cells = [100000, 100000]", {"scene.toml:6: body.0.cells", "1e+10 cells"}},
    {membrane, "cells = [2, 2]", "cells = [2, 2]\nsize = 1", {"scene.toml:7: body.0.size", "no meaning"}},
    {membrane, "to = [1, 1]", "to = [1, 0]", {"scene.toml:5: body.0.to", "larger than 'from'"}},
    {membrane, "cells = [2, 2]", "cells = [2, 2]\nyoung = 1", {"scene.toml:7: body.0.young", "no meaning"}},
    {membrane,
     "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]",
     "mesh = \"no.msh\"",
     {"scene.toml:3: body.0.mesh", "no file"}},
    {membrane,
     "[[fix]]",
     "[[body]]\nname = \"membrane\"\nshape = \"disk\"\ncenter=[0,0]\nradius=1\nsize=1\nequation=\"diffusion\"\n[[fix]]",
     {"scene.toml:10: body.1.name", "taken already", "scene.toml:2"}},
    {membrane,
     "[[body]]\nname = \"membrane\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\nequation = "
     "\"diffusion\"",
     "",
     {"scene.toml: there is no [[body]]"}},
    // fixes and loads
    {ball, "where = \"z > 0.5\"", "", {"scene.toml:14: fix.0", "neither 'on' nor 'where'"}},
    {ball, "where = \"z > 0.5\"", "where = \"z > 0.5\"\non = \"top\"", {"fix.0.where", "both 'on' and 'where'"}},
    {ball, "\"z > 0.5\"", "\"z > a\"", {"scene.toml:16: fix.0.where", "'z > a'", "column 5", "unknown name 'a'"}},
    {ball, "\"z > 0.5\"", "\"sqr(z) > 0.5\"", {"scene.toml:16: fix.0.where", "did you mean 'sqrt'?"}},
    {ball, "[0, 0, -0.02]", "[0, -0.02]", {"scene.toml:17: fix.0.value", "expected 3 components, found 2"}},
    {ball, "[0, 0, -0.02]", "0", {"scene.toml:17: fix.0.value", "expected 3 components, found 1"}},
    {ball, "[0, 0, -0.02]", "[0, 0, \"fre\"]", {"scene.toml:17: fix.0.value[2]", "unknown name 'fre'"}},
    {ball, "[0, 0, -0.02]", "[0, 0, [1]]", {"scene.toml:17: fix.0.value[2]", "found a list of 1"}},
    {ball, "[0, 0, -0.02]", "[\"free\", \"free\", \"free\"]", {"scene.toml:17: fix.0.value", "nothing is fixed"}},
    {ball, "value = [0, 0, -0.02]", "", {"scene.toml:14: fix.0", "missing key 'value'"}},
    {ball,
     "[0, 0, -0.02]",
     "[0, 0, 0]\nframe = \"norm\"",
     {"fix.0.frame", "global | normal", "did you mean 'normal'?"}},
    {ball, "body  = \"ball\"\nwhere", "body = \"bal\"\nwhere", {"scene.toml:15: fix.0.body", "did you mean 'ball'?"}},
    {ball,
     "body  = \"ball\"\nvalue = [0, 0, 0]",
     "body = \"xyzuvw\"\nvalue = [0, 0, 0]",
     {"load.0.body", "bodies: ball"}},
    {ball, "value = [0, 0, 0]", "value = [0, 0, \"free\"]", {"scene.toml:21: load.0.value", "belongs into [[fix]]"}},
    {ball, "value = [0, 0, 0]", "value = [0, 0]", {"scene.toml:21: load.0.value", "expected 3 components, found 2"}},
    {membrane, "value = 0", "value = [0, 0]", {"scene.toml:12: fix.0.value", "expected 1 component, found 2"}},
    {membrane, "value = 0", "value = 0\nframe = \"normal\"", {"scene.toml:13: fix.0.frame", "scalar"}},
    // obstacles
    {ball, "type  = \"contact\"", "", {"scene.toml:23: obstacle.0", "missing key 'type'"}},
    {ball, "on    = \"boundary\"", "", {"scene.toml:23: obstacle.0", "neither 'on' nor 'where'"}},
    {ball, "\"plane\"", "\"plain\"", {"scene.toml:27: obstacle.0.shape", "did you mean 'plane'?", "sphere"}},
    {ball, "normal = [0, 0, 1]", "", {"scene.toml:23: obstacle.0", "missing key 'normal' of shape 'plane'"}},
    {ball, "normal = [0, 0, 1]", "normal = [0, 0, 0]", {"scene.toml:29: obstacle.0.normal", "zero"}},
    {ball, "normal = [0, 0, 1]", "normal = [0, 1]", {"scene.toml:29: obstacle.0.normal", "expected 3 coordinates"}},
    {ball, "point = [0, 0, -1]", "point = [0, -1]", {"scene.toml:28: obstacle.0.point", "expected 3 coordinates"}},
    {ball, "point = [0, 0, -1]", "point = [0, 0, \"q\"]", {"scene.toml:28: obstacle.0.point[2]", "unknown name 'q'"}},
    {membrane, "lower", "shape = \"cylinder\"\ncenter=[0,0]\naxis=[1,0]\nradius=1\nlower", {"obstacle.0.shape", "3D"}},
    {membrane, "lower", "shape = \"surface\"\nfile = \"a.off\"\nlower", {"obstacle.0.file", "no file"}},
    {membrane,
     "body = \"membrane\"\nlower",
     "body = \"membrain\"\nlower",
     {"obstacle.0.body", "did you mean 'membrane'?"}},
    // settings
    {ball, "1e-8", "1", {"scene.toml:32: solver.tolerance", "(0, 1)", "found 1"}},
    {ball, "1e-8", "0", {"scene.toml:32: solver.tolerance", "(0, 1)", "found 0"}},
    {ball, "1e-8", "\"tight\"", {"scene.toml:32: solver.tolerance", "unknown name 'tight'"}},
    {ball, "1e-8", "1e-8\nmax_iterations = 0", {"scene.toml:33: solver.max_iterations", "found 0"}},
    {ball, "1e-8", "1e-8\ncycle = \"X\"", {"scene.toml:33: solver.cycle", "V | W", "'X'"}},
    {ball, "1e-8", "1e-8\npre = 0\npost = 0", {"scene.toml:34: solver.post", "nothing smooths"}},
    {ball, "1e-8", "1e-8\nstart = \"nestd\"", {"scene.toml:33: solver.start", "did you mean 'nested'?"}},
    {ball, "1e-8", "1e-8\nthreads = 0", {"scene.toml:33: solver.threads", "found 0"}},
    {ball, "uniform = 2", "uniform = -1", {"scene.toml:35: refine.uniform", "[0, 30]", "found -1"}},
    {ball, "uniform = 2", "uniform = 2.0", {"scene.toml:35: refine.uniform", "whole number in [0, 30], found 2.0"}},
    {ball, "uniform = 2", "uniform = 99999999999999", {"scene.toml:35: refine.uniform", "[0, 30]"}},
    {ball, "uniform = 2", "adaptive = 1", {"scene.toml:35: refine.adaptive", "true or false", "found 1"}},
    {ball, "uniform = 2", "goal = 'force'", {"scene.toml:35: refine.goal", "no meaning without adaptive = true"}},
    {ball,
     "uniform = 2",
     "adaptive = true\ngoal = 'forces'",
     {"scene.toml:36: refine.goal: unknown goal 'forces', did you mean 'force'?", "energy, force, peak_pressure"}},
    {ball,
     "uniform = 2",
     "adaptive = true\ngoal = 'probe polle'",
     {"scene.toml:36: refine.goal: there is no probe 'polle', did you mean 'pole'?"}},
    {ball,
     "uniform = 2",
     "adaptive = true\ngoal = 'probe x'",
     {"scene.toml:36: refine.goal: there is no probe 'x' (probes: pole)"}},
    {ball, "[solver]", "[steps]\ncount = 0\n[solver]", {"scene.toml:32: steps.count", "found 0"}},
    {ball,
     "[solver]",
     "[steps]\ncount = 2\nat = [0.5, 1]\n[solver]",
     {"scene.toml:33: steps.at", "scene.toml:32: steps.count", "one of them"}},
    {ball, "[solver]", "[steps]\nat = []\n[solver]", {"scene.toml:32: steps.at", "the list is empty"}},
    {ball, "[solver]", "[steps]\nat = 1\n[solver]", {"scene.toml:32: steps.at", "expected a list of numbers, found 1"}},
    {ball,
     "[solver]",
     "[steps]\nat = [0.5, 0.25, 1]\n[solver]",
     {"scene.toml:32: steps.at[1]", "above 0.5", "found 0.25"}},
    {ball,
     "[solver]",
     "[steps]\nat = [0.5, 0.5, 1]\n[solver]",
     {"scene.toml:32: steps.at[1]", "above 0.5", "found 0.5"}},
    {ball,
     "[solver]",
     "[steps]\nat = [0.5, nan, 1]\n[solver]",
     {"scene.toml:32: steps.at[1]", "expected a finite number"}},
    {ball, "[solver]", "[steps]\nat = [0, 1]\n[solver]", {"scene.toml:32: steps.at[0]", "(0, 1]", "found 0"}},
    {ball, "[solver]", "[steps]\nat = [0.5, 2]\n[solver]", {"scene.toml:32: steps.at[1]", "(0, 1]", "found 2"}},
    {ball,
     "[solver]",
     "[steps]\nat = [0.5, 0.75]\n[solver]",
     {"scene.toml:32: steps.at", "expected 1 as the last value", "0.75"}},
    {ball, "[solver]", "[steps]\nat = ['t', 1]\n[solver]", {"scene.toml:32: steps.at[0]", "has variables"}},
    {ball, "[solver]", "[steps]\nhalvings = -1\n[solver]", {"scene.toml:32: steps.halvings", "[0, 20]", "found -1"}},
    {ball, "[solver]", "[output]\nvtu = \"no\"\n[solver]", {"scene.toml:32: output.vtu", "true or false", "'no'"}},
    {ball, "[solver]", "[output]\nvtk = true\n[solver]", {"scene.toml:32: output.vtk", "did you mean 'vtu'?"}},
    {ball, "[solver]", "[plugins]\npath = [1]\n[solver]", {"scene.toml:32: plugins.path[0]", "expected a text"}},
    {ball,
     "[solver]",
     "[plugins]\npath = 'none'\n[solver]",
     {"scene.toml:32: plugins.path: there is no folder './none'"}},
    // probes
    {ball, "at   = [0, 0, -1]", "at = [0, 0]", {"scene.toml:40: probe.0.at", "expected 3 coordinates, found 2"}},
    {ball, "body = \"ball\"\nat", "body = \"balls\"\nat", {"scene.toml:39: probe.0.body", "did you mean 'ball'?"}},
    {ball,
     "[[probe]]",
     "[[probe]]\nname='pole'\nbody='ball'\nat=[0,0,0]\n[[probe]]",
     {"scene.toml:42: probe.1.name", "'pole'", "scene.toml:38"}},
};

TEST(BrokenScene, IsRejectedNamingPlaceAndCure) {
  ASSERT_GE(broken.size(), 45);
  for (const Broken& b : broken) {
    const test::Outcome result = test::outcome([&] { test::parse(with(b.scene, b.from, b.to)); });
    EXPECT_EQ(result.status, Exit::input) << b.from << " -> " << b.to;
    for (const char* part : b.message) EXPECT_THAT(result.message, HasSubstr(part)) << b.from << " -> " << b.to;
  }
}

TEST(BrokenScene, WithoutFixAndObstacleNothingHoldsTheBody) {
  std::string free = membrane.substr(0, membrane.find("[[fix]]"));
  const test::Outcome result = test::outcome([&] { test::parse(free); });
  EXPECT_EQ(result.status, Exit::input);
  EXPECT_THAT(result.message, HasSubstr("scene.toml: there is neither [[fix]] nor [[spring]] nor [[obstacle]]"));
  EXPECT_EQ(test::outcome([&] { test::parse(free + membrane.substr(membrane.find("[[obstacle]]"))); }).message, "");
}

TEST(BrokenScene, EmptyFilesHaveNoBody) {
  EXPECT_THAT(test::outcome([] { test::parse(""); }).message, HasSubstr("there is no [[body]]"));
  EXPECT_THAT(test::outcome([] { test::parse("# nothing\n"); }).message, HasSubstr("there is no [[body]]"));
}

TEST(BrokenScene, FacesOfASecondBodyThatIsNotNamed) {
  for (const char* key : {"other_on=boundary", "other_where=z>0"})
    EXPECT_THAT(test::outcome([&] { test::parse(ball, {std::string("obstacle.0.") + key}); }).message,
                HasSubstr("has no meaning without 'other', the second body"));
}

TEST(BrokenScene, ASecondBodyThatNothingHolds) {
  const std::string second = R"([[body]]
name = "table"
shape = "rectangle"
from = [0, 0]
to = [1, 1]
cells = [1, 1]
equation = "diffusion"
)";
  const test::Outcome result = test::outcome([&] { test::parse(membrane + second); });
  EXPECT_EQ(result.status, Exit::input);
  EXPECT_THAT(
      result.message,
      HasSubstr(
          "scene.toml:18: body.1: there is neither [[fix]] nor [[spring]] nor [[obstacle]]: nothing holds the body"));
}

// A list of a list of a truth value is what no key of a scene is.
TEST(BrokenScene, EveryKeyOfTheSpecificationChecksItsType) {
  const auto check = [](const std::string& scene, const std::string& table, const KeySpec& key) {
    const test::Outcome result = test::outcome([&] { test::parse(scene, {table + key.name + "=[[true]]"}); });
    EXPECT_EQ(result.status, Exit::input) << table << key.name;
  };
  for (const TableSpec& table : table_specs())
    for (const KeySpec& key : table.keys) {
      const bool scalar = std::string_view(key.name) == "diffusion";
      check(scalar ? membrane : ball, std::string(table.name) + (table.listed ? ".0." : "."), key);
    }
  for (const ShapeSpec& shape : obstacle_shapes())
    for (const KeySpec& key : shape.keys) {
      const std::string type = std::string("shape = \"") + shape.name + '"';
      check(with(ball, "shape = \"plane\"", type), "obstacle.0.", key);
    }
  for (const ShapeSpec& shape : body_shapes())
    for (const KeySpec& key : shape.keys) {
      const std::string type = std::string("shape = \"") + shape.name + '"';
      check(with(ball, "shape    = \"ball\"", type), "body.0.", key);
    }
}

TEST(BrokenScene, DeepNestingIsRefusedBeforeItIsParsed) {
  const auto repeated = [](const std::string& text, int count) {
    std::string all;
    for (int k = 0; k < count; ++k) all += text;
    return all;
  };
  for (const std::string& text :
       {"a = " + repeated("[", 100000), "a = " + repeated("{a=", 100000), "[" + repeated("a.", 100000) + "a]",
        repeated("a.", 100000) + "a = 1", "[" + repeated("a.\"=\".", 100000) + "a]",
        "# it's\n" + repeated("a.'=,'.", 100000) + "a = 1", "a = '''x''''\n[" + repeated("a.", 100000) + "b]"}) {
    const test::Outcome result = test::outcome([&] { test::parse(text); });
    EXPECT_EQ(result.status, Exit::input);
    EXPECT_THAT(result.message, HasSubstr("scene.toml:"));
    EXPECT_LT(result.message.size(), 200);
  }
}

TEST(BrokenScene, DotsAndBracketsInTextsAndCommentsAreNoNesting) {
  const std::string dots(1000, '.'), brackets(1000, '[');
  const Scene scene = test::parse("# " + dots + brackets + "\n" +
                                  with(ball, "\"Ball pressed on a plane\"", "'''" + dots + "\n\"" + brackets + "'''"));
  EXPECT_EQ(scene.title, dots + "\n\"" + brackets);
}

}  // namespace
}  // namespace signorini
