// Bodies from real surfaces (SIGNORINI_MESHES names their folder), filled with tetrahedra, and pressed on planes and on
// each other's surface as rigid obstacles; levels are chosen by the matrix.
#include "real_surfaces.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini {
namespace {

using namespace test;

/// The upper quarter of the body goes down by 2 % of its height.
std::string pressed(const RealSurface& body, double size, const std::string& obstacle) {
  Point<3> down{};
  down[body.up] = -0.02 * body.height();
  return test::SceneText{
      .body = fmt::format("shape = \"solid\"\nfile = \"{}\"\nsize = {}\norder = 1\nyoung = 1\npoisson = 0.3", body.file,
                          size * diameter(body)),
      .fixes = {fmt::format("where = \"{} > {}\"\nvalue = [{}, {}, {}]", "xyz"[body.up],
                            body.farthest(1)[body.up] - 0.25 * body.height(), down[0], down[1], down[2])},
      .obstacle = "type = \"contact\"\non = \"boundary\"\n" + obstacle};
}

TEST(RealMeshes, ArePressedOnPlanesAndOnEachOtherInFewCycles) {
  const std::vector<RealSurface> surfaces = real_surfaces();
  if (surfaces.empty()) GTEST_SKIP() << no_surfaces;
  for (const RealSurface& body : surfaces)
    for (const RealSurface& obstacle : surfaces)
      for (const auto& [size, method] : {std::pair{0.05, "auto"}, {0.035, "auto"}, {0.025, "auto"}}) {
        const bool plane = &obstacle == &body;
        const Point<3> lowest = body.farthest(-1);
        const std::string file = plane ? "" : placed_below(body, obstacle, fmt::format("signorini_{}.obj", getpid()));
        SCOPED_TRACE(fmt::format("{} on {}, size {}", body.file, plane ? "a plane" : obstacle.file, size));
        const auto run = test::run<3, 3>(
            pressed(body, size,
                    plane ? fmt::format("shape = \"plane\"\npoint = [{}, {}, {}]\nnormal = [0, {}, {}]", lowest[0],
                                        lowest[1], lowest[2], body.up == 1 ? 1 : 0, body.up == 2 ? 1 : 0)
                          : fmt::format("shape = \"surface\"\nfile = \"{}\"", file)),
            {fmt::format("solver.method={}", method)});
        std::filesystem::remove(file);
        const auto name = [](const RealSurface& surface) {
          return std::filesystem::path(surface.file).stem().string();
        };
        test::show("{} on {}, size {}: {} cycles\n", name(body), plane ? "a plane" : name(obstacle), size,
                   run.summary().iterations);
        EXPECT_LE(run.summary().iterations, 25);
        EXPECT_GT(run.contact().force[body.up], 0);
      }
}

}  // namespace
}  // namespace signorini
