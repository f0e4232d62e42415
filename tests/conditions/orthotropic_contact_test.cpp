// Contact of orthotropic bodies, in closed form (half planes: Suo, Proc. R. Soc. A 427, 1990) and in balance; and what
// is refused of them, or warned of.
#include <gmock/gmock.h>

#include "orthotropic.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Two blocks between smooth walls' ends, of which the upper one is orthotropic: a bar of two moduli.
TEST(OrthotropicContact, presses_on_another_body) {
  const std::string text =
      "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [0, 1]\nto = [1, 2]\ncells = [3, 3]\nplane = "
      "\"stress\"\n" +
      orthotropic(wood) +
      "[[body]]\nname = \"c\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\nplane = \"stress\"\n"
      "young = 3\npoisson = 0.2\n[[fix]]\nbody = \"c\"\non = \"bottom\"\nvalue = [\"free\", 0]\n"
      "[[fix]]\nbody = \"c\"\non = \"left\"\nvalue = [0, \"free\"]\n" +
      fix("on = \"left\"", "[0, \"free\"]") + fix("on = \"top\"", "[\"free\", -0.01]") +
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"b\"\non = \"bottom\"\nother = \"c\"\nother_on = \"top\"\n";
  Driver driver(parse_scene(text, "test.toml", ".", exact));
  ASSERT_TRUE(driver.solve().converged());
  const double force = 0.01 / (1 / wood[1] + 1.0 / 3);
  EXPECT_NEAR(driver.report().last().contact[0].force[1], force, 1e-9);
  EXPECT_NEAR(driver.report().last().contact[0].max_pressure, force, 1e-6);
}

/// Two blocks that rub, the upper one of this material; pushed down and aside.
template <int D>
std::string rubbing(const std::string& keys, const std::string& material) {
  const bool flat = D == 2;
  return "[[body]]\nname = \"b\"\n" +
         std::string(flat ? "shape = \"rectangle\"\nfrom = [1, 1]\nto = [2, 2]\ncells = [3, 3]\n"
                          : "shape = \"box\"\nfrom = [0, 0, 1]\nto = [1, 1, 2]\ncells = [3, 3, 3]\n") +
         keys + material + "[[body]]\nname = \"c\"\n" +
         (flat ? "shape = \"rectangle\"\nfrom = [0.5, 0]\nto = [2.5, 1]\ncells = [5, 2]\n"
               : "shape = \"box\"\nfrom = [-0.5, -0.5, 0]\nto = [1.5, 1.5, 1]\ncells = [4, 4, 2]\n") +
         keys + "young = 3\npoisson = 0.2\n[[fix]]\nbody = \"c\"\non = \"bottom\"\nvalue = " +
         (flat ? "[0, 0]\n" : "[0, 0, 0]\n") + fix("on = \"top\"", flat ? "[0.004, -0.01]" : "[0.004, 0.001, -0.01]") +
         "[[obstacle]]\ntype = \"elastic_coulomb\"\nfriction = 0.2\nbody = \"b\"\non = \"bottom\"\nother = "
         "\"c\"\nother_on = \"top\"\n[solver]\ntolerance = 1e-10\n";
}

ContactReport contact_of(const std::string& text) {
  Driver driver(parse_scene(text, "test.toml", ".", std::vector<std::string>{}));
  EXPECT_TRUE(driver.solve().converged()) << text;
  const ContactReport contact = driver.report().last().contact.at(0);
  double size = 0;
  for (const double f : contact.force) size = std::max(size, std::abs(f));
  for (std::size_t i = 0; i < contact.force.size(); ++i)
    EXPECT_NEAR(contact.force[i], -contact.pair->force[i], 1e-12 * size);
  // Hoops carry radial forces.
  for (std::size_t i = driver.report().last().bodies[0].axisymmetric ? 1 : 0; i < contact.force.size(); ++i)
    for (const BalanceReport& balance : driver.report().last().balance)
      EXPECT_NEAR(balance.sum()[i], 0, 1e-7 * size) << text;
  return contact;
}

