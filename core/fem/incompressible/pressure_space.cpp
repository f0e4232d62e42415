#include "core/fem/incompressible/pressure_space.hpp"

#include <algorithm>
#include <map>

#include "core/fem/elements/checked_element.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/red_refinement.hpp"

namespace signorini {
namespace {

/// What gradients without divergence leave of the resistance of displacements, in mu: C A^-1 C' is between mass
/// matrices over lambda0 + 2 mu / D (bodies that breathe as a whole) and, by the inf-sup condition, several mu.
constexpr double resistance = 1.5;

/// The materials of a mesh, as its families name them, numbered from 0.
template <int D>
class Regions {
 public:
  explicit Regions(const Mesh<D>& mesh) : mesh_(mesh) {
    if (!mesh.family_region.empty()) largest_ = std::max<Index>(-1, *std::ranges::max_element(mesh.family_region));
  }
  /// Number of a node of a family, different for different materials.
  std::size_t key(Index vertex, std::size_t family) const {
    const Index region = mesh_.family_region.empty() ? -1 : mesh_.family_region[family];
    return static_cast<std::size_t>(region + 1) * mesh_.points.size() + static_cast<std::size_t>(vertex);
  }
  std::size_t keys() const { return static_cast<std::size_t>(largest_ + 2) * mesh_.points.size(); }

 private:
  const Mesh<D>& mesh_;
  Index largest_ = -1;
};

/// A pattern of rows from what each family couples.
template <class RowsOf, class ColumnsOf>
void find_pattern(std::size_t families, Index rows, Index columns, const RowsOf& rows_of, const ColumnsOf& columns_of,
                  std::vector<Offset>& row, std::vector<Index>& column) {
  std::vector<Offset> first(static_cast<std::size_t>(rows) + 1);
  for (std::size_t f = 0; f < families; ++f)
    for (const Index k : rows_of(f))
      if (k >= 0) ++first[k + 1];
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  std::vector<Offset> next(first.begin(), first.end() - 1);
  std::vector<Index> around(static_cast<std::size_t>(first.back()));
  for (std::size_t f = 0; f < families; ++f)
    for (const Index k : rows_of(f))
      if (k >= 0) around[next[k]++] = static_cast<Index>(f);
  std::vector<Index> seen(static_cast<std::size_t>(columns), -1);
  for (Index k = 0; k < rows; ++k) {
    const auto begin = static_cast<Offset>(column.size());
    for (Offset i = first[k]; i < first[k + 1]; ++i)
      for (const Index q : columns_of(around[i]))
        if (q >= 0 && seen[q] != k) {
          seen[q] = k;
          column.push_back(q);
        }
    std::sort(column.begin() + begin, column.end());
    row.push_back(static_cast<Offset>(column.size()));
  }
}

template <int D, int P>
class SpaceBuilder {
 public:
  SpaceBuilder(const Nodes<D>& nodes, const Model<D>& model)
      : nodes_(nodes), mesh_(nodes.mesh()), model_(model), law_(model), thermal_(model), regions_(mesh_) {}

  PressureSpace<D> build() {
    out_.kind = model_.pressure;
    number();
    const auto unknowns = [&](std::size_t f) { return distinct(f); };
    find_pattern(
        mesh_.families.size(), out_.size, nodes_.size(), unknowns,
        [&](Index f) { return nodes_.of(mesh_.families[f]); }, out_.row, out_.column);
    find_pattern(mesh_.families.size(), out_.size, out_.size, unknowns, unknowns, out_.mass_row, out_.mass_column);
    out_.value.assign(out_.column.size() * D, 0);
    out_.compliance.assign(out_.mass_column.size(), 0);
    out_.response.assign(out_.mass_column.size(), 0);
    for (std::size_t f = 0; f < mesh_.families.size(); ++f)
      if (out_.unknown[f][0] >= 0)
        each_point(f, law_.constant(), [&](const auto&... point) { add_point(f, point...); });
    return std::move(out_);
  }

  std::vector<double> thermal_volume(const PressureSpace<D>& space) const {
    std::vector<double> out;
    if (thermal_.none()) return out;
    out.resize(static_cast<std::size_t>(space.size));
    for (std::size_t f = 0; f < mesh_.families.size(); ++f) {
      if (space.unknown[f][0] < 0) continue;
      each_point(f, thermal_.constant(), [&](const Barycentric& at, double measure, const Point<D>& x, const auto&) {
        const double volume = measure * 3 * thermal_.at(site_of(f, x));
        for (int a = 0; a <= D; ++a) out[space.unknown[f][a]] += volume * at[a];
      });
    }
    return out;
  }

