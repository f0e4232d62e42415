#include "transfer/block_transfer.hpp"

#include <algorithm>
#include <cassert>

#include "core/solver/weights.hpp"
#include "transfer/modifier.hpp"

namespace signorini {

template <int B>
void BlockTransfer<B>::prepare(const Level<B>& fine, const Prolongation& prolongation, bool rotate,
                               LevelSystem<B>& coarse) {
  begin(fine, prolongation, rotate, coarse);
  const GalerkinMatrix<B>* known = coarse.galerkin;
  // A product of fewer couplings than the finer level has here lacks some as well.
  const bool fewer = fine.galerkin && fine.galerkin->A.column.size() < fine.A->column.size();
  const bool complete = known && known->complete && !fewer;
  if (!complete) build_pattern(*fine.A, coarse.own_matrix);
  if (known) adopt(*known, complete, coarse);
  coarse.chunks = divide(coarse.own_matrix);
}

template <int B>
void BlockTransfer<B>::prepare_assembled(const Level<B>& fine, const Prolongation& prolongation, bool rotate,
                                         LevelSystem<B>& coarse) {
  begin(fine, prolongation, rotate, coarse);
  create(fine, coarse);
  coarse.chunks = divide(coarse.own_matrix);
}

template <int B>
void BlockTransfer<B>::begin(const Level<B>& fine, const Prolongation& prolongation, bool rotate,
                             LevelSystem<B>& coarse) {
  assert(prolongation.fine() == fine.vectors);
  P_ = &prolongation;
  const auto n = static_cast<std::size_t>(prolongation.coarse);
  position_.assign(n, -1);
  marked_.assign(n, 0);
  coarse.vectors = prolongation.coarse;
  coarse.inverse.resize(n * B * B);
  coarse.own_b.resize(n * B);
  coarse.own_x.resize(n * B);
  coarse.b = coarse.own_b.data();
  coarse.x = coarse.own_x.data();
  coarse.A = &coarse.own_matrix;
  inherit_twins(fine, rotate, coarse);
  give_slots(fine, coarse);
  sum_terms(fine, coarse);
}

// A frame, and what is prescribed in it, passes from a vector to its coarse twin. Without the frame nothing can be
// prescribed there: then the fine rows alone see to it.
template <int B>
void BlockTransfer<B>::inherit_twins(const Level<B>& fine, bool rotate, LevelSystem<B>& coarse) const {
  coarse.off.assign(static_cast<std::size_t>(coarse.vectors), 0);
  const std::vector<Index> twins = P_->twins();
  for (Index q = 0; q < coarse.vectors; ++q) {
    const Index p = twins[q];
    if (p < 0) continue;
    const double* Q = frames(fine).at(p);
    if (!Q) {
      coarse.off[q] = fine.off[p];
    } else if (rotate) {
      coarse.off[q] = fine.off[p];
      coarse.frames.add(coarse.off.size(), q, Q, frames(fine).dual_at(p));
    }
  }
}

// Every coarse vector that reaches a constrained one gets bounds: no coarse correction leaves the admissible set.
template <int B>
void BlockTransfer<B>::give_slots(const Level<B>& fine, LevelSystem<B>& coarse) const {
  Constraints<B>& c = coarse.constraints;
  c.slot.assign(static_cast<std::size_t>(coarse.vectors), -1);
  for (const Index p : fine.constraints.vector)
    for (Offset k = P_->row[p]; k < P_->row[p + 1]; ++k) c.slot[P_->column[k]] = 0;
  for (Index q = 0; q < coarse.vectors; ++q)
    if (c.slot[q] == 0) {
      c.slot[q] = c.size();
      c.vector.push_back(q);
    }
  c.lower.resize(c.vector.size() * B);
  c.upper.resize(c.vector.size() * B);
}

// Whatever is truncated: energies far below these are rounding.
template <int B>
void BlockTransfer<B>::sum_terms(const Level<B>& fine, LevelSystem<B>& coarse) const {
  const auto terms_at = [&](Index p) {
    if (!fine.terms.empty()) return fine.terms[p];
    double largest = 0;
    for (int i = 0; i < B; ++i)
      if (!(fine.off[p] >> i & 1u)) largest = std::max(largest, fine.A->diagonal(p)[i * B + i]);
    return largest;
  };
  coarse.terms.assign(static_cast<std::size_t>(coarse.vectors), 0.0);
  weights::with<B>(*P_, [&](const auto& weight) {
    for (Index p = 0; p < fine.vectors; ++p) {
      const double terms = terms_at(p);
      for (Offset k = P_->row[p]; k < P_->row[p + 1]; ++k) {
        const double size = weight(k).size();
        coarse.terms[P_->column[k]] += size * size * terms;
      }
    }
  });
}

template <int B>
void BlockTransfer<B>::begin_restriction(LevelSystem<B>& coarse) const {
  std::fill(coarse.own_b.begin(), coarse.own_b.end(), 0.0);
  std::fill(coarse.own_x.begin(), coarse.own_x.end(), 0.0);
}

template <int B>
void BlockTransfer<B>::restrict_residual(const Level<B>& fine, Index first, Index last, const double* r,
                                         LevelSystem<B>& coarse) const {
  weights::with<B>(*P_, [&](const auto& weight) {
    for (Index p = first; p < last; ++p, r += B) {
      double global[B];
      if (modifier::is_plain<B>(fine, frames(fine), p)) {
        for (int i = 0; i < B; ++i) global[i] = r[i];
      } else {
        modifier::force_to_global<B>(fine, frames(fine), p, r, global);
      }
      for (Offset k = P_->row[p]; k < P_->row[p + 1]; ++k)
        weight(k).add_force(global, coarse.own_b.data() + Offset{P_->column[k]} * B);
    }
  });
}

template <int B>
void BlockTransfer<B>::end_restriction(LevelSystem<B>& coarse) const {
  for (Index q = 0; q < coarse.vectors; ++q) {
    const double* Q = coarse.frames.at(q);
    if (!Q && !coarse.off[q]) continue;
    double* b = coarse.own_b.data() + Offset{q} * B;
    double local[B];
    modifier::force_to_local<B>(coarse, q, b, local);
    std::copy(local, local + B, b);
  }
}

template <int B>
void BlockTransfer<B>::begin_prolongation(const LevelSystem<B>& coarse) const {
  if (coarse.frames.slot.empty()) return;
  for (Index q = 0; q < coarse.vectors; ++q)
    if (coarse.frames.at(q)) {
      double global[B];
      block::product<B>(coarse.frames.at(q), coarse.x + Offset{q} * B, global);
      std::copy(global, global + B, coarse.x + Offset{q} * B);
    }
}

template <int B>
void BlockTransfer<B>::prolongate(const LevelSystem<B>& coarse, const Level<B>& fine, Index first, Index last) const {
  weights::with<B>(*P_, [&](const auto& weight) {
    for (Index p = first; p < last; ++p) {
      double global[B] = {};
      weights::interpolate<B>(*P_, weight, p, coarse.x, global);
      double* x = fine.x + Offset{p} * B;
      if (modifier::is_plain<B>(fine, frames(fine), p)) {
        for (int i = 0; i < B; ++i) x[i] += global[i];
      } else {
        double local[B];
        modifier::value_to_local<B>(fine, frames(fine), p, global, local);
        for (int i = 0; i < B; ++i) x[i] += local[i];
      }
    }
  });
  const Constraints<B>& c = fine.constraints;
  const auto [from, to] = slots_between(c, first, last);
  for (Index slot = from; slot < to; ++slot) c.project(slot, fine.x + Offset{c.vector[slot]} * B);
}

template class BlockTransfer<1>;
template class BlockTransfer<2>;
template class BlockTransfer<3>;

}  // namespace signorini
