#pragma once
#include "estimators/certificate/bubbles.hpp"
#include "estimators/certificate/face_moments.hpp"

namespace signorini {

/// Half of |grad v - A^-1 q|^2_A for a flux q in equilibrium, given by its values at the faces: scalars by Brezzi,
/// Douglas and Marini's flux of lowest order, elastic bodies by Johnson and Krizek's symmetric stress. Quadratic in the
/// values.
template <int D, int B>
class Misfit {
 public:
  /// @param flux that of v
  Misfit(const TrueProblem<D, B>& problem, const ElementFlux<D, B>& flux) : problem_(problem), flux_(flux) {}

  /// Per element; `gradient` becomes that by the values.
  std::vector<double> at(const FaceNumbers& values, FaceNumbers& gradient) const {
    return evaluate(values, gradient, true);
  }
  /// The second derivative along a direction.
  void along(const FaceNumbers& direction, FaceNumbers& out) const { evaluate(direction, out, false); }

 private:
  /// @param whole with the flux of v and the loads; else the quadratic part alone
  std::vector<double> evaluate(const FaceNumbers& values, FaceNumbers& gradient, bool whole) const;

  const TrueProblem<D, B>& problem_;
  const ElementFlux<D, B>& flux_;
};

/// Some steps of conjugate gradients for the least misfit, among changes that keep the equilibrium. Returns it, per
/// element.
template <int D, int B>
std::vector<double> reduce_misfit(const TrueProblem<D, B>& problem, const Misfit<D, B>& misfit, int steps,
                                  FaceNumbers& values);

}  // namespace signorini
