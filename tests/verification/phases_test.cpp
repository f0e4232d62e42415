// What the history tells of the phases is what the result shows.
#include "run.hpp"

namespace signorini::test {
namespace {

TEST(Phases, AreCountedBySmoothersOfAnyOrder) {
  for (const char* smoother : {"forward", "backward", "symmetric", "surface_first"}) {
    const auto r =
        run_shipped<2, 1>("obstacle_radial_2d.toml", {uniform(5), fmt::format("solver.smoother={}", smoother)});
    EXPECT_GT(r.contact().nodes, 5000);
    EXPECT_EQ(r.summary().history.back().contact_nodes, r.contact().nodes) << smoother;
  }
}

}  // namespace
}  // namespace signorini::test
