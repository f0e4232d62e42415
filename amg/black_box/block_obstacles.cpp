#include "amg/black_box/block_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/algebra/local_basis.hpp"
#include "core/base/error.hpp"
#include "core/constraints/bound_collector.hpp"
#include "core/solver/polyhedral_box.hpp"

namespace signorini {

template <int B>
BlockObstacles<B>::BlockObstacles(std::vector<BlockObstacle<B>> obstacles, Index blocks)
    : blocks_(blocks), obstacles_(std::move(obstacles)) {
  for (BlockObstacle<B>& given : obstacles_) {
    check(given);
    for (std::size_t i = 0; i < given.places.size(); ++i) given.places[i].vertex = given.blocks[i];
    for (const SurfaceVertex& at : given.places)
      for (const double c : at.position) size_ = std::max(size_, std::fabs(c));
  }
  for (Index k = 0; k < count(); ++k) {
    BoundCollector<B> collector(*this, k, bounds_, numbers_);
    for (std::size_t i = 0; i < obstacles_[k].blocks.size(); ++i)
      collector.push(obstacles_[k].blocks[i], obstacles_[k].places[i]);
    collector.flush();
  }
  std::ranges::stable_sort(bounds_, {}, &Bound<B>::vertex);
  obstacles_.push_back({std::make_shared<const PolyhedralBox<B>>(), {}, {}, "lower and upper"});
}

template <int B>
std::string BlockObstacles<B>::place(Index block) const {
  return fmt::format("block {}", block);
}

template <int B>
void BlockObstacles<B>::check(const BlockObstacle<B>& given) const {
  if (!given.obstacle) input_error(given.name, "is null, expected an obstacle");
  if (given.obstacle->functional() && !given.obstacle->linearisation())
    input_error(given.name, "has a functional without its linearisation, expected both");
  if (given.places.size() != given.blocks.size())
    input_error(given.name,
                fmt::format("found {} places, expected {}, one per block", given.places.size(), given.blocks.size()));
  for (std::size_t i = 0; i < given.blocks.size(); ++i) {
    const Index block = given.blocks[i];
    if (block < 0 || block >= blocks_)
      input_error(given.name, fmt::format("found block {}, expected 0 to {}", block, blocks_ - 1));
    if (i > 0 && block <= given.blocks[i - 1])
      input_error(given.name,
                  fmt::format("found block {} after block {}, expected ascending numbers", block, given.blocks[i - 1]));
    check_place(given, i);
  }
}

template <int B>
void BlockObstacles<B>::check_place(const BlockObstacle<B>& given, std::size_t i) const {
  const SurfaceVertex& at = given.places[i];
  const auto refuse = [&](const std::string& what) {
    input_error(given.name, fmt::format("block {}: {}", given.blocks[i], what));
  };
  const auto expect_finite = [&](const char* what, std::span<const double> numbers) {
    for (const double number : numbers)
      if (!std::isfinite(number)) refuse(fmt::format("found {} in its {}, expected finite numbers", number, what));
  };
  expect_finite("position", at.position);
  expect_finite("normal", at.normal);
  expect_finite("measure", {&at.measure, 1});
  const double length = std::hypot(at.normal[0], at.normal[1], at.normal[2]);
  if (length != 0 && !(std::fabs(length - 1) < same_direction))
    refuse(fmt::format("found a normal of length {}, expected a unit vector, or zeros where there is none", length));
  if (given.obstacle->functional() && !(at.measure > 0))
    refuse(fmt::format("found the measure {}, expected a positive one: the obstacle has an energy of its own",
                       at.measure));
}

/// By ascending block.
template <int B>
std::vector<Bound<B>> BlockObstacles<B>::all_bounds(const GivenBounds& bounds,
                                                    const std::vector<FixedDirections<B>>& fixes) const {
  std::vector<Bound<B>> out;
  auto own = bounds_.begin();
  auto fixed = fixes.begin();
  for (Index p = 0; p < blocks_; ++p) {
    while (fixed != fixes.end() && fixed->vertex < p) ++fixed;
    for (; own != bounds_.end() && own->vertex == p; ++own) out.push_back(*own);
    for (int k = 0; k < B; ++k) {
      const Interval of = bounds[static_cast<std::size_t>(Offset{p} * B + k)];
      const bool held = fixed != fixes.end() && fixed->vertex == p &&
                        std::any_of(fixed->direction, fixed->direction + fixed->count,
                                    [k](const double* direction) { return direction[k] != 0; });
      if (of.all() || held) continue;
      Bound<B>& bound = out.emplace_back(Bound<B>{p, count() - 1, {}, of.lower, of.upper});
      bound.direction[k] = 1;
    }
  }
  return out;
}

template <int B>
LocalisedProblem<B> BlockObstacles<B>::localised(const GivenBounds& bounds,
                                                 const std::vector<FixedDirections<B>>& fixes) const {
  const std::vector<Bound<B>> all = all_bounds(bounds, fixes);
  return localise(*this, static_cast<std::size_t>(blocks_), fixes, all, numbers_);
}

template <int B>
std::vector<Index> BlockObstacles<B>::touched(const Constraints<B>& c, const LocalisedProblem<B>& from,
                                              const std::vector<double>& x) const {
  const Index own = count() - 1;
  const auto is_touched = [&](Index slot) {
    const double* v = x.data() + Offset{c.vector[slot]} * B;
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{slot} * B + k;
      const Index below = from.lower_obstacle[at], above = from.upper_obstacle[at];
      if ((below >= 0 && below != own && v[k] <= c.lower[at]) || (above >= 0 && above != own && v[k] >= c.upper[at]))
        return true;
    }
    for (Offset f = c.has_facets(slot) ? c.facet_row[slot] : 0; c.has_facets(slot) && f < c.facet_row[slot + 1]; ++f) {
      const auto [below, above] = from.facets[static_cast<std::size_t>(f)].obstacle;
      const Facet<B>& facet = c.facet[static_cast<std::size_t>(f)];
      const double value = block::dot<B>(facet.normal, v);
      if ((below >= 0 && below != own && value <= facet.lower + facet.tolerated) ||
          (above >= 0 && above != own && value >= facet.upper - facet.tolerated))
        return true;
    }
    return false;
  };
  std::vector<Index> out;
  for (Index slot = 0; slot < c.size(); ++slot)
    if (is_touched(slot)) out.push_back(c.vector[slot]);
  return out;
}

template class BlockObstacles<1>;
template class BlockObstacles<2>;
template class BlockObstacles<3>;

}  // namespace signorini
