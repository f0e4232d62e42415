#include <algorithm>

#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/element_points.hpp"
#include "core/fem/assembly/stiffness_scalar.hpp"

namespace signorini {
namespace {

// The elements around every node, in flat arrays.
template <int D, int P>
struct Adjacency {
  std::vector<Offset> first;
  std::vector<Index> element;

  explicit Adjacency(const Nodes<D>& nodes)
      : first(static_cast<std::size_t>(nodes.size()) + 1),
        element(nodes.template elements<P>().size() * element_nodes<D, P>) {
    const auto& elements = nodes.template elements<P>();
    for (const auto& vertices : elements)
      for (const Index p : nodes.of(vertices)) ++first[p + 1];
    for (std::size_t p = 1; p < first.size(); ++p) first[p] += first[p - 1];
    std::vector<Offset> next(first.begin(), first.end() - 1);
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (const Index p : nodes.of(elements[e])) element[next[p]++] = static_cast<Index>(e);
  }
};

// A matrix whose pattern is known, and where the columns above the diagonal begin in each row.
template <int B>
struct Assembly {
  BlockMatrix<B> A;
  std::vector<Offset> upper;

  double* entry(Index p, Index q) {
    Offset k = upper[p];
    while (A.column[k] != q) ++k;
    return A.at(k);
  }
};

template <int D, int B, int P>
Assembly<B> pattern(const Nodes<D>& nodes, const Jumps<B>* jumps) {
  const Adjacency<D, P> around(nodes);
  const auto& elements = nodes.template elements<P>();
  const Index n = nodes.size();
  Assembly<B> out;
  out.A.row.reserve(n + 1);
  out.A.column.reserve(n + 2 * estimated_pairs(nodes));
  out.upper.resize(n);
  std::vector<Index> seen(n, -1), &column = out.A.column;
  for (Index p = 0; p < n; ++p) {
    seen[p] = p;
    column.push_back(p);
    const auto begin = static_cast<Offset>(column.size());
    for (Offset k = around.first[p]; k < around.first[p + 1]; ++k)
      for (const Index q : nodes.of(elements[around.element[k]]))
        if (seen[q] != p) {
          seen[q] = p;
          column.push_back(q);
        }
    std::sort(column.begin() + begin, column.end());
    out.upper[p] = std::upper_bound(column.begin() + begin, column.end(), p) - column.begin();
    out.A.row.push_back(static_cast<Offset>(column.size()));
  }
  if (jumps) reserve_couplings(*jumps, out.A);
  out.A.value.assign(column.size() * BlockMatrix<B>::block, 0.0);
  return out;
}

// Adds the diagonal blocks and those above the diagonal.
template <int D, int B, int P>
void add_upper_half(const Nodes<D>& nodes, const Model<B>& model, Assembly<B>& out) {
  const auto& elements = nodes.template elements<P>();
  ElementPoints<D, P> element(nodes, model);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    element.move_to(e);
    const auto node = nodes.of(elements[e]);
    for (std::size_t a = 0; a < node.size(); ++a) {
      const Index p = node[a];
      element.add_block(a, a, out.A.at(out.A.row[p]));
      for (std::size_t b = a + 1; b < node.size(); ++b) {
        const Index q = node[b];
        if (p < q)
          element.add_block(a, b, out.entry(p, q));
        else
          element.add_block(b, a, out.entry(q, p));
      }
    }
  }
}

// What lies below the diagonal is what lies above it, transposed. Rows ascend, so row q meets its lower columns p in
// order and a cursor per row replaces any search.
template <int B>
void mirror(Assembly<B>& out) {
  BlockMatrix<B>& A = out.A;
  std::vector<Offset> next(A.row.begin(), A.row.end() - 1);
  for (Index p = 0; p < A.size(); ++p) {
    double* diagonal = A.at(A.row[p]);
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < i; ++j) diagonal[i * B + j] = diagonal[j * B + i];
    for (Offset k = out.upper[p]; k < A.row[p + 1]; ++k) {
      const double* from = A.at(k);
      double* to = A.at(++next[A.column[k]]);
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) to[j * B + i] = from[i * B + j];
    }
  }
}

}  // namespace

template <int D, int B>
BlockMatrix<B> stiffness(const Nodes<D>& nodes, const Model<B>& model, const Jumps<B>* jumps) {
  if constexpr (B == 1) {
    return scalar_stiffness(nodes, model);
  } else {
    return with_order(nodes, [&](auto order) {
      Assembly<B> out = pattern<D, B, order>(nodes, jumps);
      add_upper_half<D, B, order>(nodes, model, out);
      mirror(out);
      return std::move(out.A);
    });
  }
}

template BlockMatrix<1> stiffness(const Nodes<2>&, const Model<1>&, const Jumps<1>*);
template BlockMatrix<1> stiffness(const Nodes<3>&, const Model<1>&, const Jumps<1>*);
template BlockMatrix<2> stiffness(const Nodes<2>&, const Model<2>&, const Jumps<2>*);
template BlockMatrix<3> stiffness(const Nodes<3>&, const Model<3>&, const Jumps<3>*);

}  // namespace signorini
