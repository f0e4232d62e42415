#pragma once
#include <span>
#include <utility>
#include <vector>

#include "core/mortar/creases.hpp"

namespace signorini::mortar {

/// Which of some faces of a side hang together by edges (D = 2: by nodes). Keeps its memory.
template <int D>
class Sheets {
 public:
  /// A face among those given, and which of its corners is not on the edge in question.
  struct Seat {
    Index face;
    int opposite;
  };

  /// @param creases along which they do not hang together; null: they do along all edges
  void find(const Side<D>& side, std::span<const Index> faces, const Creases<D>* creases = nullptr);

  Index count() const { return count_; }
  /// The same for faces of one sheet: the place of one of them.
  Index of(Index face) const { return root_[face]; }
  /// Two faces with an edge in common.
  const std::vector<std::pair<Seat, Seat>>& neighbours() const { return neighbours_; }

 private:
  using Edge = std::array<Index, D - 1>;

  std::vector<std::pair<Edge, Seat>> edges_;
  std::vector<std::pair<Seat, Seat>> neighbours_;
  std::vector<Index> root_;
  Index count_ = 0;
};

}  // namespace signorini::mortar
