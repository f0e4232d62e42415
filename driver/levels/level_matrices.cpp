#include "driver/levels/level_matrices.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/solver/interpolate.hpp"

namespace signorini {

template <int B>
std::size_t LevelMatrices<B>::left_out(std::size_t level) const {
  return std::min(factorised_ > 0 ? factorised_ - 1 : 0, number(level));
}

template <int B>
bool LevelMatrices<B>::all_products(std::size_t count) const {
  const auto end = is_product_.begin() + static_cast<Offset>(count);
  return std::find(is_product_.begin(), end, false) == end;
}

template <int B>
std::span<const GalerkinMatrix<B>> LevelMatrices<B>::matrices_below(std::size_t level) const {
  const std::size_t count = number(level);
  if (galerkin_.size() < count) return {};
  return std::span(galerkin_).first(count).subspan(left_out(level));
}

template <int B>
std::span<const GalerkinMatrix<B>> LevelMatrices<B>::products_below(std::size_t level) const {
  const auto matrices = matrices_below(level);
  return matrices.empty() || !all_products(number(level)) ? std::span<const GalerkinMatrix<B>>() : matrices;
}

template <int B>
void LevelMatrices<B>::share(DiscreteProblem<B>& coarse, std::size_t level, const DiscreteProblem<B>& problem,
                             bool changed) {
  const std::size_t below = number(level) - 1;
  galerkin_.resize(std::max(galerkin_.size(), below + 1));
  is_product_.resize(galerkin_.size());
  if (changed) is_product_[below] = all_products(below) && is_galerkin(coarse, prolongations_[below], problem);
  galerkin_[below] = {std::move(coarse.A), std::move(coarse.fixed), false};
}

template <int B>
void LevelMatrices<B>::continue_below(std::vector<Prolongation> prolongations,
                                      std::vector<GalerkinMatrix<B>> matrices) {
  algebraic_ = prolongations.size();
  prolongations_.insert(prolongations_.begin(), std::make_move_iterator(prolongations.begin()),
                        std::make_move_iterator(prolongations.end()));
  galerkin_ = std::move(matrices);
  is_product_.assign(galerkin_.size(), true);
}

template <int B>
void LevelMatrices<B>::drop_algebraic() {
  prolongations_.erase(prolongations_.begin(), prolongations_.begin() + static_cast<Offset>(algebraic_));
  algebraic_ = 0;
  galerkin_.clear();
  is_product_.clear();
}

template class LevelMatrices<1>;
template class LevelMatrices<2>;
template class LevelMatrices<3>;

}  // namespace signorini
