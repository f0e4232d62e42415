#include "core/solver/attainable.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/solver/rounding.hpp"

namespace signorini {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Many vectors share the energy of a response that is less than so many times that of rough vectors: one random error
// is like another. Else few motions have nearly all of it, which a single one may miss.
constexpr double shared = 100;
constexpr int errors_for_few_motions = 3;

constexpr double explained = 10;  // times what rounding does: forces that need no other reason

template <int B>
bool prescribed(const DiscreteProblem<B>& problem, Offset i) {
  return problem.fixed[static_cast<std::size_t>(i / B)] >> (i % B) & 1u;
}

// One of two with the same probability (Steele, Lea and Flood, splitmix64).
double random_sign(std::uint64_t number) {
  std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (z ^ (z >> 31)) >> 63 ? 1 : -1;
}

/// epsilon (|A||x| + |b|) on the free components.
template <int B>
std::vector<double> force_errors(const DiscreteProblem<B>& problem, const std::vector<double>& x) {
  std::vector<double> out(x.size());
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{p} * B + k;
      if (prescribed(problem, i)) continue;
      double sum = std::abs(problem.b[i]);
      for (Offset at = problem.A.row[p]; at < problem.A.row[p + 1]; ++at)
        for (int j = 0; j < B; ++j)
          sum += std::abs(problem.A.at(at)[k * B + j] * x[Offset{problem.A.column[at]} * B + j]);
      out[i] = epsilon * sum;
    }
  return out;
}

}  // namespace

template <int B>
double rough_rounding_error(const DiscreteProblem<B>& problem, const std::vector<double>& x,
                            const std::vector<double>& before, double xAx, double stepAstep) {
  double errors = 0, size = 0, step = 0;  // all of them squared, in the norm of the diagonal
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{p} * B + k;
      const double d = problem.A.diagonal(p)[k * B + k], moved = x[i] - before[i];
      if (prescribed(problem, i)) continue;
      const double error = epsilon * (std::abs(problem.b[i]) + terms_of_product(problem.A, x.data(), p, k));
      errors += error * error / d;
      size += d * x[i] * x[i];
      step += d * moved * moved;
    }
  if (errors == 0) return 0;
  double least = size > 0 ? xAx / size : infinity;
  if (step > 0 && stepAstep > 0) least = std::min(least, stepAstep / step);
  return least > 0 ? std::sqrt(errors / least) : infinity;
}

template <int B>
double rounding_error(const DiscreteProblem<B>& problem, const std::vector<double>& x, double enough,
                      const Response& response) {
  const std::vector<double> sizes = force_errors(problem, x);
  std::vector<double> forces(sizes.size());
  double rough = 0, sum = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double d = problem.A.diagonal(static_cast<Index>(i / B))[i % B * (B + 1)];
    rough += sizes[i] * sizes[i] / d;
  }
  for (int k = 0; k < errors_for_few_motions; ++k) {
    for (std::size_t i = 0; i < sizes.size(); ++i) forces[i] = sizes[i] * random_sign(k * sizes.size() + i);
    const std::optional<double> found = response(forces, enough);
    if (!found) return 0;
    sum += *found * *found;
    if (k == 0 && sum <= shared * rough) return *found;
  }
  return std::sqrt(sum / errors_for_few_motions);
}

template <int B>
Balance balance(const DiscreteProblem<B>& problem, const std::vector<double>& x, const std::vector<double>& r) {
  const Constraints<B>& c = problem.constraints;
  const std::vector<double> errors = force_errors(problem, x);
  double loads = 0, contact = 0, resting = 0, rounding = 0;  // squared
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{p} * B + k;
      if (prescribed(problem, i)) continue;
      const double d = problem.A.diagonal(p)[k * B + k];
      const Index slot = c.slot.empty() ? -1 : c.slot[p];
      const Offset at = Offset{slot} * B + k;
      const bool held = slot >= 0 && (c.width > 0 || c.has_facets(slot) || x[i] <= c.lower[at] || x[i] >= c.upper[at]);
      (held ? contact : resting) += r[i] * r[i] / d;
      loads += problem.b[i] * problem.b[i] / d;
      rounding += errors[i] * errors[i] / d;
    }
  if (contact <= explained * explained * rounding) contact = 0;
  return {std::sqrt(loads + contact), std::sqrt(resting), std::sqrt(rounding)};
}

#define SIGNORINI_INSTANTIATE(B)                                                                                  \
  template double rough_rounding_error(const DiscreteProblem<B>&, const std::vector<double>&,                     \
                                       const std::vector<double>&, double, double);                               \
  template double rounding_error(const DiscreteProblem<B>&, const std::vector<double>&, double, const Response&); \
  template Balance balance(const DiscreteProblem<B>&, const std::vector<double>&, const std::vector<double>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
