#include "core/mortar/creases.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/sorted_range.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mortar/element_face.hpp"

namespace signorini::mortar {
namespace {

// Times what the side turns by at the next edges, on that side of an edge where this is less: facets of one size turn
// by once as much.
constexpr double sharper = 3;

template <int D>
std::array<double, D> middle_of_edge(int opposite) {
  std::array<double, D> out;
  out.fill(1.0 / (D - 1));
  out[static_cast<std::size_t>(opposite)] = 0;
  return out;
}

}  // namespace

template <int D>
Creases<D>::Creases(const Side<D>& side, int order) : side_(side), order_(order) {
  find_sharp(joints());
}

template <int D>
Point<D> Creases<D>::normal(Index face, int opposite) const {
  const auto at = middle_of_edge<D>(opposite);
  return order_ == 1 ? outer_normal<D, 1>(side_, face, at, side_.normal[face])
                     : outer_normal<D, 2>(side_, face, at, side_.normal[face]);
}

template <int D>
auto Creases<D>::joints() const -> std::vector<Joint> {
  struct Half {
    std::array<Index, D - 1> edge;
    Index face;
    int opposite;
  };
  std::vector<Half> halves;
  for (Index f = 0; f < std::ssize(side_.faces); ++f)
    for (int opposite = 0; opposite < D; ++opposite) {
      Half& half = halves.emplace_back(Half{{}, f, opposite});
      for (int i = 0, k = 0; i < D; ++i)
        if (i != opposite) half.edge[k++] = side_.faces[f][i];
      half.edge = sorted(half.edge);
    }
  std::ranges::sort(halves, {}, [](const Half& h) { return std::pair(h.edge, h.face); });
  std::vector<Joint> out;
  for (std::size_t k = 1; k < halves.size(); ++k)
    if (halves[k].edge == halves[k - 1].edge)
      out.push_back({{halves[k - 1].face, halves[k].face}, {halves[k - 1].opposite, halves[k].opposite}});
  return out;
}

template <int D>
void Creases<D>::find_sharp(const std::vector<Joint>& joints) {
  std::vector<Point<D>> turns(side_.faces.size() * D);  // of the normal
  std::vector<const Joint*> candidates;
  for (const Joint& joint : joints) {
    const Point<D> by =
        difference<D>(normal(joint.face[0], joint.opposite[0]), normal(joint.face[1], joint.opposite[1]));
    for (const int s : {0, 1}) turns[seat(joint.face[s], joint.opposite[s])] = by;
    if (length<D>(by) >= steepest) candidates.push_back(&joint);
  }
  if (candidates.empty()) return;
  std::vector<std::pair<Index, Index>> around;  // node, face
  for (Index f = 0; f < std::ssize(side_.faces); ++f)
    for (const Index v : side_.faces[f]) around.emplace_back(v, f);
  std::ranges::sort(around);
  // What it turns by in that direction at the next edges, on one side: at the corner of a flat face the other edge
  // turns it in another one.
  const auto beside = [&](const Joint& joint, int s) {
    const Point<D>& by = turns[seat(joint.face[0], joint.opposite[0])];
    const Point<D>&own = side_.normal[joint.face[s]], &other = side_.normal[joint.face[1 - s]];
    double most = 0;
    for (int i = 0; i < D; ++i) {
      if (i == joint.opposite[s]) continue;
      const Index v = side_.faces[joint.face[s]][i];
      for (const auto& [node, f] : part_with(around, v, &std::pair<Index, Index>::first)) {
        if (dot(side_.normal[f], own) < dot(side_.normal[f], other)) continue;
        const auto& corners = side_.faces[f];
        const Point<D>& next = turns[seat(f, static_cast<int>(std::ranges::find(corners, v) - corners.begin()))];
        most = std::max(most, std::fabs(dot(next, by)) / length<D>(by));
      }
    }
    return most;
  };
  for (const Joint* joint : candidates) {
    const double by = length<D>(turns[seat(joint->face[0], joint->opposite[0])]);
    if (by < sharper * std::min(beside(*joint, 0), beside(*joint, 1))) continue;
    sharp_.resize(turns.size());
    for (const int s : {0, 1}) sharp_[seat(joint->face[s], joint->opposite[s])] = true;
  }
}

template class Creases<2>;
template class Creases<3>;

}  // namespace signorini::mortar
