#include "core/mesh/vertex_ids.hpp"

#include <algorithm>
#include <numeric>

namespace signorini {

std::vector<VertexId> VertexIds::coarsest() const {
  std::vector<VertexId> out(static_cast<std::size_t>(coarsest_));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

std::vector<VertexId> VertexIds::refined(std::span<const VertexId> coarse, const Refinement& refinement) {
  std::vector<VertexId> out;
  out.reserve(refinement.parents.size());
  for (const auto [a, b] : refinement.parents) {
    if (a == b) {
      out.push_back(coarse[a]);
      continue;
    }
    const std::array ends{std::min(coarse[a], coarse[b]), std::max(coarse[a], coarse[b])};
    const auto [found, is_new] = midpoint_.try_emplace(ends, coarsest_ + std::ssize(ends_));
    if (is_new) ends_.push_back(ends);
    out.push_back(found->second);
  }
  return out;
}

}  // namespace signorini
