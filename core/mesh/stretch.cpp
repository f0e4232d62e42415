#include "core/mesh/stretch.hpp"

#include <cmath>

#include "core/mesh/simplex.hpp"

namespace signorini {

template <int D>
double stretched_part(const Mesh<D>& mesh, double limit) {
  if (mesh.elements.empty()) return 0;
  const double corner = D == 2 ? 0.25 : 1 / (6 * std::sqrt(27.0));  // relative volume: 1 / (D! sqrt(D)^D)
  const double least = corner / std::pow(limit, D);
  std::size_t stretched = 0;
  for (const auto& element : mesh.elements) {
    std::array<Point<D>, D + 1> corners;
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = mesh.points[element[k]];
    stretched += relative_volume<D>(corners) < least;
  }
  return static_cast<double>(stretched) / static_cast<double>(mesh.elements.size());
}

template double stretched_part(const Mesh<2>&, double);
template double stretched_part(const Mesh<3>&, double);

}  // namespace signorini
