#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/io/atomic_files.hpp"
#include "core/io/picture.hpp"
#include "core/io/vtu_writer.hpp"
#include "driver/results.hpp"

namespace signorini {

/// Values at the vertices as solution.vtu holds them. Contact quantities are there when there are obstacles; where none
/// can be reached, or no unknown is free to, the gap is NaN and the others are zero.
template <int D, int B>
std::vector<VtuField> point_fields(const Mesh<D>& mesh, const Results<D, B>& results);

/// Writes the meshes with the solution, step by step, and lists the steps for ParaView when there are several.
class SolutionFiles {
 public:
  SolutionFiles(AtomicFiles& files, int steps, const VtuPacking& packing)
      : files_(files), steps_(steps), packing_(packing) {}

  template <int D>
  void add(const Mesh<D>& mesh, const std::vector<VtuField>& fields, double t);
  void finish() const;

 private:
  AtomicFiles& files_;
  int steps_;
  VtuPacking packing_;
  std::vector<PvdEntry> entries_;
};

/// Whether a run may write a file of this name; one that another run left is out of date.
bool is_result_file(const std::string& name);

/// The pictures, as far as they are wanted, drawn by other programs while this one goes on.
class Pictures {
 public:
  explicit Pictures(AtomicFiles& files) : files_(files) {}

  /// What could not be drawn goes to `report.warnings`, here and in finish().
  template <int D, int B>
  void start(const MeshHierarchy<D>& hierarchy, const Results<D, B>& results, Report& report);
  void finish(Report& report);

 private:
  AtomicFiles& files_;
  std::optional<Gnuplot> convergence_, result_;  // those that were started
};

/// convergence.csv and phases.csv.
void write_tables(AtomicFiles& files, const Report& report);

}  // namespace signorini
