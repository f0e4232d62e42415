// Bodies that nothing holds against their loads are refused, with the motion that nothing stops.
#include <gmock/gmock.h>

#include <functional>

#include "core/base/error.hpp"
#include "driver/driver.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

std::string refusal(const std::function<void()>& solve) {
  try {
    solve();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::no_solution) << error.what();
    return error.what();
  }
  return "solved";
}

// A load to the side: nothing is behind the block but the round, which it slides off.
TEST(UnheldBody, SlidesOffARound) {
  for (const double aside : {1e-6, 1e-3})
    for (const int refinement : {0, 1, 2, 3}) {
      const auto scene = fmt::format(R"(
[[body]]
name = "b"
shape = "rectangle"
from = [0, 0]
to = [2, 1]
cells = [4, 4]
order = 1
young = 1
poisson = 0.3
[[fix]]
body = "b"
on = "top"
value = ["free", 0]
[[load]]
body = "b"
value = [{}, 0.01]
[[obstacle]]
type = "contact"
body = "b"
on = "bottom"
shape = "sphere"
center = [-1, 1]
radius = 1.3
)",
                                     aside);
      const std::string message = refusal([&] { run<2, 2>(scene, {uniform(refinement)}); });
      EXPECT_NE(message.find("body.0"), std::string::npos) << message;
      EXPECT_NE(message.find("translation along (1, 0)"), std::string::npos) << message;
    }
}

// Nearly all of the load presses the block onto the plane.
TEST(UnheldBody, LittleLoadsToTheSideAreNamedToo) {
  for (const double aside : {1e-9, 1e-10, 1e-11})
    for (const int refinement : {0, 1}) {
      const auto upright = fmt::format(R"(
[[body]]
name = "b"
shape = "box"
from = [-1, -1, 0]
to = [1, 1, 1]
cells = [4, 4, 2]
order = 1
young = 1
poisson = 0.3
[[load]]
body = "b"
value = [{}, 0, -0.01]
[[obstacle]]
type = "contact"
body = "b"
on = "bottom"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
)",
                                       aside);
      const auto r = refusal([&] { run<3, 3>(upright, {uniform(refinement)}); });
      EXPECT_NE(r.find("translation along (1, 0, 0)"), std::string::npos) << aside << ": " << r;
      const auto turned = fmt::format(R"(
[[body]]
name = "b"
shape = "polygon"
points = [[100, 200], [100.8, 200.6], [100.5, 201], [99.7, 200.4]]
size = 0.25
order = 1
young = 1
poisson = 0.3
[[load]]
body = "b"
value = ["0.8*{0} + 0.6*0.01", "0.6*{0} - 0.8*0.01"]
[[obstacle]]
type = "contact"
body = "b"
where = "0.8*(y - 200) - 0.6*(x - 100) < 1e-9"
shape = "plane"
point = [100, 200]
normal = [-0.6, 0.8]
)",
                                      aside);
      const auto t = refusal([&] { run<2, 2>(turned, {uniform(refinement)}); });
      EXPECT_NE(t.find("translation along (0.8, 0.6)"), std::string::npos) << aside << ": " << t;
    }
}

TEST(UnheldBody, TurnsInABowl) {
  // All normals point to the centre of the bowl.
  const auto r = refusal([] {
    run<2, 2>(R"(
[[body]]
name = "b"
shape = "rectangle"
from = [0, 0]
to = [1, 1]
cells = [4, 4]
order = 1
young = 1
poisson = 0.3
[[load]]
body = "b"
value = ['-(y - 0.5)', 'x - 0.5']
[[obstacle]]
type = "contact"
body = "b"
on = "boundary"
shape = "sphere"
center = [0.5, 0.5]
radius = 3
inside = true
)");
  });
  EXPECT_NE(r.find("rotation about (0.5, 0.5)"), std::string::npos) << r;
}

// Friction is too weak for the one, and the other one tips over before it slides.
TEST(UnheldBody, SaysWhereItGoesWhereFrictionDoesNotHoldIt) {
  const auto reason = [](double width, double friction) {
    const SceneText scene{
        .body = fmt::format(
            "shape = \"rectangle\"\nfrom = [0, 0]\nto = [{}, 1]\ncells = [4, 4]\norder = 1\nyoung = 1\npoisson = "
            "0.3",
            width),
        .loads = {"value = [0.01, -0.02]"},
        .obstacle = fmt::format("type = \"coulomb\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, "
                                "1]\nfriction = {}",
                                friction),
        .refinements = 2};
    return refusal([&] { Driver(parse_scene(std::string(scene), "test.toml", ".")).solve(); });
  };
  // A long block just above what friction bears.
  const std::string slides =
      "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [8, 0.5]\ncells = [16, 1]\norder = 1\nyoung "
      "= 1\n"
      "poisson = 0.3\n[[load]]\nbody = \"b\"\nvalue = [0.00028734788556634543, -0.0009578262852211514]\n"
      "[[obstacle]]\ntype = \"coulomb\"\nfriction = 0.29997\nbody = \"b\"\non = \"bottom\"\nshape = \"plane\"\n"
      "point = [0, 0]\nnormal = [0, 1]\n[refine]\nuniform = 2\n[solver]\ntolerance = 1e-6\n";
  EXPECT_THAT(refusal([&] { Driver(parse_scene(slides, "test.toml", ".")).solve(); }),
              testing::HasSubstr("friction takes at most 99.99 %: translation along (1, 0)"));
  EXPECT_THAT(reason(1, 0.3), testing::HasSubstr("friction takes at most 60 %: translation along (1, 0)"));
  EXPECT_THAT(reason(0.3, 0.9), testing::HasSubstr("rotation about"));
}

// A block that hangs on its bottom is tilted by its load. A plane in front of its side holds it after a small turn; of
// what one far away would do linearised contact knows nothing.
TEST(UnheldBody, TurnsByMoreThanLinearisedContactMeans) {
  const auto tilted = [](const std::string& obstacle) {
    return fmt::format(R"(
[[body]]
name = "b"
shape = "rectangle"
from = [-0.3, -0.5]
to = [0.3, 0.5]
cells = [3, 3]
order = 1
young = 1e6
poisson = 0.1
[[fix]]
body = "b"
on = "bottom"
value = [0, "free"]
[[load]]
body = "b"
value = [1e-4, 0]
[[obstacle]]
type = "contact"
body = "b"
on = "right"
{}
)",
                       obstacle);
  };
  const auto plane = [&](double x) {
    return tilted(fmt::format("shape = \"plane\"\npoint = [{}, 0]\nnormal = [-1, 0]\n", x));
  };
  EXPECT_NEAR((run<2, 2>(plane(0.4)).contact().force[0]), -0.3e-4, 1e-9) << "moments about the bottom";
  {
    const std::string far = plane(200);
    try {
      run<2, 2>(far);
      ADD_FAILURE() << "solved:" << far;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::input) << error.what();
      EXPECT_NE(std::string(error.what()).find("turned by"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace signorini::test
