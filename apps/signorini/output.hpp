#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/fem/recovery/stress.hpp"
#include "core/io/atomic_files.hpp"
#include "core/io/picture.hpp"
#include "core/io/vtu_writer.hpp"
#include "driver/driver.hpp"
#include "driver/reports/results.hpp"

namespace signorini {

/// What is known of contact, at the vertices.
struct ContactFields {
  std::vector<double> gap, pressure, nodal_pressure;
  std::vector<double> contact;  ///< 0 where a node is open, 1 in contact, 2 where it slips, 3 where it sticks
  std::vector<double> normal, tangential;  ///< tractions, three per vertex; of elastic bodies
};

template <int D, int B>
ContactFields contact_fields(const Nodes<D>& nodes, const Results<D, B>& results);

/// Values at the vertices as solution.vtu holds them. Contact quantities are there when there are obstacles; where none
/// can be reached, or no unknown is free to, the gap is NaN and the others are zero.
/// @param stress per vertex; of elastic bodies
template <int D, int B>
std::vector<VtuField> point_fields(const Nodes<D>& nodes, const Results<D, B>& results,
                                   const std::vector<Stress>& stress, ContactFields contact);

/// In the elements: shares of the upper bound of the energy error, where it was estimated.
std::vector<VtuField> cell_fields(const std::vector<double>& estimate);

/// "_body1" for the names of files, where there are several bodies; else nothing.
std::string body_suffix(std::size_t body, std::size_t bodies);

/// Writes the meshes with the solution, step by step and body by body, and lists all files for ParaView when there are
/// several.
class SolutionFiles {
 public:
  SolutionFiles(AtomicFiles& files, std::size_t bodies) : files_(files), bodies_(bodies) {}

  /// @param report up to the step that is added
  /// @param body number of the body, the last of each step being the last one
  template <int D>
  void add(const Nodes<D>& nodes, const std::vector<VtuField>& fields, const std::vector<VtuField>& of_elements,
           const Report& report, std::size_t body, const VtuPacking& packing);
  /// That were added.
  std::size_t steps() const { return entries_.size() / bodies_; }
  void finish() const;

 private:
  AtomicFiles& files_;
  std::size_t bodies_;
  bool several_ = false;
  std::vector<PvdEntry> entries_;
};

/// Whether a run may write a file of this name; one that another run left is out of date.
bool is_result_file(const std::string& name);
/// What the report of an earlier run is called until a run has a report.
inline constexpr const char* old_report = "report.old.json";

/// Removes the pictures that are staged, for `reason`, which goes to `report.warnings`. Returns whether there were any.
bool give_pictures_up(AtomicFiles& files, Report& report, const std::string& reason);
/// Draw the convergence history and the result. What could not be drawn goes to `report.warnings`.
void draw_convergence(AtomicFiles& files, Report& report);
/// @param numbers of the body's obstacles in the scene
/// @param suffix of the picture's name, see body_suffix()
template <int D, int B>
void draw_result(AtomicFiles& files, const MeshHierarchy<D>& hierarchy, const Nodes<D>& nodes,
                 const Results<D, B>& results, const std::vector<Stress>& stress, const ContactFields& contact,
                 const std::vector<int>& numbers, const std::string& suffix, Report& report);

/// What result.png shows first, of all bodies at once; nothing where meshes are too fine to be drawn.
std::optional<Panel> solution_panel(Driver& driver);

/// The forces of the obstacles over the steps, where there are several; else nothing.
void draw_steps(AtomicFiles& files, Report& report);

/// convergence.csv and phases.csv; steps.csv where there are several steps.
void write_tables(AtomicFiles& files, const Report& report);

}  // namespace signorini
