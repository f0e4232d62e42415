#pragma once
#include <utility>

#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/fem/elements/nested.hpp"
#include "core/fem/elements/probe.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/recovery/contact.hpp"
#include "core/fem/recovery/error_norm.hpp"
#include "core/fem/recovery/rigid_gap.hpp"
#include "core/fem/recovery/stress.hpp"

/// What takes nodes, for meshes alone, whose nodes then are numbered as the vertices. Only tests may take that for
/// granted.
namespace signorini {

template <int D, int B>
Discretization<B> discretize(const Mesh<D>& mesh, const Model<B>& model) {
  return discretize<D, B>(Nodes<D>(mesh), model);
}
template <int D, int B>
Assembled renew(const Mesh<D>& mesh, const Model<B>& before, const Model<B>& model, Discretization<B>& last) {
  return renew<D, B>(Nodes<D>(mesh), before, model, last);
}
template <int D, int B>
BlockMatrix<B> stiffness(const Mesh<D>& mesh, const Model<B>& model) {
  return stiffness<D, B>(Nodes<D>(mesh), model);
}
template <int D, int B>
std::vector<double> load_vector(const Mesh<D>& mesh, const Model<B>& model,
                                std::vector<std::array<double, B>>* totals = nullptr) {
  return load_vector<D, B>(Nodes<D>(mesh), model, totals);
}
template <int D, int B>
std::vector<FixedDirections<B>> collect_fixes(const Mesh<D>& mesh, const Model<B>& model) {
  return collect_fixes<D, B>(Nodes<D>(mesh), model);
}
template <int D, int B>
std::vector<FixConflict> fix_conflicts(const Mesh<D>& mesh, const Model<B>& model) {
  return fix_conflicts<D, B>(Nodes<D>(mesh), model);
}
template <int D, int B>
ContactState<B> contact_state(const Mesh<D>& mesh, const Model<B>& model, const Discretization<B>& discretization,
                              const std::vector<double>& x) {
  return contact_state<D, B>(Nodes<D>(mesh), model, discretization, x);
}
template <int D, int B>
std::optional<DeformedContact> deformed_contact(const Mesh<D>& mesh, const Model<B>& model, Index obstacle,
                                                const ContactState<B>& state, const std::vector<double>& u) {
  return deformed_contact<D, B>(Nodes<D>(mesh), model, obstacle, state, u);
}
template <int D>
std::optional<StartDepth> start_depth(const Mesh<D>& mesh, const Model<D>& model, Index obstacle, bool everywhere) {
  return start_depth<D>(Nodes<D>(mesh), model, obstacle, everywhere);
}
template <int D>
Surface<D> surface(const Mesh<D>& mesh, std::vector<Index> faces) {
  return surface<D>(Nodes<D>(mesh), std::move(faces));
}
template <int D>
Surface<D> surface(const Mesh<D>& mesh) {
  return surface<D>(Nodes<D>(mesh));
}
template <int D>
std::vector<Stress> element_stress(const Mesh<D>& mesh, const Model<D>& model, const std::vector<double>& u) {
  return element_stress<D>(Nodes<D>(mesh), model, u);
}
template <int B, int D>
std::array<double, B> evaluate(const Mesh<D>& mesh, const Place<D>& place, const std::vector<double>& u) {
  return evaluate<B, D>(Nodes<D>(mesh), place, u);
}
template <int D, int B>
double energy_error(const Mesh<D>& mesh, const Model<B>& model, const std::vector<double>& u,
                    const ExactGradient<D, B>& exact) {
  return energy_error<D, B>(Nodes<D>(mesh), model, u, exact);
}
template <int D, int B>
double max_nodal_error(const Mesh<D>& mesh, const std::vector<double>& u, const ExactValue<D, B>& exact) {
  return max_nodal_error<D, B>(Nodes<D>(mesh), u, exact);
}
template <int D>
std::vector<Prolongation> prolongations(const MeshHierarchy<D>& hierarchy) {
  return prolongations<D>(hierarchy, nodes_of(hierarchy));
}

}  // namespace signorini
