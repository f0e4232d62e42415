#include "driver/problem.hpp"

#include "driver/memory.hpp"

namespace signorini {

template <int D>
MeshHierarchy<D> build_hierarchy(const Scene& scene, int block, std::vector<std::string>* warnings,
                                 const Progress& progress, std::size_t body) {
  Mesh<D> coarsest = coarsest_mesh<D>(scene, body, block, warnings, progress);
  progress.stop_if_interrupted();
  check_memory(hierarchy_size(coarsest, scene.refine.uniform), block, scene.refine.source.of("uniform"));
  return hierarchy(std::move(coarsest), scene.refine.uniform);
}

template MeshHierarchy<2> build_hierarchy(const Scene&, int, std::vector<std::string>*, const Progress&, std::size_t);
template MeshHierarchy<3> build_hierarchy(const Scene&, int, std::vector<std::string>*, const Progress&, std::size_t);

}  // namespace signorini
