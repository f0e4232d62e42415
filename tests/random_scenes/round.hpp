#pragma once
#include "generator.hpp"

namespace signorini::test {

/// The lower half of a disk or ball (D = 2, 3), its flat side loaded, on what Hertz has a formula for.
template <int D>
struct Round {
  enum class On { plane, ball, hollow, elastic_ball };  // the last one with a mesh of its own, which takes time
  On on = On::plane;
  double radius = 1, other_radius = 1;  ///< of what it lies on, without a plane
  Material material, other;             ///< the other one of an elastic ball
  double half_width = 0;                ///< of the contact, by Hertz
  bool by_symmetry = false;             ///< a half or a quarter is meshed

  double curvature() const {
    if (on == On::plane) return 1 / radius;
    return 1 / radius + (on == On::hollow ? -1 : 1) / other_radius;
  }
  double modulus() const {
    const auto compliance = [](const Material& m) { return (1 - m.poisson * m.poisson) / m.young; };
    return 1 / (compliance(material) + (on == On::elastic_ball ? compliance(other) : 0));
  }
  double force() const {
    const double a = half_width;
    return D == 2 ? pi / 4 * modulus() * a * a * curvature() : 4.0 / 3 * modulus() * a * a * a * curvature();
  }
  double area() const { return D == 2 ? 2 * half_width : pi * half_width * half_width; }
  double peak() const { return (D == 2 ? 4 / pi : 1.5) * force() / area(); }

  static constexpr double pi = 3.14159265358979323846;
  // Of the mesh, over the half width: of faces in the middle of the contact, more per way from there, refinements.
  static constexpr double face_in_middle = 0.4, growth = 0.25;
  static constexpr int refinements = D == 2 ? 2 : 1;
  static constexpr double face_at_edge = (face_in_middle + growth) / (1 << refinements);
};

template <int D>
Round<D> random_round(Random& random) {
  Round<D> out;
  using On = typename Round<D>::On;
  out.on = random.chance(D == 2 ? 0.25 : 0.1) ? On::elastic_ball : static_cast<On>(random.below(3));
  out.radius = random.between(0.5, 2);
  out.other_radius = out.radius * random.between(out.on == On::hollow ? 1.5 : 0.7, 3);
  out.material = {decades(random, 1), random.between(0, 0.4), 2};
  out.other = {decades(random, 1), random.between(0, 0.4), 2};
  out.half_width = std::min(out.radius, out.other_radius) * random.between(0.05, 0.1);
  out.by_symmetry = D == 3 || random.chance(0.5);
  return out;
}

/// The tables of a scene of it.
template <int D>
std::string text_of(const Round<D>& round, const View<D>& view, const Way& way) {
  using On = typename Round<D>::On;
  const bool elastic = round.on == On::elastic_ball;
  const double R = round.radius * view.length, other = round.other_radius * view.length;
  const auto up = [](double height) {  // on the axis
    Point<D> x{};
    x[D - 1] = height;
    return vector_text(x);
  };
  const auto body = [&](const char* name, const std::string& shape, double middle, double radius, const Material& m) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\nshape = \"{}\"\ncenter = {}\nradius = {:.17g}\nsize = \"{:.17g} + {}*sqrt(x^2 + "
        "{}^2{})\"\nyoung = {:.17g}\npoisson = {:.17g}\n",
        name, shape, up(middle), radius, Round<D>::face_in_middle * round.half_width * view.length, Round<D>::growth,
        D == 2 ? "y" : "z", D == 2 ? "" : " + y^2", m.young * view.stress, m.poisson);
  };
  const std::string upper = body("upper", D == 2 ? "half_disk" : "half_ball", R, R, round.material),
                    lower = elastic ? body("lower", D == 2 ? "disk" : "ball", -other, other, round.other) : "";
  std::string out = way.reversed ? lower + upper : upper + lower;
  const double flat = D == 2 ? 2 * R : Round<D>::pi * R * R;
  const std::string free = "\"free\"", sideways = D == 2 ? "0" : "0, 0";
  out +=
      fmt::format("[[load]]\nbody = \"upper\"\non = \"flat\"\nvalue = {}\n", up(-round.force() * view.force() / flat));
  out += fmt::format("[[fix]]\nbody = \"upper\"\non = \"flat\"\nvalue = [{}, {}]\n", sideways, free);
  if (elastic) {
    out += fmt::format("[[fix]]\nbody = \"lower\"\nwhere = \"{} < {:.17g}\"\nvalue = [{}, 0]\n", "xyz"[D - 1], -other,
                       sideways);
    const char* names[] = {"upper", "lower"};
    out +=
        fmt::format("[[obstacle]]\ntype = \"elastic\"\nbody = \"{}\"\non = \"{}\"\nother = \"{}\"\nother_on = \"{}\"\n",
                    names[way.swapped], way.swapped ? "boundary" : "curved", names[!way.swapped],
                    way.swapped ? "curved" : "boundary");
  } else {
    out += "[[obstacle]]\ntype = \"contact\"\nbody = \"upper\"\non = \"curved\"\n";
    if (round.on == On::plane)
      out += fmt::format("shape = \"plane\"\npoint = {}\nnormal = {}\n", up(0), up(1));
    else
      out += fmt::format("shape = \"sphere\"\ncenter = {}\nradius = {:.17g}\ninside = {}\n",
                         up(round.on == On::hollow ? other : -other), other, round.on == On::hollow);
  }
  if (round.by_symmetry) out += D == 2 ? "[symmetry]\nx = 0\n" : "[symmetry]\nx = 0\ny = 0\n";
  return out + fmt::format("[refine]\nuniform = {}\n", Round<D>::refinements) + solver_text(way);
}

}  // namespace signorini::test
