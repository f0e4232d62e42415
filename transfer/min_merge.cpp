#include "transfer/min_merge.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

namespace {

// Products of rotations that would vanish in exact arithmetic.
constexpr double negligible = 1e-14;

// d(fine direction) / d(coarse component j), for weight one
template <int B>
void coupling(const Level<B>& fine, Index p, int direction, const Level<B>& coarse, Index q, double* M) {
  const double *Np = fine.frames.dual_at(p), *Qq = coarse.frames.at(q);
  for (int j = 0; j < B; ++j) {
    M[j] = 0;
    for (int i = 0; i < B; ++i)
      M[j] += (Np ? Np[i * B + direction] : double(i == direction)) * (Qq ? Qq[i * B + j] : double(i == j));
    if ((coarse.off[q] >> j & 1u) || std::fabs(M[j]) <= negligible) M[j] = 0;
  }
}

// share * c must stay within the bounds for the coarse component c number `at`.
template <int B>
void tighten(Constraints<B>& coarse, Offset at, double share, double lower, double upper) {
  const double each = 1 / share;
  coarse.lower[at] = std::max(coarse.lower[at], (share > 0 ? lower : upper) * each);
  coarse.upper[at] = std::min(coarse.upper[at], (share > 0 ? upper : lower) * each);
}

}  // namespace

template <int B>
void MinMerge<B>::restrict_bounds(const Level<B>& fine, Level<B>& coarse) const {
  std::fill(coarse.constraints.lower.begin(), coarse.constraints.lower.end(), -infinity);
  std::fill(coarse.constraints.upper.begin(), coarse.constraints.upper.end(), infinity);
  const bool plain = fine.frames.slot.empty() && coarse.frames.slot.empty();
  for (Index slot = 0; slot < fine.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      if (fine.removed[fine.constraints.vector[slot]] >> k & 1u) continue;
      if (plain)
        merge_plain(fine, slot, k, coarse);
      else
        merge(fine, slot, k, coarse);
    }
}

// Where nothing is rotated every direction couples to itself alone.
template <int B>
void MinMerge<B>::merge_plain(const Level<B>& fine, Index slot, int direction, Level<B>& coarse) const {
  const Prolongation& P = this->weights();
  const double lower = fine.lower[Offset{slot} * B + direction], upper = fine.upper[Offset{slot} * B + direction];
  if (lower == -infinity && upper == infinity) return;
  const Index p = fine.constraints.vector[slot];
  const auto moves = [&](Offset k) { return P.weight[k] != 0 && !(coarse.off[P.column[k]] >> direction & 1u); };
  int terms = 0;
  for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) terms += moves(k);
  for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
    if (moves(k))
      tighten(coarse.constraints, Offset{coarse.constraints.slot[P.column[k]]} * B + direction, terms * P.weight[k],
              lower, upper);
}

template <int B>
void MinMerge<B>::merge(const Level<B>& fine, Index slot, int direction, Level<B>& coarse) const {
  const Prolongation& P = this->weights();
  const Index p = fine.constraints.vector[slot];
  const double lower = fine.lower[Offset{slot} * B + direction], upper = fine.upper[Offset{slot} * B + direction];
  if (lower == -infinity && upper == infinity) return;
  double M[B];
  int terms = 0;
  for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
    coupling<B>(fine, p, direction, coarse, P.column[k], M);
    for (int j = 0; j < B; ++j) terms += M[j] != 0 && P.weight[k] != 0;
  }
  for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
    const Index q = P.column[k];
    coupling<B>(fine, p, direction, coarse, q, M);
    const Offset at = Offset{coarse.constraints.slot[q]} * B;
    for (int j = 0; j < B; ++j) {
      const double share = terms * P.weight[k] * M[j];
      if (share != 0) tighten(coarse.constraints, at + j, share, lower, upper);
    }
  }
}

template class MinMerge<1>;
template class MinMerge<2>;
template class MinMerge<3>;

}  // namespace signorini
