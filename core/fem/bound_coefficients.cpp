#include "core/fem/bound_coefficients.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/dot.hpp"
#include "core/fem/element.hpp"

namespace signorini {
namespace {

template <int D, int B>
class Coefficients {
 public:
  Coefficients(const Nodes<D>& nodes, const std::vector<FixedDirections<B>>& fixes, std::vector<Bound<B>>& bounds)
      : nodes_(nodes), fixes_(fixes), bounds_(bounds) {}

  void run() {
    for (auto bound = bounds_.begin(); bound != bounds_.end(); ++bound) {
      const auto [a, b] = nodes_.ends(bound->vertex);
      if (a != b) move(*bound, twin(*bound, a), twin(*bound, b));
    }
  }

 private:
  /// Of the same obstacle, along nearly the same direction, at a corner.
  const Bound<B>* twin(const Bound<B>& bound, Index corner) const {
    auto at = std::ranges::lower_bound(bounds_, corner, {}, &Bound<B>::vertex);
    for (; at != bounds_.end() && at->vertex == corner; ++at)
      if (at->obstacle == bound.obstacle && dot(at->direction, bound.direction) > smooth_cosine) return &*at;
    return nullptr;
  }

  void move(Bound<B>& bound, const Bound<B>* a, const Bound<B>* b) const {
    if (const auto by = prescribed_shift(bound)) {
      bound.lower += *by;
      bound.upper += *by;
      return;
    }
    if (!a || !b) return;
    // What presses on the ends moves them along their own directions, which on curved obstacles are others than here.
    const double along_a = dot(a->direction, bound.direction), along_b = dot(b->direction, bound.direction);
    const auto coefficient = [&](double value, double at_a, double at_b) {
      if (!std::isfinite(at_a) || !std::isfinite(at_b)) return value;
      return Nodes<D>::midpoint_coefficient(value, along_a * at_a, along_b * at_b);
    };
    const bool feasible = bound.lower <= bound.upper;
    bound.lower = bound.gap + coefficient(bound.lower - bound.gap, a->lower - a->gap, b->lower - b->gap);
    bound.upper = bound.gap + coefficient(bound.upper - bound.gap, a->upper - a->gap, b->upper - b->gap);
    if (feasible && bound.lower > bound.upper) bound.lower = bound.upper = (bound.lower + bound.upper) / 2;
  }

  /// By how much the coefficient along the bound's direction is larger than the value there; nothing where it is free.
  std::optional<double> prescribed_shift(const Bound<B>& bound) const {
    const auto [a, b] = nodes_.ends(bound.vertex);
    const auto here = prescribed(bound.vertex, bound.direction), at_a = prescribed(a, bound.direction),
               at_b = prescribed(b, bound.direction);
    if (!here || !at_a || !at_b) return {};
    return *here - Nodes<D>::midpoint_value(*here, *at_a, *at_b);
  }

  std::optional<double> prescribed(Index node, const std::array<double, B>& along) const {
    const auto fixed = std::ranges::lower_bound(fixes_, node, {}, &FixedDirections<B>::vertex);
    if (fixed == fixes_.end() || fixed->vertex != node) return {};
    double value = 0, part = 0;
    for (int k = 0; k < fixed->count; ++k) {
      double cosine = 0;
      for (int i = 0; i < B; ++i) cosine += fixed->direction[k][i] * along[i];
      value += cosine * fixed->value[k];
      part += cosine * cosine;
    }
    return 1 - part < same_direction ? std::optional(value) : std::nullopt;
  }

  const Nodes<D>& nodes_;
  const std::vector<FixedDirections<B>>& fixes_;
  std::vector<Bound<B>>& bounds_;
};

}  // namespace

template <int D, int B>
void bound_coefficients(const Nodes<D>& nodes, const std::vector<FixedDirections<B>>& fixes,
                        std::vector<Bound<B>>& bounds) {
  if (nodes.order() > 1) Coefficients<D, B>(nodes, fixes, bounds).run();
}

#define SIGNORINI_INSTANTIATE(D, B) \
  template void bound_coefficients(const Nodes<D>&, const std::vector<FixedDirections<B>>&, std::vector<Bound<B>>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
