#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/fem/elements/local_stiffness.hpp"

namespace signorini {

/// Assembles a symmetric matrix row after row, each as soon as the last patch (an element, or several together) around
/// its vertex has been added. Until then the row waits in a ring buffer, which holds no more than the bandwidth of the
/// matrix asks for and stays in a cache.
///
/// For all patches announce() their vertices, then add() them in the same order.
class SymmetricRows {
 public:
  /// @param entries of the whole matrix, about: for these memory is reserved
  SymmetricRows(Index size, std::size_t entries) : last_(size, -1), ring_(64) {
    A_.row.reserve(static_cast<std::size_t>(size) + 1);
    A_.column.reserve(entries);
    A_.value.reserve(entries);
  }

  void announce(Index patch, Index p) { last_[p] = patch; }

  /// Adds the stiffness of a patch with the given vertices, and `ends` of the edges among them.
  template <std::size_t N, std::size_t E>
  void add(Index patch, const std::array<Index, N>& vertex, const std::array<std::array<int, 2>, E>& ends,
           const LocalStiffness<N, E>& local) {
    make_room(*std::max_element(vertex.begin(), vertex.end()));
    for (std::size_t a = 0; a < N; ++a) row(vertex[a]).diagonal += local.diagonal[a];
    for (std::size_t k = 0; k < E; ++k)
      if (local.edge[k] != 0) {
        const auto [low, high] = std::minmax(vertex[ends[k][0]], vertex[ends[k][1]]);
        add_to(row(low), high, local.edge[k]);
      }
    while (next_ < static_cast<Index>(last_.size()) && last_[next_] <= patch) append(next_++);
  }

  /// The matrix, after the last patch.
  BlockMatrix<1> take() { return std::move(A_); }

 private:
  struct Entry {
    Index column;
    double value;
  };

  /// Entries of a row beside the diagonal, as many as fit into two cache lines.
  struct alignas(128) Entries {
    static constexpr Index most = 9;
    double value[most];
    double diagonal = 0;
    Index column[most];
    Index used = 0;
    Index more = -1;  // in pool_
  };

  Entries& row(Index p) { return ring_[p & (static_cast<Index>(ring_.size()) - 1)]; }

  void make_room(Index p) {
    const auto size = static_cast<Index>(ring_.size());
    if (p - next_ < size) return;
    std::vector<Entries> larger(std::bit_ceil(static_cast<std::size_t>(p - next_) + 1));
    std::swap(ring_, larger);
    for (Index k = next_; k < next_ + size; ++k) row(k) = larger[k & (size - 1)];
  }

  void add_to(Entries& entries, Index column, double value) {
    Index k = 0;
    while (k < entries.used && entries.column[k] != column) ++k;
    if (k < entries.used)
      entries.value[k] += value;
    else if (k < Entries::most)
      push(entries, column, value);
    else
      add_to(more(entries), column, value);
  }

  static void push(Entries& entries, Index column, double value) {
    entries.column[entries.used] = column;
    entries.value[entries.used++] = value;
  }

  Entries& more(Entries& entries) {
    if (entries.more < 0 && free_.empty()) {
      entries.more = static_cast<Index>(pool_.size());
      pool_.emplace_back();
    } else if (entries.more < 0) {
      entries.more = free_.back();
      free_.pop_back();
    }
    return pool_[entries.more];
  }

  // The row of the matrix, and its entries in the rows below.
  void append(Index p) {
    make_room(p);
    A_.column.push_back(p);
    A_.value.push_back(row(p).diagonal);
    collect(p);
    for (const auto [q, value] : row_) {
      A_.column.push_back(q);
      A_.value.push_back(value);
      if (q < p) continue;
      Entries* below = &row(q);
      while (below->used == Entries::most) below = &more(*below);
      push(*below, p, value);
    }
    A_.row.push_back(static_cast<Offset>(A_.column.size()));
  }

  // Takes the entries of row p out of the ring, without those that vanish but for rounding. All patches that contribute
  // to an entry have been added to both diagonal entries.
  void collect(Index p) {
    const double scale = std::sqrt(row(p).diagonal) * vanishing;
    row_.clear();
    for (Entries* entries = &row(p); entries;) {
      for (Index k = 0; k < entries->used; ++k) {
        const auto [q, value] = Entry{entries->column[k], entries->value[k]};
        if (q < p || std::abs(value) > scale * std::sqrt(row(q).diagonal)) row_.push_back({q, value});
      }
      entries->diagonal = 0;
      entries->used = 0;
      const Index more = std::exchange(entries->more, -1);
      if (more >= 0) free_.push_back(more);
      entries = more >= 0 ? &pool_[more] : nullptr;
    }
    std::sort(row_.begin(), row_.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
  }

  std::vector<Index> last_;    // per row: patch
  std::vector<Entries> ring_;  // row p at p modulo the size, a power of two
  std::deque<Entries> pool_;   // for what does not fit there
  std::vector<Index> free_;    // in pool_
  Index next_ = 0;             // row to be appended
  std::vector<Entry> row_;     // its entries
  BlockMatrix<1> A_;
};

}  // namespace signorini
