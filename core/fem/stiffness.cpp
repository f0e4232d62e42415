#include <algorithm>

#include "core/fem/assemble.hpp"
#include "core/fem/checked_element.hpp"
#include "core/fem/material.hpp"
#include "core/fem/revolution.hpp"
#include "core/fem/stiffness_scalar.hpp"

namespace signorini {
namespace {

// The elements around every node, in flat arrays.
template <int D>
struct Adjacency {
  std::vector<Offset> first;
  std::vector<Index> element;

  explicit Adjacency(const Nodes<D>& nodes)
      : first(static_cast<std::size_t>(nodes.size()) + 1), element(nodes.mesh().elements.size() * (D + 1)) {
    const std::size_t elements = nodes.mesh().elements.size();
    for (std::size_t e = 0; e < elements; ++e)
      for (const Index p : nodes.of_element(e)) ++first[p + 1];
    for (std::size_t p = 1; p < first.size(); ++p) first[p] += first[p - 1];
    std::vector<Offset> next(first.begin(), first.end() - 1);
    for (std::size_t e = 0; e < elements; ++e)
      for (const Index p : nodes.of_element(e)) element[next[p]++] = static_cast<Index>(e);
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

template <int D, int B>
Assembly<B> pattern(const Nodes<D>& nodes) {
  const Adjacency<D> around(nodes);
  const Index n = nodes.size();
  Assembly<B> out;
  out.A.row.reserve(n + 1);
  out.A.column.reserve(n + 2 * estimated_edges(nodes.mesh()));
  out.upper.resize(n);
  std::vector<Index> seen(n, -1), &column = out.A.column;
  for (Index p = 0; p < n; ++p) {
    seen[p] = p;
    column.push_back(p);
    const auto begin = static_cast<Offset>(column.size());
    for (Offset k = around.first[p]; k < around.first[p + 1]; ++k)
      for (const Index q : nodes.of_element(around.element[k]))
        if (seen[q] != p) {
          seen[q] = p;
          column.push_back(q);
        }
    std::sort(column.begin() + begin, column.end());
    out.upper[p] = std::upper_bound(column.begin() + begin, column.end(), p) - column.begin();
    out.A.row.push_back(static_cast<Offset>(column.size()));
  }
  out.A.value.assign(column.size() * BlockMatrix<B>::block, 0.0);
  return out;
}

// entry += measure * (block of the hat functions with gradients g, row, and h, column)
template <int D>
inline void add_block(const Material<D>& material, double measure, const Point<D>& g, const Point<D>& h,
                      double* entry) {
  const double lambda = measure * material.lambda, mu = measure * material.mu, shear = mu * dot(g, h);
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) entry[i * D + j] += lambda * g[i] * h[j] + mu * g[j] * h[i];
    entry[i * D + i] += shear;
  }
}

// What hoop strains add to it: that of a basis function is `hoop` per radial displacement.
template <int D>
inline void add_hoop(const Material<D>& material, double measure, double hoop, const Point<D>& g, const Point<D>& h,
                     double* entry) {
  const double lambda = measure * material.lambda * hoop;
  for (int i = 0; i < D; ++i) {
    entry[i] += lambda * h[i];
    entry[i * D] += lambda * g[i];
  }
  entry[0] += (lambda + 2 * measure * material.mu * hoop) * hoop;
}

// Adds the diagonal blocks and those above the diagonal.
template <int D, int B>
void add_upper_half(const Nodes<D>& nodes, const Model<B>& model, Assembly<B>& out) {
  const Mesh<D>& mesh = nodes.mesh();
  const MaterialLaw<B> law(model);
  Material<B> material = law.constant() ? law.at({}) : Material<B>{};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    LinearElement<D> s = checked_element(mesh, mesh.elements[e], model.origin);
    s.measure *= mean_circumference<D>(model.plane, mesh, mesh.elements[e]);
    const double hoop = hoop_factor<D>(model.plane, mesh, mesh.elements[e]) / (D + 1);
    const auto node = nodes.of_element(e);
    if (!law.constant()) material = law.at(site_in(mesh, e, model.t));
    const auto add = [&](int a, int b, double* entry) {
      add_block<D>(material, s.measure, s.gradient[a], s.gradient[b], entry);
      if (hoop > 0) add_hoop<D>(material, s.measure, hoop, s.gradient[a], s.gradient[b], entry);
    };
    for (int a = 0; a <= D; ++a) {
      const Index p = node[a];
      add(a, a, out.A.at(out.A.row[p]));
      for (int b = a + 1; b <= D; ++b) {
        const Index q = node[b];
        if (p < q)
          add(a, b, out.entry(p, q));
        else
          add(b, a, out.entry(q, p));
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
BlockMatrix<B> stiffness(const Nodes<D>& nodes, const Model<B>& model) {
  if constexpr (B == 1) {
    return scalar_stiffness(nodes, model);
  } else {
    Assembly<B> out = pattern<D, B>(nodes);
    add_upper_half(nodes, model, out);
    mirror(out);
    return std::move(out.A);
  }
}

template BlockMatrix<1> stiffness(const Nodes<2>&, const Model<1>&);
template BlockMatrix<1> stiffness(const Nodes<3>&, const Model<1>&);
template BlockMatrix<2> stiffness(const Nodes<2>&, const Model<2>&);
template BlockMatrix<3> stiffness(const Nodes<3>&, const Model<3>&);

}  // namespace signorini
