#include <algorithm>

#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/stiffness_scalar.hpp"
#include "core/fem/elements/checked_element.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/fem/model/material.hpp"
#include "core/mesh/quadrature.hpp"

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

// entry += measure * (block of the basis functions with gradients g, row, and h, column)
template <int D>
inline void add_block(const Material<D>& material, double measure, const Point<D>& g, const Point<D>& h,
                      double* entry) {
  const double lambda = measure * material.lambda, mu = measure * material.mu, shear = mu * dot(g, h);
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) entry[i * D + j] += lambda * g[i] * h[j] + mu * g[j] * h[i];
    entry[i * D + i] += shear;
  }
}

// What hoop strains add to it: those of the basis functions are `row` and `column` per radial displacement.
template <int D>
inline void add_hoop(const Material<D>& material, double measure, double row, double column, const Point<D>& g,
                     const Point<D>& h, double* entry) {
  const double lambda = measure * material.lambda;
  for (int i = 0; i < D; ++i) {
    entry[i] += lambda * row * h[i];
    entry[i * D] += lambda * column * g[i];
  }
  entry[0] += (lambda + 2 * measure * material.mu) * row * column;
}

// An element at the points of a rule.
template <int D, int B, int P>
class ElementPoints {
 public:
  ElementPoints(const Nodes<D>& nodes, const Model<B>& model)
      : nodes_(nodes), model_(model), law_(model), axisymmetric_(D == 2 && model.plane == Plane::axisymmetric) {
    if (law_.constant()) material_.fill(own_part(law_.at({}), law_.at({})));
  }

  void move_to(std::size_t e) {
    const auto& vertices = nodes_.template elements<P>()[e];
    const ElementMap<D, D, P> map(nodes_.mesh(), vertices);
    const auto rule = stiffness_rule<D, P>(law_.constant() && !map.curved() && !axisymmetric_);
    size_ = rule.size();
    for (std::size_t q = 0; q < size_; ++q) {
      const auto& [barycentric, weight] = rule[q];
      const LinearElement<D> flat = checked_element(map, barycentric, model_.origin);
      measure_[q] = P == 1 ? flat.measure : weight * flat.measure;
      gradient_[q] = basis_gradients<P>(flat.gradient, barycentric);
      if (P == 2 && axisymmetric_) {
        const Point<D> x = map(barycentric);
        measure_[q] *= circumference<D>(model_.plane, x);
        hoop_[q] = hoop_values<P, D>(model_.plane, x, barycentric);
      }
      if (law_.constant()) continue;
      const Site where =
          P == 1 ? site_in(nodes_.mesh(), e, model_.t) : site_in<D>(nodes_, e, map(barycentric), model_.t);
      material_[q] = own_part(law_.at(where), P == 1 ? law_.at(where) : at_centroid(e, map));
    }
    if constexpr (P == 1) {
      measure_[0] *= mean_circumference<D>(model_.plane, nodes_.mesh(), vertices);
      hoop_[0].fill(hoop_factor<D>(model_.plane, nodes_.mesh(), vertices) / (D + 1));
    }
  }

  // Adds the block of the element's basis functions a, row, and b, column.
  void add_block(std::size_t a, std::size_t b, double* entry) const {
    for (std::size_t q = 0; q < size_; ++q)
      signorini::add_block<D>(material_[q], measure_[q], gradient_[q][a], gradient_[q][b], entry);
    for (std::size_t q = 0; axisymmetric_ && q < size_; ++q)
      add_hoop<D>(material_[q], measure_[q], hoop_[q][a], hoop_[q][b], gradient_[q][a], gradient_[q][b], entry);
  }

 private:
  static constexpr std::size_t most = most_stiffness_points<D, P>;

  Material<B> at_centroid(std::size_t e, const ElementMap<D, D, P>& map) const {
    return law_.at(site_in<D>(nodes_, e, map(barycentre<D>()), model_.t));
  }
  // Of an element's material, with that at its centroid.
  Material<B> own_part(const Material<B>& material, const Material<B>& of_element) const {
    return has_pressure(model_, of_element) ? of_displacements(material) : material;
  }

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  const MaterialLaw<B> law_;
  const bool axisymmetric_;
  std::size_t size_ = 0;
  std::array<double, most> measure_;
  std::array<std::array<double, element_nodes<D, P>>, most> hoop_;  // of axisymmetric bodies
  std::array<std::array<Point<D>, element_nodes<D, P>>, most> gradient_;
  std::array<Material<B>, most> material_;
};

// Adds the diagonal blocks and those above the diagonal.
template <int D, int B, int P>
void add_upper_half(const Nodes<D>& nodes, const Model<B>& model, Assembly<B>& out) {
  const auto& elements = nodes.template elements<P>();
  ElementPoints<D, B, P> element(nodes, model);
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
