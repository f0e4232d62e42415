#include <gmock/gmock.h>

#include <numbers>

#include "tests/bodies/scenes.hpp"
#include "tests/bodies/sector.hpp"
#include "tests/support/folder.hpp"

// Rings shrunk on each other, against Lame's solution: the largest pressure is that of a circle, whatever the meshes.

namespace signorini::test {
namespace {

using std::numbers::pi;

constexpr double interference = 1e-3;

/// A quarter of a ring extruded along z; its mesh is a file with the groups `inner`, `outer`, `ends`.
std::string extruded(const Sector& ring, double height, int layers) {
  const int in_plane = (ring.along_radius + 1) * (ring.around + 1);
  const auto node = [&](int i, int j, int k) { return 1 + k * in_plane + i * (ring.around + 1) + j; };
  std::string nodes, elements;
  int count = 0;
  const auto add = [&](int type, int group, const std::vector<int>& corners) {
    elements += fmt::format("{} {} 2 {} {} {}\n", ++count, type, group, group, fmt::join(corners, " "));
  };
  for (int k = 0; k <= layers; ++k)
    for (int i = 0; i <= ring.along_radius; ++i)
      for (int j = 0; j <= ring.around; ++j) {
        const double r = ring.inner + (ring.outer - ring.inner) * i / ring.along_radius;
        const double angle = pi / 2 * j / ring.around;
        nodes += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", node(i, j, k), r * std::cos(angle), r * std::sin(angle),
                             height * k / layers);
      }
  // Kuhn's six tetrahedra of a cell; faces along its diagonals.
  const auto triangles = [&](int group, int a, int b, int c, int d) {
    add(2, group, {a, b, d}), add(2, group, {a, d, c});
  };
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < ring.around; ++j)
      for (const int i : {0, ring.along_radius})
        triangles(i == 0 ? 1 : 2, node(i, j, k), node(i, j + 1, k), node(i, j, k + 1), node(i, j + 1, k + 1));
  for (int i = 0; i < ring.along_radius; ++i)
    for (int j = 0; j < ring.around; ++j) {
      for (const int k : {0, layers})
        triangles(3, node(i, j, k), node(i + 1, j, k), node(i, j + 1, k), node(i + 1, j + 1, k));
      for (int k = 0; k < layers; ++k) {
        std::array<int, 3> order{0, 1, 2};
        do {
          std::array<int, 3> at{i, j, k};
          std::vector<int> corners{node(at[0], at[1], at[2])};
          for (const int axis : order) ++at[axis], corners.push_back(node(at[0], at[1], at[2]));
          add(4, 4, corners);
        } while (std::ranges::next_permutation(order).found);
      }
    }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n2 1 \"inner\"\n2 2 \"outer\"\n2 3 \"ends\"\n3 4 "
      "\"inside\"\n$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      in_plane * (layers + 1), nodes, count, elements);
}

struct Fit {
  int dimension = 2;
  std::array<int, 2> cells{10, 37};  ///< around a quarter of the shaft, of the hub
  int order = 1, refinements = 1;
  std::string slave = "body";
  double radius = 1;
  double interference = 1e-3;  ///< over the radius
  double height = 0.1;         ///< over the radius, with cells as long as around, one at least
  std::array<double, 2> young = {1, 3};

  static constexpr double poisson[] = {0.3, 0.25};

  int layers(int body) const { return std::max(1, static_cast<int>(std::lround(height / (pi / 2) * cells[body]))); }

  /// Per body how much its surface moves under a pressure of 1, over the radius.
  double compliance(int body) const {
    const double modulus = young[body] / (1 - poisson[body] * poisson[body]), nu = poisson[body] / (1 - poisson[body]);
    const double a = body == 0 ? 0.5 : 1, b = body == 0 ? 1 : 2;
    return ((b * b + a * a) / (b * b - a * a) + (body == 0 ? -nu : nu)) / modulus;
  }
  double pressure() const { return interference / (compliance(0) + compliance(1)); }
};

