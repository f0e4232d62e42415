#include "core/mesh/chords.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

constexpr double rounding = 1e-6, edge = std::numbers::pi / 6;  // angles

/// From what is opposite to a corner of a face to that corner, the shortest way.
Point<2> across(const Mesh<2>& mesh, const Face<2>& face, int tip) {
  return difference<2>(mesh.points[face.vertices[tip]], mesh.points[face.vertices[1 - tip]]);
}

Point<3> across(const Mesh<3>& mesh, const Face<3>& face, int tip) {
  const Point<3>&a = mesh.points[face.vertices[(tip + 1) % 3]], &b = mesh.points[face.vertices[(tip + 2) % 3]];
  const Point<3> along = difference<3>(b, a);
  Point<3> out = difference<3>(mesh.points[face.vertices[tip]], a);
  const double part = dot<3>(out, along) / dot<3>(along, along);
  for (int k = 0; k < 3; ++k) out[k] -= part * along[k];
  return out;
}

/// The face without one of its vertices, sorted.
template <int D>
std::array<Index, D - 1> joint(const Face<D>& face, int tip) {
  std::array<Index, D - 1> out;
  for (int i = 0; i < D - 1; ++i) out[i] = face.vertices[(tip + 1 + i) % D];
  return sorted(out);
}

/// Between two faces: the angle that they turn by, which is small where one continues the other.
template <int D>
double turn(const Point<D>& a, const Point<D>& b) {
  const double la = length<D>(a), lb = length<D>(b);
  Point<D> sum, apart;  // of the unit vectors a and -b
  for (int k = 0; k < D; ++k) {
    sum[k] = a[k] / la - b[k] / lb;
    apart[k] = a[k] / la + b[k] / lb;
  }
  return 2 * std::atan2(length<D>(apart), length<D>(sum));
}

}  // namespace

double sagitta(double angle, double across) { return angle > rounding && angle < edge ? angle * across / 8 : 0; }

template <int D>
double chord_sagitta(const MeshHierarchy<D>& hierarchy, std::vector<bool> marked) {
  if (hierarchy.refinements.empty()) return 0;
  for (std::size_t k = hierarchy.refinements.size(); k-- > 0;) {
    std::vector<bool> coarser(hierarchy.levels[k].points.size());
    const auto& parents = hierarchy.refinements[k].parents;
    for (std::size_t v = 0; v < parents.size(); ++v)
      if (marked[v])
        for (const Index parent : parents[v]) coarser[parent] = true;
    marked = std::move(coarser);
  }
  const Mesh<D>& mesh = hierarchy.levels.front();
  std::map<std::array<Index, D - 1>, Point<D>> open;
  double largest = 0;
  for (const Face<D>& face : mesh.boundary)
    for (int tip = 0; tip < D && face.curve < 0; ++tip) {
      const auto common = joint(face, tip);
      if (!std::ranges::all_of(common, [&](Index p) { return marked[p]; })) continue;
      const Point<D> here = across(mesh, face, tip);
      const auto [other, first] = open.try_emplace(common, here);
      if (first) continue;
      const double size = std::min(length<D>(here), length<D>(other->second));  // the other may be no chord
      largest = std::max(largest, sagitta(turn<D>(here, other->second), size));
    }
  return largest;
}

template double chord_sagitta(const MeshHierarchy<2>&, std::vector<bool>);
template double chord_sagitta(const MeshHierarchy<3>&, std::vector<bool>);

}  // namespace signorini
