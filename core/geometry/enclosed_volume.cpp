#include "core/geometry/enclosed_volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

struct FaceSide {
  std::size_t face;
  bool ascends;  ///< the face runs through it from the vertex with the smaller number
};
using Edge = std::array<std::size_t, 2>;

/// Points at the same place are one.
std::vector<std::vector<std::size_t>> merged(const PolygonSoup& surface) {
  std::map<Point<3>, std::size_t> number;
  std::vector<std::vector<std::size_t>> faces = surface.faces;
  for (std::vector<std::size_t>& face : faces)
    for (std::size_t& v : face) v = number.emplace(surface.points[v], v).first->second;
  return faces;
}

std::map<Edge, std::vector<FaceSide>> sides_of(const std::vector<std::vector<std::size_t>>& faces) {
  std::map<Edge, std::vector<FaceSide>> sides;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < faces[f].size(); ++k) {
      const std::size_t a = faces[f][k], b = faces[f][(k + 1) % faces[f].size()];
      if (a != b) sides[{std::min(a, b), std::max(a, b)}].push_back({f, a < b});
    }
  return sides;
}

/// Of the pyramid over a face.
double volume(const PolygonSoup& surface, const std::vector<std::size_t>& face, const Point<3>& apex) {
  double sum = 0;
  const auto from = [&](std::size_t k) { return difference<3>(surface.points[face[k]], apex); };
  for (std::size_t k = 2; k < face.size(); ++k) sum += dot(from(0), cross(from(k - 1), from(k))) / 6;
  return sum;
}

}  // namespace

double enclosed_volume(const PolygonSoup& surface) {
  const auto faces = merged(surface);
  const auto sides = sides_of(faces);
  std::vector<std::vector<std::pair<std::size_t, bool>>> beside(
      faces.size());  // and whether it runs the same way round
  for (const auto& [edge, both] : sides) {
    if (both.size() != 2) return std::numeric_limits<double>::quiet_NaN();
    const bool same = both[0].ascends != both[1].ascends;
    beside[both[0].face].emplace_back(both[1].face, same);
    beside[both[1].face].emplace_back(both[0].face, same);
  }
  std::vector<int> turn(faces.size());  // 0: not seen
  double largest = 0, all = 0;
  for (std::size_t first = 0; first < faces.size(); ++first) {
    if (turn[first] != 0) continue;
    turn[first] = 1;
    double shell = 0;
    std::vector<std::size_t> front{first};
    while (!front.empty()) {
      const std::size_t f = front.back();
      front.pop_back();
      shell += turn[f] * volume(surface, faces[f], surface.points[faces[first][0]]);
      for (const auto& [other, same] : beside[f])
        if (turn[other] == 0) {
          turn[other] = same ? turn[f] : -turn[f];
          front.push_back(other);
        }
    }
    largest = std::max(largest, std::abs(shell));
    all += std::abs(shell);
  }
  return 2 * largest - all;
}

}  // namespace signorini::geometry
