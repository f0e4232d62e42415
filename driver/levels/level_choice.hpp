#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/scene/scene.hpp"
#include "methods/configuration.hpp"

/// Which meshes are levels, and what comes below the coarsest one.
namespace signorini {

template <int D>
std::vector<const Mesh<D>*> meshes_of(const MeshHierarchy<D>& hierarchy) {
  std::vector<const Mesh<D>*> out;
  for (const Mesh<D>& mesh : hierarchy.levels) out.push_back(&mesh);
  return out;
}

/// How levels below the coarsest mesh are chosen: classical or aggregation; nothing where there are none.
std::optional<Coarsening> coarsening_below(const Scene::Solver& options, int block, Index vertices);

/// The coarsest mesh that gives a level: the first one, or the finest alone where all coarser levels are to be
/// algebraic: where many cells are stretched, for there point smoothing needs levels that are coarser along the strong
/// couplings only, and uniformly refined meshes have others. Below quadratic elements there are always linear ones.
/// @param meshes coarsest first
template <int D>
std::size_t first_mesh(std::span<const Mesh<D>* const> meshes, const Scene::Solver& options, int block, int order = 1);

/// The number of meshes, coarsest first, that have no coarser level, because of bending, which those represent badly:
/// of elastic bodies that are slender, or whose cells are stretched, as far as a factorisation costs no more than some
/// cycles.
template <int D>
std::size_t factorised_meshes(std::span<const Mesh<D>* const> meshes, const Scene::Solver& options, int block);

/// Whether many cells of a mesh are stretched.
template <int D>
bool is_stretched(const Mesh<D>& mesh, int block);

}  // namespace signorini
