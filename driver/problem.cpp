#include "driver/problem.hpp"

namespace signorini {

template <int D>
MeshHierarchy<D> build_hierarchy(const Scene& scene, int block, std::vector<std::string>* warnings,
                                 const Progress& progress, std::size_t body, PromisedMemory* promised) {
  Mesh<D> coarsest = coarsest_mesh<D>(scene, body, block, warnings, progress);
  progress.stop_if_interrupted();
  const int order = scene.bodies[body].order, refinements = scene.refine.uniform + order - 1;
  check_memory(hierarchy_size(coarsest, refinements), block,
               promised ? scene.bodies[body].source.table + ", " + scene.refine.source.of("uniform")
                        : scene.refine.source.of("uniform"),
               promised, order == 1 ? 0 : D);
  return hierarchy(std::move(coarsest), refinements);
}

template MeshHierarchy<2> build_hierarchy(const Scene&, int, std::vector<std::string>*, const Progress&, std::size_t,
                                          PromisedMemory*);
template MeshHierarchy<3> build_hierarchy(const Scene&, int, std::vector<std::string>*, const Progress&, std::size_t,
                                          PromisedMemory*);

}  // namespace signorini