 private:
  static constexpr std::size_t family_nodes = element_nodes<D, 2>;
  using Barycentric = std::array<double, D + 1>;
  using Gradients = std::array<Point<D>, family_nodes>;

  Site site_of(std::size_t f, const Point<D>& x) const {
    Site s = site<D>(x, model_.t);
    if (!mesh_.family_region.empty()) s.region = mesh_.family_region[f];
    return s;
  }

  Index new_unknown(std::size_t f) {
    const Index region = mesh_.family_region.empty() ? -1 : mesh_.family_region[f];
    const auto at = static_cast<std::size_t>(region) + 1;
    material_.resize(std::max(material_.size(), at + 1), -1);
    if (material_[at] < 0) material_[at] = out_.materials++;
    out_.material.push_back(material_[at]);
    return out_.size++;
  }

  void number() {
    std::vector<Index> number(model_.pressure == Pressure::linear ? regions_.keys() : 0, -1);
    out_.unknown.resize(mesh_.families.size());
    for (std::size_t f = 0; f < mesh_.families.size(); ++f) {
      out_.unknown[f].fill(-1);
      const ElementMap<D, D, 2> map(mesh_, mesh_.families[f]);
      if (!has_pressure(model_, law_.at(site_of(f, map(barycentre<D>()))))) continue;
      if (model_.pressure == Pressure::constant) {
        out_.unknown[f].fill(new_unknown(f));
        continue;
      }
      for (int a = 0; a <= D; ++a) {
        Index& of_corner = number[regions_.key(mesh_.families[f][a], f)];
        if (of_corner < 0) of_corner = new_unknown(f);
        out_.unknown[f][a] = of_corner;
      }
    }
  }

  /// Each unknown of a family once.
  std::array<Index, D + 1> distinct(std::size_t f) const {
    std::array<Index, D + 1> out = out_.unknown[f];
    if (out_.kind == Pressure::constant) std::fill(out.begin() + 1, out.end(), -1);
    return out;
  }

  /// Calls use(barycentric, measure, x, divergence of each basis function times each unit vector).
  template <class Use>
  void each_point(std::size_t f, bool constant, const Use& use) const {
    if constexpr (P == 2) {
      const ElementMap<D, D, 2> map(mesh_, mesh_.families[f]);
      const bool simple = constant && !map.curved() && model_.plane != Plane::axisymmetric;
      for (const auto& [barycentric, weight] : stiffness_rule<D, 2>(simple)) {
        const LinearElement<D> flat = checked_element(map, barycentric, model_.origin);
        const Point<D> x = map(barycentric);
        Gradients divergence = basis_gradients<2>(flat.gradient, barycentric);
        const auto hoop = hoop_values<2, D>(model_.plane, x, barycentric);
        for (std::size_t b = 0; b < family_nodes; ++b) divergence[b][0] += hoop[b];
        use(barycentric, weight * flat.measure * circumference<D>(model_.plane, x), x, divergence);
      }
    } else {
      for (const auto& child : RedRefinement<D>::children) each_point_of_child(f, child, use);
    }
  }

  /// Where displacements are linear on the children.
  template <class Use>
  void each_point_of_child(std::size_t f, const std::array<int, D + 1>& child, const Use& use) const {
    Simplex<D> corner;
    for (int k = 0; k <= D; ++k) corner[k] = mesh_.families[f][child[k]];
    const LinearElement<D> flat = checked_element(mesh_, corner, model_.origin);
    Gradients divergence{};
    const double hoop = hoop_factor<D>(model_.plane, mesh_, corner) / (D + 1);
    for (int k = 0; k <= D; ++k) {
      divergence[child[k]] = flat.gradient[k];
      divergence[child[k]][0] += hoop;
    }
    for (const auto& [within, weight] : quadrature2<D>()) {
      Barycentric barycentric{};
      for (int k = 0; k <= D; ++k) {
        const Barycentric place = node_place<D>(child[k]);
        for (int a = 0; a <= D; ++a) barycentric[a] += within[k] * place[a];
      }
      const Point<D> x = combine<D>(mesh_, corner, within);
      use(barycentric, weight * flat.measure * circumference<D>(model_.plane, x), x, divergence);
    }
  }