class PressFit : public Folder {
 protected:
  std::string body(const Fit& fit, int k) const {
    const Sector ring{.inner = fit.radius * (k == 0 ? 0.5 : 1),
                      .outer = fit.radius * (k == 0 ? 1 + fit.interference : 2),
                      .from = 0,
                      .to = pi / 2,
                      .along_radius = fit.dimension == 2 ? fit.cells[k] / 4 + 1 : std::min(fit.cells[k] / 4 + 1, 5),
                      .around = fit.cells[k]};
    const std::string material =
        fmt::format("young = {}\npoisson = {}\norder = {}\n", fit.young[k], Fit::poisson[k], fit.order);
    const std::string name = k == 0 ? "shaft" : "hub";
    if (fit.dimension == 2) return sector(folder_, name, ring, material);
    std::ofstream(folder_ / (name + ".msh")) << extruded(ring, fit.height * fit.radius, fit.layers(k));
    return fmt::format("[[body]]\nname = \"{}\"\nmesh = \"{}\"\n{}", name, (folder_ / (name + ".msh")).string(),
                       material) +
           tables::fix(name, "ends", "[\"free\", \"free\", 0]");
  }

  /// How far the largest pressure is off.
  double off(const Fit& fit) const {
    Driver driver(scene_of(body(fit, 0) + body(fit, 1) + "[symmetry]\nx = 0\ny = 0\n" +
                           pair("shaft", "outer", "hub", "inner", fmt::format("slave = \"{}\"\n", fit.slave)) +
                           fmt::format("[refine]\nuniform = {}\n", fit.refinements)));
    const Report& report = driver.solve();
    EXPECT_TRUE(report.converged()) << report.reason();
    const ContactReport& contact = report.last().contact[0];
    EXPECT_TRUE(contact.resolved);
    EXPECT_FALSE(contact.peaks_at_edge);
    const double area = 2 * pi * fit.radius * (fit.dimension == 2 ? 1 : fit.height * fit.radius);
    EXPECT_NEAR(contact.area / area, 1, 0.02);
    EXPECT_LT(contact.largest_penetration, 0.05 * fit.interference * fit.radius);
    EXPECT_LT(contact.largest_opening, 0.05 * fit.interference * fit.radius);
    const double out = contact.max_pressure / fit.pressure() - 1;
    show("{}D, order {}, {}:{}, slave {}: pressure off by {:.2e}, area by {:.2e}, {} iterations\n", fit.dimension,
         fit.order, fit.cells[0], fit.cells[1], fit.slave, out, contact.area / area - 1,
         report.last().summary.iterations);
    return std::abs(out);
  }

  void expect_lame(Fit fit, double linear, double quadratic) const {
    for (const char* slave : {"body", "other"})
      for (const std::array<int, 2> cells : {std::array{10, 37}, std::array{37, 10}}) {
        fit.slave = slave, fit.cells = cells;
        fit.order = 1;
        EXPECT_LT(off(fit), linear) << fit.cells[0] << ":" << fit.cells[1] << " " << slave;
        fit.order = 2;
        EXPECT_LT(off(fit), quadratic) << fit.cells[0] << ":" << fit.cells[1] << " " << slave;
      }
  }
};

TEST_F(PressFit, AsLameSaysIn2D) { expect_lame({.dimension = 2}, 0.05, 0.01); }

// The less the interference the more the meshes would matter.
TEST_F(PressFit, HowEverLittleTheInterferenceIs) {
  expect_lame({.dimension = 2, .radius = 40, .interference = 1e-5}, 0.05, 0.01);
}

