#pragma once
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

/// Meshes written to files that scenes of a test read, moved in space or renumbered.
namespace signorini::test {

/// x -> scale R x + shift, R a rotation.
template <int D>
struct Motion {
  std::array<Point<D>, D> rows;
  double scale = 1;
  Point<D> shift{};

  Motion() : rows{} {
    for (int i = 0; i < D; ++i) rows[i][i] = 1;
  }
  Point<D> turned(const Point<D>& x) const {
    Point<D> y{};
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) y[i] += rows[i][j] * x[j];
    return y;
  }
  Point<D> moved(const Point<D>& x) const {
    Point<D> y = turned(x);
    for (int i = 0; i < D; ++i) y[i] = scale * y[i] + shift[i];
    return y;
  }
};

inline Motion<2> rotation2(double angle) {
  Motion<2> m;
  m.rows = {Point<2>{std::cos(angle), -std::sin(angle)}, Point<2>{std::sin(angle), std::cos(angle)}};
  return m;
}

/// Rotation by three angles about z, y and x.
inline Motion<3> rotation3(double a, double b, double c) {
  const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b), cc = std::cos(c),
               sc = std::sin(c);
  Motion<3> m;
  m.rows = {Point<3>{ca * cb, ca * sb * sc - sa * cc, ca * sb * cc + sa * sc},
            Point<3>{sa * cb, sa * sb * sc + ca * cc, sa * sb * cc - ca * sc}, Point<3>{-sb, cb * sc, cb * cc}};
  return m;
}

/// "[1, 2]" in full precision.
template <std::size_t N>
std::string text(const std::array<double, N>& v) {
  std::string out = "[";
  for (std::size_t i = 0; i < N; ++i) out += fmt::format("{}{:.17g}", i ? ", " : "", v[i]);
  return out + "]";
}

/// A folder that lives as long as the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "signorini-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path_ / name) << content;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

/// MSH 2.2, ASCII, parts as physical groups.
/// @param number the new number of every vertex; empty: as they are
template <int D>
std::string msh(const Mesh<D>& mesh, const Motion<D>& motion = {}, std::vector<Index> number = {}) {
  const std::size_t n = mesh.points.size();
  if (number.empty())
    for (std::size_t p = 0; p < n; ++p) number.push_back(static_cast<Index>(p));
  std::vector<Index> old(n);
  for (std::size_t p = 0; p < n; ++p) old[number[p]] = static_cast<Index>(p);
  std::string out = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", mesh.parts.size());
  for (std::size_t k = 0; k < mesh.parts.size(); ++k)
    out += fmt::format("{} {} \"{}\"\n", D - 1, k + 1, mesh.parts[k].name);
  out += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", n);
  for (std::size_t p = 0; p < n; ++p) {
    const Point<D> x = motion.moved(mesh.points[old[p]]);
    out += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", p + 1, x[0], x[1], D == 3 ? x[D - 1] : 0);
  }
  std::string elements;
  int count = 0;
  const auto add = [&](int type, int group, const auto& vertices) {
    elements += fmt::format("{} {} 2 {} 1", ++count, type, group);
    for (const Index v : vertices) elements += fmt::format(" {}", number[v] + 1);
    elements += '\n';
  };
  for (std::size_t k = 0; k < mesh.parts.size(); ++k)
    for (const Index f : mesh.parts[k].faces) add(D == 2 ? 1 : 2, static_cast<int>(k) + 1, mesh.boundary[f].vertices);
  for (const auto& element : mesh.elements) add(D == 2 ? 2 : 4, 1, element);
  return out + fmt::format("$EndNodes\n$Elements\n{}\n{}$EndElements\n", count, elements);
}

}  // namespace signorini::test
