#include "core/fem/conditions/bound_coefficients.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/fem/conditions/bound_bends.hpp"
#include "core/fem/elements/element.hpp"

namespace signorini {
namespace {

template <int D, int B>
class Coefficients {
 public:
  Coefficients(const Nodes<D>& nodes, const std::vector<FixedDirections<B>>& fixes, std::vector<Bound<B>>& bounds)
      : nodes_(nodes), fixes_(fixes), bounds_(bounds) {}

  void run(const std::vector<BoundBend>& bends) {
    for (std::size_t k = 0; k < bounds_.size(); ++k)
      if (const auto [a, b] = nodes_.ends(bounds_[k].vertex); a != b) move(bounds_[k], bends[k]);
  }

 private:
  void move(Bound<B>& bound, const BoundBend& bend) const {
    if (const auto by = prescribed_shift(bound)) {
      bound.lower += *by;
      bound.upper += *by;
      return;
    }
    const bool feasible = bound.lower <= bound.upper;
    bound.lower += Nodes<D>::midpoint_coefficient(0, bend.lower / 2, bend.lower / 2);
    bound.upper += Nodes<D>::midpoint_coefficient(0, bend.upper / 2, bend.upper / 2);
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
void bound_coefficients(const Nodes<D>& nodes, const Model<B>& model, const std::vector<FixedDirections<B>>& fixes,
                        std::vector<Bound<B>>& bounds) {
  if (nodes.order() > 1) Coefficients<D, B>(nodes, fixes, bounds).run(bound_bends(nodes, model, bounds));
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                          \
  template void bound_coefficients(const Nodes<D>&, const Model<B>&, const std::vector<FixedDirections<B>>&, \
                                   std::vector<Bound<B>>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
