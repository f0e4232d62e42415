// Hertz's contact of a ball and of a cylinder with a rigid plane.
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

constexpr double E = 1, nu = 0.3, R = 1, modulus = E / (1 - nu * nu);

/// Relative differences from the theory: contact radius from the area, peak pressure and approach of the centre from
/// the computed force.
struct Differences {
  double radius, pressure, approach;
};

/// Lower half of a ball or cylinder between two planes that approach each other by 2 delta: by symmetry the middle
/// plane moves down by delta and is free to widen. A small part around the axis keeps the body from sliding away.
template <int D>
SceneText pressed_half(double delta, const std::string& size) {
  const bool plane = D == 2;
  const char *zeros = plane ? "0" : "0, 0", *free = plane ? "\"free\"" : "\"free\", \"free\"";
  const char* core = plane ? "y > -1e-9 && abs(x) < 0.09" : "z > -1e-9 && x^2 + y^2 < 0.16";
  return {.body = fmt::format(R"(
shape = "{}"
center = [{}, 0]
radius = 1
size = "{}"
order = 1
young = 1
poisson = 0.3)",
                              plane ? "half_disk" : "half_ball", zeros, size),
          .fixes = {fmt::format("on = \"flat\"\nvalue = [{}, {}]", free, -delta),
                    fmt::format("where = \"{}\"\nvalue = [{}, \"free\"]", core, zeros)},
          .obstacle = fmt::format(R"(
type = "contact"
on = "curved"
shape = "plane"
point = [{0}, -1]
normal = [{0}, 1])",
                                  zeros)};
}

/// K. L. Johnson, Contact Mechanics, Cambridge 1985, sec. 4.2 and 5.6.
Differences cylinder(const Run<2, 2>& r, double delta) {
  const double P = r.contact().force[1], a = std::sqrt(4 * P * R / (pi * modulus)), p0 = 2 * P / (pi * a);
  const double approach = P / (pi * modulus) * (2 * std::log(4 * R / a) - 1);
  return {r.contact().area / 2 / a - 1, r.contact().max_pressure / p0 - 1, approach / delta - 1};
}

/// Approach with the compliance of the finite ball, Y. Tatara, J. Eng. Mater. Technol. 113 (1991) 285-291: Hertz's
/// a^2 / R less the displacement that the force on the other pole causes here, F f(a) / (pi E), which for small a is
/// Boussinesq's.
Differences ball(const Run<3, 3>& r, double delta) {
  const double F = r.contact().force[2], a = std::cbrt(3 * F * R / (4 * modulus)), p0 = 3 * F / (2 * pi * a * a);
  const double s = a * a + 4 * R * R, f = 2 * (1 + nu) * R * R / (s * std::sqrt(s)) + (1 - nu * nu) / std::sqrt(s);
  return {std::sqrt(r.contact().area / pi) / a - 1, r.contact().max_pressure / p0 - 1,
          (a * a / R - F * f / (pi * E)) / delta - 1};
}

/// The distance of neighbouring vertices, more or less.
template <int D>
double spacing(const Run<D, D>& r) {
  const double area = r.contact().area / r.contact().nodes;
  return D == 2 ? area : std::sqrt(area);
}

template <int D>
void expect_hertz(double delta, const std::string& size, int refinements) {
  std::vector<Differences> found;
  for (int k = 0; k <= refinements; ++k) {
    const auto r = run<D, D>(pressed_half<D>(delta, size), {uniform(k)});
    if constexpr (D == 2)
      found.push_back(cylinder(r, delta));
    else
      found.push_back(ball(r, delta));
    const Differences& d = found.back();
    const double radius = D == 2 ? r.contact().area / 2 : std::sqrt(r.contact().area / pi);
    EXPECT_LE(std::abs(d.radius) * radius, spacing(r) / 4);
    show("{}D, {} unknowns, {} in contact, radius {:.4f}: radius {:+.4f}, pressure {:+.4f}, approach {:+.4f}\n", D,
         r.summary().level_unknowns.back(), r.contact().nodes, radius, d.radius, d.pressure, d.approach);
  }
  const Differences &first = found.front(), &last = found.back();
  // In 3D the finest meshes of sizes from 0.046 to 0.054 are off by up to 0.0097 and 0.0061, this one by 0.0015,
  // 0.0060.
  EXPECT_LE(std::abs(last.radius), D == 2 ? 0.003 : 0.01);
  EXPECT_LE(std::abs(last.pressure), D == 2 ? 0.004 : 0.0065);
  EXPECT_LE(std::abs(last.approach), 0.03);
  EXPECT_LE(std::abs(last.radius), std::abs(first.radius) / 10);
  EXPECT_LE(std::abs(last.pressure), std::abs(first.pressure) / 16);
  for (int k = 1; k <= refinements; ++k) {
    if (k > 1) {  // the error of the largest pressure may change its sign
      EXPECT_LE(std::abs(found[k].pressure),
                std::max(std::abs(found[k - 1].pressure), std::abs(found[k - 2].pressure)));
    }
    EXPECT_LE(std::abs(found[k].approach), std::abs(found[k - 1].approach));
  }
}

TEST(Hertz, Cylinder) {
  expect_hertz<2>(0.005, "min(0.02 + 0.2*sqrt(x^2 + (y + 1)^2), 0.04 + 0.3*sqrt(x^2 + y^2))", 4);
}
TEST(Hertz, Ball) { expect_hertz<3>(0.011, "0.05 + 0.3 * sqrt(x^2 + y^2 + (z + 1)^2)", 3); }

}  // namespace
}  // namespace signorini::test
