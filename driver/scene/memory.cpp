#include "driver/scene/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/proc.hpp"

namespace signorini {
namespace {

std::string gigabytes(double bytes) { return fmt::format("{:.3g} GB", bytes / 1e9); }
}  // namespace

/// The matrices and some twenty vectors on all levels, and the meshes. By Euler's formula there are about as many edges
/// as vertices and elements together.
double expected_memory(const HierarchySize& size, int block, int quadratic) {
  // Quadratic elements are four or eight of the mesh; likewise from the pairs of nodes in elements, faces and edges.
  const double blocks = quadratic == 0   ? 3 * size.vertices + 2 * size.elements
                        : quadratic == 2 ? size.vertices + 21 * size.elements / 4
                                         : 4 * size.vertices + 33 * size.elements / 8;
  const double matrix = blocks * (8.0 * block * block + 4);
  const double all_levels = 1.25;
  return all_levels * (matrix + 20 * 8.0 * block * size.vertices) + size.bytes;
}

TooLarge::TooLarge(const std::string& origin, std::string complaint)
    : Error(Exit::input, fmt::format("{}: {}", origin, complaint)), complaint_(std::move(complaint)) {}

double available_memory() {
  const double machine = proc_bytes("/proc/meminfo", "MemAvailable").value_or(infinity);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return machine;
  const double taken = proc_bytes("/proc/self/status", "VmSize").value_or(0);
  return std::min(machine, std::max(static_cast<double>(limit.rlim_cur) - taken, 0.0));
}

void check_memory(const HierarchySize& size, int block, const std::string& origin, PromisedMemory* promised,
                  int quadratic) {
  constexpr double most = std::numeric_limits<Index>::max();
  const PromisedMemory before = promised ? *promised : PromisedMemory();
  const double unknowns = size.vertices * block, bytes = expected_memory(size, block, quadratic),
               available = available_memory();
  std::string need = fmt::format("{:.4g} unknowns need about {} of memory", unknowns, gigabytes(bytes));
  if (before.bodies > 0)
    need += fmt::format(" beside {} for the {} before", gigabytes(before.bytes),
                        before.bodies == 1 ? "body" : fmt::format("{} bodies", before.bodies));
  if (before.bytes + bytes > available)
    throw TooLarge(origin, fmt::format("{}, and {} are available", need, gigabytes(available)));
  if (std::max(size.elements, unknowns) > most)
    throw TooLarge(origin, fmt::format("{}, and more than {} are beyond this version", need, most));
  if (promised) *promised = {before.bytes + bytes - size.bytes, before.bodies + 1};
}

template <int D>
void check_memory(const Scene::Block<D>& cells, int block, const std::string& origin) {
  HierarchySize size{1, D == 2 ? 2.0 : 6.0, 0};
  for (const Index count : cells.cells) {
    size.vertices *= count + 1.0;
    size.elements *= count;
  }
  size.bytes = size.vertices * 8 * D + size.elements * 4 * (D + 1);
  check_memory(size, block, origin);
}

template void check_memory(const Scene::Block<2>&, int, const std::string&);
template void check_memory(const Scene::Block<3>&, int, const std::string&);

}  // namespace signorini
