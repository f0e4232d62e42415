#include "estimators/certificate/base_flux.hpp"

#include <algorithm>

#include "core/fem/assembly/discretize.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {
namespace {

constexpr double most_poisson = 0.3;

double softer_poisson(double poisson) { return std::min(poisson, most_poisson); }

/// The same shear modulus, and a Poisson ratio of no more than 0.3. Nothing is loaded, heated or in contact; what
/// was prescribed is zero.
template <int B>
Model<B> softer(const Model<B>& model) {
  Model<B> out = model;
  const Field young = model.young, poisson = model.poisson;
  out.poisson = Field([poisson](const Site& x) { return softer_poisson(poisson(x)); }, "softer", "estimate");
  out.young =
      Field([young, poisson](const Site& x) { return young(x) * (1 + softer_poisson(poisson(x))) / (1 + poisson(x)); },
            "softer", "estimate");
  if (const auto nu = poisson.constant()) out.poisson = softer_poisson(*nu);
  if (const auto E = young.constant(); E && poisson.constant())
    out.young = *E * (1 + softer_poisson(*poisson.constant())) / (1 + *poisson.constant());
  out.loads.clear();
  out.expansion = 0;
  out.obstacles.clear();
  out.pressure = Pressure::none;
  for (Fix<B>& fix : out.fixes)
    for (std::optional<Field>& value : fix.value)
      if (value) value = Field(0.0);
  return out;
}

}  // namespace

template <int D, int B>
BaseFlux<D, B>::BaseFlux(const TrueProblem<D, B>& problem, const Model<B>& model, const Bubbles<D, B>& v)
    : problem_(problem), softer_(softer(model)), v_(v) {
  if constexpr (B == D)
    if (MaterialLaw<B>(model).constant()) average_pressure();  // pressures jump where materials do
}

template <int D, int B>
void BaseFlux<D, B>::average_pressure() {
  pressure_.assign(problem_.mesh.points.size(), 0);
  std::vector<double> volume(pressure_.size());
  for (Index e = 0; e < problem_.elements(); ++e) {
    const auto gradient = v_.gradients(e);
    const double measure = problem_.element[e].measure;
    for (int a = 0; a <= D; ++a) {
      const Index p = problem_.mesh.elements[e][a];
      if constexpr (B == D)
        for (int i = 0; i < D; ++i) pressure_[p] += measure * problem_.material[e].lambda * gradient[a][i][i];
      volume[p] += measure;
    }
  }
  for (std::size_t p = 0; p < pressure_.size(); ++p) pressure_[p] /= volume[p];
}

template <int D, int B>
std::array<Gradient<D, B>, D + 1> BaseFlux<D, B>::operator()(Index e) const {
  auto s = v_.gradients(e);
  const Simplex<D>& v = problem_.mesh.elements[e];
  Material<B> material = problem_.material[e];
  if constexpr (B == D)
    if (!pressure_.empty()) material.lambda = 0;
  Gradient<D, B> of_z{};
  if (!z_.empty()) of_z = flux(material_[e], gradient<D, B>(problem_.element[e].gradient, v, z_));
  for (int a = 0; a <= D; ++a) {
    s[a] = flux(material, s[a]);
    add(1, of_z, s[a]);
    for (int i = 0; i < B && !pressure_.empty(); ++i) s[a][i][i] += pressure_[v[a]];
  }
  return s;
}

template <int D, int B>
bool BaseFlux<D, B>::correct(const ContactForces<D, B>& contact, const LinearSolve<B>& solve) {
  std::vector<double> force(problem_.mesh.points.size() * B);
  for (Index e = 0; e < problem_.elements(); ++e) {
    const auto residual = element_residuals<D, B>(problem_, e, (*this)(e), contact);
    for (int a = 0; a <= D; ++a)
      for (int i = 0; i < B; ++i) force[Offset{problem_.mesh.elements[e][a]} * B + i] -= residual[a][i];
  }
  for (std::size_t n = 0; n < problem_.outer.size(); ++n) {
    const auto v = face_vertices<D>(problem_.mesh, problem_.incidence.sides[problem_.outer[n].face]);
    for (int k = 0; k < D; ++k)
      for (int i = 0; i < B; ++i)
        force[Offset{v[k]} * B + i] +=
            problem_.outer[n].load[k][i] + (contact.on_face.empty() ? 0 : contact.on_face[n][k][i]);
  }
  DiscreteProblem<B> problem = discretize<D, B>(problem_.linear, softer_).problem;
  problem.b = local_forces(problem, force);
  for (std::size_t p = 0; p < problem.fixed.size(); ++p)
    for (int k = 0; k < B; ++k)
      if (problem.fixed[p] >> k & 1u) problem.b[p * B + static_cast<std::size_t>(k)] = 0;
  std::vector<double> x;
  if (!solve(problem, x)) return false;
  z_ = to_global(problem, std::move(x));
  const MaterialLaw<B> law(softer_);
  for (std::size_t e = 0; e < problem_.element.size(); ++e)
    material_.push_back(law.at(law.constant() ? Site{} : site_in<D>(problem_.mesh, e, softer_.t)));
  return true;
}

template class BaseFlux<2, 1>;
template class BaseFlux<3, 1>;
template class BaseFlux<2, 2>;
template class BaseFlux<3, 3>;

}  // namespace signorini
