#pragma once
#include <numeric>
#include <vector>

#include "core/base/types.hpp"

namespace signorini::geometry {

/// Numbers that have been found to be one.
class Groups {
 public:
  explicit Groups(std::size_t n) : root_(n) { std::iota(root_.begin(), root_.end(), Index{0}); }
  Index find(Index i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(Index i, Index j) { root_[find(i)] = find(j); }
  /// Per number that of its group, from 0 in the order of the first ones.
  std::vector<Index> numbered(Index& count) {
    std::vector<Index> number(root_.size(), -1), out(root_.size());
    count = 0;
    for (std::size_t i = 0; i < root_.size(); ++i) {
      Index& n = number[find(static_cast<Index>(i))];
      if (n < 0) n = count++;
      out[i] = n;
    }
    return out;
  }

 private:
  std::vector<Index> root_;
};

}  // namespace signorini::geometry