template <int D>
void expect_rubbing(const std::string& keys, const std::string& axes) {
  constexpr double E = 2, nu = 0.3, G = E / 2.6;
  for (const int p : {1, 2}) {
    SCOPED_TRACE(keys + order(p));
    const auto turned = contact_of(rubbing<D>(keys + order(p), orthotropic(wood) + axes)),
               same = contact_of(rubbing<D>(keys + order(p), orthotropic({E, E, E, nu, nu, nu, G, G, G}) + axes)),
               isotropic = contact_of(rubbing<D>(keys + order(p), "young = 2\npoisson = 0.3\n"));
    for (std::size_t i = 0; i < isotropic.force.size(); ++i)
      EXPECT_NEAR(same.force[i], isotropic.force[i], 1e-7 * std::abs(isotropic.force.back()));
    EXPECT_EQ(same.slip_nodes, isotropic.slip_nodes);
    const auto norm = [](const std::vector<double>& f) {
      double sum = 0;
      for (const double x : f) sum += x * x;
      return std::sqrt(sum);
    };
    EXPECT_GT(turned.slip_nodes, 0);
    EXPECT_LE(norm(turned.tangential_force), 0.2 * norm(turned.normal_force) * (1 + 1e-9));
    EXPECT_GT(std::abs(turned.force.back() / isotropic.force.back() - 1), 0.05) << "another material";
  }
}

TEST(OrthotropicContact, rubs_on_an_isotropic_body_in_balance) {
  for (const char* plane : {"strain", "stress", "axisymmetric"})
    expect_rubbing<2>(fmt::format("plane = \"{}\"\n", plane), "material_axes = [[0.866, 0.5]]\n");
  expect_rubbing<3>("", "material_axes = [[0.866, 0.5, 0], [0, 1, 1]]\n");
}

/// A rigid cylinder on a half plane in plane stress, fibres along its surface and across it.
TEST(OrthotropicContact, half_plane_is_pressed_by_the_law_of_hertz) {
  for (const bool across : {false, true}) {
    const double s11 = 1 / wood[across ? 1 : 0], s22 = 1 / wood[across ? 0 : 1], s12 = -wood[3] / wood[0],
                 s66 = 1 / wood[6], mean = std::sqrt(s11 * s22), rho = (2 * s12 + s66) / (2 * mean),
                 n = std::sqrt((1 + rho) / 2), modulus = 1 / (n * std::pow(s11 / s22, -0.25) * mean);
    const std::string text = text_of(
        "shape = \"rectangle\"\nfrom = [-8, -8]\nto = [8, 0]\ncells = [16, 8]\nplane = \"stress\"\norder = 2\n" +
            orthotropic(wood) + (across ? "material_axes = [[0, 1]]\n" : ""),
        fix("on = \"bottom\"", "[0, 0]") +
            table("obstacle", "type = \"contact\"\non = \"top\"\nshape = \"sphere\"\ncenter = [0, 4.98]\nradius = 5") +
            "[refine]\nuniform = 4\n");
    Driver driver(parse_scene(text, "test.toml", ".", std::vector<std::string>{"solver.tolerance=1e-9"}));
    ASSERT_TRUE(driver.solve().converged());
    const ContactReport& contact = driver.report().last().contact[0];
    const double P = -contact.force[1];
    EXPECT_NEAR(contact.max_pressure, std::sqrt(P * modulus / (pi * 5)), 0.02 * contact.max_pressure) << across;
    EXPECT_NEAR(contact.radius, std::sqrt(4 * P * 5 / (pi * modulus)), 0.03 * contact.radius) << across;
  }
}

