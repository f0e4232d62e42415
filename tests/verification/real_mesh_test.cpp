// Bodies from real surfaces (SIGNORINI_MESHES names their folder), filled with tetrahedra, and pressed on planes and on
// each other's surface as rigid obstacles; levels are chosen by the matrix.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/mesh/simplex.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini {
namespace {

struct Surface {
  std::string file;
  int up;  // direction that the body is pressed against
  std::vector<Point<3>> points{};
  std::vector<std::string> faces{};

  /// The vertex that lies farthest in the direction of `sign`.
  Point<3> farthest(double sign) const {
    return *std::ranges::max_element(points, {}, [&](const Point<3>& p) { return sign * p[up]; });
  }
  double height() const { return farthest(1)[up] - farthest(-1)[up]; }
};

Surface read(const std::string& file, int up) {
  Surface surface{file, up};
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (Point<3> p; std::sscanf(line.c_str(), "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3) surface.points.push_back(p);
    if (line.starts_with("f ")) surface.faces.push_back(line);
  }
  return surface;
}

double diameter(const Surface& surface) {
  Point<3> low = surface.points.front(), high = low;
  for (const Point<3>& p : surface.points)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  return length<3>(difference<3>(high, low));
}

/// The obstacle, scaled to the height of the body and with its top right below the lowest vertex of the body.
std::string placed_below(const Surface& body, const Surface& obstacle, const std::string& name) {
  Surface turned = obstacle;
  turned.up = body.up;
  const double scale = body.height() / turned.height();
  const Point<3> top = turned.farthest(1), at = body.farthest(-1);
  const std::string file = (std::filesystem::temp_directory_path() / name).string();
  std::ofstream out(file);
  for (const Point<3>& p : obstacle.points)
    out << fmt::format("v {} {} {}\n", at[0] + scale * (p[0] - top[0]), at[1] + scale * (p[1] - top[1]),
                       at[2] + scale * (p[2] - top[2]));
  for (const std::string& face : obstacle.faces) out << face << '\n';
  return file;
}

/// The upper quarter of the body goes down by 2 % of its height.
std::string pressed(const Surface& body, double size, const std::string& obstacle) {
  Point<3> down{};
  down[body.up] = -0.02 * body.height();
  return test::SceneText{
      .body = fmt::format("shape = \"solid\"\nfile = \"{}\"\nsize = {}\nyoung = 1\npoisson = 0.3", body.file,
                          size * diameter(body)),
      .fixes = {fmt::format("where = \"{} > {}\"\nvalue = [{}, {}, {}]", "xyz"[body.up],
                            body.farthest(1)[body.up] - 0.25 * body.height(), down[0], down[1], down[2])},
      .obstacle = "type = \"contact\"\non = \"boundary\"\n" + obstacle};
}

TEST(RealMeshes, ArePressedOnPlanesAndOnEachOtherInFewCycles) {
  const char* folder = std::getenv("SIGNORINI_MESHES");
  if (!folder) GTEST_SKIP() << "SIGNORINI_MESHES does not name a folder with spot.obj, fandisk.obj and rocker-arm.obj";
  std::vector<Surface> surfaces;
  for (const auto& [name, up] : {std::pair{"spot.obj", 1}, {"fandisk.obj", 1}, {"rocker-arm.obj", 2}}) {
    const std::string file = std::string(folder) + "/" + name;
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
    surfaces.push_back(read(file, up));
  }
  for (const Surface& body : surfaces)
    for (const Surface& obstacle : surfaces)
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
        test::show("{} cycles\n", run.summary().iterations);
        EXPECT_LE(run.summary().iterations, 25);
        EXPECT_GT(run.contact().force[body.up], 0);
      }
}

}  // namespace
}  // namespace signorini
