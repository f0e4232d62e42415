#include "amg/coarsening/classical.hpp"

#include <algorithm>

#include "amg/coarsening/splitting.hpp"
#include "amg/coarsening/strength.hpp"

namespace signorini {

namespace {

constexpr double many = 0.35;            // coarse over fine vectors above which the coarse ones are split again
constexpr double weak_part = 0.2;        // part of the largest weight of a row
constexpr std::size_t most_weights = 8;  // of a row

struct Weight {
  Index to;
  double value;
};

/// One row of weights at a time. What is left of them when the small ones are dropped keeps their sum.
class Row {
 public:
  explicit Row(Index columns) : sum_(static_cast<std::size_t>(columns), 0.0) {}

  void add(Index q, double weight) {
    if (weight == 0) return;
    if (sum_[q] == 0) found_.push_back({q, 0});
    sum_[q] += weight;
  }

  /// By ascending column, until take() is called again; begins the next row.
  const std::vector<Weight>& take() {
    taken_.clear();
    std::swap(taken_, found_);
    const double all = collect();
    keep_the_largest();
    double kept = 0;
    for (const Weight& c : taken_) kept += c.value;
    for (Weight& c : taken_) c.value *= all / kept;
    return taken_;
  }

 private:
  double collect() {
    double largest = 0, sum = 0;
    for (Weight& c : taken_) {
      c.value = sum_[c.to];
      sum_[c.to] = 0;
      largest = std::max(largest, c.value);
      sum += c.value;
    }
    std::erase_if(taken_, [=](const Weight& c) { return c.value < weak_part * largest; });
    return sum;
  }

  void keep_the_largest() {
    if (taken_.size() > most_weights) {
      std::ranges::nth_element(taken_, taken_.begin() + most_weights, {},
                               [](const Weight& c) { return std::pair(-c.value, c.to); });
      taken_.resize(most_weights);
    }
    std::ranges::sort(taken_, {}, &Weight::to);
  }

  std::vector<double> sum_;  // zero between the rows
  std::vector<Weight> found_, taken_;
};

/// The couplings of each vector to coarse ones, these by their coarse numbers.
StrengthGraph to_coarse(const StrengthGraph& graph, const CoarseVectors& coarse) {
  StrengthGraph out;
  out.reserve(graph.size(), graph.to.size());
  for (Index p = 0; p < graph.size(); ++p) {
    for (const Coupling& c : graph.of(p))
      if (const Index q = coarse.number[c.to]; q >= 0) out.add({q, c.strength});
    out.end_row();
  }
  return out;
}

/// From coarse neighbours, and through fine ones: from those of their coarse neighbours that are neighbours already,
/// else from all of them. Where not all of the diagonal is balanced the weights sum to less than one: the values fall
/// off towards what is prescribed.
class Weights {
 public:
  Weights(const StrengthGraph& graph, const CoarseVectors& coarse)
      : graph_(graph),
        coarse_(coarse),
        to_coarse_(to_coarse(graph, coarse)),
        seen_(coarse.vector.size(), -1),
        row_(coarse.size()) {}

  /// Those of vector p, until the next call.
  const std::vector<Weight>& of(Index p) {
    if (coarse_.number[p] >= 0) {
      itself_ = {{coarse_.number[p], 1}};
      return itself_;
    }
    interpolate(p);
    return row_.take();
  }

 private:
  void interpolate(Index p) {
    for (const Index q : to_coarse_.neighbours(p)) seen_[q] = p;
    double total = 0;
    for (const Coupling& c : graph_.of(p))
      if (coarse_.number[c.to] >= 0 || !to_coarse_.neighbours(c.to).empty()) total += c.strength;
    const double scale = graph_.balanced[p] / total;
    for (const Coupling& c : graph_.of(p)) {
      if (const Index q = coarse_.number[c.to]; q >= 0)
        row_.add(q, scale * c.strength);
      else
        go_through(p, c.to, scale * c.strength);
    }
  }

  void go_through(Index p, Index fine, double weight) {
    double common = 0, all = 0;
    for (const Coupling& c : to_coarse_.of(fine)) {
      if (seen_[c.to] == p) common += c.strength;
      all += c.strength;
    }
    weight *= graph_.balanced[fine] / (common > 0 ? common : all);
    for (const Coupling& c : to_coarse_.of(fine))
      if (common == 0 || seen_[c.to] == p) row_.add(c.to, weight * c.strength);
  }

  const StrengthGraph& graph_;
  const CoarseVectors& coarse_;
  StrengthGraph to_coarse_;
  std::vector<Index> seen_;  // per coarse vector: the last vector that it is a neighbour of
  Row row_;
  std::vector<Weight> itself_;
};

/// For rows from a graph, and from its coarse vectors to their twins.
Prolongation no_rows(const StrengthGraph& graph, Index coarse, std::vector<Index> twin) {
  Prolongation P;
  P.coarse = coarse;
  P.twin = std::move(twin);
  P.row.reserve(graph.row.size());
  P.column.reserve(graph.to.size());
  P.weight.reserve(graph.to.size());
  return P;
}

void append(const std::vector<Weight>& row, Prolongation& P) {
  for (const Weight& c : row) {
    P.column.push_back(c.to);
    P.weight.push_back(c.value);
  }
  P.row.push_back(static_cast<Offset>(P.column.size()));
}

Prolongation interpolation(const StrengthGraph& graph, const CoarseVectors& coarse) {
  Prolongation P = no_rows(graph, coarse.size(), coarse.vector);
  Weights weights(graph, coarse);
  for (Index p = 0; p < graph.size(); ++p) append(weights.of(p), P);
  return P;
}

/// The same in two steps: from the coarse vectors of `further` to those of this graph, and from these on.
Prolongation interpolation(const StrengthGraph& graph, const CoarseVectors& coarse, const Prolongation& further) {
  std::vector<Index> twin;
  for (const Index q : further.twin) twin.push_back(coarse.vector[q]);
  Prolongation P = no_rows(graph, further.coarse, std::move(twin));
  Weights weights(graph, coarse);
  Row row(P.coarse);
  for (Index p = 0; p < graph.size(); ++p) {
    for (const Weight& c : weights.of(p))
      for (Offset m = further.row[c.to]; m < further.row[c.to + 1]; ++m)
        row.add(further.column[m], c.value * further.weight[m]);
    append(row.take(), P);
  }
  return P;
}

}  // namespace

template <int B>
Prolongation classical_interpolation(const BlockMatrix<B>& A, const std::vector<Flags>& off, bool gently) {
  const StrengthGraph graph = strong_couplings(A, off);
  const CoarseVectors coarse(split(graph, VectorKind::fine));  // the smoother solves for what is coupled to nothing
  if (coarse.size() <= many * graph.size()) return interpolation(graph, coarse);
  const StrengthGraph further = couplings_among(coarse, graph, gently);
  return interpolation(graph, coarse, interpolation(further, CoarseVectors(split(further, VectorKind::coarse))));
}

template Prolongation classical_interpolation(const BlockMatrix<1>&, const std::vector<Flags>&, bool);
template Prolongation classical_interpolation(const BlockMatrix<2>&, const std::vector<Flags>&, bool);
template Prolongation classical_interpolation(const BlockMatrix<3>&, const std::vector<Flags>&, bool);

}  // namespace signorini