  void add_point(std::size_t f, const Barycentric& barycentric, double measure, const Point<D>& x,
                 const Gradients& divergence) {
    const Material<D> material = law_.at(site_of(f, x));
    const double own = std::max(lambda_of_pressure(material), material.mu * least);
    const double with = of_displacements(material).lambda + resistance * material.mu;
    const auto nodes = nodes_.of(mesh_.families[f]);
    for (int a = 0; a <= D; ++a) {
      const Index k = out_.unknown[f][a];
      for (std::size_t b = 0; b < nodes.size(); ++b) {
        const Offset at = find(out_.row, out_.column, k, nodes[b]);
        for (int i = 0; i < D; ++i) out_.value[at * D + i] += measure * barycentric[a] * divergence[b][i];
      }
      for (int b = 0; b <= D; ++b) {
        const Offset at = find(out_.mass_row, out_.mass_column, k, out_.unknown[f][b]);
        const double product = measure * barycentric[a] * barycentric[b];
        out_.compliance[at] += product / own;
        out_.response[at] += product / with;
      }
    }
  }

  static Offset find(const std::vector<Offset>& row, const std::vector<Index>& column, Index k, Index q) {
    return std::lower_bound(column.begin() + row[k], column.begin() + row[k + 1], q) - column.begin();
  }

  static constexpr double least = 1e-3;  // of lambda over mu, where an element is partly hardly incompressible

  const Nodes<D>& nodes_;
  const Mesh<D>& mesh_;
  const Model<D>& model_;
  const MaterialLaw<D> law_;
  const ThermalStrain<D> thermal_;
  const Regions<D> regions_;
  std::vector<Index> material_;  // per region + 1
  PressureSpace<D> out_;
};

}  // namespace

template <int D>
PressureSpace<D> pressure_space(const Nodes<D>& nodes, const Model<D>& model) {
  return with_order(nodes, [&](auto order) { return SpaceBuilder<D, order>(nodes, model).build(); });
}

template <int D>
std::vector<double> thermal_volume(const Nodes<D>& nodes, const Model<D>& model, const PressureSpace<D>& space) {
  return with_order(nodes, [&](auto order) { return SpaceBuilder<D, order>(nodes, model).thermal_volume(space); });
}

template <int D>
std::vector<double> prolongate(const PressureSpace<D>& coarse, const Mesh<D>& coarse_mesh, const std::vector<double>& p,
                               const Refinement& refinement, const PressureSpace<D>& fine, const Mesh<D>& fine_mesh) {
  const Regions<D> before(coarse_mesh), now(fine_mesh);
  // At the nodes of the coarse families, which are the corners of the fine ones: the mean over the families around.
  std::vector<double> sum(before.keys()), count(sum.size());
  for (std::size_t f = 0; f < coarse_mesh.families.size(); ++f) {
    if (coarse.unknown[f][0] < 0) continue;
    for (std::size_t k = 0; k < element_nodes<D, 2>; ++k) {
      const std::size_t key = before.key(coarse_mesh.families[f][k], f);
      sum[key] += coarse.at(p, f, node_place<D>(k));
      ++count[key];
    }
  }
  std::vector<double> out(static_cast<std::size_t>(fine.size));
  for (std::size_t f = 0; f < fine_mesh.families.size(); ++f) {
    if (fine.unknown[f][0] < 0) continue;
    double mean = 0;
    for (int a = 0; a <= D; ++a) {
      const Index father = refinement.parents[fine_mesh.families[f][a]][0];
      const Index region = fine_mesh.family_region.empty() ? -1 : fine_mesh.family_region[f];
      const std::size_t key = static_cast<std::size_t>(region + 1) * coarse_mesh.points.size() + father;
      const double value = count[key] > 0 ? sum[key] / count[key] : 0;
      if (fine.kind == Pressure::linear) out[fine.unknown[f][a]] = value;
      mean += value / (D + 1);
    }
    if (fine.kind == Pressure::constant) out[fine.unknown[f][0]] = mean;
  }
  return out;
}

template PressureSpace<2> pressure_space(const Nodes<2>&, const Model<2>&);
template PressureSpace<3> pressure_space(const Nodes<3>&, const Model<3>&);
template std::vector<double> thermal_volume(const Nodes<2>&, const Model<2>&, const PressureSpace<2>&);
template std::vector<double> thermal_volume(const Nodes<3>&, const Model<3>&, const PressureSpace<3>&);
template std::vector<double> prolongate(const PressureSpace<2>&, const Mesh<2>&, const std::vector<double>&,
                                        const Refinement&, const PressureSpace<2>&, const Mesh<2>&);
template std::vector<double> prolongate(const PressureSpace<3>&, const Mesh<3>&, const std::vector<double>&,
                                        const Refinement&, const PressureSpace<3>&, const Mesh<3>&);

}  // namespace signorini
