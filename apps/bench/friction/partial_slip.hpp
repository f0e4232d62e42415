#pragma once
#include <string>
#include <vector>

namespace signorini::bench {

/// A step beside Cattaneo's and Mindlin's theory for the same forces. Lengths and forces are those of the scene.
struct PartialSlipStep {
  double normal = 0, tangential = 0;  ///< forces on the body, the latter as it pulls
  double contact = 0, contact_in_theory = 0;
  double stick = 0, stick_in_theory = 0;  ///< radii; computed ones from the areas of the nodes
  /// Of the tangential traction along the force, in parts of the largest one before the force turned: the root of the
  /// mean square over the contact, the largest difference at a node, and at a node more than two spacings away from
  /// where sticking and contact end, for the traction's slope is infinite there. Of the recovered one, and of force
  /// over area.
  double mean_error = 0, largest_error = 0, largest_inside = 0;
  double nodal_mean_error = 0, nodal_largest_error = 0;
  /// The same mean of the traction across the force, which the theory neglects.
  double across = 0;
  double dissipated = 0;  ///< since the first step
  int nodes = 0, iterations = 0;
};

/// A whole scene.
struct PartialSlip {
  double unknowns = 0, seconds = 0, limit = 0;  ///< limit: of the tangential force, friction times the pressing force
  std::vector<PartialSlipStep> steps;           ///< the first one presses, without friction
  /// Of the loop from the first turn to the end: what the report has, what force and displacement of the steps enclose
  /// by the trapezium rule, and the closed form.
  double dissipated = 0, enclosed = 0, loop = 0;
};

/// partial_slip_2d.toml or partial_slip_3d.toml, changed.
struct PartialSlipScene {
  int dimension = 2;
  int refinements = 3;
  bool turns = true;                     ///< the whole loop; else two steps, one that presses and one that loads
  std::vector<std::string> overrides{};  ///< others, as `--set` takes them
};

/// Error(Exit::not_converged) where a step fails.
PartialSlip solve_partial_slip(const PartialSlipScene& scene);

/// The tables of docs/measured/friction.md.
void print_partial_slip(bool quick);

}  // namespace signorini::bench
