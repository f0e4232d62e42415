#pragma once
#include <array>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/fem/assembly/discretize.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/incompressible/pressure_space.hpp"
#include "core/fem/model/model.hpp"
#include "core/fem/pairs/paired_bodies.hpp"
#include "core/mesh/mesh.hpp"
#include "driver/levels/level_solution.hpp"

namespace signorini {

/// Of scalar bodies there is nothing to know.
struct NoPressure {};
template <int D, int B>
using PressureOf = std::conditional_t<D == B, PressureSpace<D>, NoPressure>;

/// A mesh of a hierarchy, and all that is kept for it from one solve to the next.
template <int D, int B>
struct MeshLevel {
  using Pairs = std::shared_ptr<const PairedBodies<B>>;

  /// The problem after its solve: all but its matrix, which is among the products where the mesh is a coarse one.
  struct Kept {
    Model<B> model;
    Discretization<B> discretization;
  };

  /// Keeps references.
  /// @param made_by the refinement of the next coarser mesh; null: this is the coarsest one
  MeshLevel(const Mesh<D>& of, const Refinement* made_by, Nodes<D> numbered)
      : mesh(&of), refinement(made_by), nodes(std::move(numbered)) {}

  const Mesh<D>* mesh;
  const Refinement* refinement;
  Nodes<D> nodes;
  Pairs all_pairs, pairs;  ///< that may touch each other; those whose unknowns are jumps
  std::array<std::shared_ptr<const Jumps<B>>, 2> connected;  ///< interpolation from the coarser mesh is between these
  std::optional<Kept> kept;
  bool changed = false;                            ///< the matrix is another one than in the last solve
  LevelSolution<B> before, now;                    ///< of the last step that was accepted, and of the last solve
  std::optional<PressureOf<D, B>> pressure_space;  ///< of the last solve; none: no pressure has unknowns of its own
  std::vector<double> force;                       ///< at the nodes, B for each, beside the model's loads; empty: none
};

}  // namespace signorini
