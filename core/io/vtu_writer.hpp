#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace signorini {

/// Numbers at the vertices or in the elements of a mesh, the components of one place following each other.
/// 1 component: a scalar; 2 or 3: a vector (2 are written as 3); 9: a tensor, row-major.
struct VtuField {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

struct VtuMark {
  std::string name;
  int value;
};

/// How a file is packed.
struct VtuPacking {
  double worthwhile = 0.6;  ///< see PackedVtu
  int threads = 1;
};

/// Writes a VTK unstructured grid with binary data (appended raw, packed by zlib). With order 2 the cells are quadratic
/// triangles or tetrahedra, one for each family of the mesh (see Nodes), and cell fields are theirs. Marks are numbers
/// of the whole, by name, as VTK's field data. The file appears under its name when it is complete, and does not depend
/// on the number of threads. Error(Exit::input) if it cannot be written.
template <int D>
void write_vtu(const std::filesystem::path& path, const Mesh<D>& mesh, const std::vector<VtuField>& point_fields,
               const std::vector<VtuField>& cell_fields = {}, const VtuPacking& packing = {}, int order = 1,
               const std::vector<VtuMark>& marks = {});

/// One entry of a collection: a file, relative to the folder of the collection, the time it belongs to, and its number
/// among those of that time.
struct PvdEntry {
  double time;
  std::string file;
  int part = 0;
};

/// Writes a ParaView collection, likewise.
void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

}  // namespace signorini
