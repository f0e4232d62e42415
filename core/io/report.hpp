#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/io/estimate_report.hpp"
#include "core/io/warning.hpp"
#include "core/mesh/mesh.hpp"
#include "core/solver/summary.hpp"

namespace signorini {

/// Two bodies that touch each other.
struct PairReport {
  std::string slave, master;
  std::string reason;  ///< why this one is the slave
  /// What the obstacle exerts on the second body, and its moment about ContactReport::moment_about. The forces on both
  /// sum to zero up to rounding; moments do as far as nodes on both sides are in the same places.
  std::vector<double> force, moment;
};

/// A bolt whose shank is cut, and pulled together there.
struct BoltReport {
  double force = 0;       ///< that it pulls by
  double shortening = 0;  ///< by which the sides of the cut are pulled into each other
  bool locked = false;    ///< it keeps its length, and the force is what comes of that
};

/// What one obstacle does to the body it acts on.
struct ContactReport {
  int obstacle = 0;           ///< number of the scene's [[obstacle]], from 0
  std::string body;           ///< that it acts on
  Index nodes = 0;            ///< vertices in contact
  Index open_nodes = 0;       ///< those it may reach besides
  double area = 0;            ///< measure of the contact (or coincidence) set; a length in 2D
  double radius = 0;          ///< of a disk of that area; in 2D half the length
  std::vector<double> force;  ///< exerted on the body, one entry per unknown of a vertex
  double max_pressure = 0;
  bool resolved = true;                                ///< nodes enough for pressures, see recover_pressure()
  bool peaks_at_edge = false;                          ///< likewise
  Index slip_nodes = 0, stick_nodes = 0;               ///< of those in contact, where there is friction
  std::vector<double> normal_force, tangential_force;  ///< the parts of `force` along the obstacle's normal, and across
  /// Of an elastic body: of `force` about the point `moment_about`, with the undeformed positions: about the z-axis in
  /// 2D, else three entries.
  std::vector<double> moment, moment_about;
  std::vector<double> motion;        ///< of the point `moment_about` since t = 0, from where friction counts
  double dissipated_in_step = 0;     ///< work of friction, not negative
  double dissipated = 0;             ///< the same since the first step
  std::vector<double> displacement;  ///< mean of the surface that it may reach, one entry per unknown of a vertex
  Index undetermined_nodes = 0;   ///< of those in contact, held by a fix along the obstacle's normal, see ContactNode
  double undetermined_force = 0;  ///< sum of what presses there
  /// Of the deformed boundary against the true obstacle: the deepest vertex inside it, the farthest one off it where
  /// contact is claimed, and the largest displacement at these; NaN where the obstacle could not tell.
  double largest_penetration = 0, largest_opening = 0, largest_displacement = 0;
  double depth = 0;                      ///< what contact flattens, see DeformedContact
  double off = 0;                        ///< likewise
  bool over_edge = false;                ///< of the larger of these: where an edge of the obstacle is
  Index beyond_nodes = 0;                ///< those in contact that the other body is no longer in front of
  double penetration_between_nodes = 0;  ///< see violation_between_nodes(); NaN where it is not measured
  std::optional<PairReport> pair{};      ///< nothing where it acts on one body
  bool tied = false;  ///< a tie: its nodes are held together, and count as in contact; there are no pressures
  std::optional<BoltReport> bolt{};  ///< of a tie with pretension
};

/// A total force on the body it acts on, one entry per unknown of a vertex.
struct ForceReport {
  int number = 0;  ///< of the scene's [[load]], [[fix]] or [[spring]], from 0
  std::vector<double> force;
  /// Of a fix or a spring of an elastic body, about the origin, with the undeformed positions: about the z-axis in 2D,
  /// else three entries; empty for a body of revolution, of which moments cancel.
  std::vector<double> moment = {};
  std::optional<double> open_area = {};  ///< of a load with `where_open`: what it acts on
};

/// How a rigid part has moved, and what moves it.
struct RigidReport {
  int number = 0;  ///< of the scene's [[rigid]], from 0
  std::vector<double> point, displacement, rotation;
  std::vector<double> force, torque;  ///< on the part, about the point: applied, or needed for what is prescribed
};

/// All that acts on one body: the totals of loads, of fixes and springs, and of obstacles. They sum to zero but for the
/// algebraic error.
struct BalanceReport {
  std::string body;
  std::vector<double> applied, reactions, contact;

