#pragma once
#include <fmt/format.h>

#include <array>
#include <cmath>
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
  /// Moved by as much in each direction.
  Surface moved(double by) const {
    Surface result = *this;
    for (auto& p : result.points)
      for (double& x : p) x += by;
    return result;
  }
  /// Turned about the x axis and then about the z axis: faces are flat but for rounding from then on.
  Surface turned(double about_x, double about_z) const {
    Surface result = *this;
    const double c = std::cos(about_x), d = std::sin(about_x), e = std::cos(about_z), f = std::sin(about_z);
    for (auto& [x, y, z] : result.points) {
      const double u = c * y - d * z;
      z = d * y + c * z;
      y = f * x + e * u;
      x = e * x - f * u;
    }
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

/// The box from [0, 0, 0] to `high`, oriented outwards.
inline Surface box(const std::array<double, 3>& high) {
  Surface s = cube(0, 1);
  for (auto& p : s.points)
    for (std::size_t k = 0; k < 3; ++k) p[k] *= high[k];
  return s;
}

/// A polygon (counterclockwise, divided into triangles) times [0, height].
inline Surface prism(const std::vector<std::array<double, 2>>& polygon, double height,
                     const std::vector<std::array<int, 3>>& triangles) {
  Surface s;
  const int n = static_cast<int>(polygon.size());
  for (const double z : {0.0, height})
    for (const auto& p : polygon) s.points.push_back({p[0], p[1], z});
  for (const auto& [a, b, c] : triangles) {
    s.triangles.push_back({a, c, b});
    s.triangles.push_back({a + n, b + n, c + n});
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    s.triangles.push_back({i, j, j + n});
    s.triangles.push_back({i, j + n, i + n});
  }
  return s;
}

}  // namespace signorini::test
