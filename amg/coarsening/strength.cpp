#include "amg/coarsening/strength.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace signorini {

namespace {

// Part of the largest coupling of a row. Scalars: less than what a seven-point stencil leaves between opposite corners
// of cells on every second plane, which is 0.25.
template <int B>
constexpr double strong = B == 1   ? 0.2
                          : B == 2 ? 0.25
                                   : 0.4;

// The same of scalars in rows with a positive coupling above a part of the largest: elements stretched out, whose
// corners are coupled by 0.25 though nothing smooth goes along these couplings, as the positive ones say.
constexpr double strong_beside_positive = 0.3, positive = 0.25;

constexpr double strong_norm = 0.2;  // of groups

template <int B>
double strength(const double* block) {
  if constexpr (B == 1) return std::max(0.0, -*block);
  return std::sqrt(square<B>(block));
}

template <int B>
double part_that_is_strong(double largest, double largest_positive) {
  return B == 1 && largest_positive > positive * largest ? strong_beside_positive : strong<B>;
}

/// Those of couplings that are strong at their other end, too.
/// @param largest per vector: of its couplings
StrengthGraph strong_at_both_ends(const StrengthGraph& graph, const std::vector<double>& largest) {
  StrengthGraph out;
  out.balanced = graph.balanced;
  for (Index g = 0; g < graph.size(); ++g) {
    for (const Coupling& c : graph.of(g))
      if (c.strength * largest[g] >= strong_norm * largest[c.to]) out.add(c);
    out.end_row();
  }
  return out;
}

}  // namespace

StrengthGraph reversed(const StrengthGraph& graph) {
  StrengthGraph out;
  out.row.assign(graph.row.size(), 0);
  for (const Index q : graph.to) ++out.row[static_cast<std::size_t>(q) + 1];
  std::partial_sum(out.row.begin(), out.row.end(), out.row.begin());
  out.to.resize(graph.to.size());
  out.strength.resize(graph.to.size());
  std::vector<Offset> next(out.row.begin(), out.row.end() - 1);
  for (Index p = 0; p < graph.size(); ++p)
    for (Offset k = graph.row[p]; k < graph.row[p + 1]; ++k) {
      const Offset at = next[graph.to[k]]++;
      out.to[at] = p;
      out.strength[at] = graph.strength[k];
    }
  return out;
}

template <int B>
StrengthGraph strong_couplings(const BlockMatrix<B>& A, const std::vector<Flags>& off) {
  constexpr Flags all = (1u << B) - 1;
  StrengthGraph graph;
  graph.reserve(A.size(), A.column.size());
  graph.balanced.assign(static_cast<std::size_t>(A.size()), 1.0);
  std::vector<double> found;
  for (Index p = 0; p < A.size(); ++p) {
    const Offset begin = A.row[p], end = A.row[p + 1];
    found.resize(static_cast<std::size_t>(end - begin));
    double largest = 0, largest_positive = 0, sum = *A.at(begin);
    for (Offset k = begin + 1; k < end; ++k) {
      const Index q = A.column[k];
      sum += *A.at(k);
      largest_positive = std::max(largest_positive, *A.at(k));
      found[k - begin] = off[p] == all || off[q] == all ? 0 : strength<B>(A.at(k));
      largest = std::max(largest, found[k - begin]);
    }
    if (B == 1) graph.balanced[p] = 1 - std::clamp(sum / *A.at(begin), 0.0, 1.0);
    const double enough = part_that_is_strong<B>(largest, largest_positive) * largest;
    for (Offset k = begin + 1; k < end; ++k)
      if (const double s = found[k - begin]; s > 0 && s >= enough)
        graph.add({A.column[k], static_cast<float>(s / largest)});
    graph.end_row();
  }
  return graph;
}

template <int B>
StrengthGraph strong_couplings_of_groups(const BlockMatrix<B>& A, const std::vector<Flags>& off, Index group,
                                         const std::vector<Index>& part, bool at_both_ends) {
  constexpr Flags all = (1u << B) - 1;
  const Index groups = A.size() / group;
  StrengthGraph graph;
  graph.balanced.assign(static_cast<std::size_t>(groups), 1.0);
  std::vector<double> sum(static_cast<std::size_t>(groups), 0.0);  // zero between the rows
  std::vector<double> norm;                                        // per group: of its largest coupling
  std::vector<Index> found;
  for (Index g = 0; g < groups; ++g) {
    found.clear();
    for (Index p = g * group; p < (g + 1) * group; ++p)
      for (Offset k = A.row[p]; off[p] != all && k < A.row[p + 1]; ++k) {
        const Index q = A.column[k], h = q / group;
        if (h == g || off[q] == all || (!part.empty() && part[g] != part[h])) continue;
        if (sum[h] == 0) found.push_back(h);
        sum[h] += square<B>(A.at(k));
      }
    double largest = 0;
    for (const Index h : found) largest = std::max(largest, sum[h]);
    std::ranges::sort(found);
    for (const Index h : found) {
      if (sum[h] > 0 && sum[h] >= strong_norm * strong_norm * largest)
        graph.add({h, static_cast<float>(std::sqrt(sum[h] / largest))});
      sum[h] = 0;
    }
    graph.end_row();
    norm.push_back(std::sqrt(largest));
  }
  return at_both_ends ? strong_at_both_ends(graph, norm) : graph;
}

template StrengthGraph strong_couplings_of_groups(const BlockMatrix<1>&, const std::vector<Flags>&, Index,
                                                  const std::vector<Index>&, bool);
template StrengthGraph strong_couplings_of_groups(const BlockMatrix<2>&, const std::vector<Flags>&, Index,
                                                  const std::vector<Index>&, bool);
template StrengthGraph strong_couplings_of_groups(const BlockMatrix<3>&, const std::vector<Flags>&, Index,
                                                  const std::vector<Index>&, bool);
template StrengthGraph strong_couplings(const BlockMatrix<1>&, const std::vector<Flags>&);
template StrengthGraph strong_couplings(const BlockMatrix<2>&, const std::vector<Flags>&);
template StrengthGraph strong_couplings(const BlockMatrix<3>&, const std::vector<Flags>&);

}  // namespace signorini
