#pragma once
#include "core/solver/discrete_problem.hpp"
#include "estimators/certificate/bubbles.hpp"
#include "estimators/certificate/certificate.hpp"
#include "estimators/certificate/face_moments.hpp"

namespace signorini {

/// A stress near the true one, linear in each element, that equilibrated tractions are made from. That of the
/// displacement alone is constant in elements, and all stresses with tractions near it have the same mean there: too
/// far off. Better are three terms together: 2 mu eps(u + c) with bubbles c, a pressure lambda tr eps(u + c) averaged
/// at the vertices, and the stress of one more linear finite element function z that takes away what is then left of
/// the loads. z may be that of any material: it is one that does not lock.
template <int D>
class BaseStress {
 public:
  /// Keeps references.
  BaseStress(const TrueProblem<D, D>& problem, const Model<D>& model, const std::vector<double>& u,
             const Bubbles<D, D>& bubbles);

  /// Finds z, roughly. Returns whether that worked.
  bool correct(const Nodes<D>& nodes, const ContactForces<D, D>& contact, const LinearSolve<D>& solve);

  std::array<Gradient<D, D>, D + 1> operator()(Index e) const;

 private:
  Gradient<D, D> gradient_at_vertex(Index e, const Gradient<D, D>& bubble) const;

  const TrueProblem<D, D>& problem_;
  const Model<D> softer_;
  const std::vector<double>& u_;
  const Bubbles<D, D>& bubbles_;
  std::vector<double> pressure_;  // per vertex; empty: as it is in each element
  std::vector<double> z_;
  std::vector<Material<D>> material_;  // that of z
};

}  // namespace signorini
