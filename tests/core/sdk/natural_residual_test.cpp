// The natural residual of obstacles with bounds, against the formula x -> P(x + D^-1 r) - x written out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/obstacles.hpp"

namespace signorini::test {
namespace {

/// Scalar vectors of which those in `constrained` have the bounds 0 <= x <= 1.
struct Vectors {
  std::vector<double> x, inverse;
  std::vector<Index> constrained;
  std::vector<double> lower = std::vector<double>(constrained.size(), 0), upper = std::vector<double>(lower.size(), 1);

  LevelView<1> view() {
    LevelView<1> out{};
    out.vectors = static_cast<Index>(x.size());
    out.inverse = inverse.data();
    out.x = x.data();
    out.constrained = constrained.data();
    out.slots = static_cast<Index>(constrained.size());
    out.lower = lower.data();
    out.upper = upper.data();
    return out;
  }
};

std::vector<Vectors> dense_and_sparse() {
  std::vector<Vectors> out;
  for (const std::vector<Index>& constrained : {std::vector<Index>{0, 1, 2, 3, 4, 5}, {1, 4}, {}})
    out.push_back({{0, 0.25, 1, 0.5, 0, 1}, {0.5, 0.5, 0.5, 0.25, 0.25, 0.25}, constrained});
  return out;
}

TEST(NaturalResidual, IsTheLargestStepOfProjectedJacobi) {
  const std::vector<double> r{-4, 1, 0.5, -8, 1, 2};
  for (Vectors& v : dense_and_sparse())
    for (Index first = 0; first < 6; ++first)
      for (Index last = first; last <= 6; ++last) {
        double expected = 0;
        for (Index p = first; p < last; ++p) {
          const bool bounded = std::ranges::find(v.constrained, p) != v.constrained.end();
          const double free = v.x[p] + v.inverse[p] * r[p];
          expected = std::max(expected, std::abs((bounded ? std::clamp(free, 0.0, 1.0) : free) - v.x[p]));
        }
        EXPECT_EQ(Box<1>().natural_residual(v.view(), first, last, r.data()), expected);
      }
}

TEST(NaturalResidual, KeepsNaNWhereverItIs) {
  for (Vectors& v : dense_and_sparse())
    for (std::size_t bad = 0; bad < 6; ++bad) {
      std::vector<double> r(6, 1);
      r[bad] = std::nan("");
      EXPECT_TRUE(std::isnan(Box<1>().natural_residual(v.view(), 0, 6, r.data()))) << bad;
    }
}

}  // namespace
}  // namespace signorini::test
