// Of a functional: its change and its slope, and that both are those of one convex function.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "conformance/node_checks.hpp"

namespace signorini::conformance {
namespace {

template <int B>
using Vector = std::array<double, B>;

/// What changes between two places are made of.
template <int B>
double terms_between(const Node<B>& node, const Vector<B>& from, const Vector<B>& to) {
  return (node.slopes(from) + node.slopes(to)) * length<B>(difference<B>(to, from));
}

template <int B>
std::string change_is_not_zero(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const double still = node.change(s.x, s.x), other = node.change(s.x, s.z);
  if (still != 0) return fmt::format("change(x, x) is {:.6g}", still);
  return std::isfinite(other) ? "" : fmt::format("change(x, z) is {:.6g}", other);
}

template <int B>
std::string change_is_not_antisymmetric(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const double there = node.change(s.x, s.z), back = node.change(s.z, s.x);
  if (std::fabs(there + back) <= 1e-10 * (terms_between<B>(node, s.x, s.z) + std::fabs(there))) return {};
  return fmt::format("change(x, z) is {:.6g} and change(z, x) is {:.6g}", there, back);
}

template <int B>
std::string changes_do_not_add_up(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const double first = node.change(s.x, s.z), second = node.change(s.z, s.w), whole = node.change(s.x, s.w);
  const double terms = terms_between<B>(node, s.x, s.z) + terms_between<B>(node, s.z, s.w);
  if (std::fabs(first + second - whole) <= 1e-9 * (terms + std::fabs(whole))) return {};
  return fmt::format("change(x, z) is {:.6g}, change(z, w) is {:.6g} and change(x, w) is {:.6g}", first, second, whole);
}

template <int B>
std::string change_loses_digits(Node<B>& node) {
  const Sample<B>& s = node.sample();
  Vector<B> way;  // in each component of its own, for one of them may be near a kink
  for (int k = 0; k < B; ++k) way[k] = 1e-9 * std::fabs(s.x[k]) * std::tanh(s.step[k] / s.size);
  const Vector<B> to = s.moved(s.x, way), d = difference<B>(to, s.x), back = difference<B>(s.x, to);
  const double change = node.change(s.x, to), mean = 0.5 * (node.slope(s.x, d) - node.slope(to, back));
  if (!(std::fabs(change - mean) > 2e-8 * node.slopes(s.x) * length<B>(d))) return {};
  return fmt::format("a step of 1e-9 of x changes it by {:.10g}, its mean slope times the step is {:.10g}", change,
                     mean);
}

template <int B>
std::string slope_is_not_homogeneous(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const double once = node.slope(s.x, s.step);
  for (const double t : {3.5, 1e-3}) {
    Vector<B> d = s.step;
    for (double& v : d) v *= t;
    const double other = node.slope(s.x, d);
    if (!(std::fabs(other - t * once) <= 1e-10 * t * (node.slopes(s.x) * length<B>(s.step) + std::fabs(once))))
      return fmt::format("slope(x, d) is {:.6g}, and slope(x, {:g} d) is {:.6g}", once, t, other);
  }
  return {};
}

/// At one place, along one direction. What the slope leaves of the change falls with the step, wherever kinks are;
/// where the slope itself has one, or bends without end, it does so late or slowly.
template <int B>
std::string slope_is_no_derivative_at(Node<B>& node, const char* name, const Vector<B>& at, const Vector<B>& way) {
  const Sample<B>& s = node.sample();
  double least = infinity, most = 0, change = 0, slope = 0, over = 0;
  for (const double part : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14}) {
    Vector<B> d = way;
    for (double& v : d) v *= part;
    const Vector<B> to = s.moved(at, d);
    d = difference<B>(to, at);
    const double step = length<B>(d);
    if (step < 0.01 * part * length<B>(way)) break;  // bounds, or rounding, leave nothing of it
    const double c = node.change(at, to), l = node.slope(at, d), error = std::fabs(c - l) / step;
    if (!(error >= least)) least = error, change = c, slope = l, over = step;
    most = std::fmax(most, error);
    if (std::isnan(error)) break;
  }
  if (over == 0 || least <= 1e-4 * node.slopes(at) || least <= 1e-2 * most) return {};
  return fmt::format(
      "from {} = ({:.6g}) along ({:.6g}) the slope is {:.6g}, and the change over a step of {:.2g} is "
      "{:.6g} times its length",
      name, fmt::join(at, ", "), fmt::join(way, ", "), slope / over, over, change / over);
}

template <int B>
std::string slope_is_no_derivative(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const Vector<B> y = node.minimiser(s.x, s.force);
  for (const auto& [name, at] : {std::pair("x", s.x), std::pair("the local solver's y", y)}) {
    if (!all_finite(at)) continue;
    for (int side = 0; side < 2 * B + 1; ++side) {
      const Vector<B> way = side < 2 * B ? Node<B>::unit(side / 2, side % 2 ? -s.size : s.size) : s.step;
      if (length<B>(way) == 0) continue;
      if (std::string wrong = slope_is_no_derivative_at<B>(node, name, at, way); !wrong.empty()) return wrong;
    }
  }
  return {};
}

template <int B>
std::string is_not_convex(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const Vector<B> d = difference<B>(s.z, s.x);
  const double slope = node.slope(s.x, d), change = node.change(s.x, s.z);
  const double tolerated = 1e-9 * (terms_between<B>(node, s.x, s.z) + std::fabs(change));
  if (slope > change + tolerated)
    return fmt::format("slope(x, z - x) is {:.6g}, and change(x, z) is only {:.6g}", slope, change);
  Vector<B> middle;
  for (int k = 0; k < B; ++k) middle[k] = s.x[k] + 0.5 * d[k];
  const double half = node.change(s.x, middle);
  if (half > 0.5 * change + tolerated)
    return fmt::format("half way the change is {:.6g}, and on the whole way {:.6g}", half, change);
  return {};
}

}  // namespace

template <int B>
std::vector<NodeCheck<B>> checks_of_changes() {
  return {{"change_zero", "xz", has_functional<B>, change_is_not_zero<B>},
          {"change_antisymmetric", "xz", has_functional<B>, change_is_not_antisymmetric<B>},
          {"change_adds_up", "xzw", has_functional<B>, changes_do_not_add_up<B>},
          {"change_digits", "xd", has_functional<B>, change_loses_digits<B>},
          {"slope_homogeneous", "xd", has_functional<B>, slope_is_not_homogeneous<B>},
          {"slope_derivative", "xdM", has_functional<B>, slope_is_no_derivative<B>},
          {"convex", "xz", has_functional<B>, is_not_convex<B>}};
}

template std::vector<NodeCheck<1>> checks_of_changes<1>();
template std::vector<NodeCheck<2>> checks_of_changes<2>();
template std::vector<NodeCheck<3>> checks_of_changes<3>();

}  // namespace signorini::conformance
