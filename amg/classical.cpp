#include "amg/classical.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <span>

namespace signorini {

namespace {

template <int B>
constexpr double strong = B == 3 ? 0.4 : 0.25;  // part of the largest coupling of a row
constexpr std::size_t most_weights = 6;         // of a row

struct Coupling {
  Index to;
  double strength;
};

/// The strong couplings of each vector, in compressed rows.
struct Graph {
  std::vector<Offset> row{0};
  std::vector<Coupling> edge;

  Index size() const { return static_cast<Index>(row.size()) - 1; }
  std::span<const Coupling> of(Index p) const { return {edge.data() + row[p], edge.data() + row[p + 1]}; }
};

template <int B>
double strength(const double* block) {
  if constexpr (B == 1) return std::max(0.0, -*block);
  double sum = 0;
  for (int i = 0; i < B * B; ++i) sum += block[i] * block[i];
  return std::sqrt(sum);
}

template <int B>
Graph strong_couplings(const BlockMatrix<B>& A, const std::vector<Flags>& off) {
  constexpr Flags all = (1u << B) - 1;
  Graph graph;
  for (Index p = 0; p < A.size(); ++p) {
    const std::size_t begin = graph.edge.size();
    double largest = 0;
    for (Offset k = A.row[p]; k < A.row[p + 1] && off[p] != all; ++k)
      if (const Index q = A.column[k]; q != p && off[q] != all) {
        graph.edge.push_back({q, strength<B>(A.at(k))});
        largest = std::max(largest, graph.edge.back().strength);
      }
    const auto weak = [&](const Coupling& c) { return !(c.strength >= strong<B> * largest) || c.strength == 0; };
    graph.edge.erase(std::remove_if(graph.edge.begin() + static_cast<std::ptrdiff_t>(begin), graph.edge.end(), weak),
                     graph.edge.end());
    graph.row.push_back(static_cast<Offset>(graph.edge.size()));
  }
  return graph;
}

Graph transposed(const Graph& graph) {
  Graph out;
  out.row.assign(graph.row.size(), 0);
  out.edge.resize(graph.edge.size());
  for (const Coupling& c : graph.edge) ++out.row[c.to + 1];
  for (std::size_t p = 1; p < out.row.size(); ++p) out.row[p] += out.row[p - 1];
  std::vector<Offset> next(out.row.begin(), out.row.end() - 1);
  for (Index p = 0; p < graph.size(); ++p)
    for (const Coupling& c : graph.of(p)) out.edge[next[c.to]++] = {p, c.strength};
  return out;
}

enum class Part : std::uint8_t { open, coarse, fine };

/// Vectors become coarse in the order of how many open ones would interpolate from them, most first.
std::vector<Part> split(const Graph& depends) {
  const Graph serves = transposed(depends);
  const Index n = depends.size();
  std::vector<Part> part(n, Part::open);
  std::vector<Index> worth(n);
  using Entry = std::pair<Index, Index>;  // worth, and the number negated: the first of equals leads
  std::priority_queue<Entry> queue;
  for (Index p = 0; p < n; ++p) {
    worth[p] = static_cast<Index>(serves.of(p).size());
    if (depends.of(p).empty() && worth[p] == 0)
      part[p] = Part::fine;  // the smoother solves for it
    else
      queue.emplace(worth[p], -p);
  }
  while (!queue.empty()) {
    const auto [value, negated] = queue.top();
    queue.pop();
    const Index p = -negated;
    if (part[p] != Part::open || value != worth[p]) continue;
    part[p] = Part::coarse;
    for (const Coupling& served : serves.of(p)) {
      if (part[served.to] != Part::open) continue;
      part[served.to] = Part::fine;
      for (const Coupling& other : depends.of(served.to))
        if (part[other.to] == Part::open) queue.emplace(++worth[other.to], -other.to);
    }
  }
  return part;
}

/// One row of weights, over coarse neighbours and those of fine neighbours.
class Row {
 public:
  Row(const Graph& graph, const std::vector<Part>& part) : graph_(graph), part_(part), sum_(part.size(), 0) {}

  const std::vector<Coupling>& weights(Index p) {
    found_.clear();
    for (const Coupling& c : graph_.of(p)) {
      if (part_[c.to] == Part::coarse)
        add(c.to, c.strength);
      else
        distribute(c);
    }
    for (Coupling& c : found_) {
      c.strength = sum_[c.to];
      sum_[c.to] = 0;
    }
    keep_the_largest();
    return found_;
  }

 private:
  void add(Index q, double strength) {
    if (sum_[q] == 0) found_.push_back({q, 0});
    sum_[q] += strength;
  }

  void distribute(const Coupling& through) {
    double total = 0;
    for (const Coupling& c : graph_.of(through.to))
      if (part_[c.to] == Part::coarse) total += c.strength;
    for (const Coupling& c : graph_.of(through.to))
      if (part_[c.to] == Part::coarse) add(c.to, through.strength * c.strength / total);
  }

  void keep_the_largest() {
    if (found_.size() > most_weights) {
      std::nth_element(found_.begin(), found_.begin() + most_weights, found_.end(),
                       [](const Coupling& a, const Coupling& b) {
                         return std::pair(-a.strength, a.to) < std::pair(-b.strength, b.to);
                       });
      found_.resize(most_weights);
    }
    std::ranges::sort(found_, {}, &Coupling::to);
    double total = 0;
    for (const Coupling& c : found_) total += c.strength;
    for (Coupling& c : found_) c.strength /= total;
  }

  const Graph& graph_;
  const std::vector<Part>& part_;
  std::vector<double> sum_;  // zero between the rows
  std::vector<Coupling> found_;
};

}  // namespace

template <int B>
Prolongation classical_interpolation(const BlockMatrix<B>& A, const std::vector<Flags>& off) {
  const Graph graph = strong_couplings(A, off);
  const std::vector<Part> part = split(graph);
  std::vector<Index> number(part.size(), -1);
  Prolongation out;
  for (std::size_t p = 0; p < part.size(); ++p)
    if (part[p] == Part::coarse) {
      number[p] = out.coarse++;
      out.twin.push_back(static_cast<Index>(p));
    }
  Row row(graph, part);
  for (Index p = 0; p < graph.size(); ++p) {
    if (part[p] == Part::coarse) {
      out.column.push_back(number[p]);
      out.weight.push_back(1);
    } else {
      for (const Coupling& c : row.weights(p)) {
        out.column.push_back(number[c.to]);
        out.weight.push_back(c.strength);
      }
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

template Prolongation classical_interpolation(const BlockMatrix<1>&, const std::vector<Flags>&);
template Prolongation classical_interpolation(const BlockMatrix<2>&, const std::vector<Flags>&);
template Prolongation classical_interpolation(const BlockMatrix<3>&, const std::vector<Flags>&);

}  // namespace signorini
