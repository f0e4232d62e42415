#include "apps/signorini/problem.hpp"

#include "apps/signorini/interrupt.hpp"
#include "apps/signorini/memory.hpp"

namespace signorini {

template <int D>
MeshHierarchy<D> build_hierarchy(const Scene& scene, int block, std::vector<std::string>* warnings) {
  Mesh<D> coarsest = coarsest_mesh<D>(scene, block, warnings);
  stop_if_interrupted();
  check_memory(hierarchy_size(coarsest, scene.refine.uniform), block, scene.refine.source.of("uniform"));
  return hierarchy(std::move(coarsest), scene.refine.uniform);
}

template MeshHierarchy<2> build_hierarchy(const Scene&, int, std::vector<std::string>*);
template MeshHierarchy<3> build_hierarchy(const Scene&, int, std::vector<std::string>*);

}  // namespace signorini
