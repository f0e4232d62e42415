#include "amg/coarsening/smoothed_aggregation.hpp"

#include <algorithm>

namespace signorini {
namespace {

/// 4 / (3 lambda), where lambda = 2 bounds the eigenvalues of a diagonally dominant matrix over its diagonal.
constexpr double damping = 2.0 / 3;

}  // namespace

template <int B>
Prolongation smoothed_aggregation(const BlockMatrix<B>& A, const std::vector<Flags>& off,
                                  const Aggregator& aggregator) {
  const StrengthGraph graph = strong_couplings(A, off);
  Aggregates aggregates = aggregator.aggregate(graph);
  Prolongation P;
  P.coarse = aggregates.size();
  std::vector<double> sum(aggregates.root.size(), 0.0);  // zero between the rows
  std::vector<Index> found;
  for (Index p = 0; p < graph.size(); ++p) {
    found.clear();
    const auto add = [&](Index q, double weight) {
      const Index a = aggregates.of[q];
      if (a < 0 || weight == 0) return;
      if (sum[a] == 0) found.push_back(a);
      sum[a] += weight;
    };
    add(p, 1 - damping);
    double total = 0;
    for (const Coupling& c : graph.of(p)) total += c.strength;
    for (const Coupling& c : graph.of(p)) add(c.to, damping * graph.balanced[p] * c.strength / total);
    std::ranges::sort(found);
    for (const Index a : found) {
      P.column.push_back(a);
      P.weight.push_back(sum[a]);
      sum[a] = 0;
    }
    P.row.push_back(static_cast<Offset>(P.column.size()));
  }
  P.twin = std::move(aggregates.root);
  return P;
}

template Prolongation smoothed_aggregation(const BlockMatrix<1>&, const std::vector<Flags>&, const Aggregator&);
template Prolongation smoothed_aggregation(const BlockMatrix<2>&, const std::vector<Flags>&, const Aggregator&);
template Prolongation smoothed_aggregation(const BlockMatrix<3>&, const std::vector<Flags>&, const Aggregator&);

}  // namespace signorini
