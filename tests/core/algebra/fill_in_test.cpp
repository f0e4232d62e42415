#include "core/algebra/fill_in.hpp"

#include <gtest/gtest.h>

namespace signorini::test {
namespace {

BlockMatrix<1> matrix(std::vector<Offset> row, std::vector<Index> column, std::vector<double> value) {
  BlockMatrix<1> A;
  A.row = std::move(row);
  A.column = std::move(column);
  A.value.assign(value.begin(), value.end());
  return A;
}

TEST(FillIn, PutsBlocksAtTheirPlacesInAnyOrder) {
  const BlockMatrix<1> A = matrix({0, 2, 3, 5}, {0, 2, 1, 2, 0}, {1, 2, 3, 4, 5});
  BlockMatrix<1> wider = matrix({0, 3, 5, 8}, {0, 1, 2, 1, 0, 2, 0, 1}, std::vector<double>(8, 0));
  std::vector<Offset> position(3, -1);
  int missing = 0;
  fill_in(A, wider, position, [&](Index, Index) { ++missing; });
  EXPECT_EQ(missing, 0);
  const std::vector<double> expected = {1, 0, 2, 3, 0, 4, 5, 0};
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), wider.value.begin(), wider.value.end()));
}

TEST(FillIn, SaysWhatHasNoPlace) {
  const BlockMatrix<1> A = matrix({0, 2, 4}, {0, 1, 1, 0}, {1, 2, 3, 2});
  BlockMatrix<1> narrower = matrix({0, 2, 3}, {0, 1, 1}, {0, 0, 0});
  std::vector<Offset> position(2, -1);
  std::vector<std::pair<Index, Index>> missing;
  fill_in(A, narrower, position, [&](Index q, Index r) { missing.emplace_back(q, r); });
  EXPECT_EQ(missing, (std::vector<std::pair<Index, Index>>{{1, 0}}));
}

}  // namespace
}  // namespace signorini::test
