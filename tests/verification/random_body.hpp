#pragma once
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/fem/elements/element.hpp"
#include "tests/random_scenes/view.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {

template <int D>
Point<D> scaled(double by, Point<D> x) {
  for (double& c : x) c *= by;
  return x;
}

template <int D>
Point<D> sum(Point<D> x, const Point<D>& y) {
  for (int i = 0; i < D; ++i) x[i] += y[i];
  return x;
}

/// A direction of no special kind, or along an axis.
template <int D>
Point<D> direction(Random& random) {
  Point<D> d{};
  if (random.chance(0.4)) {
    d[static_cast<std::size_t>(random.below(D))] = random.chance(0.5) ? 1 : -1;
    return d;
  }
  for (double& c : d) c = random.between(-1, 1);
  normalise(d);
  return d;
}

template <int D>
struct RandomObstacle {
  std::string part;  ///< of the body
  bool plane, inside;
  Point<D> point, normal;  ///< of a plane; the centre of a sphere
  double radius;
};

enum class Bodies { soft, stiff_and_moved };

/// A body within the unit ball about the origin, and all that acts on it; kept for the judge beside the scene's text.
template <int D>
struct RandomBody {
  RandomBody(std::uint64_t seed, Bodies bodies) : moved(bodies == Bodies::stiff_and_moved), random_(seed) {
    const double decades = moved ? 5 : 0;
    text = "title = \"random\"\n[[body]]\nname = \"b\"\n" + shape() +
           fmt::format("order = 1\nyoung = {:.3g}\npoisson = {:.3g}\n",
                       std::pow(10.0, random_.between(-3, 3) + decades), random_.between(0, 0.45));
    add_fix();
    add_loads();
    for (int k = 1 + random_.below(4); k > 0; --k) add_obstacle();
    text += fmt::format("[refine]\nuniform = {}\n", random_.below(D == 2 ? 3 : 2));
  }

  bool moved;  ///< by prescribed values
  std::string text;
  std::string fixed_part;
  std::array<bool, D> fixed{};
  std::string traction_part;
  Point<D> body_force{}, traction{};
  std::vector<RandomObstacle<D>> obstacles;

 private:
  std::string shape() {
    const double a = random_.between(0.15, 0.65), b = random_.between(0.15, 0.65), c = random_.between(0.15, 0.35);
    if constexpr (D == 3)
      return fmt::format("shape = \"box\"\nfrom = [{0}, {1}, {2}]\nto = [{3}, {4}, {5}]\ncells = [2, 2, 2]\n", -a, -b,
                         -c, a, b, c);
    const int kind = random_.below(3);
    if (kind == 0)
      return fmt::format("shape = \"rectangle\"\nfrom = [{}, {}]\nto = [{}, {}]\ncells = [3, 3]\n", -a, -b, a, b);
    parts_ = kind == 1 ? std::vector<std::string>{"boundary"} : std::vector<std::string>{"edge0", "edge1", "edge2"};
    if (kind == 1) return fmt::format("shape = \"disk\"\ncenter = [0, 0]\nradius = {}\nsize = {}\n", a, 0.6 * a);
    std::string points;
    const int corners = 3 + random_.below(4);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + random_.between(0, 0.6)) / corners,
                   radius = random_.between(0.4, 0.95);
      points += fmt::format("{}[{}, {}]", k ? ", " : "", radius * std::cos(angle), radius * std::sin(angle));
    }
    return fmt::format("shape = \"polygon\"\npoints = [{}]\nsize = 0.35\n", points);
  }

  const std::string& any_part() {
    return parts_[static_cast<std::size_t>(random_.below(static_cast<int>(parts_.size())))];
  }

  void add_fix() {
    if (random_.chance(moved ? 0.1 : 0.5)) return;
    fixed_part = any_part();
    for (bool& held : fixed) held = random_.chance(0.3);
    fixed[static_cast<std::size_t>(random_.below(D))] = true;
    std::string value;
    for (const bool held : fixed) value += (value.empty() ? "" : ", ") + (held ? prescribed() : "\"free\"");
    text += fmt::format("[[fix]]\nbody = \"b\"\non = \"{}\"\nvalue = [{}]\n", fixed_part, value);
  }

  std::string prescribed() {
    return moved ? fmt::format("{:.3g}", random_.between(-1, 1) * std::pow(10.0, random_.between(-4, 0))) : "0";
  }

  void add_loads() {
    const double size = std::pow(10.0, random_.between(-6, 0));
    body_force = scaled<D>(size, direction<D>(random_));
    text += fmt::format("[[load]]\nbody = \"b\"\nvalue = {}\n", vector_text(body_force));
    if (random_.chance(0.6)) return;
    traction = scaled<D>(size * std::pow(10.0, random_.between(-6, 0.5)), direction<D>(random_));
    traction_part = parts_[0];
    text += fmt::format("[[load]]\nbody = \"b\"\non = \"{}\"\nvalue = {}\n", traction_part, vector_text(traction));
  }

  /// One that the body does not reach into.
  void add_obstacle() {
    const std::string part = random_.chance(0.3) ? "boundary" : any_part();
    RandomObstacle<D> o{part, random_.chance(0.5), random_.chance(0.3), {}, direction<D>(random_), 0};
    const double off = random_.chance(0.5) ? 1 : random_.between(1, 1.3);
    o.point = scaled<D>(-off, o.normal);
    if (!o.plane) {
      o.radius = o.inside ? random_.between(1, 3) : random_.between(0.2, 2);
      o.point = scaled<D>(o.inside ? random_.between(0, o.radius - 1) : off + o.radius, o.normal);
    }
    obstacles.push_back(o);
    text += fmt::format("[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\non = \"{}\"\n", o.part);
    text += o.plane ? fmt::format("shape = \"plane\"\npoint = {}\nnormal = {}\n", vector_text(o.point),
                                  vector_text(o.normal))
                    : fmt::format("shape = \"sphere\"\ncenter = {}\nradius = {:.17g}\ninside = {}\n",
                                  vector_text(o.point), o.radius, o.inside);
  }

  Random random_;
  std::vector<std::string> parts_ = D == 2
                                        ? std::vector<std::string>{"left", "right", "bottom", "top"}
                                        : std::vector<std::string>{"left", "right", "front", "back", "bottom", "top"};
};

}  // namespace signorini::test
