#include "core/mesh/vertex_ids.hpp"

#include <gtest/gtest.h>

#include <set>

namespace signorini::test {
namespace {

Refinement made_of(std::vector<std::array<Index, 2>> parents) {
  Refinement out;
  out.parents = std::move(parents);
  return out;
}

TEST(VertexIds, StayTheSameWhateverElseIsCut) {
  VertexIds ids(3);
  const auto one = ids.refined(ids.coarsest(), made_of({{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}}));
  const auto other = ids.refined(ids.coarsest(), made_of({{2, 1}, {2, 2}, {0, 2}, {0, 0}, {1, 1}}));
  EXPECT_EQ(one[4], other[0]);
  EXPECT_EQ((std::vector{one[0], one[1], one[2]}), ids.coarsest());
  EXPECT_EQ(std::set<VertexId>(one.begin(), one.end()).size(), one.size());
  EXPECT_EQ(std::ranges::find(one, other[2]), one.end());
}

TEST(VertexIds, KnowTheirParentsOnAllMeshes) {
  VertexIds ids(2);
  const auto once = ids.refined(ids.coarsest(), made_of({{0, 0}, {1, 0}, {1, 1}}));
  const auto twice = ids.refined(once, made_of({{0, 0}, {0, 1}, {1, 1}, {1, 2}, {2, 2}}));
  EXPECT_EQ(ids.parents(twice[0]), (std::array<VertexId, 2>{0, 0}));
  EXPECT_EQ(ids.parents(twice[2]), (std::array<VertexId, 2>{0, 1}));
  EXPECT_EQ(ids.parents(twice[1]), (std::array{twice[0], twice[2]}));
  EXPECT_EQ(ids.parents(twice[3]), (std::array{twice[4], twice[2]}));
}

}  // namespace
}  // namespace signorini::test
