#pragma once
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/fem/assembly/discretize.hpp"
#include "core/solver/functional.hpp"

namespace signorini {

/// What functionals keep of a load step: their own numbers at its solution, by node and obstacle, since slots are
/// numbered anew in every step.
template <int B>
class OwnNumbers {
 public:
  OwnNumbers() = default;
  /// @param x solution in local coordinates
  OwnNumbers(const Discretization<B>& discretization, const std::vector<double>& x)
      : width_(discretization.problem.constraints.width) {
    if (discretization.functional.empty()) return;
    const std::vector<double> data = functional::data_at(discretization.problem, x);
    for (std::size_t slot = 0; slot < discretization.functional.size(); ++slot) {
      if (discretization.functional[slot] < 0) continue;
      of_.emplace_back(discretization.problem.constraints.vector[slot], discretization.functional[slot]);
      const auto from = data.begin() + static_cast<Offset>(slot) * width_;
      numbers_.insert(numbers_.end(), from, from + width_);
    }
  }

  /// For other nodes: each takes over those of the one in `source`; -1: none.
  OwnNumbers at_nodes(std::span<const Index> source) const {
    OwnNumbers out;
    out.width_ = width_;
    for (std::size_t p = 0; p < source.size(); ++p) {
      auto found = std::ranges::lower_bound(of_, std::pair(source[p], Index{0}));
      for (; found != of_.end() && found->first == source[p]; ++found) {
        out.of_.emplace_back(static_cast<Index>(p), found->second);
        const auto from = numbers_.begin() + (found - of_.begin()) * width_;
        out.numbers_.insert(out.numbers_.end(), from, from + width_);
      }
    }
    return out;
  }

  /// To where the next step has the same obstacles at the same nodes: Constraints::before.
  void hand_to(Discretization<B>& next) const {
    Constraints<B>& c = next.problem.constraints;
    for (std::size_t slot = 0; slot < next.functional.size(); ++slot) {
      const std::pair key(c.vector[slot], next.functional[slot]);
      const auto found = std::ranges::lower_bound(of_, key);
      if (found == of_.end() || *found != key) continue;
      const auto from = numbers_.begin() + (found - of_.begin()) * width_;
      std::copy_n(from, std::min(width_, c.width), c.before.begin() + static_cast<Offset>(slot) * c.width);
    }
  }

 private:
  int width_ = 0;
  std::vector<std::pair<Index, Index>> of_;  // node and obstacle, ascending
  std::vector<double> numbers_;
};

}  // namespace signorini
