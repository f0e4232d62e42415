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
  for (const auto [a, b] : refinement.parents) out.push_back(a == b ? coarse[a] : midpoint(coarse[a], coarse[b]));
  return out;
}

VertexId VertexIds::midpoint(VertexId a, VertexId b) {
  const Edge ends{std::min(a, b), std::max(a, b)};
  const auto [found, is_new] = midpoint_.try_emplace(ends, coarsest_ + std::ssize(ends_));
  if (is_new) ends_.push_back(ends);
  return found->second;
}

VertexId VertexIds::known_midpoint(VertexId a, VertexId b) const {
  const auto found = midpoint_.find({std::min(a, b), std::max(a, b)});
  return found == midpoint_.end() ? -1 : found->second;
}

}  // namespace signorini
