#include "amg/coarsening/splitting.hpp"

#include <algorithm>
#include <span>

namespace signorini {

namespace {

constexpr double by_several_paths = 0.6;  // part of the largest coupling of a row

/// Whether neighbours are neighbours of each other. False also where the rows do not ascend.
bool is_symmetric(const StrengthGraph& graph) {
  std::vector<Offset> next(graph.row.begin(), graph.row.end() - 1);
  for (Index p = 0; p < graph.size(); ++p)
    for (const Index q : graph.neighbours(p)) {
      if (next[q] == graph.row[q + 1] || graph.to[next[q]] != p) return false;
      ++next[q];
    }
  return true;
}

std::size_t longest_row(const StrengthGraph& graph) {
  std::size_t out = 0;
  for (Index p = 0; p < graph.size(); ++p) out = std::max(out, graph.neighbours(p).size());
  return out;
}

/// Vectors in stacks by their worth, which only rises: of equals the last one put in leads. What has been raised or
/// removed since is passed over.
class Stacks {
 public:
  Stacks(std::size_t vectors, std::size_t largest) : stack_(largest + 1), worth_(vectors, none) {}

  bool holds(Index p) const { return worth_[p] != none; }

  void insert(Index p, Index worth) {
    worth_[p] = worth;
    stack_[worth].push_back(p);
    top_ = std::max(top_, worth);
  }

  void remove(Index p) { worth_[p] = none; }

  void raise(Index p) { insert(p, worth_[p] + 1); }

  /// One of the most worth, -1: there is none.
  Index best() {
    for (; top_ >= 0; --top_)
      for (std::vector<Index>& stack = stack_[top_]; !stack.empty(); stack.pop_back())
        if (worth_[stack.back()] == top_) return stack.back();
    return none;
  }

 private:
  static constexpr Index none = -1;
  std::vector<std::vector<Index>> stack_;
  std::vector<Index> worth_;
  Index top_ = none;
};

}  // namespace

std::vector<VectorKind> split(const StrengthGraph& needs, VectorKind alone) {
  // Where both are the same, one that stays in the cache.
  const bool one = is_symmetric(needs);
  const StrengthGraph backwards = one ? StrengthGraph{} : reversed(needs);
  const StrengthGraph& serves = one ? needs : backwards;
  const Index n = needs.size();
  std::vector<VectorKind> part(static_cast<std::size_t>(n), VectorKind::fine);
  // No vector can be worth more than by all that it serves turning fine.
  Stacks open(part.size(), 2 * longest_row(serves));
  for (Index p = n - 1; p >= 0; --p) {
    const auto worth = static_cast<Index>(serves.neighbours(p).size());
    if (needs.neighbours(p).empty() && worth == 0)
      part[p] = alone;
    else
      open.insert(p, worth);
  }
  std::vector<Index> turned;  // fine by the last choice
  for (Index p = open.best(); p >= 0; p = open.best()) {
    part[p] = VectorKind::coarse;
    open.remove(p);
    turned.clear();
    for (const Index q : serves.neighbours(p)) {
      if (!open.holds(q)) continue;
      open.remove(q);
      turned.push_back(q);
      __builtin_prefetch(needs.neighbours(q).data());
    }
    for (const Index q : turned) {
      const std::span<const Index> others = needs.neighbours(q);
      // The first of equals leads: on structured grids that keeps to every second line.
      for (std::size_t k = others.size(); k-- > 0;)
        if (open.holds(others[k])) open.raise(others[k]);
    }
  }
  return part;
}

CoarseVectors::CoarseVectors(const std::vector<VectorKind>& part) : number(part.size(), -1) {
  for (std::size_t p = 0; p < part.size(); ++p)
    if (part[p] == VectorKind::coarse) {
      number[p] = size();
      vector.push_back(static_cast<Index>(p));
    }
}

StrengthGraph couplings_among(const CoarseVectors& coarse, const StrengthGraph& graph, bool by_several) {
  StrengthGraph out;
  out.reserve(coarse.size(), graph.to.size());
  std::vector<double> total(static_cast<std::size_t>(graph.size()), 0.0);
  for (Index p = 0; p < graph.size(); ++p)
    for (const Coupling& c : graph.of(p)) total[p] += c.strength;
  std::vector<double> sum(coarse.vector.size(), 0.0);
  std::vector<int> paths(coarse.vector.size(), 0);
  std::vector<Index> found;
  double reached = 0;  // by the paths from one vector
  const auto add = [&](Index to, double strength) {
    const Index q = coarse.number[to];
    if (q < 0 || strength == 0) return;
    if (sum[q] == 0) found.push_back(q);
    sum[q] += strength;
    ++paths[q];
    reached += strength;
  };
  for (const Index p : coarse.vector) {
    found.clear();
    reached = 0;
    double ended = total[p] * (1 / graph.balanced[p] - 1);  // paths that end at prescribed values
    for (const Coupling& c : graph.of(p)) {
      const double onward = c.strength * graph.balanced[c.to];
      add(c.to, c.strength);
      const double part = onward / total[c.to];
      if (coarse.number[c.to] < 0) ended += c.strength - onward;
      for (const Coupling& further : graph.of(c.to))
        if (further.to != p) add(further.to, part * further.strength);
    }
    double largest = 0;
    for (const Index q : found) largest = std::max(largest, sum[q]);
    for (const Index q : found) {
      if (sum[q] >= by_several_paths * largest && (!by_several || paths[q] > 1))
        out.add({q, static_cast<float>(sum[q] / largest)});
      sum[q] = 0;
      paths[q] = 0;
    }
    out.end_row();
    out.balanced.push_back(reached > 0 ? reached / (reached + ended) : 1);
  }
  return out;
}

}  // namespace signorini
