#include "core/fem/polynomial_fit.hpp"

#include <gtest/gtest.h>

#include "tests/support/random.hpp"

namespace signorini {
namespace {

TEST(PolynomialFit, FindsWhatSamplesAreTakenFrom) {
  test::Random random(3);
  for (const std::size_t count : {4u, 7u, 8u, 20u}) {
    std::vector<Sample<2>> samples;
    for (std::size_t k = 0; k < count; ++k) {
      const double x = random.between(-1e-3, 3e-3), y = random.between(1e-3, 2e-3);
      const double squares = count < 8 ? 0 : 1e6 * (x * x - 3 * x * y + 2 * y * y);
      samples.push_back({{x, y}, 7 + 1e3 * (2 * x - y) + squares});
    }
    const auto value = fitted_value(samples);
    ASSERT_TRUE(value);
    EXPECT_NEAR(*value, 7, 1e-8) << count;
  }
}

TEST(PolynomialFit, SaysNothingWhereSamplesDecideNothing) {
  EXPECT_FALSE(fitted_value(std::vector<Sample<1>>{}));
  EXPECT_FALSE(fitted_value(std::vector<Sample<1>>{{{0}, 1}, {{1}, 2}}));
  EXPECT_FALSE(fitted_value(std::vector<Sample<1>>{{{0}, 1}, {{0}, 2}, {{0}, 3}}));
  std::vector<Sample<2>> in_a_row;
  in_a_row.reserve(9);
  for (int k = 0; k < 9; ++k) in_a_row.push_back({{1.0 * k, 0}, 1.0 * k});
  EXPECT_FALSE(fitted_value(in_a_row));
}

}  // namespace
}  // namespace signorini
