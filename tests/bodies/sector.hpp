#pragma once
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace signorini::test {

/// Part of a ring around (0, y), or all of it, from one angle to another; radii of cells grow geometrically. Its mesh
/// is a file with the groups `inner`, `outer`, and unless it is closed `first` and `last`.
struct Sector {
  double inner, outer;
  double from = 0, to = 2 * std::numbers::pi;
  int along_radius, around;
  double y = 0;

  bool closed() const { return to - from > 2 * std::numbers::pi - 1e-9; }
  int columns() const { return closed() ? around : around + 1; }
  int node(int i, int j) const { return 1 + i * columns() + j % columns(); }  // as Gmsh counts

  std::string text() const {
    std::string nodes, elements;
    int count = 0;
    const auto add = [&](int type, int group, std::initializer_list<int> corners) {
      elements += fmt::format("{} {} 2 {} {}", ++count, type, group, group);
      for (const int corner : corners) elements += fmt::format(" {}", corner);
      elements += '\n';
    };
    for (int i = 0; i <= along_radius; ++i)
      for (int j = 0; j < columns(); ++j) {
        const double r = inner * std::pow(outer / inner, double(i) / along_radius);
        const double angle = from + (to - from) * j / around;
        nodes += fmt::format("{} {:.17g} {:.17g} 0\n", node(i, j), r * std::cos(angle), y + r * std::sin(angle));
      }
    for (int j = 0; j < around; ++j) {
      add(1, 1, {node(0, j), node(0, j + 1)});
      add(1, 2, {node(along_radius, j), node(along_radius, j + 1)});
    }
    for (int i = 0; i < along_radius && !closed(); ++i) {
      add(1, 3, {node(i, 0), node(i + 1, 0)});
      add(1, 4, {node(i, around), node(i + 1, around)});
    }
    for (int i = 0; i < along_radius; ++i)
      for (int j = 0; j < around; ++j) {
        add(2, 5, {node(i, j), node(i + 1, j), node(i + 1, j + 1)});
        add(2, 5, {node(i, j), node(i + 1, j + 1), node(i, j + 1)});
      }
    return fmt::format(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"inner\"\n1 2 \"outer\"\n1 3 \"first\"\n"
        "1 4 \"last\"\n2 5 \"inside\"\n$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
        (along_radius + 1) * columns(), nodes, count, elements);
  }
};

/// The body's table, with its mesh in the folder.
inline std::string sector(const std::filesystem::path& folder, const std::string& name, const Sector& shape,
                          const std::string& material) {
  const std::filesystem::path file = folder / (name + ".msh");
  std::ofstream(file) << shape.text();
  return fmt::format("[[body]]\nname = \"{}\"\nmesh = \"{}\"\n{}", name, file.string(), material);
}

}  // namespace signorini::test
