#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
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

  /// That of an edge; new where no mesh has had it.
  VertexId midpoint(VertexId a, VertexId b);
  /// The same where it is known, else -1.
  VertexId known_midpoint(VertexId a, VertexId b) const;

  /// The ends of the edge that the vertex is the midpoint of; on the coarsest mesh itself twice.
  std::array<VertexId, 2> parents(VertexId id) const {
    return id < coarsest_ ? std::array{id, id} : ends_[static_cast<std::size_t>(id - coarsest_)];
  }

 private:
  VertexId coarsest_;
  std::vector<std::array<VertexId, 2>> ends_;  // of the midpoints
  using Edge = std::array<VertexId, 2>;        // ascending
  struct Hash {
    std::size_t operator()(const Edge& edge) const noexcept {
      return (static_cast<std::size_t>(edge[0]) * 0x9e3779b97f4a7c15u ^ static_cast<std::size_t>(edge[1])) *
             0xff51afd7ed558ccdu;
    }
  };
  std::unordered_map<Edge, VertexId, Hash> midpoint_;
};

}  // namespace signorini
