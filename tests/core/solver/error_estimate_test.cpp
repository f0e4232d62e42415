// The algebraic error estimate against the true error, once the contact set rests.
#include <gtest/gtest.h>

#include "tests/core/solver/cases.hpp"
#include "tests/support/pdas.hpp"

namespace signorini::test {
namespace {

struct Iterate {
  double estimate, error;
  Index changed;
};

// Estimate and true error after every cycle until the error meets rounding.
template <int B>
std::vector<Iterate> history(const Nested<B>& nested, const Reference& exact, SolverOptions options) {
  options.tolerance = 1e-11;
  options.max_iterations = 60;
  std::vector<double> x;
  std::vector<Iterate> out;
  const double size = solution_norm(nested, exact.x);
  solve_from_zero(nested, x, options, [&](const IterationRecord& r) {
    const double error = energy_norm<B>(nested.finest().A, vector(x) - exact.x) / size;
    out.push_back({r.algebraic_error, error, r.changed});
    return error > 1e-10;
  });
  return out;
}

template <int B>
void expect_within_a_third_and_three(const Case<B>& c) {
  if (c.name.find("biactive") != std::string::npos || c.name == "full_contact") return;  // solved in one or two cycles
  const Reference exact = reference(c.nested.finest());
  for (const char* smoother : {"adjoint", "forward", "symmetric"})
    for (const char* cycle : {"V", "W"})
      for (const int steps : {1, 2}) {
        SolverOptions options;
        options.smoother = smoother;
        options.cycle = cycle;
        options.pre = options.post = steps;
        const auto iterates = history(c.nested, exact, options);
        std::size_t linear = iterates.size();
        while (linear > 0 && iterates[linear - 1].changed == 0) --linear;
        for (std::size_t k = linear + 2; k < iterates.size(); ++k) {  // two ratios of gains lie behind it
          const auto& [estimate, error, changed] = iterates[k];
          if (error < 1e-10) break;
          EXPECT_GE(estimate, error / 3) << c.name << ", " << smoother << steps << cycle << ", cycle " << k + 1
                                         << " of " << iterates.size() << ", linear from " << linear + 1;
          if (k < linear + 4)
            continue;  // acceleration has not gathered its directions: what comes is faster than what was
          EXPECT_LE(estimate, error * 3) << c.name << ", " << smoother << steps << cycle << ", cycle " << k + 1
                                         << " of " << iterates.size() << ", linear from " << linear + 1;
        }
      }
}

TEST(AlgebraicError, IsEstimatedWithinAFactorOfThreeOnScalarProblems) {
  for (const auto& c : scalar_cases()) expect_within_a_third_and_three(c);
}
TEST(AlgebraicError, IsEstimatedWithinAFactorOfThreeInElasticity) {
  for (const auto& c : plane_cases()) expect_within_a_third_and_three(c);
  for (const auto& c : space_cases()) expect_within_a_third_and_three(c);
}

}  // namespace
}  // namespace signorini::test
