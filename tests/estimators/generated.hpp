#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "tests/estimators/estimates.hpp"

namespace signorini::test {

/// Numbers and choices for small scenes, by chance.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}

  std::string number(double from, double to) {
    return fmt::format("{:.4f}", std::uniform_real_distribution<double>(from, to)(random_));
  }
  int whole(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  bool half() { return std::bernoulli_distribution(0.5)(random_); }
  std::string pick(const std::vector<std::string>& all) {
    return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random_)];
  }
  std::string cells(int dimension, int most) {
    std::string out = std::to_string(whole(2, most));
    for (int i = 1; i < dimension; ++i) out += ", " + std::to_string(whole(2, most));
    return "[" + out + "]";
  }

 private:
  std::mt19937 random_;
};

/// Upper over lower bound. The true gap is known up to the upper bound of a finer mesh.
inline double checked(const std::string& scene, int refinements, int finer, const std::string& only_reason = "") {
  const Estimated found = estimated(scene, refinements, "1e-9"), fine = estimated(scene, refinements + finer, "1e-9");
  const double gap = found.lifted() - fine.lifted();
  for (const std::string& reason : found.estimate.reasons) EXPECT_EQ(reason, only_reason) << scene;
  EXPECT_EQ(found.estimate.guaranteed, found.estimate.reasons.empty()) << scene;
  EXPECT_LT(found.estimate.imbalance, 1e-12) << scene;
  EXPECT_LE(found.estimate.lower, gap + fine.estimate.upper) << scene;
  EXPECT_GE(found.estimate.upper, gap) << scene;
  EXPECT_LE(found.estimate.total - found.estimate.upper, fine.estimate.total - fine.estimate.lower) << scene;
  EXPECT_GE(found.estimate.total - found.estimate.lower, fine.estimate.total - fine.estimate.upper) << scene;
  constexpr double rounding = 1e-12;  // of the energy: elements that have the solution itself
  return found.estimate.upper > rounding * found.estimate.energy ? found.estimate.upper / found.estimate.lower : 1;
}

/// The one that a part of them does not exceed.
inline double quantile(std::vector<double> ratios, double part) {
  std::ranges::sort(ratios);
  return ratios[static_cast<std::size_t>(part * static_cast<double>(ratios.size() - 1))];
}

inline void print_ratios(const char* of, const std::vector<double>& ratios) {
  std::printf("upper over lower, %s (%zu): median %.2f, nine of ten %.2f, worst %.2f\n", of, ratios.size(),
              quantile(ratios, 0.5), quantile(ratios, 0.9), quantile(ratios, 1));
}

}  // namespace signorini::test
