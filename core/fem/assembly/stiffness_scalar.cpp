#include "core/fem/assembly/stiffness_scalar.hpp"

#include "core/fem/elements/checked_element.hpp"
#include "core/fem/elements/local_stiffness.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/fem/elements/symmetric_rows.hpp"
#include "core/fem/model/material.hpp"
#include "core/mesh/quadrature.hpp"

namespace signorini {
namespace {

template <int D>
class ScalarAssembler {
 public:
  ScalarAssembler(const Nodes<D>& nodes, const Model<1>& model)
      : nodes_(nodes),
        mesh_(nodes.mesh()),
        model_(model),
        law_(model),
        rows_(nodes.size(), static_cast<std::size_t>(nodes.size()) + 2 * estimated_pairs(nodes)) {}

  BlockMatrix<1> assemble() {
    if (nodes_.order() == 2)
      add(mesh_.families, node_pairs<element_nodes<D, 2>>(),
          [this](const Family<D>& v, std::size_t e) { return quadratic(v, e); });
    else if (mesh_.families.empty() || !mesh_.region.empty())
      add(mesh_.elements, simplex_edges<D>(), [this](const Simplex<D>& v, std::size_t e) {
        return element(v, mesh_.region.empty() ? -1 : mesh_.region[e]);
      });
    else
      add(mesh_.families, child_edges<D>(), [this](const Family<D>& v, std::size_t) { return family(v); });
    return rows_.take();
  }

 private:
  template <class Patches, class Ends, class Stiffness>
  void add(const Patches& patches, const Ends& ends, const Stiffness& stiffness) {
    for (std::size_t i = 0; i < patches.size(); ++i)
      for (const Index p : nodes_.of(patches[i])) rows_.announce(static_cast<Index>(i), p);
    for (std::size_t i = 0; i < patches.size(); ++i)
      rows_.add(static_cast<Index>(i), nodes_.of(patches[i]), ends, stiffness(patches[i], i));
  }

  ElementStiffness<D> element(const Simplex<D>& vertices, Index region = -1) const {
    const LinearElement<D> s = checked_element(mesh_, vertices, model_.origin);
    Site where;
    if (!law_.constant()) where = site<D>(centroid<D>(mesh_, vertices), model_.t);
    where.region = region;
    const double around = mean_circumference<D>(model_.plane, mesh_, vertices);
    return element_stiffness(s, around * s.measure * law_.at(where).diffusion);
  }

  using QuadraticStiffness = LocalStiffness<element_nodes<D, 2>, node_pairs<element_nodes<D, 2>>().size()>;
  QuadraticStiffness quadratic(const Family<D>& vertices, std::size_t e) const {
    const ElementMap<D, D, 2> map(mesh_, vertices);
    const bool simple = law_.constant() && model_.plane != Plane::axisymmetric;
    QuadraticStiffness out{};
    for (const auto& [barycentric, weight] : stiffness_rule<D, 2>(simple && !map.curved())) {
      const LinearElement<D> flat = checked_element(map, barycentric, model_.origin);
      const double measure = weight * flat.measure * circumference<D>(model_.plane, map(barycentric));
      Site where;
      if (!law_.constant()) where = site_in<D>(nodes_, e, map(barycentric), model_.t);
      add_stiffness(basis_gradients<2>(flat.gradient, barycentric), measure * law_.at(where).diffusion, out);
    }
    clear_vanishing(out, node_pairs<element_nodes<D, 2>>());
    return out;
  }

  FamilyStiffness<D> family(const Family<D>& vertices) const {
    if (law_.constant() && model_.plane != Plane::axisymmetric && is_straight(vertices)) {
      Simplex<D> father;
      std::copy_n(vertices.begin(), D + 1, father.begin());
      const LinearElement<D> s = linear_element(mesh_, father);
      if (s.measure > 0) [[likely]]
        return red_.children_of(element_stiffness(s, s.measure * law_.at({}).diffusion));
    }
    return child_by_child(vertices);
  }

  // Midpoints on curved surfaces have moved.
  bool is_straight(const Family<D>& vertices) const {
    constexpr auto ends = simplex_edges<D>();
    for (std::size_t k = 0; k < ends.size(); ++k)
      if (mesh_.points[vertices[D + 1 + k]] !=
          midpoint<D>(mesh_.points[vertices[ends[k][0]]], mesh_.points[vertices[ends[k][1]]]))
        return false;
    return true;
  }

  FamilyStiffness<D> child_by_child(const Family<D>& vertices) const {
    constexpr auto& children = RedRefinement<D>::children;
    constexpr auto edges = edges_of_children<D>();
    FamilyStiffness<D> out{};
    for (std::size_t child = 0; child < children.size(); ++child) {
      Simplex<D> corner;
      for (int a = 0; a <= D; ++a) corner[a] = vertices[children[child][a]];
      const ElementStiffness<D> one = element(corner);
      for (int a = 0; a <= D; ++a) out.diagonal[children[child][a]] += one.diagonal[a];
      for (std::size_t k = 0; k < one.edge.size(); ++k) out.edge[edges[child][k]] += one.edge[k];
    }
    return out;
  }

  const Nodes<D>& nodes_;
  const Mesh<D>& mesh_;
  const Model<1>& model_;
  const MaterialLaw<1> law_;
  const RedStiffness<D> red_;
  SymmetricRows rows_;
};

}  // namespace

template <int D>
BlockMatrix<1> scalar_stiffness(const Nodes<D>& nodes, const Model<1>& model) {
  return ScalarAssembler<D>(nodes, model).assemble();
}

template BlockMatrix<1> scalar_stiffness(const Nodes<2>&, const Model<1>&);
template BlockMatrix<1> scalar_stiffness(const Nodes<3>&, const Model<1>&);

}  // namespace signorini
