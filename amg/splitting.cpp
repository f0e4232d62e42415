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

/// Vectors in buckets by their worth, each a doubly linked list; of equals the last one put in leads.
class Buckets {
 public:
  Buckets(std::size_t vectors, std::size_t largest) : first_(largest + 1, none), next_(vectors), previous_(vectors) {}

  void insert(Index p, Index worth) {
    next_[p] = first_[worth];
    previous_[p] = none;
    if (next_[p] != none) previous_[next_[p]] = p;
    first_[worth] = p;
    top_ = std::max(top_, worth);
  }

  void remove(Index p, Index worth) {
    (previous_[p] == none ? first_[worth] : next_[previous_[p]]) = next_[p];
    if (next_[p] != none) previous_[next_[p]] = previous_[p];
  }

  /// One of the most worth, -1: all buckets are empty.
  Index best() {
    while (top_ > 0 && first_[top_] == none) --top_;
    return first_[top_];
  }

 private:
  static constexpr Index none = -1;
  std::vector<Index> first_, next_, previous_;
  Index top_ = 0;
};

}  // namespace

std::vector<Part> split(const StrengthGraph& depends, Part alone) {
  const Served served(depends);
  const Index n = depends.size();
  std::vector<Part> part(static_cast<std::size_t>(n), Part::open);
  std::vector<Index> worth(part.size());
  // No vector can be worth more than by all that it serves turning fine.
  Buckets open(part.size(), 2 * static_cast<std::size_t>(served.most()));
  for (Index p = n - 1; p >= 0; --p) {
    worth[p] = static_cast<Index>(served.by(p).size());
    if (depends.of(p).empty() && worth[p] == 0)
      part[p] = alone;
    else
      open.insert(p, worth[p]);
  }
  for (Index p = open.best(); p >= 0; p = open.best()) {
    part[p] = Part::coarse;
    open.remove(p, worth[p]);
    for (const Index q : served.by(p)) {
      if (part[q] != Part::open) continue;
      part[q] = Part::fine;
      open.remove(q, worth[q]);
      for (const Coupling& other : depends.of(q)) {
        if (part[other.to] != Part::open) continue;
        open.remove(other.to, worth[other.to]);
        open.insert(other.to, ++worth[other.to]);
      }
    }
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
  const auto add = [&](Index to, double strength) {
    const Index q = coarse.number[to];
    if (q < 0) return;
    if (sum[q] == 0) found.push_back(q);
    sum[q] += strength;
  };
  for (const Index p : coarse.vector) {
    found.clear();
    for (const Coupling& c : graph.of(p)) {
      add(c.to, c.strength);
      for (const Coupling& further : graph.of(c.to))
        if (further.to != p) add(further.to, c.strength * further.strength / total[c.to]);
    }
    double largest = 0;
    for (const Index q : found) largest = std::max(largest, sum[q]);
    for (const Index q : found) {
      if (sum[q] >= by_several_paths * largest) out.edge.push_back({q, static_cast<float>(sum[q] / largest)});
      sum[q] = 0;
    }
    out.row.push_back(static_cast<Offset>(out.edge.size()));
    out.balanced.push_back(graph.balanced[p]);
  }
  return out;
}

}  // namespace signorini