TEST(OrthotropicScene, constants_of_no_material_are_refused) {
  const auto message = [&](const std::string& keys) {
    return refusal([&] { parse_scene(text_of(plate + keys, fix("on = \"bottom\"", "[0, 0]")), "test.toml", "."); });
  };
  EXPECT_THAT(
      message(orthotropic({1, -1, 1, 0, 0, 0, 1, 1, 1})),
      AllOf(HasSubstr("test.toml"), HasSubstr("orthotropic"), HasSubstr("E2 is -1, expected a positive number")));
  EXPECT_THAT(message(orthotropic({1, 4, 1, 0.5, 0, 0, 1, 1, 1})), HasSubstr("nu12 is 0.5, expected less than"));
  EXPECT_THAT(message(orthotropic({1, 1, 1, 0.6, 0.6, 0.6, 1, 1, 1})),
              HasSubstr("the determinant 1 - nu12 nu21 - nu13 nu31 - nu23 nu32 - 2 nu12 nu23 nu31 is -0.512"));
  EXPECT_THAT(message(orthotropic({1, 1, 1, 0.5, 0.5, 0.5, 1, 1, 1})), HasSubstr("the determinant"));
  EXPECT_EQ(message(orthotropic({1e200, 1e200, 1e200, 0.3, 0.3, 0.3, 1e200, 1e200, 1e200})), "not refused");
  EXPECT_THAT(message(orthotropic(wood) + "pressure = \"linear\"\n"), HasSubstr("for isotropic bodies"));
  EXPECT_THAT(message("orthotropic = [1, 2]\n"), HasSubstr("expected 9 numbers"));
  EXPECT_THAT(message(orthotropic(wood) + "young = 1\n"), HasSubstr("'young' has no meaning beside 'orthotropic'"));
  EXPECT_THAT(message(orthotropic(wood) + "material_axes = [[0, 0]]\n"), HasSubstr("expected a direction"));
  EXPECT_THAT(message("young = 1\npoisson = 0\nmaterial_axes = [[1, 0]]\n"), HasSubstr("without 'orthotropic'"));
  EXPECT_THAT(message(orthotropic(wood) + "plane = \"axisymmetric\"\nmaterial_center = [0, 0]\n"),
              HasSubstr("around its axis already"));
}

TEST(OrthotropicScene, scene_that_is_not_symmetric_in_its_directions_is_refused) {
  const auto solve = [](const std::string& axes) {
    Driver driver(parse_scene(
        text_of("shape = \"rectangle\"\nfrom = [-1, 0]\nto = [1, 1]\ncells = [2, 2]\n" + orthotropic(wood) + axes,
                fix("on = \"bottom\"", "[0, 0]") + "[symmetry]\nx = 0\n"),
        "test.toml", "."));
    driver.solve();
  };
  EXPECT_THAT(refusal([&] { solve("material_axes = [[1, 1]]\n"); }), HasSubstr("the orthotropic material"));
  EXPECT_EQ(refusal([&] { solve(""); }), "not refused");
}

TEST(OrthotropicScene, estimate_says_why_it_has_no_bounds) {
  Driver driver(parse_scene(text_of(plate + order(1) + orthotropic(wood),
                                    fix("on = \"bottom\"", "[0, 0]") +
                                        table("obstacle",
                                              "type = \"contact\"\non = \"top\"\nshape = \"plane\"\npoint = "
                                              "[0, 0.99]\nnormal = [0, -1]") +
                                        "[solver]\nestimate = true\n"),
                            "test.toml", "."));
  ASSERT_TRUE(driver.solve().converged());
  ASSERT_TRUE(driver.report().last().estimate);
  EXPECT_THAT(driver.report().last().estimate->reasons, testing::Contains(HasSubstr("orthotropic")));
}

TEST(OrthotropicScene, nearly_incompressible_material_is_warned_of) {
  const auto warnings = [](double nu) {
    Driver driver(parse_scene(text_of(plate + order(2) + orthotropic({1, 1, 1, nu, nu, nu, 0.34, 0.34, 0.34}),
                                      fix("on = \"bottom\"", "[0, 0]")),
                              "test.toml", "."));
    driver.solve();
    std::string out;
    for (const Warning& warning : driver.report().warnings) out += warning.text;
    return out;
  };
  EXPECT_THAT(warnings(0.48), HasSubstr("orthotropic body 'b'"));
  EXPECT_THAT(warnings(0.4), testing::Not(HasSubstr("orthotropic body 'b'")));
}

}  // namespace
}  // namespace signorini::test
