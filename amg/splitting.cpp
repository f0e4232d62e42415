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
  Buckets(std::size_t vectors, std::size_t largest) : first_(largest + 1, none), vector_(vectors) {}

  bool holds(Index p) const { return vector_[p].worth >= 0; }

  void insert(Index p, Index worth) {
    vector_[p] = {first_[worth], none, worth};
    if (first_[worth] != none) vector_[first_[worth]].previous = p;
    first_[worth] = p;
    top_ = std::max(top_, worth);
  }

  void remove(Index p) {
    const Vector out = vector_[p];
    (out.previous == none ? first_[out.worth] : vector_[out.previous].next) = out.next;
    if (out.next != none) vector_[out.next].previous = out.previous;
    vector_[p].worth = none;
  }

  void raise(Index p) {
    const Index worth = vector_[p].worth;
    remove(p);
    insert(p, worth + 1);
  }

  /// One of the most worth, -1: all buckets are empty.
  Index best() {
    while (top_ > 0 && first_[top_] == none) --top_;
    return first_[top_];
  }

 private:
  static constexpr Index none = -1;
  struct Vector {
    Index next = none, previous = none, worth = none;  // worth none: in no bucket
  };
  std::vector<Index> first_;
  std::vector<Vector> vector_;
  Index top_ = 0;
};

}  // namespace

std::vector<Part> split(const StrengthGraph& depends, Part alone) {
  const Served served(depends);
  const Index n = depends.size();
  std::vector<Part> part(static_cast<std::size_t>(n), Part::fine);
  // No vector can be worth more than by all that it serves turning fine.
  Buckets open(part.size(), 2 * static_cast<std::size_t>(served.most()));
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
