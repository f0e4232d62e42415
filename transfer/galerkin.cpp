// Coarse matrices: A_c = P'AP with the modifiers of rotated and truncated vectors, row by row, so that recomputing the
// rows near a phase change gives bitwise what a full assembly gives (Krause, 4.5).
#include <algorithm>
#include <cassert>
#include <numeric>
#include <span>

#include "core/algebra/fill_in.hpp"
#include "core/solver/weights.hpp"
#include "transfer/block_transfer.hpp"
#include "transfer/modifier.hpp"

namespace signorini {

namespace {

// A component is lost when its fine functions, each by itself, have less than this part of the energy that they would
// have without truncation; what rounding of rotations leaves is far smaller, a component with any fine function left
// far larger.
constexpr double lost = 1e-13;

// A component is a motion without energy when its energy is less than this part of that of its finest functions by
// themselves, which is rounding; a spring of this part holds it: weak, so that a body may fall onto an obstacle, and
// strong enough that rounding of the residual does not move it.
constexpr double nothing = 1e-14, spring = 1e-8;

template <int B>
void decouple(BlockMatrix<B>& C, Index q, Flags off) {
  double* diagonal = C.at(C.row[q]);
  for (int i = 0; i < B; ++i) {
    if (!(off >> i & 1u)) continue;
    for (Offset k = C.row[q]; k < C.row[q + 1]; ++k) std::fill_n(C.at(k) + i * B, B, 0.0);
    for (int j = 0; j < B; ++j) diagonal[j * B + i] = 0;
    diagonal[i * B + i] = 1;
  }
}

template <int B>
void invert_diagonal(LevelSystem<B>& level, Index q) {
  double* inverse = level.inverse.data() + Offset{q} * B * B;
  block::invert<B>(level.own_matrix.diagonal(q), inverse);
  for (int i = 0; i < B; ++i)
    if (level.off[q] >> i & 1u) inverse[i * B + i] = 0;
}

}  // namespace

template <int B>
void BlockTransfer<B>::adopt(const GalerkinMatrix<B>& known, bool complete, LevelSystem<B>& coarse) {
  bool fits = true;
  if (complete)
    coarse.own_matrix = known.A;
  else
    fill_in(known.A, coarse.own_matrix, position_, [&fits](Index, Index) { fits = false; });
  if (!fits) {  // the finer matrix couples less than the one that the product is of: it is computed
    std::fill(coarse.own_matrix.value.begin(), coarse.own_matrix.value.end(), 0.0);
    return;
  }
  coarse.off = prescribed_ = known.off;
  for (Index q = 0; q < coarse.vectors; ++q) invert_diagonal(coarse, q);
  assembled_ = true;
}

template <int B>
void BlockTransfer<B>::transpose_weights() {
  const auto n = static_cast<std::size_t>(P_->coarse);
  child_row_.assign(n + 1, 0);
  for (const Index q : P_->column) ++child_row_[static_cast<std::size_t>(q) + 1];
  for (std::size_t q = 0; q < n; ++q) child_row_[q + 1] += child_row_[q];
  child_.resize(P_->column.size());
  std::vector<Offset> next(child_row_.begin(), child_row_.end() - 1);
  for (Index p = 0; p < P_->fine(); ++p)
    for (Offset k = P_->row[p]; k < P_->row[p + 1]; ++k)
      child_[next[P_->column[k]]++] = {p, static_cast<Index>(k - P_->row[p])};
}

template <int B>
void BlockTransfer<B>::begin_pattern(const BlockMatrix<B>& A, BlockMatrix<B>& coarse) {
  transpose_weights();
  coarse.row.assign(1, 0);
  coarse.row.reserve(static_cast<std::size_t>(P_->coarse) + 1);
  coarse.column.clear();
  const std::size_t blocks = P_->column.size() + static_cast<std::size_t>(P_->coarse);  // a guess
  coarse.column.reserve(blocks);
  coarse.value.clear();
  coarse.value.reserve(blocks * B * B);
  place_.assign(static_cast<std::size_t>(A.size()), -1);
}

// The coarse vectors that a row reaches through the fine ones that its children are coupled to.
template <int B>
void BlockTransfer<B>::build_pattern(const BlockMatrix<B>& A, BlockMatrix<B>& coarse) {
  begin_pattern(A, coarse);
  for (Index q = 0; q < P_->coarse; ++q) {
    clear_reached();
    reach_neighbours(A, q);
    append_pattern(q, coarse);
  }
}

// Row q from the fine vectors reached, zero.
template <int B>
void BlockTransfer<B>::append_pattern(Index q, BlockMatrix<B>& coarse) {
  const auto begin = static_cast<Offset>(coarse.column.size());  // positions of earlier rows lie before
  const auto add = [&](Index s) {
    if (position_[s] >= begin) return;
    position_[s] = begin;
    coarse.column.push_back(s);
  };
  add(q);
  for (const Index r : reached_)
    for (Offset m = P_->row[r]; m < P_->row[r + 1]; ++m) add(P_->column[m]);
  std::sort(coarse.column.begin() + begin + 1, coarse.column.end());
  coarse.row.push_back(static_cast<Offset>(coarse.column.size()));
  coarse.value.resize(coarse.column.size() * B * B, 0.0);
}

template <int B>
void BlockTransfer<B>::create(const Level<B>& fine, LevelSystem<B>& coarse) {
  prescribed_ = coarse.off;
  begin_pattern(*fine.A, coarse.own_matrix);
  weights::with<B>(*P_, [&](const auto& weight) {
    for (Index q = 0; q < P_->coarse; ++q) {
      const bool complete = sum_children(fine, q, weight);
      const std::size_t summed = reached_.size();
      if (!complete) reach_neighbours(*fine.A, q);  // what is truncated now may come back
      append_pattern(q, coarse.own_matrix);
      sum_parents(coarse, q, summed, weight);
      finish_row(coarse, q);
    }
  });
  assembled_ = true;
}

template <int B>
const std::vector<Index>& BlockTransfer<B>::assemble(const Level<B>& fine, LevelSystem<B>& coarse) {
  if (!assembled_) {
    prescribed_ = coarse.off;
    rows_.resize(static_cast<std::size_t>(coarse.vectors));
    std::iota(rows_.begin(), rows_.end(), Index{0});
  } else {
    rows_ = affected_rows(fine);
  }
  if (!rows_.empty() && child_row_.empty()) transpose_weights();
  place_.resize(static_cast<std::size_t>(fine.vectors), -1);
  BlockMatrix<B>& C = coarse.own_matrix;
  weights::with<B>(*P_, [&](const auto& weight) {
    for (const Index q : rows_) {
      sum_children(fine, q, weight);
      std::fill(C.at(C.row[q]), C.at(C.row[q + 1]), 0.0);
      sum_parents(coarse, q, reached_.size(), weight);
      finish_row(coarse, q);
    }
  });
  assembled_ = true;
  return rows_;
}

template <int B>
void BlockTransfer<B>::mark_parents(Index p, std::vector<Index>& rows) {
  for (Offset k = P_->row[p]; k < P_->row[p + 1]; ++k)
    if (const Index q = P_->column[k]; !marked_[q]) {
      marked_[q] = 1;
      rows.push_back(q);
    }
}

// A row changes with the fine rows it is made of, and with the truncation of their neighbours.
template <int B>
std::vector<Index> BlockTransfer<B>::affected_rows(const Level<B>& fine) {
  std::vector<Index> rows;
  for (const Index p : fine.outdated.renewed) mark_parents(p, rows);
  for (const Index p : fine.outdated.changed)
    for (Offset k = fine.A->row[p]; k < fine.A->row[p + 1]; ++k) mark_parents(fine.A->column[k], rows);
  for (const Index q : rows) marked_[q] = 0;
  std::sort(rows.begin(), rows.end());
  return rows;
}

// Adds what vector p would give to the diagonal if it were coupled to no other.
// @param M its block in global coordinates, null where nothing of it interpolates
template <int B>
template <class Weight>
void BlockTransfer<B>::add_alone(const Level<B>& fine, Index p, const double* M, const Weight& W) {
  const double* diagonal = fine.A->diagonal(p);
  for (int i = 0; i < B; ++i)
    if (!(fine.off[p] >> i & 1u)) untruncated_ += W.size() * W.size() * diagonal[i * B + i];
  if (!M) return;
  double half[B * B] = {};
  W.add_from_left(M, half);
  W.add_from_right(half, alone_);
}

template <int B>
void BlockTransfer<B>::clear_reached() {
  for (const Index r : reached_) place_[r] = -1;
  reached_.clear();
}

/// @return the place of fine vector r among those reached
template <int B>
Index BlockTransfer<B>::reach(Index r) {
  if (place_[r] < 0) {
    place_[r] = static_cast<Index>(reached_.size());
    reached_.push_back(r);
  }
  return place_[r];
}

// The fine vectors that the children of a coarse one are coupled to.
template <int B>
void BlockTransfer<B>::reach_neighbours(const BlockMatrix<B>& A, Index q) {
  for (Offset c = child_row_[q]; c < child_row_[q + 1]; ++c) {
    const Index p = child_[c].vector;
    if (P_->midpoints)
      reach(p);
    else
      for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) reach(A.column[k]);
  }
}

