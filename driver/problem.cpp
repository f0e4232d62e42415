#include "driver/problem.hpp"

namespace signorini {

template <int D>
MeshHierarchy<D> build_hierarchy(const Scene& scene, int block, std::vector<std::string>* warnings,
                                 const Progress& progress, std::size_t body, PromisedMemory* promised) {
  Mesh<D> coarsest = coarsest_mesh<D>(scene, body, block, warnings, progress);
  progress.stop_if_interrupted();
  check_memory(hierarchy_size(coarsest, scene.refine.uniform), block,
               promised ? scene.bodies[body].source.table + ", " + scene.refine.source.of("uniform")
                        : scene.refine.source.of("uniform"),
               promised);
  return hierarchy(std::move(coarsest), scene.refine.uniform);
}

template MeshHierarchy<2> build_hierarchy(const Scene&, int, std::vector<std::string>*, const Progress&, std::size_t,
                                          PromisedMemory*);
template MeshHierarchy<3> build_hierarchy(const Scene&, int, std::vector<std::string>*, const Progress&, std::size_t,
                                          PromisedMemory*);

}  // namespace signorini
