#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "conformance/node.hpp"

namespace signorini::conformance {

/// A check that asks an obstacle about one node after the other.
template <int B>
struct NodeCheck {
  std::string_view id;
  std::string_view parts;  ///< of the sample that it looks at, see describe()
  bool (*applies)(const Obstacle<B>& obstacle);
  std::string (*wrong)(Node<B>& node);  ///< what was found; "" where nothing is wrong
};

template <int B>
std::vector<NodeCheck<B>> checks_of_changes();
template <int B>
std::vector<NodeCheck<B>> checks_of_minimisers();
template <int B>
std::vector<NodeCheck<B>> checks_of_linearisations();
template <int B>
std::vector<NodeCheck<B>> checks_of_numbers();

template <int B>
bool always(const Obstacle<B>&) {
  return true;
}
template <int B>
bool has_functional(const Obstacle<B>& obstacle) {
  return obstacle.functional() != nullptr;
}

}  // namespace signorini::conformance
