#pragma once
#include "core/solver/components.hpp"

namespace signorini {

/// Transfer between two levels from interpolation weights; the few vectors that are rotated, truncated or
/// prescribed get their small block modifiers on the fly. The merge of bounds is left to the monotone restriction.
template <int B>
class BlockTransfer : public Transfer<B> {
 public:
  void prepare(const Level<B>& fine, const Prolongation& prolongation, bool rotate, LevelSystem<B>& coarse) override;
  void prepare_assembled(const Level<B>& fine, const Prolongation& prolongation, bool rotate,
                         LevelSystem<B>& coarse) override;
  const std::vector<Index>& assemble(const Level<B>& fine, LevelSystem<B>& coarse) override;
  void begin_restriction(LevelSystem<B>& coarse) const override;
  void restrict_residual(const Level<B>& fine, Index first, Index last, const double* r,
                         LevelSystem<B>& coarse) const override;
  void end_restriction(LevelSystem<B>& coarse) const override;
  void begin_prolongation(const LevelSystem<B>& coarse) const override;
  void prolongate(const LevelSystem<B>& coarse, const Level<B>& fine, Index first, Index last) const override;

 protected:
  const Prolongation& weights() const { return *P_; }
  /// Those that matter to interpolation.
  const Frames<B>& frames(const Level<B>& fine) const { return P_->local ? no_frames_ : fine.frames; }

 private:
  void begin(const Level<B>& fine, const Prolongation& prolongation, bool rotate, LevelSystem<B>& coarse);
  void inherit_twins(const Level<B>& fine, bool rotate, LevelSystem<B>& coarse) const;
  void give_slots(const Level<B>& fine, LevelSystem<B>& coarse) const;
  void sum_terms(const Level<B>& fine, LevelSystem<B>& coarse) const;
  void adopt(const GalerkinMatrix<B>& known, bool complete, LevelSystem<B>& coarse);
  void transpose_weights();
  void begin_pattern(const BlockMatrix<B>& A, BlockMatrix<B>& coarse);
  void build_pattern(const BlockMatrix<B>& A, BlockMatrix<B>& coarse);
  void append_pattern(Index q, BlockMatrix<B>& coarse);
  void create(const Level<B>& fine, LevelSystem<B>& coarse);
  std::vector<Index> affected_rows(const Level<B>& fine);
  void mark_parents(Index p, std::vector<Index>& rows);
  void clear_reached();
  Index reach(Index r);
  void reach_neighbours(const BlockMatrix<B>& A, Index q);
  template <class Weight>
  bool sum_children(const Level<B>& fine, Index q, const Weight& weight);
  template <class Weight>
  void sum_parents(LevelSystem<B>& coarse, Index q, std::size_t summed, const Weight& weight);
  template <class Weight>
  void add_alone(const Level<B>& fine, Index p, const double* M, const Weight& W);
  void finish_row(LevelSystem<B>& coarse, Index q);

  struct Child {
    Index vector;
    Index entry;  // of its weights
  };
  const Prolongation* P_ = nullptr;
  const Frames<B> no_frames_{};
  std::vector<Offset> child_row_;  // transposed weights: the fine vectors that a coarse one interpolates to
  std::vector<Child> child_;
  std::vector<Flags> prescribed_;  // per coarse vector: components off whatever is truncated
  std::vector<Offset> position_;   // per coarse vector: its block in the row at work, or in an earlier one, -1: in none
  std::vector<char> marked_;       // per coarse vector
  std::vector<Index> place_;       // per fine vector: its block among `sums_`, -1: none
  std::vector<Index> reached_;     // fine vectors that the row at work is coupled to
  std::vector<double> sums_;       // the blocks of those that are summed, which come first
  double alone_[B * B] = {};       // of the row at work: what its diagonal would be if no fine vectors were coupled
  double untruncated_ = 0;         // the size of that without truncation
  bool assembled_ = false;
  std::vector<Index> rows_;  // recomputed the last time
};

}  // namespace signorini
