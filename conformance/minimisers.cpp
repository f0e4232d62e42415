// The local solver, of a box or of a functional: that it minimises, within the bounds, wherever it starts.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "conformance/node_checks.hpp"

namespace signorini::conformance {
namespace {

template <int B>
using Place = std::array<double, B>;

template <int B>
std::string in_words(const Place<B>& v) {
  return fmt::format("({:.8g})", fmt::join(v, ", "));
}

/// The force that is left at y: r - M (y - x).
template <int B>
Place<B> force_left(const Node<B>& node, const Place<B>& y) {
  return difference<B>(node.sample().force, node.product(difference<B>(y, node.sample().x)));
}

/// What forces are made of there.
template <int B>
double size_of_forces(const Node<B>& node, const Place<B>& y) {
  const Sample<B>& s = node.sample();
  return length<B>(s.force) + length<B>(node.product(difference<B>(y, s.x))) + node.slopes(y);
}

/// How much of that is rounding, for places are known to 16 digits and no more.
template <int B>
double rounding_of_forces(const Node<B>& node, const Place<B>& y) {
  double stiffness = 0;
  for (const double v : node.sample().M) stiffness = std::fmax(stiffness, std::fabs(v));
  return 1e-14 * stiffness * (length<B>(node.sample().x) + length<B>(y) + length<B>(node.sample().last));
}

/// How large places are, and how far a force like that moves.
template <int B>
double size_of_places(const Node<B>& node, const Place<B>& y) {
  return length<B>(node.sample().x) + length<B>(y);
}

template <int B>
std::string is_not_finite(Node<B>& node) {
  const Place<B> y = node.minimiser(node.sample().x, node.sample().force);
  return all_finite(y) ? "" : "the local solver leads from x to " + in_words<B>(y);
}

template <int B>
std::string is_beyond_bounds(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const Place<B> y = node.minimiser(s.x, s.force);
  for (int k = 0; k < B; ++k)
    if (y[k] < s.lower[k] || y[k] > s.upper[k])
      return fmt::format("the local solver leads from x to {}, by {:.3g} beyond the bound of component {}",
                         in_words<B>(y), std::fmax(s.lower[k] - y[k], y[k] - s.upper[k]), k);
  return {};
}

template <int B>
std::string depends_on_start(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const Place<B> y = node.minimiser(s.x, s.force);
  // The same energy, seen from z.
  const Place<B> from_x = node.product(difference<B>(s.z, s.x)), force = difference<B>(s.force, from_x);
  const Place<B> other = node.minimiser(s.z, force);
  const double size = size_of_places<B>(node, y) + length<B>(s.z);
  if (!(length<B>(difference<B>(y, other)) > 1e-8 * size)) return {};
  return fmt::format("from x it leads to {}, and from z, with the same energy, to {}", in_words<B>(y),
                     in_words<B>(other));
}

template <int B>
std::string does_not_rest(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const Place<B> y = node.minimiser(s.x, s.force), force = force_left<B>(node, y), again = node.minimiser(y, force);
  const double size = 1e-8 * size_of_places<B>(node, y);
  if (length<B>(difference<B>(y, again)) > size)
    return fmt::format("the local solver leads from x to {}, and from there on to {}", in_words<B>(y),
                       in_words<B>(again));
  const double residual = node.natural_residual(y, force);
  if (residual <= size || !all_finite(y)) return {};
  return fmt::format("the local solver leads from x to {}, where the natural residual is {:.6g}", in_words<B>(y),
                     residual);
}

/// By how much there is less energy at z than at y, where that is more than rounding; else 0.
template <int B>
double gain(const Node<B>& node, const Place<B>& y, const Place<B>& z) {
  const Place<B> d = difference<B>(z, y), left = force_left<B>(node, y), Md = node.product(d);
  const double by = block::dot<B>(left.data(), d.data()) - 0.5 * block::dot<B>(d.data(), Md.data()) - node.change(y, z);
  const double terms = (size_of_forces<B>(node, y) + length<B>(Md)) * length<B>(d) + std::fabs(node.change(y, z));
  return by > 1e-9 * terms + rounding_of_forces<B>(node, y) * length<B>(d) ? by : 0;
}

template <int B>
std::string has_more_energy(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const Place<B> y = node.minimiser(s.x, s.force);
  for (const double part : {1.0, 1e-2, 1e-4})
    for (const Place<B>& way : {difference<B>(s.x, y), difference<B>(s.z, y), s.step, force_left<B>(node, y)}) {
      const double whole = length<B>(way);
      Place<B> d = way;
      for (double& v : d) v *= whole > 0 ? part * s.size / whole : 0;
      const Place<B> z = s.moved(y, d);
      if (const double less = gain<B>(node, y, z); less > 0)
        return fmt::format("the local solver leads from x to {}; at {} the energy is less, by {:.3g}", in_words<B>(y),
                           in_words<B>(z), less);
    }
  return {};
}

/// A way from y along which slopes lead down.
template <int B>
std::string leads_down(const Node<B>& node, const Sample<B>& s, const Place<B>& y) {
  const Place<B> left = force_left<B>(node, y);
  for (int side = 0; side < 2 * B + 2; ++side) {
    Place<B> way = side < 2 * B ? Node<B>::unit(side / 2, side % 2 ? -s.size : s.size) : s.step;
    if (side == 2 * B + 1)
      for (int k = 0; k < B; ++k) way[k] = length<B>(left) > 0 ? s.size * left[k] / length<B>(left) : 0;
    const Place<B> d = difference<B>(s.moved(y, way), y);
    if (length<B>(d) < 1e-3 * s.size) continue;  // bounds leave nothing of it
    const double slope = node.slope(y, d), work = block::dot<B>(left.data(), d.data());
    if (slope - work < -(1e-6 * size_of_forces<B>(node, y) + rounding_of_forces<B>(node, y)) * length<B>(d))
      return fmt::format(
          "the local solver leads from x to {}; from there along {} the functional has the slope {:.6g}, "
          "and the force left does the work {:.6g}",
          in_words<B>(y), in_words<B>(d), slope, work);
  }
  return {};
}

template <int B>
std::string has_a_slope_down(Node<B>& node) {
  const Sample<B>& s = node.sample();
  return leads_down<B>(node, s, node.minimiser(s.x, s.force));
}

/// Several directions with a functional and a fix are refused before.
template <int B>
bool may_be_prescribed(const Obstacle<B>& obstacle) {
  return !obstacle.functional() || obstacle.descriptor().directions <= 2;
}

template <int B>
std::string moves_what_is_prescribed(Node<B>& node) {
  if (node.obstacle().functional() && node.sample().directions > 1) return {};
  for (int k = 0; k < B; ++k) {
    Sample<B> s = node.sample();
    s.lower[k] = s.upper[k] = s.x[k];
    s.put_within_bounds();
    Node<B> held(node.obstacle(), s);
    const Place<B> y = held.minimiser(s.x, s.force);
    if (y[k] != s.x[k])
      return fmt::format("with component {} prescribed as {:.6g} the local solver leads from x to {}", k, s.x[k],
                         in_words<B>(y));
    if (const std::string wrong = leads_down<B>(held, s, y); !wrong.empty())
      return fmt::format("with component {} prescribed as {:.6g} {}", k, s.x[k], wrong);
  }
  return {};
}

template <int B>
bool may_have_facets(const Obstacle<B>& obstacle) {
  return B > 1 && obstacle.functional();  // boxes with them are the kernel's own
}

template <int B>
std::string fails_on_a_facet(Node<B>& node) {
  const Sample<B>& s = node.sample();
  if (length<B>(s.normal) < 0.1) return {};
  Node<B> faceted(node.obstacle(), s, true);
  const Place<B> start = s.z, force = difference<B>(s.force, node.product(difference<B>(start, s.x)));
  const Place<B> y = faceted.minimiser(start, force);
  const auto beyond = [&](const Place<B>& v) {
    return block::dot<B>(s.normal.data(), v.data()) - faceted.facet().upper;
  };
  if (!all_finite(y)) return "the local solver leads from z to " + in_words<B>(y);
  const double rounding = faceted.facet().tolerated + 1e-9 * size_of_places<B>(node, y);
  if (beyond(y) > rounding)
    return fmt::format("the local solver leads from z to {}, by {:.3g} beyond the facet", in_words<B>(y), beyond(y));
  for (const double part : {1.0, 1e-2})
    for (const Place<B>& to : {s.x, s.z, s.w}) {
      Place<B> d = difference<B>(to, y);
      for (double& v : d) v *= part;
      const Place<B> z = s.moved(y, d);
      if (beyond(z) > -rounding) continue;
      if (const double less = gain<B>(node, y, z); less > 1e-6 * size_of_forces<B>(node, y) * length<B>(d))
        return fmt::format(
            "the local solver leads from z to {}; at {}, which the facet admits, the energy is less, by "
            "{:.3g}",
            in_words<B>(y), in_words<B>(z), less);
    }
  return {};
}

template <int B>
std::string is_no_distance(Node<B>& node) {
  const Sample<B>& s = node.sample();
  Place<B> at_bounds = s.x;
  for (int k = 0; k < B; ++k)
    if (std::isfinite(s.lower[k])) at_bounds[k] = s.lower[k];
  for (const Place<B>& x : {s.x, at_bounds}) {
    const auto found = node.distance(x);
    for (int k = 0; k < B; ++k) {
      const double below = s.lower[k] - x[k], above = s.upper[k] - x[k];
      const double rounding = 1e-12 * (std::fabs(x[k]) + s.size);
      const bool touches = found.critical >> k & 1u;
      const bool right = found.lower[k] <= 0 && found.upper[k] >= 0 && found.lower[k] >= below - rounding &&
                         found.upper[k] <= above + rounding && touches == (below == 0 || above == 0);
      if (!right)
        return fmt::format(
            "at {} it says of component {}: from {:.6g} to {:.6g}, {}; expected from {:.6g} to {:.6g}, {}",
            in_words<B>(x), k, found.lower[k], found.upper[k], touches ? "critical" : "not critical", below, above,
            below == 0 || above == 0 ? "critical" : "not critical");
    }
  }
  return {};
}

}  // namespace

template <int B>
std::vector<NodeCheck<B>> checks_of_minimisers() {
  return {{"distance", "x", always<B>, is_no_distance<B>},
          {"minimise_finite", "xM", always<B>, is_not_finite<B>},
          {"minimise_bounds", "xM", always<B>, is_beyond_bounds<B>},
          {"minimise_start", "xzM", always<B>, depends_on_start<B>},
          {"minimise_rests", "xM", always<B>, does_not_rest<B>},
          {"minimise_energy", "xM", always<B>, has_more_energy<B>},
          {"minimise_slope", "xM", always<B>, has_a_slope_down<B>},
          {"prescribed", "xM", may_be_prescribed<B>, moves_what_is_prescribed<B>},
          {"facet", "zMn", may_have_facets<B>, fails_on_a_facet<B>}};
}

template std::vector<NodeCheck<1>> checks_of_minimisers<1>();
template std::vector<NodeCheck<2>> checks_of_minimisers<2>();
template std::vector<NodeCheck<3>> checks_of_minimisers<3>();

}  // namespace signorini::conformance
