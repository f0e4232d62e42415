#pragma once
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

namespace signorini::test {

/// Triangle surfaces in the OFF format, written by the tests themselves.
struct Surface {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> triangles;

  std::string off() const {
    std::string text = fmt::format("OFF\n{} {} 0\n", points.size(), triangles.size());
    for (const auto& p : points) text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
    for (const auto& t : triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
  }
  std::string stl() const {
    std::string text = "solid s\n";
    for (const auto& t : triangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int v : t) text += fmt::format("vertex {} {} {}\n", points[v][0], points[v][1], points[v][2]);
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid s\n";
  }
  Surface reversed() const {
    Surface result = *this;
    for (auto& t : result.triangles) std::swap(t[1], t[2]);
    return result;
  }
  Surface& add(const Surface& other) {
    const int shift = static_cast<int>(points.size());
    points.insert(points.end(), other.points.begin(), other.points.end());
    for (const auto& t : other.triangles) triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    return *this;
  }
};

/// The cube [low, high]^3, oriented outwards. The first two triangles are the bottom.
inline Surface cube(double low, double high) {
  Surface s;
  for (int i = 0; i < 8; ++i) s.points.push_back({i & 1 ? high : low, i & 2 ? high : low, i & 4 ? high : low});
  s.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return s;
}

}  // namespace signorini::test
