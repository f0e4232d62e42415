#pragma once
#include <vector>

#include "core/base/types.hpp"
#include "core/io/msh_input.hpp"

namespace signorini {

/// Positions of nodes by their tag in the file, which may have gaps.
class MshNodes {
 public:
  bool empty() const { return tags_.empty(); }
  void add(Offset tag) { tags_.push_back(tag); }
  /// To be called after the last node; a tag that occurs twice is an error.
  void close(const MshInput& input);
  /// The position of a node; an unknown tag is an error.
  Index find(Offset tag, const MshInput& input) const;

 private:
  std::vector<Offset> tags_;
  Offset first_ = 0;
  std::vector<Index> direct_;  ///< by tag - first_, where tags are dense
  std::vector<Index> sorted_;  ///< positions by ascending tag, where they are not
};

}  // namespace signorini
