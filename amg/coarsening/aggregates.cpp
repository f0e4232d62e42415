#include "amg/coarsening/aggregates.hpp"

#include <algorithm>
#include <numeric>

namespace signorini {
namespace {

constexpr Index none = -1;

class Aggregation {
 public:
  explicit Aggregation(const StrengthGraph& graph) : graph_(graph), of_(static_cast<std::size_t>(graph.size()), none) {}

  void take_free_neighbourhoods() {
    for (Index p = 0; p < graph_.size(); ++p)
      if (of_[p] == none && !graph_.neighbours(p).empty() &&
          std::ranges::all_of(graph_.neighbours(p), [&](Index q) { return of_[q] == none; }))
        found(p);
  }

  void join_the_strongest() {
    const std::vector<Index> before = of_;
    for (Index p = 0; p < graph_.size(); ++p) {
      if (of_[p] != none) continue;
      float most = 0;
      for (const Coupling& c : graph_.of(p))
        if (before[c.to] != none && c.strength > most) {
          most = c.strength;
          of_[p] = before[c.to];
        }
    }
  }

  void gather_the_rest() {
    for (Index p = 0; p < graph_.size(); ++p)
      if (of_[p] == none && !graph_.neighbours(p).empty()) found(p);
  }

  Aggregates result() && { return rooted_at_the_surface(graph_, std::move(of_), std::move(root_)); }

 private:
  void found(Index p) {
    const auto a = static_cast<Index>(root_.size());
    root_.push_back(p);
    of_[p] = a;
    for (const Index q : graph_.neighbours(p))
      if (of_[q] == none) of_[q] = a;
  }

  const StrengthGraph& graph_;
  std::vector<Index> of_, root_;
};

}  // namespace

Aggregates rooted_at_the_surface(const StrengthGraph& graph, std::vector<Index> of, std::vector<Index> root) {
  for (Index p = 0; p < graph.size(); ++p)
    if (of[p] != none && graph.neighbours(p).size() < graph.neighbours(root[of[p]]).size()) root[of[p]] = p;
  std::vector<Index> order(root.size()), number(root.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](Index a) { return root[a]; });
  Aggregates out;
  for (const Index a : order) {
    number[a] = out.size();
    out.root.push_back(root[a]);
  }
  for (Index& a : of)
    if (a != none) a = number[a];
  out.of = std::move(of);
  return out;
}

Aggregates aggregate(const StrengthGraph& graph) {
  Aggregation aggregation(graph);
  aggregation.take_free_neighbourhoods();
  aggregation.join_the_strongest();
  aggregation.gather_the_rest();
  return std::move(aggregation).result();
}

}  // namespace signorini
