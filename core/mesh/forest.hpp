#pragma once
#include <memory>
#include <span>

#include "core/mesh/barycentric.hpp"
#include "core/mesh/bisection.hpp"
#include "core/mesh/vertex_ids.hpp"

namespace signorini {

/// A mesh of a forest, and what its vertices are called in all of its meshes.
template <int D>
struct MadeMesh {
  Mesh<D> mesh;              ///< complete in itself: a coarsest mesh to whoever gets it
  std::vector<VertexId> id;  ///< per vertex
};

/// Bisection trees, one per element of a coarsest mesh, see bisection.hpp. Their leaves are the elements of a
/// conforming mesh, numbered depth first.
///
///     Forest<3> forest(std::make_shared<const Mesh<3>>(coarsest));
///     forest.bisect(leaves_with_large_errors);
///     MadeMesh<3> finer = forest.mesh();
///
/// A mesh is the same in whatever order its elements were marked, and once more the same after it was refined and
/// coarsened.
template <int D>
class Forest {
 public:
  explicit Forest(std::shared_ptr<const Mesh<D>> coarsest);
  Forest(const Forest&) = delete;
  Forest& operator=(const Forest&) = delete;

  Index leaves() const { return static_cast<Index>(leaf_.size()); }
  /// Cuts leaves once, and those around them as often as conformity asks for. New vertices of curved edges are placed
  /// as those of uniform refinement are.
  void bisect(std::span<const Index> leaves);
  /// The same for all leaves, as often as is said of each, its descendants counted in: none of them has fewer cuts.
  void refine(std::span<const int> cuts);
  /// Takes out the newest vertices of leaves, each where it is that of all leaves around it, and all of these may go.
  /// @param may_go per leaf
  /// @return how many vertices are gone; a refinement is undone by going on until none is
  Index coarsen(const std::vector<bool>& may_go);
  MadeMesh<D> mesh() const;
  /// The ends of the edge that a vertex is the midpoint of; on the coarsest mesh itself twice.
  std::array<VertexId, 2> parents(VertexId id) const { return ids_.parents(id); }
  const VertexIds& ids() const { return ids_; }
  /// How often a leaf's element of the coarsest mesh was cut to make it.
  int generation(Index leaf) const { return tree_[leaf_[leaf]].generation; }
  /// Vertices that are off the curve they belong to, or elements would be inverted.
  Index straightened() const { return straightened_; }

 private:
  struct Node {
    Bisected<D> simplex;
    Index root;              // element of the coarsest mesh
    Index first_child = -1;  // the second follows it
    Index newest = -1;       // vertex; roots have none
    std::int16_t generation = 0;
    std::int16_t wanted = 0;  // generation up to which refine() cuts
  };
  class Cutting;

  Index add_children(Index node, Index middle);
  void find_leaves();
  Point<D> place(Index a, Index b, Index root, std::span<const Index> faces);

  std::shared_ptr<const Mesh<D>> coarsest_;
  VertexIds ids_;
  std::vector<Point<D>> points_;  // by id
  std::vector<Index> uses_;       // by id: leaves that have the vertex
  std::vector<Node> tree_;        // the coarsest mesh's elements first
  std::vector<Index> free_;       // first ones of pairs of nodes that are gone
  std::vector<Index> leaf_;       // depth first
  Index straightened_ = 0;
  Barycentric<D - 1> on_faces_;
  Barycentric<D> in_elements_;
};

}  // namespace signorini
