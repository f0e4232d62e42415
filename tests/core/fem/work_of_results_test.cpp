#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"

// What results take may be a fifth of a run. Times tell little on busy machines: here their work is counted, in bytes
// of memory and in materials asked for.

namespace {
std::atomic<std::size_t> bytes_taken{0};
}  // namespace

void* operator new(std::size_t size) {
  bytes_taken += size;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace signorini::testing {
namespace {

constexpr double number = sizeof(double), index = sizeof(Index);

/// Bytes taken while `work` is done, in all.
template <class Work>
double taken(const Work& work) {
  const std::size_t before = bytes_taken;
  work();
  return static_cast<double>(bytes_taken - before);
}

// A stress is 6 numbers. Per node there are: the one that is returned and the one that grows; the sums of a linear
// fit, 10 numbers; the elements around it, 24 indices, where these and its neighbours begin, and where the next one
// comes; some marks. Nothing is kept of elements, which are nearly 6 times as many as nodes. Near the boundary
// neighbours are listed as well, up to 14 and how many, in a list that grows by doubling.
TEST(WorkOfResults, StressesOfLinearElementsTakeAFewNumbersPerNode) {
  const Mesh<3> mesh = box({0, 0, 0}, {1, 1, 1}, {24, 24, 24});
  Model<3> model;
  std::size_t asked = 0;
  model.young = expression([&asked](const Site&) {
    ++asked;
    return 1.0;
  });
  const std::vector<double> u(mesh.points.size() * 3, 1e-3);
  asked = 0;
  const double bytes = taken([&] { nodal_stress<3>(Nodes(mesh), model, u); });
  EXPECT_EQ(asked, mesh.elements.size()) << "the stress of an element is computed once";
  const double numbers = 6 + 6 + 10 + 3, indices = 24 + 2 * 15, marks = 16;
  EXPECT_LE(bytes / mesh.vertices(), numbers * number + indices * index + marks);
}

// Of a scalar each node may be in contact: with a gap, an area, a pressure, a force, a direction and the pressure
// again, beside its numbers and marks. (At the edge of the contact, which is left out here, it takes more.)
TEST(WorkOfResults, ContactOfAScalarTakesAFewNumbersPerNode) {
  const Mesh<3> mesh = box({0, 0, 0}, {1, 1, 1}, {24, 24, 24});
  Model<1> model;
  model.obstacles = {term<1>([](const SurfaceVertex&) { return bound<1>({1}, 0, infinity); }, {})};
  const auto discrete = discretize(mesh, model);
  ContactState<1> state;
  const double bytes = taken([&] { state = contact_state(mesh, model, discrete, discrete.problem.start); });
  ASSERT_EQ(state.obstacles[0].nodes, mesh.vertices());
  const double numbers = 6, volume = 1, indices = 2, marks = 16;
  EXPECT_LE(bytes / mesh.vertices(), (numbers + volume) * number + indices * index + marks);
}

}  // namespace
}  // namespace signorini::testing
