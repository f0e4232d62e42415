#pragma once
#include <string>
#include <vector>

#include "apps/signorini/results.hpp"
#include "core/io/atomic_files.hpp"
#include "core/io/vtu_writer.hpp"

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

/// Draws the convergence history and the result. What could not be drawn goes to `report.warnings`.
template <int D, int B>
void draw_pictures(AtomicFiles& files, const MeshHierarchy<D>& hierarchy, const Results<D, B>& results, Report& report);

/// convergence.csv and phases.csv.
void write_tables(AtomicFiles& files, const Report& report);

}  // namespace signorini
