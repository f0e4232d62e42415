#include "core/mesh/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace signorini {
namespace {

double factorial(int n) { return std::tgamma(n + 1); }

// Mean of the barycentric monomial over a simplex: K! a! b! ... / (K + a + b + ...)!
template <int K>
void expect_exact(std::span<const QuadraturePoint<K>> rule, int degree) {
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b)
      for (int c = 0; a + b + c <= degree && (K > 1 || c == 0); ++c) {
        double sum = 0;
        for (const auto& [x, weight] : rule) {
          EXPECT_GT(weight, 0);
          sum += weight * std::pow(x[0], a) * std::pow(x[1], b) * (K > 1 ? std::pow(x[K > 1 ? 2 : 0], c) : 1);
        }
        const double exact = factorial(K) * factorial(a) * factorial(b) * factorial(c) / factorial(K + a + b + c);
        EXPECT_NEAR(sum, exact, 1e-14) << a << b << c;
      }
}

TEST(Quadrature, IsExactForItsDegree) {
  expect_exact<1>(quadrature2<1>(), 2);
  expect_exact<2>(quadrature2<2>(), 2);
  expect_exact<3>(quadrature2<3>(), 2);
  expect_exact<1>(quadrature5<1>(), 5);
  expect_exact<2>(quadrature5<2>(), 5);
  expect_exact<3>(quadrature5<3>(), 5);
}

}  // namespace
}  // namespace signorini
