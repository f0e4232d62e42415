#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/forest.hpp"

namespace signorini {

/// The meshes of a run that refines where its error is, one after the other.
///
///     Adaptation<D> adaptation(coarsest, 1);
///     ... solve on adaptation.mesh(), estimate ...
///     adaptation.refine(share_of_elements, 2);
///     u = adaptation.carried_over(u, B);  // where the next solve starts
template <int D>
class Adaptation {
 public:
  /// @param uniform how often all edges of the coarsest mesh are halved first
  Adaptation(Mesh<D> coarsest, int uniform);

  const Mesh<D>& mesh() const { return made_.mesh; }
  /// Goes on to a finer mesh. Elements are cut until all are expected to have about the same share of the error: each
  /// cut takes that of an element down by the rate of linear elements, h^2 for the energy, and halves it.
  /// @param share of the error, per element, not negative
  /// @param growth of the number of elements, but for what conformity adds
  void refine(std::span<const double> share, double growth);
  /// Numbers per vertex of the mesh before, linear in its elements.
  std::vector<double> carried_over(const std::vector<double>& u, int block) const;

 private:
  Forest<D> forest_;
  MadeMesh<D> made_;
  std::vector<VertexId> before_;  // of the mesh before
};

}  // namespace signorini
