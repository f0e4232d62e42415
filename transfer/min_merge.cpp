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

}  // namespace

template <int B>
void MinMerge<B>::restrict_bounds(const Level<B>& fine, Level<B>& coarse) const {
  std::fill(coarse.constraints.lower.begin(), coarse.constraints.lower.end(), -infinity);
  std::fill(coarse.constraints.upper.begin(), coarse.constraints.upper.end(), infinity);
  for (Index slot = 0; slot < fine.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k)
      if (!(fine.removed[fine.constraints.vector[slot]] >> k & 1u)) merge(fine, slot, k, coarse);
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
      if (share == 0) continue;
      double& coarse_lower = coarse.constraints.lower[at + j];
      double& coarse_upper = coarse.constraints.upper[at + j];
      coarse_lower = std::max(coarse_lower, (share > 0 ? lower : upper) / share);
      coarse_upper = std::min(coarse_upper, (share > 0 ? upper : lower) / share);
    }
  }
}

template class MinMerge<1>;
template class MinMerge<2>;
template class MinMerge<3>;

}  // namespace signorini