  std::vector<double> sum() const;
};

/// The solve of one body.
struct BodyReport {
  std::string name;
  Summary summary;
  bool axisymmetric = false;  ///< forces, areas and energies are those of the whole body
  Index axis_nodes = 0;       ///< held on the axis, where the radial displacement is zero
  /// Planes of symmetry, "x = 0". Forces, areas and energies are those of the whole body, which consists of so many
  /// copies of what is meshed; numbers of nodes and unknowns are those of one.
  std::vector<std::string> symmetry = {};
  int copies = 1;
  int order = 1;              ///< of its elements
  bool order_chosen = false;  ///< by the program, and not by the scene
};

/// "quadratic (order 2, chosen by auto)"
std::string elements_text(int order, bool chosen);

/// The solution at a point.
struct ProbeReport {
  std::string name, body;
  std::vector<double> value;  ///< one entry per unknown of a vertex
};

struct PluginReport {
  std::string id, file, version;
};

/// How often something was computed, over all levels and steps.
struct Assemblies {
  int stiffness = 0, load = 0;
  int constraints = 0;  ///< prescribed values, bounds and frames
  int hierarchies = 0;  ///< choices of levels by the matrix
};

/// Seconds spent, and on what.
struct Times {
  double mesh = 0, assemble = 0, setup = 0, solve = 0, output = 0, total = 0;
  Assemblies assemblies;
};

/// One quasi-static step, or part of one.
struct StepReport {
  int step = 1;            ///< number of the scene's step, from 1
  double from = 0, t = 1;  ///< where it starts and ends
  int halvings = 0;        ///< how often the step was cut in two to get this part
  Summary summary;
  std::vector<ContactReport> contact;
  std::vector<ProbeReport> probes;
  std::vector<ForceReport> applied, reactions, springs;  ///< of each load, of each fix, of each spring
  std::vector<RigidReport> rigid;                        ///< of each rigid part
  std::vector<BalanceReport> balance;                    ///< of each body
  std::vector<BodyReport> bodies;                        ///< `summary` is what they have in common, see merged()
  std::vector<std::string> undetermined;                 ///< motions of the body that nothing decides
  std::optional<EstimateReport> estimate;  ///< of the error of the mesh; nothing where it was not asked for
};

/// A step, or part of one, that was not solved as a whole.
struct FailedStep {
  int step = 1;
  double from = 0, t = 1;
  int iterations = 0;
  std::string reason;
};

/// What the boundary of a body from a mesh file is taken for.
struct GeometryReport {
  std::string body;
  std::vector<SurfacePiece> pieces;
  Index straightened = 0;  ///< how many, see MeshHierarchy
};

/// A mesh of a run that refines where its error is.
struct AdaptiveStep {
  Index elements = 0;
  Index unknowns = 0;
  int iterations = 0;
  double energy = 0;
  EstimateReport error;  ///< of the energy
  double seconds = 0;    ///< since the beginning of the run
};

struct AdaptiveReport {
  std::vector<AdaptiveStep> steps;
  bool reached = false;  ///< the tolerance
  std::string reason;    ///< why it ended
};

/// Everything `report.json` says. The tables in report_rows.cpp know its keys.
struct Report {
  std::string scene, title;
  int dimension = 0;
  std::string hierarchy = "meshes";  ///< or "matrix": all levels below the finest mesh are algebraic
  int planned_steps = 1;             ///< by the scene
  std::vector<StepReport> steps;     ///< at least one; the top-level keys are those of the last
  std::vector<FailedStep> failed;    ///< what was then solved in parts
  Warnings warnings;
  std::vector<PluginReport> plugins;
  std::vector<GeometryReport> geometry;  ///< of bodies from mesh files
  Times time;
  double peak_memory_mb = 0;
  /// Before the last step was solved. Those that were finished are there; of a single one the last iterate, if there is
  /// one on the finest mesh.
  bool interrupted = false;
  std::optional<AdaptiveReport> adaptive{};  ///< of the finest mesh are all other numbers
  std::string error;                         ///< the same, by an error: its message. Empty: none

  /// Whether there are several steps, or were to be: of the scene or parts of its only one.
  bool has_steps() const { return planned_steps > 1 || !failed.empty(); }
  const StepReport& last() const { return steps.back(); }
  bool converged() const;
  /// Why the last step ended; where another one failed and the last one did not, that one's reason.
  std::string reason() const;
};

/// One solve of a matrix and bounds alone.
struct QpReport {
  struct Active {
    Index lower = 0, upper = 0;  ///< unknowns at these bounds
  };
  struct Times {
    double read = 0, setup = 0, solve = 0, total = 0;  ///< seconds
  };
  Summary summary;
  int block = 1;
  Active active;
  Times time;
};

/// The keys that are promised to users (docs/report.md), in full precision; a number that is not finite becomes null.
nlohmann::ordered_json to_json(const Report& report);
nlohmann::ordered_json to_json(const QpReport& report);

}  // namespace signorini