// Row q of P'A in global coordinates, for the fine vectors reached. Returns whether nothing was left out as truncated.
template <int B>
template <class Weight>
bool BlockTransfer<B>::sum_children(const Level<B>& fine, Index q, const Weight& weight) {
  const BlockMatrix<B>& A = *fine.A;
  constexpr Flags all = (1u << B) - 1;
  bool complete = true;
  clear_reached();
  std::fill_n(alone_, B * B, 0.0);
  untruncated_ = 0;
  const auto sum_at = [this](Index r) {
    const bool first = place_[r] < 0;
    const std::size_t at = static_cast<std::size_t>(reach(r)) * B * B;
    if (first) {
      if (at == sums_.size()) sums_.resize(2 * at + B * B);
      std::fill_n(sums_.data() + at, B * B, 0.0);
    }
    return sums_.data() + at;
  };
  for (Offset c = child_row_[q]; c < child_row_[q + 1]; ++c) {
    const Offset k = A.row[child_[c].vector];
    __builtin_prefetch(A.column.data() + k);
    __builtin_prefetch(A.at(k));
  }
  for (Offset c = child_row_[q]; c < child_row_[q + 1]; ++c) {
    const Index p = child_[c].vector;
    const auto W = weight(P_->row[p] + child_[c].entry);
    if (fine.removed(p) == all) {
      add_alone(fine, p, nullptr, W);
      complete = false;
      continue;
    }
    const bool plain = modifier::is_plain<B>(fine, frames(fine), p);
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) {
      const Index r = A.column[k];
      if (fine.removed(r) == all) {
        complete = false;
        continue;
      }
      const double* M = A.at(k);
      double curved[B * B], modified[B * B];
      if (fine.nonlinear && r == p)
        if (const double* H = fine.curvature(p)) {
          for (int i = 0; i < B * B; ++i) curved[i] = M[i] + H[i];
          M = curved;
        }
      if (!plain || !modifier::is_plain<B>(fine, frames(fine), r)) {
        modifier::block_to_global<B>(fine, frames(fine), p, r, M, modified);
        M = modified;
      }
      if (r == p) add_alone(fine, p, M, W);
      W.add_from_left(M, sum_at(r));
    }
  }
  return complete;
}

