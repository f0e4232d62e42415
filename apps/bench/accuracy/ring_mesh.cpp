#include "apps/bench/accuracy/ring_mesh.hpp"

#include <fmt/os.h>

#include <cmath>
#include <numbers>

namespace signorini::bench {

void write_quarter_ring(const std::filesystem::path& file, double inner, double outer) {
  constexpr int around = 6, across = 4;
  auto out = fmt::output_file(file.string());
  const auto at = [](int i, int j) { return j * (around + 1) + i + 1; };
  out.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"inner\"\n1 2 \"outer\"\n2 3 \"ring\"\n");
  out.print("$EndPhysicalNames\n$Nodes\n{}\n", (around + 1) * (across + 1));
  for (int j = 0; j <= across; ++j)
    for (int i = 0; i <= around; ++i) {
      const double angle = std::numbers::pi / 2 * i / around, r = inner + (outer - inner) * j / across;
      out.print("{} {} {} 0\n", at(i, j), i == around ? 0 : r * std::cos(angle), r * std::sin(angle));
    }
  out.print("$EndNodes\n$Elements\n{}\n", 2 * around + 2 * around * across);
  int number = 0;
  for (int i = 0; i < around; ++i) {
    out.print("{} 1 2 1 1 {} {}\n", ++number, at(i, 0), at(i + 1, 0));
    out.print("{} 1 2 2 2 {} {}\n", ++number, at(i, across), at(i + 1, across));
  }
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < around; ++i) {
      out.print("{} 2 2 3 3 {} {} {}\n", ++number, at(i, j), at(i, j + 1), at(i + 1, j + 1));
      out.print("{} 2 2 3 3 {} {} {}\n", ++number, at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  out.print("$EndElements\n");
}

}  // namespace signorini::bench
