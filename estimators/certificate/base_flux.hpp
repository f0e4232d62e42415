#pragma once
#include "core/solver/discrete_problem.hpp"
#include "estimators/certificate/bubbles.hpp"
#include "estimators/certificate/certificate.hpp"
#include "estimators/certificate/face_moments.hpp"

namespace signorini {

/// A flux near the true one, linear in each element, that equilibrated ones are made from: that of a function v, better
/// than u by its bubbles, and that of one more linear finite element function z that takes away what is then left of
/// the loads. Elastic bodies have the pressure lambda tr eps(v) of v averaged at the vertices, and z may be that of any
/// material: it is one that does not lock. (The stress of linear elements alone is constant in each, and all stresses
/// with tractions near it have the same mean there: too far off. Quadratic elements are in equilibrium with the loads
/// on the hat functions of their own mesh, and not on those of their children.)
template <int D, int B>
class BaseFlux {
 public:
  /// Keeps references.
  BaseFlux(const TrueProblem<D, B>& problem, const Model<B>& model, const Bubbles<D, B>& v);

  /// Finds z, roughly. Returns whether that worked.
  bool correct(const ContactForces<D, B>& contact, const LinearSolve<B>& solve);

  std::array<Gradient<D, B>, D + 1> operator()(Index e) const;

 private:
  void average_pressure();

  const TrueProblem<D, B>& problem_;
  const Model<B> softer_;
  const Bubbles<D, B>& v_;
  std::vector<double> pressure_;  // per vertex; empty: as it is in each element
  std::vector<double> z_;
  std::vector<Material<B>> material_;  // that of z
};

}  // namespace signorini