// Adds (P'A)P to row q, of the first `summed` fine vectors reached.
template <int B>
template <class Weight>
void BlockTransfer<B>::sum_parents(LevelSystem<B>& coarse, Index q, std::size_t summed, const Weight& weight) {
  BlockMatrix<B>& C = coarse.own_matrix;
  for (Offset k = C.row[q]; k < C.row[q + 1]; ++k) position_[C.column[k]] = k;
  const double* sum = sums_.data();
  for (const Index r : std::span(reached_).first(summed)) {
    for (Offset m = P_->row[r]; m < P_->row[r + 1]; ++m) {
      const Offset k = position_[P_->column[m]];
      assert(k >= C.row[q] && k < C.row[q + 1] && C.column[k] == P_->column[m]);
      weight(m).add_from_right(sum, C.at(k));
    }
    sum += B * B;
  }
}

// Rotates the row into the coarse frames, and decouples what has lost all its fine functions (Krause, remark 4.4): its
// diagonal becomes one, and it neither gets a residual nor interpolates. What is seen to be indefinite is as well.
template <int B>
void BlockTransfer<B>::finish_row(LevelSystem<B>& coarse, Index q) {
  BlockMatrix<B>& C = coarse.own_matrix;
  for (Offset k = C.row[q]; k < C.row[q + 1]; ++k)
    modifier::block_to_local<B>(coarse, q, C.column[k], prescribed_[q], prescribed_[C.column[k]], C.at(k));
  modifier::block_to_local<B>(coarse, q, q, prescribed_[q], prescribed_[q], alone_);
  double* diagonal = C.at(C.row[q]);
  Flags off = prescribed_[q];
  for (int i = 0; i < B; ++i) {
    double& own = diagonal[i * B + i];
    const double alone = alone_[i * B + i];
    const double terms = coarse.terms[q];
    if (!(alone > lost * untruncated_) || !(own >= -nothing * terms))
      off |= static_cast<Flags>(1u << i);
    else if (own < nothing * terms)
      own = spring * terms;
  }
  decouple(C, q, off);
  coarse.off[q] = off;
  invert_diagonal(coarse, q);
}

template class BlockTransfer<1>;
template class BlockTransfer<2>;
template class BlockTransfer<3>;

}  // namespace signorini
