#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/solver/discrete_problem.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Interpolations between levels, and the matrices of those below the finest one, which a solver takes over where it
/// would compute the same. Levels are meshes, numbered as in their hierarchy, and below them algebraic ones.
template <int B>
class LevelMatrices {
 public:
  /// @param first the coarsest mesh that is a level
  /// @param factorised the number of meshes that need no coarser level
  /// @param between the meshes, from `first` on
  LevelMatrices(std::size_t first, std::size_t factorised, std::vector<Prolongation> between)
      : first_(first), factorised_(factorised), prolongations_(std::move(between)) {}

  /// From a mesh to the next finer one.
  const Prolongation& above(std::size_t level) const { return prolongations_[number(level)]; }
  std::span<Prolongation> between_meshes() { return std::span(prolongations_).subspan(algebraic_); }
  std::span<const Prolongation> between_algebraic() const { return std::span(prolongations_).first(algebraic_); }
  /// What a solve on a mesh goes down to.
  std::span<const Prolongation> below(std::size_t level) const {
    return std::span(prolongations_).first(number(level)).subspan(left_out(level));
  }

  /// The matrices of the same levels, if all are there; else none.
  std::span<const GalerkinMatrix<B>> matrices_below(std::size_t level) const;
  /// Likewise, if all of them are products.
  std::span<const GalerkinMatrix<B>> products_below(std::size_t level) const;
  /// The matrix of a mesh, to be given back by share(); null: not there.
  GalerkinMatrix<B>* of(std::size_t level) {
    return number(level) < galerkin_.size() ? &galerkin_[number(level)] : nullptr;
  }
  /// On nested meshes the matrix of the coarser one is the product that the solver would compute: it takes it over.
  /// @param coarse problem on the next coarser mesh than `level`; without its matrix afterwards
  /// @param changed whether one of the two matrices is another one than when it was last shared
  void share(DiscreteProblem<B>& coarse, std::size_t level, const DiscreteProblem<B>& problem, bool changed);
  /// No matrix is known to be a product any more.
  void forget_products() { is_product_.assign(galerkin_.size(), false); }

  /// Algebraic levels below the coarsest mesh.
  /// @param matrices one for each prolongation
  void continue_below(std::vector<Prolongation> prolongations, std::vector<GalerkinMatrix<B>> matrices);
  /// Takes them away.
  void drop_algebraic();

 private:
  std::size_t number(std::size_t level) const { return algebraic_ + level - first_; }
  std::size_t left_out(std::size_t level) const;  // the number of coarsest meshes that are no levels below this one
  bool all_products(std::size_t count) const;

  std::size_t first_, factorised_;
  std::vector<Prolongation> prolongations_;  // between the meshes, after those between algebraic levels
  std::size_t algebraic_ = 0;                // number of the latter
  std::vector<GalerkinMatrix<B>> galerkin_;  // of the levels below the finest, as far as they are there
  std::vector<bool> is_product_;             // of each of these: the solver would compute it for the next finer level
};

}  // namespace signorini
