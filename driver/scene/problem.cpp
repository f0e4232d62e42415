#include "driver/scene/problem.hpp"

#include <fmt/ranges.h>

#include "core/io/warning_kinds.hpp"
#include "core/mesh/families.hpp"

namespace signorini {

template <int D>
MeshHierarchy<D> hierarchy_of(Mesh<D> coarsest, int uniform, const Scene& scene, int block, Warnings* warnings,
                              std::size_t body, PromisedMemory* promised) {
  const int order = scene.bodies[body].order, refinements = uniform + order - 1;
  check_memory(hierarchy_size(coarsest, refinements), block,
               promised ? scene.bodies[body].source.table + ", " + scene.refine.source.of("uniform")
                        : scene.refine.source.of("uniform"),
               promised, order == 1 ? 0 : D);
  MeshHierarchy<D> meshes = hierarchy(std::move(coarsest), refinements);
  if (order == 2)
    for (const Index v : straighten_families(meshes.levels.back()))
      meshes.straightened.push_back(meshes.finest().points[v]);
  if (const auto& at = meshes.straightened; warnings && !at.empty())
    warnings->push_back(warning<"straight-edges">(scene.bodies[body].source.table, at.size(), fmt::join(at[0], ", "),
                                                  at.size() > 1 ? fmt::format(" and at {} more", at.size() - 1) : ""));
  return meshes;
}

template <int D>
MeshHierarchy<D> build_hierarchy(const Scene& scene, int block, Warnings* warnings, const Progress& progress,
                                 std::size_t body, PromisedMemory* promised) {
  Mesh<D> coarsest = coarsest_mesh<D>(scene, body, block, warnings, progress);
  progress.stop_if_interrupted();
  return hierarchy_of(std::move(coarsest), scene.refine.uniform, scene, block, warnings, body, promised);
}

#define SIGNORINI_INSTANTIATE(D)                                                                                    \
  template MeshHierarchy<D> hierarchy_of(Mesh<D>, int, const Scene&, int, Warnings*, std::size_t, PromisedMemory*); \
  template MeshHierarchy<D> build_hierarchy(const Scene&, int, Warnings*, const Progress&, std::size_t,             \
                                            PromisedMemory*);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
