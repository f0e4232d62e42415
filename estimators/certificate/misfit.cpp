#include "estimators/certificate/misfit.hpp"

#include <type_traits>

#include "core/base/dot.hpp"
#include "estimators/certificate/free_changes.hpp"
#include "estimators/certificate/linear_flux.hpp"
#include "estimators/certificate/stress_element.hpp"

namespace signorini {

template <int D, int B>
std::vector<double> Misfit<D, B>::evaluate(const FaceNumbers& values, FaceNumbers& gradient, bool whole) const {
  using Element = std::conditional_t<B == 1, LinearFlux<D>, StressElement<D>>;
  std::vector<double> out(problem_.element.size());
  gradient.assign(values.size(), 0);
  for (Index e = 0; e < problem_.elements(); ++e) {
    const Simplex<D>& v = problem_.mesh.elements[e];
    const auto rank = ranks<D>(v);
    const Index* faces = problem_.incidence.face.data() + Offset{e} * (D + 1);
    typename Element::FaceValues z;
    const auto each = [&](const auto& use) {
      for (int k = 0; k <= D; ++k) {
        const double sign = problem_.incidence.sides[faces[k]].element[0] == e ? 1 : -1;
        for (int a = 0, m = 0; a <= D; ++a)
          if (a != k) use(sign, faces[k], place_on_face(rank, k, a), z[k][m++]);
      }
    };
    each([&](double sign, Index face, int place, auto& here) {
      for (int i = 0; i < B; ++i) here[i] = sign * signorini::at<D, B>(values, face, place)[i];
    });
    std::array<Gradient<D, B>, D + 1> flux{};
    std::array<double, B> source{};
    if (whole) flux = flux_(e), source = problem_.source[e];
    const Element element(problem_.element[e], corners<D>(problem_.mesh.points, v));
    out[e] = element.misfit(problem_.material[e], flux, source, z);
    each([&](double sign, Index face, int place, auto& here) {
      for (int i = 0; i < B; ++i) signorini::at<D, B>(gradient, face, place)[i] += sign * here[i];
    });
  }
  return out;
}

namespace {

template <int D, int B>
void precondition(const TrueProblem<D, B>& problem, const FaceNumbers& gradient, FaceNumbers& z) {
  if constexpr (B == 1)
    around_edges(problem, gradient, z);
  else
    along_faces(problem, gradient, z);
}

}  // namespace

template <int D, int B>
std::vector<double> reduce_misfit(const TrueProblem<D, B>& problem, const Misfit<D, B>& misfit, int steps,
                                  FaceNumbers& values) {
  FaceNumbers gradient(values.size()), z(values.size()), direction(values.size()), bent(values.size());
  std::vector<double> of_element = misfit.at(values, gradient);
  double before = 0;
  for (int step = 0; step < steps; ++step) {
    precondition<D, B>(problem, gradient, z);
    const double now = dot(gradient, z);
    if (!(now > 0)) break;
    const double keep = step > 0 ? now / before : 0;
    before = now;
    for (std::size_t k = 0; k < z.size(); ++k) direction[k] = keep * direction[k] - z[k];
    misfit.along(direction, bent);
    const double curvature = dot(direction, bent);
    if (!(curvature > 0)) break;
    const double length = -dot(gradient, direction) / curvature;
    for (std::size_t k = 0; k < z.size(); ++k) {
      values[k] += length * direction[k];
      gradient[k] += length * bent[k];
    }
  }
  return steps > 0 ? misfit.at(values, gradient) : of_element;
}

#define SIGNORINI_INSTANTIATE(D, B) \
  template std::vector<double> reduce_misfit(const TrueProblem<D, B>&, const Misfit<D, B>&, int, FaceNumbers&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
