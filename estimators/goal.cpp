#include "estimators/goal.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {
namespace {

/// The problem of what is free of the dual solution, and in `start` what the rest of it is.
template <int B>
DiscreteProblem<B> dual_problem(const DiscreteProblem<B>& problem, const Quantity<B>& goal) {
  DiscreteProblem<B> out;
  out.A = problem.A;
  out.b = goal.of_solution;
  out.fixed = problem.fixed;
  out.start.resize(out.b.size());
  for (std::size_t p = 0; p < out.fixed.size(); ++p) {
    for (std::size_t k = 0; k < B; ++k)
      if ((goal.held[p] & ~problem.fixed[p]) >> k & 1u) out.start[p * B + k] = -goal.of_force[p * B + k];
    out.fixed[p] |= goal.held[p];
  }
  eliminate(out);
  for (std::size_t p = 0; p < out.fixed.size(); ++p)
    for (std::size_t k = 0; k < B; ++k)
      if (out.fixed[p] >> k & 1u) out.b[p * B + k] = 0;
  return out;
}

}  // namespace

template <int B>
std::optional<std::vector<double>> dual_solution(const DiscreteProblem<B>& problem, const Quantity<B>& goal,
                                                 const LinearSolve<B>& solve) {
  const DiscreteProblem<B> dual = dual_problem(problem, goal);
  std::vector<double> z(dual.b.size());
  if (!solve(dual, z)) return {};
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += dual.start[i];
  if (max_norm(z) == 0) return {};
  return to_global(problem, std::move(z));
}

template <int D, int B>
std::vector<double> dual_weighted(const Estimator<D, B>& by, const Nodes<D>& nodes, const Model<B>& model,
                                  const std::vector<double>& u, const std::vector<double>& z) {
  const double size = max_norm(z), scale = size > 0 ? max_norm(u) / size : 0;
  const auto shares = [&](double times) {
    std::vector<double> v = u;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += times * z[i];
    return by.estimate(nodes, model, v, {}).of_element;
  };
  std::vector<double> out = shares(scale);
  const std::vector<double> other = shares(-scale);
  for (std::size_t e = 0; e < out.size(); ++e) out[e] = scale > 0 ? (out[e] - other[e]) / (2 * scale) : 0;
  return out;
}

namespace {

/// The nodes of elements in which some nodes that an obstacle may reach are held otherwise than others.
template <int D, int B>
std::vector<char> at_edges(const Nodes<D>& nodes, const DiscreteProblem<B>& problem, const Quantity<B>& goal) {
  std::vector<char> out(static_cast<std::size_t>(nodes.size()));
  if (problem.constraints.slot.empty()) return out;
  with_order(nodes, [&](auto order) {
    for (const auto& vertices : nodes.template elements<order>()) {
      const auto element = nodes.of(vertices);
      std::optional<Flags> held;
      bool differ = false;
      for (const Index p : element) {
        if (problem.constraints.slot[p] < 0) continue;
        differ = differ || (held && *held != goal.held[p]);
        held = goal.held[p];
      }
      for (const Index p : element) out[p] = out[p] || differ;
    }
  });
  return out;
}

}  // namespace

template <int D, int B>
double goal_error(const Nodes<D>& nodes, const DiscreteProblem<B>& problem, const Quantity<B>& goal,
                  const std::vector<double>& share) {
  const std::vector<char> edge = at_edges(nodes, problem, goal);
  double sum = 0, around_edges = 0;
  with_order(nodes, [&](auto order) {
    const auto& elements = nodes.template elements<order>();
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const auto element = nodes.of(elements[e]);
      if (std::ranges::any_of(element, [&](Index p) { return edge[p] != 0; }))
        around_edges += std::abs(share[e]);
      else
        sum += share[e];
    }
  });
  return std::abs(sum) + around_edges;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                    \
  template std::vector<double> dual_weighted(const Estimator<D, B>&, const Nodes<D>&, const Model<B>&, \
                                             const std::vector<double>&, const std::vector<double>&);  \
  template double goal_error(const Nodes<D>&, const DiscreteProblem<B>&, const Quantity<B>&,           \
                             const std::vector<double>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

template std::optional<std::vector<double>> dual_solution(const DiscreteProblem<1>&, const Quantity<1>&,
                                                          const LinearSolve<1>&);
template std::optional<std::vector<double>> dual_solution(const DiscreteProblem<2>&, const Quantity<2>&,
                                                          const LinearSolve<2>&);
template std::optional<std::vector<double>> dual_solution(const DiscreteProblem<3>&, const Quantity<3>&,
                                                          const LinearSolve<3>&);

}  // namespace signorini
