#pragma once
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// A balanced tree of points, or of boxes around them, to find those near something.
template <int D>
class PointTree {
 public:
  /// An axis-parallel one.
  struct Box {
    Point<D> low, high;
  };

  /// Refers to `points`; holds those whose numbers are given. O(n log n).
  PointTree(std::span<const Point<D>> points, std::vector<Index> numbers) : PointTree(points, {}, std::move(numbers)) {}

  /// Holds boxes.
  /// @param half per point half the widths of the box whose middle it is; empty: all are zero. Referred to as well
  PointTree(std::span<const Point<D>> points, std::span<const Point<D>> half, std::vector<Index> numbers)
      : points_(points), half_(half), numbers_(std::move(numbers)) {
    if (!numbers_.empty()) build(0, numbers_.size());
  }

  /// Calls visit(number) for every point of every leaf all of whose boxes up to the root pass `may_hold(box)`.
  template <class MayHold, class Visit>
  void search(const MayHold& may_hold, const Visit& visit) const {
    if (!nodes_.empty()) search(0, may_hold, visit, [](Index, Index) { return false; });
  }

  /// The same for the nearest to x: of two boxes the nearer one comes first, so that what is found there rules out most
  /// of the others.
  template <class MayHold, class Visit>
  void search_nearest(const Point<D>& x, const MayHold& may_hold, const Visit& visit) const {
    if (nodes_.empty()) return;
    search(0, may_hold, visit, [&](Index left, Index right) { return far(right, x) < far(left, x); });
  }

  /// Squared distance of a box.
  static double squared_distance(const Box& box, const Point<D>& x) {
    double sum = 0;
    for (int k = 0; k < D; ++k) {
      const double off = std::max({box.low[k] - x[k], x[k] - box.high[k], 0.0});
      sum += off * off;
    }
    return sum;
  }

 private:
  static constexpr std::size_t leaf = 8;
  struct Node {
    Box box;
    std::size_t first, last;
    Index right;  ///< the left child follows its parent; -1 for leaves
  };

  Box box_of(std::size_t first, std::size_t last) const {
    Box box{points_[numbers_[first]], points_[numbers_[first]]};
    for (std::size_t i = first; i < last; ++i)
      for (int k = 0; k < D; ++k) {
        const double middle = points_[numbers_[i]][k], half = half_.empty() ? 0 : half_[numbers_[i]][k];
        box.low[k] = std::min(box.low[k], middle - half);
        box.high[k] = std::max(box.high[k], middle + half);
      }
    return box;
  }

  Index build(std::size_t first, std::size_t last) {
    const auto here = static_cast<Index>(nodes_.size());
    nodes_.push_back({box_of(first, last), first, last, -1});
    if (last - first <= leaf) return here;
    const Box box = nodes_[here].box;
    int widest = 0;
    for (int k = 1; k < D; ++k)
      if (box.high[k] - box.low[k] > box.high[widest] - box.low[widest]) widest = k;
    const std::size_t middle = first + (last - first) / 2;
    const auto begin = numbers_.begin();
    std::nth_element(begin + first, begin + middle, begin + last,
                     [&](Index a, Index b) { return points_[a][widest] < points_[b][widest]; });
    build(first, middle);
    const Index right = build(middle, last);
    nodes_[here].right = right;
    return here;
  }

  double far(Index n, const Point<D>& x) const { return squared_distance(nodes_[n].box, x); }

  /// @param right_first right_first(left, right): which of two children comes first
  template <class MayHold, class Visit, class RightFirst>
  void search(Index n, const MayHold& may_hold, const Visit& visit, const RightFirst& right_first) const {
    const Node& node = nodes_[n];
    if (!may_hold(node.box)) return;
    if (node.right < 0) {
      for (std::size_t i = node.first; i < node.last; ++i) visit(numbers_[i]);
      return;
    }
    Index first = n + 1, second = node.right;
    if (right_first(first, second)) std::swap(first, second);
    search(first, may_hold, visit, right_first);
    search(second, may_hold, visit, right_first);
  }

  std::span<const Point<D>> points_, half_;
  std::vector<Index> numbers_;
  std::vector<Node> nodes_;
};

}  // namespace signorini
