#include "core/constraints/admissible_sets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/sdk/box_obstacle.hpp"
#include "core/solver/functional.hpp"

namespace signorini {
namespace {

constexpr double far = 1e3;                       // of bounds and of the body
constexpr double of_distance = rounding_of_sums;  // what rounding makes of what is far away
constexpr double of_coordinates = 1e-9;           // the same of what is near

template <int B>
bool may_be_no_box(const Obstacle<B>& obstacle) {
  return !obstacle.functional() && !dynamic_cast<const BoxObstacle<B>*>(&obstacle);
}

/// Calls use(sides) for each of the 3^B - 1 directions to sides, edges and corners of a box: entries -1, 0 and 1.
template <int B, class Use>
void each_side(const Use& use) {
  int count = 1;
  for (int k = 0; k < B; ++k) count *= 3;
  for (int number = 0; number < count; ++number) {
    std::array<int, B> sides;
    for (int k = 0, rest = number; k < B; ++k, rest /= 3) sides[k] = rest % 3 - 1;
    if (std::ranges::any_of(sides, [](int side) { return side != 0; })) use(sides);
  }
}

/// The constraints of a problem with the identity as its matrix: the minimiser is what is admissible next to b.
template <int B>
class Projection {
 public:
  Projection(const DiscreteProblem<B>& problem, double size)
      : constraints_(problem.constraints),
        size_(size),
        n_(problem.fixed.size()),
        x_(n_ * B),
        b_(n_ * B),
        one_(n_ * B * B),
        row_(n_ + 1),
        column_(n_) {
    std::iota(row_.begin(), row_.end(), 0);
    std::iota(column_.begin(), column_.end(), 0);
    for (std::size_t i = 0; i < one_.size(); i += B * B)
      for (int k = 0; k < B; ++k) one_[i + static_cast<std::size_t>(k) * (B + 1)] = 1;
    view_ = functional::view(problem);
    view_.vectors = static_cast<Index>(n_);
    view_.row = row_.data();
    view_.column = column_.data();
    view_.value = view_.inverse = one_.data();
    view_.b = b_.data();
    view_.x = x_.data();
    view_.relaxation = 1;
  }

  /// Asks an obstacle for what it admits next to points far away on these sides.
  void run(const Segment<B>& segment, const std::array<int, B>& sides) {
    const auto [from, to] = slots_between(constraints_, segment.first, segment.last);
    for (Index slot = from; slot < to; ++slot)
      for (int k = 0; k < B; ++k) {
        const Offset i = Offset{constraints_.vector[slot]} * B + k;
        b_[i] = sides[k] * distance(slot);
        x_[i] = clamp(slot, k, 0);
      }
    segment.obstacle->sweep(view_, segment.first, segment.last, Order::forward);
  }

  /// Of the last run, at a vector.
  std::array<double, B> at(Index p) const {
    std::array<double, B> out;
    std::copy_n(x_.data() + Offset{p} * B, B, out.begin());
    return out;
  }
  std::array<double, B> found(Index slot) const { return at(constraints_.vector[slot]); }
  std::array<double, B> expected(Index slot) const {
    std::array<double, B> out;
    for (int k = 0; k < B; ++k) out[k] = clamp(slot, k, b_[Offset{constraints_.vector[slot]} * B + k]);
    return out;
  }
  double distance(Index slot) const {
    double size = size_;
    for (int k = 0; k < B; ++k)
      for (const double bound : {constraints_.lower[Offset{slot} * B + k], constraints_.upper[Offset{slot} * B + k]})
        if (std::isfinite(bound)) size = std::max(size, std::abs(bound));
    return far * size;
  }

 private:
  double clamp(Index slot, int k, double x) const {
    const Offset at = Offset{slot} * B + k;
    return block::clamp(x, constraints_.lower[at], constraints_.upper[at]);
  }

  const Constraints<B>& constraints_;
  double size_;
  std::size_t n_;
  std::vector<double> x_, b_, one_;
  std::vector<Offset> row_;
  std::vector<Index> column_;
  LevelView<B> view_;
};

template <int B>
[[noreturn]] void refuse(const ObstaclePlaces<B>& places, const Segment<B>& segment, Index vector,
                         const std::array<double, B>& found, const std::array<double, B>& expected) {
  Index number = 0;
  while (number < places.count() && places.obstacle(number) != segment.obstacle) ++number;
  throw Error(Exit::plugin,
              fmt::format("{}: the plugin's sweep ends at ({:.6g}) in local coordinates of the node at {}, where its "
                          "directions and bounds admit ({:.6g}): what an obstacle admits at a node has to be the box "
                          "of its bounds along its directions",
                          number < places.count() ? places.origin(number) : "obstacle", fmt::join(found, ", "),
                          places.place(vector), fmt::join(expected, ", ")));
}

}  // namespace

template <int B>
void check_admissible_sets(const ObstaclePlaces<B>& places, const DiscreteProblem<B>& problem, double size, bool all) {
  const auto asked = [all](const Segment<B>& s) {
    return all ? !s.obstacle->functional() : may_be_no_box(*s.obstacle);
  };
  if (std::ranges::none_of(problem.segments, asked)) return;
  Projection<B> projection(problem, size);
  for (const Segment<B>& segment : problem.segments) {
    if (!asked(segment)) continue;
    const std::pair<Index, Index> slots = slots_between(problem.constraints, segment.first, segment.last);
    each_side<B>([&](const std::array<int, B>& sides) {
      projection.run(segment, sides);
      for (Index p = segment.first; p < segment.last; ++p)  // also what no bound holds
        if (const auto at = projection.at(p); !std::ranges::all_of(at, [](double v) { return std::isfinite(v); }))
          refuse<B>(places, segment, p, at, {});
      for (Index slot = slots.first; slot < slots.second; ++slot) {
        const auto found = projection.found(slot), expected = projection.expected(slot);
        const double rounding = of_distance * projection.distance(slot);
        for (int k = 0; k < B; ++k)
          if (!(std::abs(found[k] - expected[k]) <= rounding + of_coordinates * std::abs(expected[k])))
            refuse<B>(places, segment, problem.constraints.vector[slot], found, expected);
      }
    });
  }
}

template void check_admissible_sets(const ObstaclePlaces<1>&, const DiscreteProblem<1>&, double, bool);
template void check_admissible_sets(const ObstaclePlaces<2>&, const DiscreteProblem<2>&, double, bool);
template void check_admissible_sets(const ObstaclePlaces<3>&, const DiscreteProblem<3>&, double, bool);

}  // namespace signorini
