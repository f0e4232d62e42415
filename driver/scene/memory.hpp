#pragma once
#include <string>

#include "core/base/error.hpp"
#include "core/mesh/refine.hpp"
#include "core/scene/scene.hpp"

namespace signorini {

/// What the bodies of a scene will take when they are solved, beside their meshes, which are there already.
struct PromisedMemory {
  double bytes = 0;
  int bodies = 0;
};

/// What does not fit into the memory that is available, or needs larger numbers than Index.
class TooLarge : public Error {
 public:
  TooLarge(const std::string& origin, std::string complaint);
  /// Unknowns and bytes, without the place.
  const std::string& complaint() const { return complaint_; }

 private:
  std::string complaint_;
};

/// Bytes that a problem on such a hierarchy with `block` unknowns per vertex is expected to take, its meshes included.
/// @param quadratic 0, or the dimension where the finest mesh cuts quadratic elements
double expected_memory(const HierarchySize& size, int block, int quadratic);

/// Bytes that the program may still take: of the machine's, and of those that a limit on its address space leaves.
double available_memory();

/// TooLarge at `origin` if a problem on such a hierarchy with `block` unknowns per vertex would not fit into memory.
/// Else it is promised what it needs beside its meshes.
/// @param promised to the bodies before it; null: there are no others
/// @param quadratic as for expected_memory()
void check_memory(const HierarchySize& size, int block, const std::string& origin, PromisedMemory* promised = nullptr,
                  int quadratic = 0);

/// The same for a structured mesh before it is built.
template <int D>
void check_memory(const Scene::Block<D>& cells, int block, const std::string& origin);

}  // namespace signorini
