#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/fem/elements/probe.hpp"
#include "core/fem/pairs/slave_choice.hpp"
#include "core/fem/recovery/contact.hpp"
#include "core/fem/recovery/counterforces.hpp"
#include "core/fem/recovery/forces.hpp"
#include "core/fem/recovery/master_side.hpp"
#include "core/fem/recovery/rigid_gap.hpp"
#include "core/fem/recovery/rigid_motion.hpp"
#include "core/fem/recovery/ties.hpp"
#include "core/io/warning.hpp"
#include "driver/levels/nested_solver.hpp"
#include "driver/scene/symmetry.hpp"

namespace signorini {

/// A solution in the user's terms, on the finest mesh.
template <int D, int B>
struct Results {
  std::vector<double> u;  ///< global coordinates, B per node
  ContactState<B> contact;
  Forces<B> forces;
  std::vector<std::vector<double>> moments, spring_moments;  ///< of fixes and springs, see ForceReport
  std::vector<std::optional<DeformedContact>> deformed;      ///< per obstacle of the model
  std::vector<double> between_nodes;                         ///< likewise, see violation_between_nodes()
  std::vector<double> pressure;                              ///< of NestedSolver::pressure_space()
  std::vector<RigidMotion<B>> rigid;                         ///< as those of the model
  std::vector<TieForce<B>> ties;                             ///< tie_forces()
  std::vector<BoltState> bolts;                              ///< of each tie with pretension
  std::vector<NodalForce<B>> counterforces;                  ///< see there
  std::vector<ContactNode<B>> masters;                       ///< master_side()
  std::vector<SlaveChoice> slaves;                           ///< per obstacle of the model
  std::vector<Point<B>> shift;                               ///< of slaves, see NestedSolver
  JointLoad<B> joints;                                       ///< see Solution
  ConditionsAcross across{};  ///< planes of symmetry; all else is of the part that is meshed
};

/// @param x the solution in local coordinates
/// @param pressure of NestedSolver::pressure_space()
/// @param slaves choose_slaves() of the model; none: of each obstacle the first body is
template <int D, int B>
Results<D, B> results(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
                      std::vector<double> x, std::vector<double> pressure, std::vector<SlaveChoice> slaves,
                      std::vector<Point<B>> shift, JointLoad<B> joints = {});
template <int D, int B>
Results<D, B> results(const Nodes<D>& nodes, const Model<B>& model, const Solution<B>& solution) {
  return results<D, B>(nodes, model, solution.discretization, solution.x, solution.pressure, {}, {}, solution.joints);
}

/// Probes with the places where they lie.
template <int D>
struct Probes {
  std::vector<std::string> names;
  std::vector<Place<D>> places;
  std::vector<Planes> beyond;  ///< per probe the planes of symmetry on whose other side it is; places are images then
};

/// Those of a body; Error(Exit::input) for one outside it.
template <int D>
Probes<D> locate_probes(const Mesh<D>& mesh, const Scene& scene, std::size_t body = 0);

/// What the user is told, with the scene's numbers of fixes, loads and obstacles.
template <int D, int B>
StepReport step_report(const Scene& scene, const Nodes<D>& nodes, const Probes<D>& probes, const Results<D, B>& results,
                       double t, const Summary& summary, std::size_t body = 0);

/// What is known beforehand to spoil the result, seen on the coarsest mesh.
template <int D>
Warnings scene_warnings(const Scene& scene, const Mesh<D>& mesh, std::size_t body = 0);

/// Fixes that contradict each other, one sentence per pair, and expressions that cut through faces of the coarsest
/// mesh.
template <int D, int B>
Warnings model_warnings(const Scene& scene, const Nodes<D>& nodes, const Model<B>& model, std::size_t body = 0);

}  // namespace signorini
