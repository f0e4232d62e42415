#pragma once
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/mesh/simplex.hpp"

/// Real surfaces that the environment names a folder of.
namespace signorini::test {

struct RealSurface {
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

inline RealSurface read_surface(const std::string& file, int up) {
  RealSurface surface{file, up};
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (Point<3> p; std::sscanf(line.c_str(), "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3) surface.points.push_back(p);
    if (line.starts_with("f ")) surface.faces.push_back(line);
  }
  return surface;
}

inline double diameter(const RealSurface& surface) {
  Point<3> low = surface.points.front(), high = low;
  for (const Point<3>& p : surface.points)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  return signorini::length<3>(difference<3>(high, low));
}

/// The obstacle, scaled to the height of the body and with its top right below the lowest vertex of the body.
inline std::string placed_below(const RealSurface& body, const RealSurface& obstacle, const std::string& name) {
  RealSurface turned = obstacle;
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

/// Those in the folder that SIGNORINI_MESHES names; none where it names none, or a file is missing.
inline std::vector<RealSurface> real_surfaces() {
  const char* folder = std::getenv("SIGNORINI_MESHES");
  std::vector<RealSurface> surfaces;
  if (!folder) return surfaces;
  for (const auto& [name, up] : {std::pair{"spot.obj", 1}, {"fandisk.obj", 1}, {"rocker-arm.obj", 2}}) {
    const std::string file = std::string(folder) + "/" + name;
    if (!std::filesystem::exists(file)) return {};
    surfaces.push_back(read_surface(file, up));
  }
  return surfaces;
}

inline const char* const no_surfaces =
    "SIGNORINI_MESHES does not name a folder with spot.obj, fandisk.obj and rocker-arm.obj";

}  // namespace signorini::test
