#pragma once
#include <algorithm>
#include <functional>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/base/crew.hpp"
#include "core/sdk/level_view.hpp"

namespace signorini {

/// The vectors of a level in chunks of consecutive ones that fit into the cache, and how far the matrix couples them:
/// no vector of chunks <= c is coupled to one of chunks > highest[c], none of chunks >= c to one of chunks < lowest[c].
struct Chunks {
  Index vectors = 0, size = 1;
  std::vector<Index> highest, lowest;

  Index count() const { return static_cast<Index>(highest.size()); }
};

/// @param bytes of the matrix in one chunk: several chunks of several passes share the second level cache
template <int B>
Chunks divide(const BlockMatrix<B>& A, Offset bytes = 1 << 19);

/// Calls visit(from, to) with consecutive parts of first <= p < last: what one loop of a visit touches still is in the
/// first level cache in the next one.
template <int B, class Visit>
void in_pieces(Index first, Index last, const Visit& visit) {
  constexpr Index size = 512 / B;
  for (; first < last; first += size) visit(first, std::min(last, first + size));
}

/// Passes over the vectors of a level, one after the other, that read no further than the matrix couples. They follow
/// each other through memory: a pass enters a chunk as soon as the one before it has left all chunks coupled to that.
/// The result is bitwise that of whole passes, but the matrix is fetched from memory once for all of them, as far as
/// the numbering keeps neighbours together (Wellein et al., Efficient temporal blocking for stencil computations,
/// 2009).
class Passes {
 public:
  using Run = std::function<void(Index first, Index last)>;

  /// `run` treats the vectors first <= p < last; chunks come in the given order.
  void add(Order order, Run run) { passes_.push_back({order, true, std::move(run)}); }
  /// A pass of which any order of chunks is fine.
  void add(Run run) { passes_.push_back({Order::forward, false, std::move(run)}); }
  /// A pass over all vectors at once, which may reach further than the matrix couples: nothing overtakes it.
  void add_whole(std::function<void()> run) {
    passes_.push_back({Order::forward, false, [run = std::move(run)](Index, Index) { run(); }, true});
  }
  /// With a crew of several threads different passes go on at the same time, each where it would be without them: the
  /// result is bitwise the same. More threads than passes gain nothing; where the chunks are few, none is started.
  void run(const Chunks& chunks, Crew& crew) const;

 private:
  struct Pass {
    Order order;
    bool ordered;
    Run run;
    bool whole = false;
  };
  std::vector<Pass> passes_;
};

}  // namespace signorini
