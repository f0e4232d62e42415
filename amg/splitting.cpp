#include "amg/splitting.hpp"

#include <algorithm>

namespace signorini {

namespace {

constexpr double by_several_paths = 0.6;  // part of the largest coupling of a row

/// Per vector those that are coupled to it.
class Served {
 public:
  explicit Served(const StrengthGraph& graph) : row_(graph.row.size(), 0), vector_(graph.edge.size()) {
    for (const Coupling& c : graph.edge) ++row_[static_cast<std::size_t>(c.to) + 1];
    for (std::size_t p = 1; p < row_.size(); ++p) row_[p] += row_[p - 1];
    std::vector<Offset> next(row_.begin(), row_.end() - 1);
    for (Index p = 0; p < graph.size(); ++p)
      for (const Coupling& c : graph.of(p)) vector_[next[c.to]++] = p;
  }

  std::span<const Index> by(Index p) const { return {vector_.data() + row_[p], vector_.data() + row_[p + 1]}; }

  Offset most() const {
    Offset out = 0;
    for (std::size_t p = 1; p < row_.size(); ++p) out = std::max(out, row_[p] - row_[p - 1]);
    return out;
  }

 private:
  std::vector<Offset> row_;
  std::vector<Index> vector_;
};

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

std::vector<Part> split(const StrengthGraph& depends, Part alone) {
  const Served served(depends);
  const Index n = depends.size();
  std::vector<Part> part(static_cast<std::size_t>(n), Part::fine);
  // No vector can be worth more than by all that it serves turning fine.
  Stacks open(part.size(), 2 * static_cast<std::size_t>(served.most()));
  for (Index p = n - 1; p >= 0; --p) {
    const auto worth = static_cast<Index>(served.by(p).size());
    if (depends.of(p).empty() && worth == 0)
      part[p] = alone;
    else
      open.insert(p, worth);
  }
  std::vector<Index> turned;  // fine by the last choice
  for (Index p = open.best(); p >= 0; p = open.best()) {
    part[p] = Part::coarse;
    open.remove(p);
    turned.clear();
    for (const Index q : served.by(p)) {
      if (!open.holds(q)) continue;
      open.remove(q);
      turned.push_back(q);
    }
    for (const Index q : turned)
      // The first of equals leads: on structured grids that keeps to every second line.
      for (std::size_t k = depends.of(q).size(); k-- > 0;)
        if (const Index other = depends.of(q)[k].to; open.holds(other)) open.raise(other);
  }
  return part;
}

CoarseVectors::CoarseVectors(const std::vector<Part>& part) : number(part.size(), -1) {
  for (std::size_t p = 0; p < part.size(); ++p)
    if (part[p] == Part::coarse) {
      number[p] = size();
      vector.push_back(static_cast<Index>(p));
    }
}

StrengthGraph couplings_among(const CoarseVectors& coarse, const StrengthGraph& graph) {
  StrengthGraph out;
  std::vector<double> total(static_cast<std::size_t>(graph.size()), 0.0);
  for (Index p = 0; p < graph.size(); ++p)
    for (const Coupling& c : graph.of(p)) total[p] += c.strength;
  std::vector<double> sum(coarse.vector.size(), 0.0);
  std::vector<Index> found;
  double reached = 0;  // by the paths from one vector
  const auto add = [&](Index to, double strength) {
    const Index q = coarse.number[to];
    if (q < 0 || strength == 0) return;
    if (sum[q] == 0) found.push_back(q);
    sum[q] += strength;
    reached += strength;
  };
  for (const Index p : coarse.vector) {
    found.clear();
    reached = 0;
    double ended = total[p] * (1 / graph.balanced[p] - 1);  // paths that end at prescribed values
    for (const Coupling& c : graph.of(p)) {
      const double onward = c.strength * graph.balanced[c.to];
      add(c.to, c.strength);
      if (coarse.number[c.to] < 0) ended += c.strength - onward;
      for (const Coupling& further : graph.of(c.to))
        if (further.to != p) add(further.to, onward * further.strength / total[c.to]);
    }
    double largest = 0;
    for (const Index q : found) largest = std::max(largest, sum[q]);
    for (const Index q : found) {
      if (sum[q] >= by_several_paths * largest) out.edge.push_back({q, static_cast<float>(sum[q] / largest)});
      sum[q] = 0;
    }
    out.row.push_back(static_cast<Offset>(out.edge.size()));
    out.balanced.push_back(reached > 0 ? reached / (reached + ended) : 1);
  }
  return out;
}

}  // namespace signorini
