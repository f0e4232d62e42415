// The memory of all bodies together has to be there, before any is refined.
#include "driver/scene/memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/base/proc.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const HierarchySize& size, PromisedMemory& promised) {
  try {
    check_memory(size, 1, "body.2", &promised);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

TEST(Memory, OfAllBodiesTogetherIsAskedFor) {
  const double available = *proc_bytes("/proc/meminfo", "MemAvailable");
  const HierarchySize nearly_half{1, 1, 0.4 * available};
  PromisedMemory promised;
  EXPECT_EQ(refusal(nearly_half, promised), "");
  EXPECT_LT(promised.bytes, 1e4) << "what the mesh takes is not available any more";
  promised.bytes += 0.7 * available;
  EXPECT_THAT(refusal(nearly_half, promised), AllOf(HasSubstr("body.2: "), HasSubstr("for the body before")));
  EXPECT_EQ(promised.bodies, 1) << "nothing is promised to what is refused";
  PromisedMemory alone;
  EXPECT_EQ(refusal(nearly_half, alone), "");
}

}  // namespace
}  // namespace signorini::test
