#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "apps/signorini/show.hpp"
#include "core/io/warning_kinds.hpp"

namespace signorini {

inline constexpr std::size_t most_patches = 200000;   ///< about as many as a panel has pixels
inline constexpr std::size_t enough_patches = 60000;  ///< finer ones can hardly be told

inline bool is_too_many(const std::vector<Patch>& patches) { return patches.size() > most_patches; }

/// A level of the hierarchy, and for each of its vertices that on the finest level.
template <int D>
struct Drawn {
  const Mesh<D>* mesh;
  std::vector<Index> fine;
};

template <int D>
Drawn<D> finest(const MeshHierarchy<D>& hierarchy) {
  Drawn<D> drawn{&hierarchy.finest(), std::vector<Index>(hierarchy.finest().points.size())};
  std::iota(drawn.fine.begin(), drawn.fine.end(), 0);
  return drawn;
}

/// One level down; false on the coarsest.
template <int D>
bool coarsen(const MeshHierarchy<D>& hierarchy, Drawn<D>& drawn) {
  const auto level = drawn.mesh - hierarchy.levels.data();
  if (level == 0) return false;
  const auto& parents = hierarchy.refinements[level - 1].parents;
  drawn.mesh = &hierarchy.levels[level - 1];
  std::vector<Index> fine(drawn.mesh->points.size());
  for (std::size_t v = 0; v < parents.size(); ++v)
    if (parents[v][0] == parents[v][1]) fine[parents[v][0]] = drawn.fine[v];
  drawn.fine = std::move(fine);
  return true;
}

inline std::size_t triangle_count(const Mesh<2>& mesh) { return mesh.elements.size(); }
inline std::size_t triangle_count(const Mesh<3>& mesh) { return mesh.boundary.size(); }

/// The finest level on which `patches`, which stops once is_too_many() of them, are no more than are seen; the coarsest
/// one if they are few enough to be drawn in a moment.
/// @param all whether they are all triangles of the level, so that they need not be made to be counted
template <int D, class Patches>
std::vector<Patch> few_patches(const Shown<D>& shown, Warnings& notes, bool all, Patches patches) {
  Drawn<D> drawn = finest(shown.hierarchy);
  while (all && triangle_count(*drawn.mesh) > enough_patches && coarsen(shown.hierarchy, drawn)) {
  }
  std::vector<Patch> result = patches(drawn);
  while (result.size() > enough_patches && coarsen(shown.hierarchy, drawn)) result = patches(drawn);
  if (!is_too_many(result)) return result;
  notes.push_back(
      warning<"missing-picture">(fmt::format("result.png: more than {} triangles are too many to draw", most_patches)));
  return {};
}

inline void set_corner(Patch& patch, int c, const Point<2>& x, double value) {
  patch.corner[c][0] = x[0];
  patch.corner[c][1] = x[1];
  patch.corner[c][2] = 0;
  patch.value[c] = value;
}

inline void set_corner(Patch& patch, int c, const Point<3>& x, double value) {
  std::copy(x.begin(), x.end(), patch.corner[c]);
  patch.value[c] = value;
}

}  // namespace signorini
