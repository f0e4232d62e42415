#include "methods/held_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/rounding.hpp"
#include "core/solver/force_split.hpp"

namespace signorini {

namespace {

constexpr double touching = rounding_of_differences;  // of the terms of a distance: what rounding makes of it

template <int B>
using ReadSide = typename Polyhedron<B>::Side;

/// Takes sides as long as they are independent.
template <int B>
class Collector {
 public:
  explicit Collector(const Polyhedron<B>& polyhedron) : polyhedron_(polyhedron) {}

  void take(int k) {
    if (count_ == B || !polyhedron_.get(k, side_)) return;
    if (Polyhedron<B>::add_row(side_.normal, rows_, count_)) sides_.number[count_++] = static_cast<short>(k + 1);
  }

  HeldSides<B> found() {
    std::sort(sides_.number, sides_.number + count_);
    return sides_;
  }

 private:
  const Polyhedron<B>& polyhedron_;
  ReadSide<B> side_;
  double rows_[B * B];
  int count_ = 0;
  HeldSides<B> sides_;
};

template <int B>
int sides_of(const Polyhedron<B>& polyhedron) {
  return 2 * (B + polyhedron.facets());
}

template <int B>
bool touches(const ReadSide<B>& side, const double* x) {
  double terms = std::abs(side.bound);
  for (int i = 0; i < B; ++i) terms += std::abs(side.normal[i] * x[i]);
  return Polyhedron<B>::excess(side, x) >= -touching * terms;
}

/// Sides that leave no room: both bounds are the same.
template <int B>
void take_pairs(const Polyhedron<B>& polyhedron, Collector<B>& held) {
  for (int k = 0; k < sides_of(polyhedron); k += 2)
    if (ReadSide<B> lower, upper;
        polyhedron.get(k, lower) && polyhedron.get(k + 1, upper) && -lower.bound == upper.bound)
      held.take(k);
}

/// Calls visit(side, row) for each held side with what its normal adds to the `count` rows before: a unit vector
/// orthogonal to these, which is stored behind them.
template <int B, class Visit>
void each_row(const Polyhedron<B>& polyhedron, const HeldSides<B>& sides, double* rows, int count, const Visit& visit) {
  ReadSide<B> side;
  for (int k = 0; k < B && sides.number[k] > 0; ++k) {
    if (count == B || !polyhedron.get(sides.number[k] - 1, side)) continue;
    if (Polyhedron<B>::add_row(side.normal, rows, count)) visit(side, rows + B * count++);
  }
}

}  // namespace

template <int B>
HeldSides<B> sides_at(const Polyhedron<B>& polyhedron, const double* x) {
  Collector<B> held(polyhedron);
  take_pairs(polyhedron, held);
  for (int k = 0; k < sides_of(polyhedron); ++k)
    if (ReadSide<B> side; polyhedron.get(k, side) && touches<B>(side, x)) held.take(k);
  return held.found();
}

template <int B>
HeldSides<B> sides_before(const Polyhedron<B>& polyhedron, const double* d, const double* target) {
  Collector<B> held(polyhedron);
  take_pairs(polyhedron, held);
  double M[B * B] = {}, y[B];
  for (int i = 0; i < B; ++i) M[i * (B + 1)] = d[i];
  if (polyhedron.contains(target) || !polyhedron.nearest(M, target, y)) return held.found();
  std::array<double, B> force;
  for (int i = 0; i < B; ++i) force[i] = d[i] * (target[i] - y[i]);
  std::vector<std::array<double, B>> directions;
  std::vector<int> touched;
  for (int k = 0; k < sides_of(polyhedron); ++k) {
    ReadSide<B> side;
    if (!polyhedron.get(k, side) || !touches<B>(side, y)) continue;
    const double length = block::norm<B>(side.normal);
    std::array<double, B>& direction = directions.emplace_back();
    for (int i = 0; i < B; ++i) direction[i] = side.normal[i] / length;
    touched.push_back(k);
  }
  const ForceSplit split = split_force<B>(directions, force);
  for (std::size_t k = 0; k < touched.size(); ++k)
    if (split.part[k] > 0) held.take(touched[k]);
  return held.found();
}

template <int B>
HeldSides<B> equal_sides(const Polyhedron<B>& polyhedron) {
  Collector<B> held(polyhedron);
  take_pairs(polyhedron, held);
  return held.found();
}

template <int B>
HeldSides<B> all_sides(const Polyhedron<B>& polyhedron) {
  Collector<B> held(polyhedron);
  for (int k = 0; k < sides_of(polyhedron); ++k) held.take(k);
  return held.found();
}

template <int B>
void go_onto(const Polyhedron<B>& polyhedron, const HeldSides<B>& sides, double* y) {
  for (int pass = 0; pass < 2; ++pass) {  // the second one takes off what rounding of the way leaves
    double rows[B * B];
    each_row(polyhedron, sides, rows, 0, [&](const ReadSide<B>& side, const double* row) {
      double along = 0;
      for (int i = 0; i < B; ++i) along += side.normal[i] * row[i];
      const double by = Polyhedron<B>::excess(side, y) / along;
      for (int i = 0; i < B; ++i) y[i] -= by * row[i];
      if (side.component >= 0) y[side.component] = side.normal[side.component] * side.bound;
    });
  }
}

template <int B>
int held_coordinates(const Polyhedron<B>& polyhedron, const HeldSides<B>& sides, Flags off, double* T) {
  double rows[B * B] = {};
  int count = 0;
  for (int k = 0; k < B; ++k)
    if (off >> k & 1u) rows[B * count++ + k] = 1;
  each_row(polyhedron, sides, rows, count, [&](const ReadSide<B>&, const double*) { ++count; });
  const int held = count;
  for (int k = 0; k < B && count < B; ++k) {
    double axis[B] = {};
    axis[k] = 1;
    count += Polyhedron<B>::add_row(axis, rows, count);
  }
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) T[i * B + j] = rows[j * B + i];
  return held;
}

#define SIGNORINI_INSTANTIATE(B)                                                          \
  template HeldSides<B> sides_at(const Polyhedron<B>&, const double*);                    \
  template HeldSides<B> sides_before(const Polyhedron<B>&, const double*, const double*); \
  template HeldSides<B> equal_sides(const Polyhedron<B>&);                                \
  template HeldSides<B> all_sides(const Polyhedron<B>&);                                  \
  template void go_onto(const Polyhedron<B>&, const HeldSides<B>&, double*);              \
  template int held_coordinates(const Polyhedron<B>&, const HeldSides<B>&, Flags, double*);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
