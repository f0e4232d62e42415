// The numbers of a functional: how they grow with the surface, how they are renewed, and what friction says of them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "conformance/node_checks.hpp"

namespace signorini::conformance {
namespace {

constexpr double more = 3;  // as much of the surface

template <int B>
bool has_numbers(const Obstacle<B>& obstacle) {
  return obstacle.functional() && obstacle.descriptor().data > 0;
}

template <int B>
std::string does_not_scale(Node<B>& node) {
  const Sample<B>& s = node.sample();
  const Scaling* scaling = node.obstacle().scaling();
  if (!scaling) return "it has numbers and no Scaling";
  Sample<B> large = s;
  scaling->scale(more, large.data.data());
  scaling->scale(more, large.before.data());
  const Node<B> other(node.obstacle(), large);
  const double once = node.change(s.x, s.z), grown = other.change(s.x, s.z);
  const double terms = (node.slopes(s.x) + node.slopes(s.z)) * length<B>(difference<B>(s.z, s.x)) + std::fabs(once);
  if (std::fabs(grown - more * once) <= 1e-9 * more * terms) return {};
  return fmt::format("change(x, z) is {:.6g}, and with the numbers ({:.6g}) of scale(3) {:.6g}", once,
                     fmt::join(large.data.begin(), large.data.begin() + s.width, ", "), grown);
}

template <int B>
bool renews(const Obstacle<B>& obstacle) {
  return obstacle.renewal() != nullptr;
}

template <int B>
std::string renews_wrongly(Node<B>& node) {
  const auto first = node.renewed(), second = node.renewed();
  const int width = node.sample().width;
  for (int k = 0; k < most_data; ++k) {
    if (k >= width && first[k] != -1)
      return fmt::format("renew() writes {:.6g} to number {} of a slot that has {}", first[k], k, width);
    if (k < width && !std::isfinite(first[k])) return fmt::format("renew() makes number {} {}", k, first[k]);
    if (first[k] != second[k])
      return fmt::format("renew() makes number {} {:.17g}, and asked again {:.17g}", k, first[k], second[k]);
  }
  return {};
}

template <int B>
bool rubs(const Obstacle<B>& obstacle) {
  return B > 1 && obstacle.friction() && obstacle.functional();
}

template <int B>
std::string law_is_another(Node<B>& node) {
  Sample<B> s = node.sample();
  const FrictionLaw law = node.obstacle().friction()->law(s.data.data());
  double pressing = 0;
  if (law.coefficient != 0) {
    if (!node.obstacle().renewal() || !std::isfinite(s.lower[0])) return {};
    s.x[0] = s.lower[0];
    pressing = std::fabs(s.force[0]);
    s.force[0] = -pressing;
    s.data = Node<B>(node.obstacle(), s).renewed();
  }
  for (int k = 0; k < B; ++k) {
    if (!(s.tangential >> k & 1u)) continue;
    s.x[k] = s.last[k];
  }
  const Node<B> stuck(node.obstacle(), s);
  const double expected = law.bound + law.coefficient * pressing;
  for (int k = 0; k < B; ++k) {
    if (!(s.tangential >> k & 1u)) continue;
    const double slope = stuck.slope(s.x, Node<B>::unit(k, 1));
    if (!(std::fabs(slope - expected) <= 1e-9 * (std::fabs(slope) + std::fabs(expected))))
      return fmt::format(
          "law() says bound {:.6g} and coefficient {:.6g}; pressed by {:.6g}, the slope of what sticks is "
          "{:.6g}",
          law.bound, law.coefficient, pressing, slope);
  }
  return {};
}

}  // namespace

template <int B>
std::vector<NodeCheck<B>> checks_of_numbers() {
  return {{"scaling", "xz", has_numbers<B>, does_not_scale<B>},
          {"renew", "xM", renews<B>, renews_wrongly<B>},
          {"law", "M", rubs<B>, law_is_another<B>}};
}

template std::vector<NodeCheck<1>> checks_of_numbers<1>();
template std::vector<NodeCheck<2>> checks_of_numbers<2>();
template std::vector<NodeCheck<3>> checks_of_numbers<3>();

}  // namespace signorini::conformance
