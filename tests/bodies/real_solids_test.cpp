#include <algorithm>

#include "tests/bodies/scenes.hpp"
#include "tests/verification/real_surfaces.hpp"

// Solids from real surfaces pressed into each other with friction. SIGNORINI_MESHES names the surfaces' folder.

namespace signorini::test {
namespace {

/// @param size of the mesh far from `at`; there it is an eighth of it
std::string solid(const char* name, const std::string& file, double size, const Point<3>& at, double young) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nshape = \"solid\"\nfile = \"{}\"\nsize = \"min({}, {} + 0.3 * sqrt((x - {})^2 + (y - "
      "{})^2 + (z - {})^2))\"\n{}",
      name, file, size, size / 8, at[0], at[1], at[2], material(young));
}

std::string held(const char* body, const std::string& where, const Point<3>& value) {
  return fmt::format("[[fix]]\nbody = \"{}\"\nwhere = \"{}\"\nvalue = [{}, {}, {}]\n", body, where, value[0], value[1],
                     value[2]);
}

/// The upper quarter of the upper body goes down by 8 % of its height, and sideways by 0.5 %; the lower quarter of the
/// lower one stays.
std::string pressed(const RealSurface& body, const std::string& below, double size) {
  const char up = "xyz"[body.up];
  Point<3> way{0.005 * body.height(), 0, 0};
  way[body.up] = -0.08 * body.height();
  const double top = body.farthest(1)[body.up], bottom = body.farthest(-1)[body.up];
  const Point<3> at = body.farthest(-1);
  return solid("upper", body.file, size, at, 1) + solid("lower", below, size, at, 1) +
         held("upper", fmt::format("{} > {}", up, top - 0.25 * body.height()), way) +
         held("lower", fmt::format("{} < {}", up, bottom - 0.75 * body.height()), {}) +
         pair("upper", "boundary", "lower", "boundary", "friction = 0.3\n", "elastic_coulomb");
}

struct Found {
  std::vector<double> u;
  ContactReport contact;
  int iterations;
};

Found solve(const std::string& text, const std::string& method) {
  Driver driver(scene_of(text + fmt::format("[solver]\nmethod = \"{}\"\ntolerance = 1e-9\n", method)));
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  const StepReport& step = report.last();
  expect_opposite(step.contact[0]);
  expect_balance(step, 1e-8 * length(step.contact[0].force));
  return {driver.solution(), step.contact[0], step.summary.iterations};
}

void expect_same(const Found& found, const Found& expected) {
  const auto size = [](double c) { return std::abs(c); };
  const double largest = std::abs(*std::ranges::max_element(expected.u, {}, size));
  for (std::size_t k = 0; k < found.u.size(); ++k) ASSERT_NEAR(found.u[k], expected.u[k], 1e-6 * largest) << k;
  EXPECT_EQ(found.contact.nodes, expected.contact.nodes);
  EXPECT_EQ(found.contact.slip_nodes, expected.contact.slip_nodes);
}

TEST(RealSolids, ArePressedIntoEachOther) {
  const std::vector<RealSurface> surfaces = real_surfaces();
  if (surfaces.empty()) GTEST_SKIP() << no_surfaces;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const RealSurface &body = surfaces[k], &other = surfaces[(k + 1) % surfaces.size()];
    const std::string below = placed_below(body, other, fmt::format("signorini_{}.obj", getpid()));
    for (const double size : {0.08, 0.06, 0.045}) {
      SCOPED_TRACE(fmt::format("{} on {}, size {}", body.file, other.file, size));
      const std::string text = pressed(body, below, size * diameter(body));
      const Found found = solve(text, "auto");
      const ContactReport& contact = found.contact;
      show("{} unknowns, {} cycles, {} nodes in contact, {} slip, force {:.4g}, inside {:.2g}, slave {} ({})\n",
           found.u.size(), found.iterations, contact.nodes, contact.slip_nodes, contact.force[body.up],
           contact.largest_penetration, contact.pair->slave, contact.pair->reason);
      EXPECT_GT(contact.force[body.up], 0);
      EXPECT_LE(found.iterations, 120);
      if (size == 0.08) expect_same(found, solve(text, "newton"));
    }
    std::filesystem::remove(below);
  }
}

}  // namespace
}  // namespace signorini::test
