#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "tests/core/mesh/mesh_checks.hpp"

namespace signorini::test {

template <int D>
geometry::Size<D> constant(double h) {
  return [h](const Point<D>&) { return h; };
}

/// Mean length of the edges with both ends in the region.
template <int D, class Region>
double mean_edge(const Mesh<D>& mesh, const Region& region) {
  std::set<std::array<Index, 2>> edges;
  for (const auto& element : mesh.elements)
    for (const auto [a, b] : simplex_edges<D>()) edges.insert(sorted(std::array{element[a], element[b]}));
  double sum = 0, count = 0;
  for (const auto& [a, b] : edges)
    if (region(mesh.points[a]) && region(mesh.points[b])) {
      sum += length<D>(difference<D>(mesh.points[a], mesh.points[b]));
      ++count;
    }
  return sum / count;
}

template <int D>
double mean_edge(const Mesh<D>& mesh) {
  return mean_edge(mesh, [](const Point<D>&) { return true; });
}

/// Smallest angle of the triangles, or smallest dihedral angle of the tetrahedra, in degrees.
template <int D>
double smallest_angle(const Mesh<D>& mesh) {
  double smallest = 180;
  for (const auto& element : mesh.elements) {
    std::array<Point<D>, D + 1> normals;
    for (int i = 0; i <= D; ++i) normals[i] = area_vector(mesh, Face<D>{outward_face<D>(element, i), 0, -1});
    for (int i = 0; i <= D; ++i)
      for (int j = 0; j < i; ++j) {
        double dot = 0;
        for (int k = 0; k < D; ++k) dot -= normals[i][k] * normals[j][k];
        const double cosine = dot / (length<D>(normals[i]) * length<D>(normals[j]));
        smallest = std::min(smallest, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi);
      }
  }
  return smallest;
}

/// The parts hold every boundary face once.
template <int D>
void expect_parts_cover(const Mesh<D>& mesh) {
  std::vector<Index> faces;
  for (const Part& part : mesh.parts) faces.insert(faces.end(), part.faces.begin(), part.faces.end());
  std::sort(faces.begin(), faces.end());
  EXPECT_EQ(faces, faces_of(mesh, "boundary", "test"));
}

/// Every vertex of a face on a curve is as far from its centre or axis as the radius, up to rounding.
template <int D>
void expect_on_curves(const Mesh<D>& mesh) {
  for (const Face<D>& face : mesh.boundary) {
    if (face.curve < 0) continue;
    const Curve<D>& curve = mesh.curves.at(face.curve);
    for (const Index v : face.vertices) {
      Point<D> radial = difference<D>(mesh.points[v], curve.center);
      if (curve.kind == Curve<D>::Kind::cylinder) radial[D - 1] = 0;
      EXPECT_NEAR(length<D>(radial), curve.radius, 1e-14 * curve.radius);
    }
  }
}

/// Every vertex of the part has exactly this coordinate.
template <int D>
void expect_flat(const Mesh<D>& mesh, const char* part, int direction, double value) {
  for (const Index f : faces_of(mesh, part, "test")) {
    EXPECT_EQ(mesh.boundary[f].curve, -1);
    for (const Index v : mesh.boundary[f].vertices) EXPECT_EQ(mesh.points[v][direction], value);
  }
}

template <int D>
bool equal(const Mesh<D>& a, const Mesh<D>& b) {
  if (a.points != b.points || a.elements != b.elements || a.boundary.size() != b.boundary.size()) return false;
  for (std::size_t f = 0; f < a.boundary.size(); ++f)
    if (a.boundary[f].vertices != b.boundary[f].vertices || a.boundary[f].curve != b.boundary[f].curve) return false;
  return true;
}

/// A file of the test's own, removed in the end.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& content)
      : path_(std::filesystem::temp_directory_path() / ("signorini_" + std::to_string(getpid()) + "_" + name)) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace signorini::test
