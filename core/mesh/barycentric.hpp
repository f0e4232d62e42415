#pragma once
#include <array>
#include <unordered_map>

#include "core/mesh/vertex_ids.hpp"

namespace signorini {

/// Vertices of a mesh that came of bisection in barycentric coordinates of the simplices of the coarsest one: exact.
template <int K>
class Barycentric {
 public:
  using Coordinates = std::array<double, K + 1>;

  explicit Barycentric(const VertexIds& ids) : ids_(ids) {}

  /// @param simplex its number
  /// @param corners its vertices, on the coarsest mesh
  /// @param id of a vertex in it
  Coordinates of(Index simplex, const std::array<Index, K + 1>& corners, VertexId id) {
    for (int i = 0; i <= K; ++i)
      if (corners[i] == id) {
        Coordinates out{};
        out[i] = 1;
        return out;
      }
    const Key key{simplex, id};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    const auto [a, b] = ids_.parents(id);
    const Coordinates from = of(simplex, corners, a), to = of(simplex, corners, b);
    Coordinates out;
    for (int i = 0; i <= K; ++i) out[i] = 0.5 * from[i] + 0.5 * to[i];
    known_.emplace(key, out);
    return out;
  }

 private:
  struct Key {
    Index simplex;
    VertexId id;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const noexcept {
      return (static_cast<std::size_t>(key.id) * 0x9e3779b97f4a7c15u ^ static_cast<std::size_t>(key.simplex)) *
             0xff51afd7ed558ccdu;
    }
  };
  const VertexIds& ids_;
  std::unordered_map<Key, Coordinates, Hash> known_;
};

}  // namespace signorini
