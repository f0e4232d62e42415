#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/mesh/forest.hpp"

namespace signorini {

/// What is solved on a mesh: itself, and where elements are quadratic its uniform refinement; with the nodes.
template <int D>
struct SolvedOn {
  const MeshHierarchy<D>& meshes;
  const Nodes<D>& nodes;
};

/// The meshes of a run that refines where its error is, one after the other.
///
///     Adaptation<D> adaptation(coarsest, 1);
///     ... solve on adaptation.mesh(), estimate ...
///     adaptation.refine(solved_on, share_of_elements, 2);
///     start = adaptation.carried_over(solved_on, u, next, B);  // where the next solve starts
template <int D>
class Adaptation {
 public:
  /// @param uniform how often all edges of the coarsest mesh are halved first
  /// @param order of the elements
  Adaptation(Mesh<D> coarsest, int uniform, int order = 1);

  const Mesh<D>& mesh() const { return made_.mesh; }
  /// Goes on to a finer mesh. Elements are cut until all are expected to have about the same share of the error: each
  /// cut takes that of an element down by the rate of its order, h^(2 order) for the energy, and halves it.
  /// @param share of the error, per element of the nodes, not negative
  /// @param growth of the number of elements, but for what conformity adds
  void refine(const SolvedOn<D>& solved, std::span<const double> share, double growth);
  /// A finite element function on the mesh before: its values at the vertices of the finest mesh that is solved on now.
  /// @param u coefficients of the nodes then, `block` each
  std::vector<double> carried_over(const SolvedOn<D>& before, const std::vector<double>& u, const SolvedOn<D>& now,
                                   int block) const;

 private:
  /// Of an element of the mesh.
  struct Leaf {
    Index element;                    // of the nodes, which number them anew
    std::array<Index, D + 1> corner;  // ids, in the order of that one
    int generation;
  };
  std::vector<Leaf> leaves(const SolvedOn<D>& solved) const;

  Forest<D> forest_;
  MadeMesh<D> made_;
  std::vector<Leaf> before_;  // of the mesh before
  double left_to_half_;       // of an element's share of the error
};

}  // namespace signorini
