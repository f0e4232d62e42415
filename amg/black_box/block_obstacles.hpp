#pragma once
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "amg/black_box/block_obstacle.hpp"
#include "amg/black_box/given_bounds.hpp"
#include "core/constraints/localise.hpp"

namespace signorini {

/// The obstacles that a caller gives to blocks of a matrix, and the bounds of single unknowns beside them.
template <int B>
class BlockObstacles final : public ObstaclePlaces<B> {
 public:
  /// Asks the obstacles for their bounds.
  /// @param blocks how many the matrix has
  /// @throws Error(Exit::input) naming the obstacle, the block and what was expected; the obstacle's own complaints
  BlockObstacles(std::vector<BlockObstacle<B>> obstacles, Index blocks);

  /// What holds with these bounds of single unknowns, without those of `fixes`.
  LocalisedProblem<B> localised(const GivenBounds& bounds, const std::vector<FixedDirections<B>>& fixes) const;

  /// Blocks where an obstacle, and not a bound of single unknowns, holds x, ascending.
  /// @param from localised(), where the bounds of the constraints are from
  /// @param x local coordinates
  std::vector<Index> touched(const Constraints<B>& constraints, const LocalisedProblem<B>& from,
                             const std::vector<double>& x) const;

  /// Whether one of the obstacles bounds a block.
  bool acts_on(Index block) const { return std::ranges::binary_search(bounds_, block, {}, &Bound<B>::vertex); }

  Index count() const override { return static_cast<Index>(obstacles_.size()); }
  const std::shared_ptr<const Obstacle<B>>& obstacle(Index k) const override { return obstacles_[k].obstacle; }
  std::string origin(Index k) const override { return obstacles_[k].name; }
  std::string origin_at(Index k, Index block) const override { return origin(k) + ": " + place(block); }
  std::string place(Index block) const override;
  double size() const override { return size_; }

 private:
  void check(const BlockObstacle<B>& given) const;
  void check_place(const BlockObstacle<B>& given, std::size_t i) const;
  std::vector<Bound<B>> all_bounds(const GivenBounds& bounds, const std::vector<FixedDirections<B>>& fixes) const;

  Index blocks_;
  std::vector<BlockObstacle<B>> obstacles_;  // the last one: the bounds of single unknowns
  double size_ = 0;
  std::vector<Bound<B>> bounds_;  // of the others, by ascending block
  std::vector<FunctionalNumbers<B>> numbers_;
};

}  // namespace signorini
