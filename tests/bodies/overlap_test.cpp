#include <gmock/gmock.h>

#include "tests/bodies/scenes.hpp"

// Bodies that overlap at the start without a vertex of one inside the other one. Where they touch, and the gap is as
// negative as the overlap, the same is solved.

namespace signorini::test {
namespace {

using tables::block, tables::fix;

struct Blocks {
  std::string low, from, to, cells;  // of the upper one, without what is along the last axis
  double height;                     // of the lower one
  std::string more;
};

std::string scene(const Blocks& blocks, double by, const std::string& options, const std::string& on) {
  const bool flat = std::ranges::count(blocks.from, ',') == 0;
  const auto at = [&](const std::string& start, double z) { return fmt::format("[{}, {:.17g}]", start, z); };
  return blocks.low +
         block("up", at(blocks.from, blocks.height - by), at(blocks.to, blocks.height + 0.4 - by), blocks.cells) +
         fix("low", "bottom", flat ? "[0, 0]" : "[0, 0, 0]") + fix("up", "top", flat ? "[0, -0.01]" : "[0, 0, -0.01]") +
         pair("up", on, "low", on == "boundary" ? "boundary" : "top", options) + blocks.more;
}

double force_of(const std::string& text) {
  Driver driver(scene_of(text));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  return report.last().contact[0].force.back();
}

TEST(Overlap, WithoutAVertexInsideIsThatOfTheSurfaces) {
  const std::string square = block("low", "[-0.2, -0.2, 0]", "[0.2, 0.2, 0.4]", "[1, 1, 1]");
  const std::string bar = block("low", "[-1, -0.2, 0]", "[1, 0.2, 0.4]", "[1, 1, 1]");
  const std::string wide = block("low", "[-0.8, -0.6, 0]", "[0.8, 0.6, 0.4]", "[3, 2, 1]");
  const std::string flat = block("low", "[-0.2, 0]", "[0.2, 0.4]", "[1, 2]");
  const std::string symmetry = "[symmetry]\ny = 0\n";
  const std::vector<Blocks> all = {
      {flat, "-0.2", "0.2", "[1, 2]", 0.4, ""},
      {flat, "-0.2", "0.5", "[1, 1]", 0.4, ""},
      {flat, "-0.2", "0.2", "[1, 2]", 0.4, "[symmetry]\nx = 0\n"},
      {square, "-0.2, -0.2", "0.2, 0.2", "[1, 1, 1]", 0.4, ""},
      {square, "-0.2, -0.2", "0.2, 0.2", "[1, 1, 1]", 0.4, "[symmetry]\nx = 0\ny = 0\n"},
      {bar, "-0.2, -1", "0.2, 1", "[1, 1, 1]", 0.4, ""},
      {wide, "-0.9, -0.6", "0.9, 0.6", "[1, 1, 3]", 0.4, symmetry},
  };
  for (const Blocks& blocks : all)
    for (const char* on : {"bottom", "boundary"})
      for (const char* slave : {"", "slave = \"other\"\n"}) {
        const double pressed = force_of(scene(blocks, 0, fmt::format("gap = -0.01\n{}", slave), "bottom"));
        EXPECT_GT(pressed, 1e-4);
        EXPECT_NEAR(force_of(scene(blocks, 0.01, slave, on)), pressed, 1e-8) << blocks.from << ' ' << on << slave;
      }
}

// Free to widen: a uniform pressure shortens both.
TEST(Overlap, OfAlignedColumnsPressesAsInterferenceDoes) {
  const std::string blocks = block("low", "[-0.2, 0]", "[0.2, 0.4]", "[1, 2]") +
                             block("up", "[-0.2, 0.39]", "[0.2, 0.8]", "[1, 2]") +
                             fix("low", "bottom", "[\"free\", 0]") + fix("low", "left", "[0, \"free\"]") +
                             fix("up", "top", "[\"free\", -0.01]") + fix("up", "left", "[0, \"free\"]");
  const double pressure = 0.02 / ((1 - 0.3 * 0.3) * (0.4 + 0.41));
  EXPECT_NEAR(force_of(blocks + pair("up", "bottom", "low", "top")), 0.4 * pressure, 1e-10);
}

// Plates on edge that cross each other: deeper than they are thick no face sees the opposite one, for its own sides are
// nearer.
TEST(Overlap, ThatNoFacesSeeIsRefused) {
  const auto plates = [](double by, const std::string& on, const std::string& other_on) {
    return block("low", "[-1, -0.02, 0]", "[1, 0.02, 0.4]", "[1, 1, 1]") +
           block("up", fmt::format("[-0.02, -1, {}]", 0.4 - by), fmt::format("[0.02, 1, {}]", 0.8 - by), "[1, 1, 1]") +
           fix("low", "bottom", "[0, 0, 0]") + fix("up", "top", "[0, 0, 0]") + pair("up", on, "low", other_on);
  };
  expect_error(plates(0.1, "boundary", "boundary"), Exit::input, "no faces there are opposite");
  EXPECT_GT(force_of(plates(0.1, "bottom", "top")), 0);
  EXPECT_GT(force_of(plates(0.01, "boundary", "boundary")), 0);
}

}  // namespace
}  // namespace signorini::test
