#include "amg/classical.hpp"

#include <algorithm>

#include "amg/splitting.hpp"
#include "amg/strength.hpp"

namespace signorini {

namespace {

constexpr double many = 0.35;            // coarse over fine vectors above which the coarse ones are split again
constexpr double negligible = 0.2;       // part of the largest weight of a row
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

  void append_to(Prolongation& P) {
    const double all = collect();
    keep_the_largest();
    double kept = 0;
    for (const Weight& c : found_) kept += c.value;
    for (const Weight& c : found_) {
      P.column.push_back(c.to);
      P.weight.push_back(c.value * (all / kept));
    }
    P.row.push_back(static_cast<Offset>(P.column.size()));
    found_.clear();
  }

 private:
  double collect() {
    double largest = 0, sum = 0;
    for (Weight& c : found_) {
      c.value = sum_[c.to];
      sum_[c.to] = 0;
      largest = std::max(largest, c.value);
      sum += c.value;
    }
    std::erase_if(found_, [=](const Weight& c) { return c.value < negligible * largest; });
    return sum;
  }

  void keep_the_largest() {
    if (found_.size() > most_weights) {
      std::ranges::nth_element(found_, found_.begin() + most_weights, {},
                               [](const Weight& c) { return std::pair(-c.value, c.to); });
      found_.resize(most_weights);
    }
    std::ranges::sort(found_, {}, &Weight::to);
  }

  std::vector<double> sum_;  // zero between the rows
  std::vector<Weight> found_;
};

/// The couplings of each vector to coarse ones, these by their coarse numbers.
StrengthGraph to_coarse(const StrengthGraph& graph, const CoarseVectors& coarse) {
  StrengthGraph out;
  out.row.reserve(graph.row.size());
  out.edge.reserve(graph.edge.size());
  for (Index p = 0; p < graph.size(); ++p) {
    for (const Coupling& c : graph.of(p))
      if (const Index q = coarse.number[c.to]; q >= 0) out.edge.push_back({q, c.strength});
    out.row.push_back(static_cast<Offset>(out.edge.size()));
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

  void append_row(Index p, Prolongation& P) {
    if (coarse_.number[p] >= 0) {
      P.column.push_back(coarse_.number[p]);
      P.weight.push_back(1);
      P.row.push_back(static_cast<Offset>(P.column.size()));
    } else {
      interpolate(p);
      row_.append_to(P);
    }
  }

 private:
  void interpolate(Index p) {
    for (const Coupling& c : to_coarse_.of(p)) seen_[c.to] = p;
    double total = 0;
    for (const Coupling& c : graph_.of(p))
      if (coarse_.number[c.to] >= 0 || !to_coarse_.of(c.to).empty()) total += c.strength;
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
};

/// For so many weights without growing.
Prolongation rows_for(Index rows, std::size_t weights) {
  Prolongation P;
  P.row.reserve(static_cast<std::size_t>(rows) + 1);
  P.column.reserve(weights);
  P.weight.reserve(weights);
  return P;
}

Prolongation interpolation(const StrengthGraph& graph, const CoarseVectors& coarse) {
  Prolongation P = rows_for(graph.size(), graph.edge.size());
  P.coarse = coarse.size();
  P.twin = coarse.vector;
  Weights weights(graph, coarse);
  for (Index p = 0; p < graph.size(); ++p) weights.append_row(p, P);
  return P;
}

/// Interpolation by `first` from the vectors that `second` interpolates to.
Prolongation product(const Prolongation& first, const Prolongation& second) {
  Prolongation P = rows_for(first.fine(), first.column.size());
  P.coarse = second.coarse;
  for (const Index q : second.twin) P.twin.push_back(first.twin[q]);
  Row row(P.coarse);
  for (Index p = 0; p < first.fine(); ++p) {
    for (Offset k = first.row[p]; k < first.row[p + 1]; ++k)
      for (Offset m = second.row[first.column[k]]; m < second.row[first.column[k] + 1]; ++m)
        row.add(second.column[m], first.weight[k] * second.weight[m]);
    row.append_to(P);
  }
  return P;
}

}  // namespace

template <int B>
Prolongation classical_interpolation(const BlockMatrix<B>& A, const std::vector<Flags>& off) {
  StrengthGraph graph = strong_couplings(A, off);
  const CoarseVectors coarse(split(graph, Part::fine));  // the smoother solves for what is coupled to nothing
  Prolongation P = interpolation(graph, coarse);
  if (coarse.size() <= many * graph.size()) return P;
  const StrengthGraph further = couplings_among(coarse, graph);
  graph = {};  // what follows takes its memory
  return product(P, interpolation(further, CoarseVectors(split(further, Part::coarse))));
}

template Prolongation classical_interpolation(const BlockMatrix<1>&, const std::vector<Flags>&);
template Prolongation classical_interpolation(const BlockMatrix<2>&, const std::vector<Flags>&);
template Prolongation classical_interpolation(const BlockMatrix<3>&, const std::vector<Flags>&);

}  // namespace signorini
