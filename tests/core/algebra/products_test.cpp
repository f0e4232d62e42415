// Products with block matrices against Eigen.
#include "core/algebra/products.hpp"

#include <gtest/gtest.h>

#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

template <int B>
void expect_products() {
  Random random(B);
  const auto A = random_matrix<B>(random, 50);
  std::vector<double> x(50 * B), b(50 * B), y(50 * B), r(50 * B);
  for (double& v : x) v = random.between(-1, 1);
  for (double& v : b) v = random.between(-1, 1);
  product<B>(A, x.data(), y.data());
  residual<B>(A, x.data(), b.data(), r.data());
  EXPECT_LE((vector(y) - dense(A) * vector(x)).norm(), 1e-13);
  EXPECT_LE((vector(r) - vector(b) + dense(A) * vector(x)).norm(), 1e-13);
}

TEST(Products, AgreeWithDenseOnes) {
  expect_products<1>();
  expect_products<2>();
  expect_products<3>();
}

}  // namespace
}  // namespace signorini::test
