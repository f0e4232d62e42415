#pragma once
#include <cstddef>
#include <deque>
#include <vector>

#include "driver/levels/mesh_level.hpp"

namespace signorini {

/// The meshes of a hierarchy, coarsest first. References to a level stay good until it is dropped.
template <int D, int B>
class MeshLevels {
 public:
  /// Keeps references to the meshes.
  /// @param nodes of each mesh
  MeshLevels(const MeshHierarchy<D>& hierarchy, std::vector<Nodes<D>> nodes);

  std::size_t size() const { return levels_.size(); }
  MeshLevel<D, B>& operator[](std::size_t level) { return levels_[level]; }
  const MeshLevel<D, B>& operator[](std::size_t level) const { return levels_[level]; }
  MeshLevel<D, B>& finest() { return levels_.back(); }
  const MeshLevel<D, B>& finest() const { return levels_.back(); }
  std::vector<const Mesh<D>*> meshes() const;

  auto begin() { return levels_.begin(); }
  auto end() { return levels_.end(); }
  auto begin() const { return levels_.begin(); }
  auto end() const { return levels_.end(); }

  /// A mesh that has come out of the finest one is the finest one now. It knows no last step.
  void append(const Mesh<D>& mesh, const Refinement& refinement, Nodes<D> nodes);
  /// The next coarser one is the finest one again.
  void drop_finest();
  /// The next coarser mesh has been refined in another way. What is known of the last step goes over: displacements by
  /// VertexId, linear between, and obstacles' own numbers from the vertex itself, or else from an end of the edge whose
  /// midpoint it is; a start for pressures does not.
  void replace_finest(const Mesh<D>& mesh, const Refinement& refinement, Nodes<D> nodes);

 private:
  std::deque<MeshLevel<D, B>> levels_;
};

}  // namespace signorini
