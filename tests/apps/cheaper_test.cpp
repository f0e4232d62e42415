// Models that cost less, as `signorini check` proposes them.
#include "tests/apps/program.hpp"

namespace signorini::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Cheaper : public Program {
 protected:
  std::string check(const std::string& scene) {
    write("scene.toml", scene);
    const Ended ended = signorini({"check", "scene.toml"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return ended.out;
  }
};

std::string block(const std::string& distance, const std::string& more = "") {
  return "[[body]]\nname = \"b\"\nshape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 2, 1]\ncells = [2, 4, 2]\nyoung = 1\n"
         "poisson = 0.3\n[[fix]]\nbody = \"b\"\non = \"top\"\nvalue = [0, 0, -0.05]\n[[obstacle]]\ntype = \"contact\"\n"
         "body = \"b\"\non = \"bottom\"\nshape = \"expression\"\ndistance = \"" +
         distance + "\"\nnormal = [0, 0, 1]\n" + more;
}

// What is proposed gives the answer of the whole.
TEST_F(Cheaper, PlanesOfSymmetry) {
  const std::string both = check(block("z + 0.5 * ((x - 0.5)^2 + (y - 1)^2)"));
  EXPECT_THAT(both, HasSubstr("cheaper: symmetric about x=0.5: `--set symmetry.x=0.5`"));
  EXPECT_THAT(both, HasSubstr("`--set symmetry.y=1`"));
  EXPECT_THAT(both, Not(HasSubstr("symmetry.z")));
  const auto solve = [&](const char* out, const std::vector<std::string>& planes) {
    std::vector<std::string> arguments{"solve", "scene.toml", "--out", out, "--quiet", "--set", "refine.uniform=2"};
    for (const std::string& plane : planes) arguments.insert(arguments.end(), {"--set", plane});
    return signorini(arguments).status;
  };
  ASSERT_EQ(solve("whole", {}), 0);
  ASSERT_EQ(solve("part", {"symmetry.x=0.5", "symmetry.y=1"}), 0);
  const double force = report("whole")["contact"][0]["force"][2];
  EXPECT_NEAR(report("part")["contact"][0]["force"][2], force, 0.005 * force) << "but for the mesh";

  const std::string one = check(block("z + 0.5 * ((x - 0.4)^2 + (y - 1)^2)"));
  EXPECT_THAT(one, Not(HasSubstr("symmetry.x")));
  EXPECT_THAT(one, HasSubstr("symmetry.y=1"));
  EXPECT_THAT(check(block("z + 0.5 * ((x - 0.5)^2 + (y - 1)^2)", "[symmetry]\nx = 0.5\n")),
              Not(HasSubstr("symmetry.x")));
  EXPECT_THAT(check(block("z", "[[load]]\nbody = \"b\"\nvalue = [1e-3, 0, 0]\n")), Not(HasSubstr("symmetry.x")));
}

// On one side alone acts what is in the half that is kept, or in the other one.
TEST_F(Cheaper, NoPlanesWhereSomethingActsOnOneSide) {
  const auto beam = [](const std::string& conditions) {
    return "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [10, 1]\ncells = [20, 2]\nyoung = "
           "1000\npoisson = 0.3\n[[load]]\nbody = \"b\"\nvalue = [0, -0.001]\n" +
           conditions;
  };
  const auto on = [](const std::string& kind, const std::string& what) {
    return "[[" + kind + "]]\nbody = \"b\"\n" + what + "\n";
  };
  const std::string bottom = on("fix", "on = \"bottom\"\nvalue = [0, 0]");
  EXPECT_THAT(check(beam(bottom)), HasSubstr("symmetry.x=5"));
  for (const char* side : {"left", "right"}) {
    const std::string at = std::string("on = \"") + side + "\"\n";
    EXPECT_THAT(check(beam(on("fix", at + "value = [0, 0]"))), Not(HasSubstr("symmetry.x"))) << side;
    EXPECT_THAT(check(beam(bottom + on("load", at + "pressure = 1"))), Not(HasSubstr("symmetry.x"))) << side;
    EXPECT_THAT(check(beam(bottom + on("spring", at + "stiffness = [1, 1]"))), Not(HasSubstr("symmetry.x"))) << side;
  }
  EXPECT_THAT(check(beam(bottom + on("load", "at = [7, 1]\nvalue = [0, -1]"))), Not(HasSubstr("symmetry.x")));
  EXPECT_THAT(check(beam(on("fix", "where = \"y < 0.01 && x > 2.4\"\nvalue = [0, 0]"))), Not(HasSubstr("symmetry.x")));
  // A plane that drags the body along.
  EXPECT_THAT(check(beam(bottom + on("obstacle",
                                     "type = \"coulomb\"\nfriction = 0.3\non = \"top\"\nshape = \"plane\"\npoint = "
                                     "[\"0.01 * t\", 1]\nnormal = [0, -1]"))),
              Not(HasSubstr("symmetry.x")));
}

TEST_F(Cheaper, FrictionThatIsNone) {
  const std::string scene = block("z + 0.1 * x", "friction = 0.0\n");
  const auto at = scene.find("\"contact\"");
  EXPECT_THAT(check(std::string(scene).replace(at, 9, "\"coulomb\"")), HasSubstr("friction 0: type = \"contact\""));
}

TEST_F(Cheaper, BodiesThatMightBeRigid) {
  const auto stack = [](const char* young) {
    return std::string(
               "[[body]]\nname = \"upper\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\nyoung = "
               "1\npoisson = 0.3\n[[body]]\nname = \"lower\"\nshape = \"rectangle\"\nfrom = [-1, -1]\nto = [3, "
               "0]\ncells = [4, "
               "1]\npoisson = 0.3\nyoung = ") +
           young +
           "\n[[fix]]\nbody = \"upper\"\non = \"top\"\nvalue = [0, -0.01]\n[[fix]]\nbody = \"lower\"\non = \"bottom\"\n"
           "value = [0, 0]\n[[obstacle]]\ntype = \"elastic\"\nbody = \"upper\"\non = \"bottom\"\nother = "
           "\"lower\"\nother_on = \"top\"\n";
  };
  EXPECT_THAT(check(stack("1e6")), HasSubstr("'lower' is 1e+06 times as stiff as the other body"));
  EXPECT_THAT(check(stack("100")), Not(HasSubstr("times as stiff as the other body: a rigid")));
  std::string orthotropic = stack("1e6");
  const std::string isotropic = "poisson = 0.3\nyoung = 1e6";
  orthotropic.replace(orthotropic.find(isotropic), isotropic.size(),
                      "orthotropic = [1e6, 1e6, 1e6, 0.3, 0.3, 0.3, 4e5, 4e5, 4e5]");
  EXPECT_THAT(check(orthotropic), Not(HasSubstr("times as stiff as the other body: a rigid")));
}

}  // namespace
}  // namespace signorini::test
