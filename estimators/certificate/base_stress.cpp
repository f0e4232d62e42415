#include "estimators/certificate/base_stress.hpp"

#include <algorithm>

#include "core/fem/assembly/discretize.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {
namespace {

constexpr double most_poisson = 0.3;

double softer_poisson(double poisson) { return std::min(poisson, most_poisson); }

/// The same shear modulus, and a Poisson ratio of no more than 0.3. Nothing is loaded or in contact; what was
/// prescribed is zero.
template <int D>
Model<D> softer(const Model<D>& model) {
  Model<D> out = model;
  const Field young = model.young, poisson = model.poisson;
  out.poisson = Field([poisson](const Site& x) { return softer_poisson(poisson(x)); }, "softer", "estimate");
  out.young =
      Field([young, poisson](const Site& x) { return young(x) * (1 + softer_poisson(poisson(x))) / (1 + poisson(x)); },
            "softer", "estimate");
  if (const auto nu = poisson.constant()) out.poisson = softer_poisson(*nu);
  if (const auto E = young.constant(); E && poisson.constant())
    out.young = *E * (1 + softer_poisson(*poisson.constant())) / (1 + *poisson.constant());
  out.loads.clear();
  out.obstacles.clear();
  out.pressure = Pressure::none;
  for (Fix<D>& fix : out.fixes)
    for (std::optional<Field>& value : fix.value)
      if (value) value = Field(0.0);
  return out;
}

template <int D>
double trace(const Gradient<D, D>& g) {
  double sum = 0;
  for (int i = 0; i < D; ++i) sum += g[i][i];
  return sum;
}

}  // namespace

template <int D>
BaseStress<D>::BaseStress(const TrueProblem<D, D>& problem, const Model<D>& model, const std::vector<double>& u,
                          const Bubbles<D, D>& bubbles)
    : problem_(problem), softer_(softer(model)), u_(u), bubbles_(bubbles) {
  if (!MaterialLaw<D>(model).constant()) return;  // pressures jump where materials do
  pressure_.assign(problem.mesh.points.size(), 0);
  std::vector<double> volume(pressure_.size());
  for (Index e = 0; e < problem.elements(); ++e) {
    const auto H = bubbles_.gradients(e);
    const double measure = problem.element[e].measure, lambda = problem.material[e].lambda;
    for (int a = 0; a <= D; ++a) {
      const Index p = problem.mesh.elements[e][a];
      pressure_[p] += measure * lambda * trace<D>(gradient_at_vertex(e, H[a]));
      volume[p] += measure;
    }
  }
  for (std::size_t p = 0; p < pressure_.size(); ++p) pressure_[p] /= volume[p];
}

template <int D>
Gradient<D, D> BaseStress<D>::gradient_at_vertex(Index e, const Gradient<D, D>& bubble) const {
  Gradient<D, D> g = gradient<D, D>(problem_.element[e].gradient, problem_.mesh.elements[e], u_);
  add(1, bubble, g);
  return g;
}

template <int D>
std::array<Gradient<D, D>, D + 1> BaseStress<D>::operator()(Index e) const {
  auto s = bubbles_.gradients(e);
  const Simplex<D>& v = problem_.mesh.elements[e];
  Material<D> material = problem_.material[e];
  if (!pressure_.empty()) material.lambda = 0;
  Gradient<D, D> of_z{};
  if (!z_.empty()) of_z = flux(material_[e], gradient<D, D>(problem_.element[e].gradient, v, z_));
  for (int a = 0; a <= D; ++a) {
    s[a] = flux(material, gradient_at_vertex(e, s[a]));
    add(1, of_z, s[a]);
    for (int i = 0; i < D && !pressure_.empty(); ++i) s[a][i][i] += pressure_[v[a]];
  }
  return s;
}

template <int D>
bool BaseStress<D>::correct(const Nodes<D>& nodes, const ContactForces<D, D>& contact, const LinearSolve<D>& solve) {
  std::vector<double> force(problem_.mesh.points.size() * D);
  for (Index e = 0; e < problem_.elements(); ++e) {
    const auto residual = element_residuals<D, D>(problem_, e, (*this)(e), contact);
    for (int a = 0; a <= D; ++a)
      for (int i = 0; i < D; ++i) force[Offset{problem_.mesh.elements[e][a]} * D + i] -= residual[a][i];
  }
  for (std::size_t n = 0; n < problem_.outer.size(); ++n) {
    const auto v = face_vertices<D>(problem_.mesh, problem_.incidence.sides[problem_.outer[n].face]);
    for (int k = 0; k < D; ++k)
      for (int i = 0; i < D; ++i)
        force[Offset{v[k]} * D + i] +=
            problem_.outer[n].load[k][i] + (contact.on_face.empty() ? 0 : contact.on_face[n][k][i]);
  }
  DiscreteProblem<D> problem = discretize<D, D>(nodes, softer_).problem;
  problem.b = local_forces(problem, force);
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (int k = 0; k < D; ++k)
      if (problem.fixed[p] >> k & 1u) problem.b[p * D + static_cast<std::size_t>(k)] = 0;
  std::vector<double> x;
  if (!solve(problem, x)) return false;
  z_ = to_global(problem, std::move(x));
  const MaterialLaw<D> law(softer_);
  for (std::size_t e = 0; e < problem_.element.size(); ++e)
    material_.push_back(law.at(law.constant() ? Site{} : site_in<D>(problem_.mesh, e, softer_.t)));
  return true;
}

template class BaseStress<2>;
template class BaseStress<3>;

}  // namespace signorini
