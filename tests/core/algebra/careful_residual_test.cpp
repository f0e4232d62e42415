#include "core/algebra/careful_residual.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace signorini::test {
namespace {

// A beam that is bent so little that the terms of its rows cancel to the last digit and beyond.
TEST(CarefulResidual, KnowsForcesFarBelowTheRoundingOfTheirTerms) {
  constexpr Index n = 50;
  BlockMatrix<1> A;
  for (Index i = 0; i < n; ++i) {
    A.column.push_back(i);
    A.value.push_back(6);
    for (const Index away : {-2, -1, 1, 2})
      if (i + away >= 0 && i + away < n) {
        A.column.push_back(i + away);
        A.value.push_back(std::abs(away) == 1 ? -4 : 1);
      }
    A.row.push_back(static_cast<Offset>(A.column.size()));
  }
  std::vector<double> x(n), b(n, 1e-20), r(n);
  for (Index i = 0; i < n; ++i) x[i] = 0.1 + std::ldexp(i % 3, -56);
  careful_residual(A, x.data(), b.data(), 0, n, r.data());
  for (Index i = 2; i < n - 2; ++i) {
    // Differences of neighbours are exact.
    const double second[] = {(x[i - 2] - x[i - 1]) - (x[i - 1] - x[i]), (x[i - 1] - x[i]) - (x[i] - x[i + 1]),
                             (x[i] - x[i + 1]) - (x[i + 1] - x[i + 2])};
    const double expected = 1e-20 - (second[0] - 2 * second[1] + second[2]);
    EXPECT_NEAR(r[i], expected, 1e-31) << i;  // two doubles have 106 bits
  }
}

}  // namespace
}  // namespace signorini::test
