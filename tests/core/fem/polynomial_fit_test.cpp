#include "core/fem/elements/polynomial_fit.hpp"

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

TEST(PolynomialFit, IsTheSameSummedUpAndAtEveryPlace) {
  test::Random random(7);
  std::vector<Sample<3, 2>> samples(40);
  const auto exact = [](const std::array<double, 3>& x) {
    return std::array{1 + x[0] - 2 * x[1] * x[2], x[2] * x[2] - 3 * x[0] * x[1] + 0.5 * x[1]};
  };
  const auto anywhere = [&] { return std::array{random.between(4, 6), random.between(-1, 3), random.between(0, 0.1)}; };
  for (auto& sample : samples) {
    sample.x = anywhere();
    sample.value = exact(sample.x);
  }
  PolynomialFit<2, 3, 2> fit(samples), summed_up(samples);
  summed_up.sum_up();
  for (int k = 0; k < 5; ++k) {
    const auto x = anywhere();
    for (const auto& found : {fit.at(x), summed_up.at(x)}) {
      ASSERT_TRUE(found);
      for (int n = 0; n < 2; ++n) EXPECT_NEAR((*found)[n], exact(x)[n], 1e-11);
    }
  }
}

/// The square of the value's error, in the mean.
TEST(PolynomialFit, KnowsWhatErrorsOfSamplesDo) {
  test::Random random(11);
  constexpr int trials = 2000;
  for (const std::size_t count : {5u, 9u, 25u}) {
    double known = 0, found = 0;  // squares
    for (int trial = 0; trial < trials; ++trial) {
      std::vector<Sample<1>> samples;
      for (std::size_t k = 0; k < count; ++k) {
        const double x = random.between(-1, 2);
        samples.push_back({{x}, 3 - x + 2 * x * x + 0.1 * random.between(-1, 1)});
      }
      PolynomialFit<2, 1> fit(samples);
      fit.sum_up();
      known += fit.error({0})[0] * fit.error({0})[0];
      found += ((*fit.at({0}))[0] - 3) * ((*fit.at({0}))[0] - 3);
    }
    EXPECT_NEAR(known / found, 1, 0.2) << count;
  }
}

}  // namespace
}  // namespace signorini
