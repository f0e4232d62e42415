#pragma once
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "core/solver/jumps.hpp"

namespace signorini {

/// Blocks by vector.
template <int B>
using BlockRow = std::map<Index, std::array<double, B * B>>;

/// Makes Jumps of what is known of them in terms of displacements.
template <int B>
class JumpBuilder {
 public:
  /// u_p = x_p + sum_q W_pq u_q. The q may be such p themselves, on circles(), too, but for those that this finds.
  /// Nothing is known of p before.
  void add(Index p, BlockRow<B> W);
  /// Whether u_p depends on such a p by this row.
  bool leads_to(const BlockRow<B>& W, Index p) const;
  /// Of rows that are to be added, none of which is there yet, those on circles that leave no unknowns, or nearly so:
  /// by these and by what is there u_p would depend on itself, and by so much that displacements are large for small x.
  /// They must not be added. Ascending.
  std::vector<Index> circles(const std::map<Index, BlockRow<B>>& rows) const;
  /// Both rows, which are the inverse of each other within the vectors that are added by this.
  void add(Index p, BlockRow<B> by_unknowns, BlockRow<B> by_displacements);
  bool has(Index p) const { return rows_.contains(p); }
  /// Says of an added p that rows of others have its unknown, see Jumps::common.
  void share(Index p) { common_.push_back(p); }

  Jumps<B> take();

 private:
  struct Rows {
    BlockRow<B> basis;    // by unknowns; empty: not known yet
    BlockRow<B> weights;  // see add(); of both rows the inverse
    bool resolved = false;
  };
  /// What u_p depends on; null: on x_p alone, or on what is known.
  const BlockRow<B>* weights(Index p) const;
  void resolve(const std::vector<Index>& circle);

  std::map<Index, Rows> rows_;
  std::vector<Index> common_;
};

/// Those of all that are chosen. What is not, is a displacement.
/// @param keep per vector of `all`; of those that are given, or have a common unknown, all or none
template <int B>
Jumps<B> chosen_jumps(const Jumps<B>& all, const std::vector<char>& keep);

}  // namespace signorini
