#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// What stays the same of a vertex where meshes are numbered anew.
using VertexId = std::int64_t;

/// Vertices of the coarsest mesh by their numbers there, all others by the edge whose midpoint they are. They are never
/// renumbered: another mesh in which the same edge is cut has the same vertex.
///
///     VertexIds ids(coarse.vertices());
///     auto of_fine = ids.refined(ids.coarsest(), refinement);  // where u is kept
///     auto of_next = ids.refined(ids.coarsest(), another);     // and here is wanted
class VertexIds {
 public:
  explicit VertexIds(Index coarsest) : coarsest_(coarsest) {}

  /// Per vertex of the coarsest mesh.
  std::vector<VertexId> coarsest() const;
  /// Per vertex of a mesh that has come out of one with the ids `coarse`.
  std::vector<VertexId> refined(std::span<const VertexId> coarse, const Refinement& refinement);

  /// The ends of the edge that the vertex is the midpoint of; on the coarsest mesh itself twice.
  std::array<VertexId, 2> parents(VertexId id) const {
    return id < coarsest_ ? std::array{id, id} : ends_[static_cast<std::size_t>(id - coarsest_)];
  }

 private:
  VertexId coarsest_;
  std::vector<std::array<VertexId, 2>> ends_;  // of the midpoints
  std::map<std::array<VertexId, 2>, VertexId> midpoint_;
};

}  // namespace signorini
