#include "amg/black_box/recognise_block.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace signorini {

namespace {

constexpr double most = 0.6, mostly_not = 0.25;  // of pairs of rows
constexpr double more_than_rounding = 1e-5;      // part of couplings; of cells stretched s times it is about 0.3 / s
constexpr Index fewest_blocks = 4;               // below, chance makes rows alike
/// Blocks that both rows are coupled to over those that one is. Zeros and single prescribed components take some away;
/// neighbours in a seven-point stencil have 5 / 7.
constexpr double enough_alike = 0.75;

/// Compares which blocks rows are coupled to, blocks beginning `shift` columns before a multiple of their size.
class BlockCouplings {
 public:
  BlockCouplings(const SparseRows& A, Index block, Index shift) : A_(A), block_(block), shift_(shift) {}

  /// Part of the pairs of rows i and i + 1, i + shift + 1 no multiple of the block, that are coupled to the same
  /// blocks; pairs with rows that are coupled to nothing, such as those of prescribed values, do not count, nor those
  /// that are coupled to each other only: any two scalars may be.
  double part_alike() {
    Index found = 0, count = 0;
    for (Index i = 0; i + 1 < A_.rows; ++i) {
      if ((i + shift_ + 1) % block_ == 0 || alone(i) || alone(i + 1)) continue;
      find(i, one_);
      find(i + 1, other_);
      if (one_.size() == 1 && one_ == other_) continue;
      ++count;
      both_.clear();
      std::ranges::set_intersection(one_, other_, std::back_inserter(both_));
      const auto either = static_cast<double>(one_.size() + other_.size() - both_.size());
      found += static_cast<double>(both_.size()) >= enough_alike * either;
    }
    return count > 0 ? static_cast<double>(found) / count : 0;
  }

 private:
  bool alone(Index i) const {
    return std::all_of(A_.column.begin() + A_.row[i], A_.column.begin() + A_.row[i + 1],
                       [i](Index c) { return c == i; });
  }

  void find(Index i, std::vector<Index>& blocks) const {
    blocks.clear();
    for (Offset k = A_.row[i]; k < A_.row[i + 1]; ++k)
      if (A_.value[k] != 0) blocks.push_back((A_.column[k] + shift_) / block_);
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  }

  const SparseRows& A_;
  const Index block_, shift_;
  std::vector<Index> one_, other_, both_;
};

/// Rows i and i + 1 of different blocks that are coupled to the same columns but for few.
double part_alike_across(const SparseRows& A, Index block) {
  // Shifted by one, the pairs within blocks of two are those across; of three, one of the two pairs is.
  const double part = BlockCouplings(A, block, 1).part_alike();
  return block == 2 ? part : std::max(0.0, 2 * part - 1);
}

/// Absolute couplings of different components over all couplings of different unknowns.
double part_mixed(const SparseRows& A, Index block) {
  double mixed = 0, all = 0;
  for (Index i = 0; i < A.rows; ++i)
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k) {
      const Index j = A.column[k];
      if (i == j) continue;
      all += std::abs(A.value[k]);
      if (i % block != j % block) mixed += std::abs(A.value[k]);
    }
  return all > 0 ? mixed / all : 0;
}

}  // namespace

int recognised_block(const SparseRows& A) {
  if (!is_square(A)) return 1;
  for (const Index block : {3, 2})
    if (A.rows % block == 0 && A.rows >= fewest_blocks * block && BlockCouplings(A, block, 0).part_alike() >= most &&
        part_alike_across(A, block) <= mostly_not && part_mixed(A, block) >= more_than_rounding)
      return block;
  return 1;
}

}  // namespace signorini
