#pragma once
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/functional.hpp"

namespace signorini {

/// Friction counts from where its vectors were after the last load step.
/// @param x that, B per vector, in local coordinates
template <int B>
void count_from(const std::vector<double>& x, Constraints<B>& c) {
  for (std::size_t slot = 0; !c.last.empty() && slot < c.vector.size(); ++slot)
    for (int k = 0; k < B; ++k) c.last[slot * B + k] += x[Offset{c.vector[slot]} * B + k];
}

/// What functionals keep of a load step: their own numbers at its solution, by vector and obstacle, since slots
/// are numbered anew in every step.
template <int B>
class OwnNumbers {
 public:
  OwnNumbers() = default;
  /// @param acts per slot: the obstacle whose functional acts there, -1: none; empty without any
  /// @param x solution in local coordinates
  OwnNumbers(const DiscreteProblem<B>& problem, const std::vector<Index>& acts, const std::vector<double>& x)
      : width_(problem.constraints.width) {
    if (acts.empty()) return;
    const std::vector<double> data = functional::data_at(problem, x);
    for (std::size_t slot = 0; slot < acts.size(); ++slot) {
      if (acts[slot] < 0) continue;
      of_.emplace_back(problem.constraints.vector[slot], acts[slot]);
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

  /// To where the next step has the same obstacles at the same vectors: Constraints::before.
  void hand_to(const std::vector<Index>& acts, Constraints<B>& c) const {
    for (std::size_t slot = 0; slot < acts.size(); ++slot) {
      const std::pair key(c.vector[slot], acts[slot]);
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