// Linear tetrahedra need a refinement for what quadratic ones have without it: the coarse body's displacement is off
// the circle by the chords' sagitta times the strain.
TEST_F(PressFit, AsLameSaysIn3D) {
  EXPECT_LT(off({.dimension = 3, .cells = {10, 37}, .order = 1, .refinements = 1, .slave = "body"}), 0.05);
  EXPECT_LT(off({.dimension = 3, .cells = {10, 37}, .order = 1, .refinements = 1, .slave = "other"}), 0.05);
  EXPECT_LT(off({.dimension = 3, .cells = {10, 37}, .order = 2, .refinements = 0, .slave = "body"}), 0.01);
  EXPECT_LT(off({.dimension = 3, .cells = {37, 10}, .order = 2, .refinements = 0, .slave = "other"}), 0.01);
}

// The nodes of a fine slave press where the coarse master's displacement sticks out: pressures are those that the
// coarse side transmits, and no better or worse than with that as the slave.
TEST_F(PressFit, OfAFineSlaveIsWhatTheCoarseMasterTransmitsIn2D) {
  for (const std::array<int, 2> cells : {std::array{10, 37}, {37, 10}, {5, 18}, {18, 5}})
    for (const char* slave : {"body", "other"}) {
      EXPECT_LT(off({.cells = cells, .order = 1, .refinements = 0, .slave = slave}), 0.05);
      EXPECT_LT(off({.cells = cells, .order = 2, .refinements = 0, .slave = slave}), 0.01);
    }
}

TEST_F(PressFit, OfAFineSlaveIsWhatTheCoarseMasterTransmitsIn3D) {
  Fit fit{.dimension = 3, .order = 1, .refinements = 0, .height = 0.5};
  for (const std::array<double, 2> young : {std::array{1.0, 3.0}, {1.0, 1.0}, {3.0, 1.0}})
    for (const bool fine_shaft : {false, true}) {
      fit.young = young, fit.cells = fine_shaft ? std::array{37, 10} : std::array{10, 37};
      fit.slave = fine_shaft ? "body" : "other";
      const double as_slave = off(fit);
      fit.slave = fine_shaft ? "other" : "body";
      const double as_master = off(fit);
      EXPECT_NEAR(as_slave, as_master, 0.01);
      if (young[1] > young[0]) EXPECT_LT(as_slave, 0.05);  // the coarse mesh itself is as good as that
    }
}

// The softer coarse master bulges between the nodes of a fine stiff slave: every second one is open. The area is that
// of what is transmitted all the same, see off().
TEST_F(PressFit, OfAFineStiffSlaveTouchesAllAround) {
  for (const std::array<int, 2> cells : {std::array{6, 12}, {8, 16}})
    for (const int refinements : {0, 1})
      for (const char* slave : {"body", "other"})
        EXPECT_LT(off({.cells = cells, .order = 1, .refinements = refinements, .slave = slave, .young = {1, 30}}),
                  0.05);
}

// A bore of ten cells has edges of 36 degrees: whichever side is the slave, that they are no circle is told.
TEST_F(PressFit, InAPolygonIsWarnedOf) {
  const auto ring = [&](const std::string& name, double inner, double outer, int around) {
    return sector(folder_, name, {.inner = inner, .outer = outer, .along_radius = 2, .around = around},
                  "young = 1\npoisson = 0.3\norder = 1\n") +
           tables::fix(name, name == "hub" ? "outer" : "inner", "[0, 0]");
  };
  for (const char* slave : {"body", "other"})
    for (const int refinements : {0, 1}) {
      Driver driver(scene_of(ring("shaft", 0.5, 1 + interference, 37) + ring("hub", 1, 2, 10) +
                             pair("shaft", "outer", "hub", "inner", fmt::format("slave = \"{}\"\n", slave)) +
                             fmt::format("[refine]\nuniform = {}\n", refinements)));
      EXPECT_THAT(driver.solve().warnings, testing::Contains(testing::HasSubstr("if the flat faces of the body")))
          << slave << " " << refinements;
    }
}

}  // namespace
}  // namespace signorini::test
