// Bodies whose scenes say nothing of elements bend as beams and plates do: elements are quadratic by default.
#include "core/mesh/structured.hpp"
#include "driver/driver.hpp"
#include "mesh_file.hpp"
#include "run.hpp"

namespace signorini::test {
namespace {

constexpr double length = 10, load = 1e-4;  // height and modulus are 1

/// Of a beam of Timoshenko's that is clamped at one end, with a force of `load` per area on the other one.
double deflection(double modulus, double poisson) {
  const double shear = 1 / (2 * (1 + poisson)), bending = load * std::pow(length, 3) / (3 * modulus / 12);
  return bending + load * length / (shear * 5 / 6);
}

const std::string material = "young = 1\npoisson = 0.3\n";

/// @param body all keys of a beam along x but for its name
StepReport bent(const std::string& body, int dimension) {
  const bool plane = dimension == 2;
  const std::string zeros = plane ? "[0, 0]" : "[0, 0, 0]";
  const std::string down = plane ? fmt::format("[0, -{}]", load) : fmt::format("[0, 0, -{}]", load);
  const std::string tip = plane ? fmt::format("[{}, 0.5]", length) : fmt::format("[{}, 0.5, 0.5]", length);
  Driver driver(parse_scene("[[body]]\nname = \"b\"\n" + body +
                                "[[fix]]\nbody = \"b\"\nwhere = \"x < 1e-9\"\nvalue = " + zeros + "\n" +
                                fmt::format("[[load]]\nbody = \"b\"\nwhere = \"x > {} - 1e-9\"\nvalue = ", length) +
                                down + "\n[[probe]]\nname = \"tip\"\nbody = \"b\"\nat = " + tip + "\n",
                            "beam.toml", "."));
  return driver.solve().last();
}

double tip(const StepReport& step) { return -step.probes.at(0).value.back(); }

const std::string flat = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [10, 1]\ncells = [20, 2]\n",
                  thick = "shape = \"box\"\nfrom = [0, 0, 0]\nto = [10, 1, 1]\ncells = [16, 2, 2]\n";

// Linear elements on the same meshes are about twice too stiff.
TEST(DefaultElements, BeamsBendAsTheoryHasIt) {
  const double stress = deflection(1, 0.3), strain = deflection(1 / (1 - 0.09), 0.3);
  const StepReport plane = bent(flat + "plane = \"stress\"\n" + material, 2);
  EXPECT_EQ(plane.bodies.at(0).order, 2);
  EXPECT_TRUE(plane.bodies.at(0).order_chosen);
  EXPECT_NEAR(tip(plane), stress, 0.01 * stress);
  EXPECT_NEAR(tip(bent(flat + material, 2)), strain, 0.01 * strain);
  EXPECT_NEAR(tip(bent(thick + material, 3)), stress, 0.02 * stress);
  EXPECT_LT(tip(bent(flat + "order = 1\n" + material, 2)), 0.6 * strain);
  const StepReport linear = bent(thick + "order = 1\n" + material, 3);
  EXPECT_LT(tip(linear), 0.6 * stress);
  EXPECT_EQ(linear.bodies.at(0).order, 1);
  EXPECT_FALSE(linear.bodies.at(0).order_chosen);
}

TEST(DefaultElements, OfMeshesOfFirstOrderAreQuadraticToo) {
  const TemporaryFolder folder;
  const auto beam = [&](const auto& mesh) {
    return fmt::format("mesh = \"{}\"\n", folder.write("beam.msh", msh(mesh)));
  };
  const double stress = deflection(1, 0.3), strain = deflection(1 / (1 - 0.09), 0.3);
  EXPECT_NEAR(tip(bent(beam(rectangle({0, 0}, {10, 1}, {20, 2})) + material, 2)), strain, 0.01 * strain);
  EXPECT_NEAR(tip(bent(beam(box({0, 0, 0}, {10, 1, 1}, {16, 2, 2})) + material, 3)), stress, 0.02 * stress);
}

// Nearly incompressible. Half of the difference is the clamped end, which theory lets widen.
TEST(DefaultElements, BeamsOfRubberBendToo) {
  const double strain = deflection(1 / (1 - 0.499 * 0.499), 0.499);
  EXPECT_NEAR(tip(bent(flat + "young = 1\npoisson = 0.499\n", 2)), strain, 0.04 * strain);
}

// A clamped plate under a uniform load, Mindlin's.
TEST(DefaultElements, RoundPlatesBend) {
  const double q = 1e-5, R = length, D = 1 / (12 * (1 - 0.09)), shear = 1 / 2.6 * 5 / 6;
  const double center = q * std::pow(R, 4) / (64 * D) + q * R * R / (4 * shear);
  Driver driver(parse_scene(
      fmt::format("[[body]]\nname = \"b\"\n{}plane = \"axisymmetric\"\n{}[[fix]]\nbody = \"b\"\non = \"right\"\n"
                  "value = [0, 0]\n[[load]]\nbody = \"b\"\non = \"top\"\nvalue = [0, -{}]\n"
                  "[[probe]]\nname = \"tip\"\nbody = \"b\"\nat = [0, 0.5]\n",
                  flat, material, q),
      "plate.toml", "."));
  EXPECT_NEAR(tip(driver.solve().last()), center, 0.01 * center);
}

// Half of a beam that is held at both ends and bent by its weight.
TEST(DefaultElements, OfHalvesAreQuadraticToo) {
  const double weight = 1e-5, modulus = 1 / (1 - 0.09), shear = 1 / 2.6 * 5 / 6, span = 2 * length;
  const double middle = weight * std::pow(span, 4) / (384 * modulus / 12) + weight * span * span / (8 * shear);
  Driver driver(parse_scene(
      "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [-10, 0]\nto = [10, 1]\ncells = [40, 2]\n" + material +
          "[symmetry]\nx = 0\n[[fix]]\nbody = \"b\"\non = \"right\"\nvalue = [0, 0]\n[[load]]\nbody = \"b\"\n" +
          fmt::format("value = [0, -{}]\n", weight) + "[[probe]]\nname = \"tip\"\nbody = \"b\"\nat = [0, 0.5]\n",
      "half.toml", "."));
  EXPECT_NEAR(tip(driver.solve().last()), middle, 0.01 * middle);
}

}  // namespace
}  // namespace signorini::test
