#include "core/fem/recovery/rigid_motion.hpp"

#include <algorithm>

#include "core/fem/elements/element.hpp"

namespace signorini {
namespace {

/// The force on a component that is prescribed; nothing where it is free.
template <int B>
std::optional<double> reaction(const Discretization<B>& discretization, Index p, int component,
                               const std::vector<double>& x) {
  if (!(discretization.problem.fixed[p] >> component & 1u)) return {};
  double along[B] = {};
  along[component] = 1;
  return discretization.prescribed.force(discretization.prescribed.at(p), along, x);
}

/// Of a body of revolution: what holds the nodes of a part but the first carrier on their circles. They move with that
/// one along the axis alone.
template <int B>
double radial_rest(const Discretization<B>& discretization, const RigidNodes<B>& part, const std::vector<double>& x) {
  double sum = 0;
  for (const Index p : part.nodes)
    if (p != part.carriers[0]) sum += reaction(discretization, p, 0, x).value_or(0);
  return sum;
}

}  // namespace

template <int B>
std::vector<RigidMotion<B>> rigid_motions(const Model<B>& model, const Discretization<B>& discretization,
                                          const std::vector<double>& x) {
  std::vector<RigidMotion<B>> out;
  if constexpr (B > 1) {
    if (!discretization.pairs) return out;
    for (std::size_t k = 0; k < model.rigid.size(); ++k) {
      const RigidNodes<B>& part = discretization.pairs->rigid[k];
      const Site at = site<B>(part.point, model.t);
      RigidMotion<B>& motion = out.emplace_back();
      motion.point = part.point;
      const auto [shift, turn, left] = part.carriers;
      for (int i = 0; i < B; ++i) {
        motion.displacement[i] = x[Offset{shift} * B + i];
        const std::optional<double> held = reaction(discretization, shift, i, x);
        (held ? motion.reaction : motion.applied)[i] = held ? *held : model.rigid[k].force[i](at);
      }
      if (model.plane == Plane::axisymmetric) motion.reaction[0] += radial_rest(discretization, part, x);
      for (int i = 0; i < RigidPart<B>::rotations && turn >= 0; ++i) {
        motion.rotation[i] = x[Offset{turn} * B + i] / part.length;
        const std::optional<double> held = reaction(discretization, turn, i, x);
        motion.torque[i] = held ? *held * part.length : model.rigid[k].torque[i](at);
      }
    }
  }
  return out;
}

template std::vector<RigidMotion<1>> rigid_motions(const Model<1>&, const Discretization<1>&,
                                                   const std::vector<double>&);
template std::vector<RigidMotion<2>> rigid_motions(const Model<2>&, const Discretization<2>&,
                                                   const std::vector<double>&);
template std::vector<RigidMotion<3>> rigid_motions(const Model<3>&, const Discretization<3>&,
                                                   const std::vector<double>&);

}  // namespace signorini
