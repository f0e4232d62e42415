#pragma once
#include "core/sdk/block.hpp"
#include "core/solver/level.hpp"

/// The small blocks at vectors that are not plain: rotations between local and global coordinates, and the removal of
/// components that do not interpolate. `frames` are those of the level that count for interpolation.
namespace signorini::modifier {

template <int B>
inline bool is_plain(const Level<B>& level, const Frames<B>& frames, Index p) {
  return level.removed(p) == 0 && (B == 1 || !frames.at(p));
}

template <int B>
inline void drop(Flags components, double* x) {
  for (int k = 0; k < B; ++k)
    if (components >> k & 1u) x[k] = 0;
}

/// local = D N' global: what an interpolated value does to the components that take part
template <int B>
inline void value_to_local(const Level<B>& level, const Frames<B>& frames, Index p, const double* global,
                           double* local) {
  if (const double* N = frames.dual_at(p))
    block::transposed_product<B>(N, global, local);
  else
    for (int k = 0; k < B; ++k) local[k] = global[k];
  drop<B>(level.removed(p), local);
}

/// global = N D local, the transposed of value_to_local
template <int B>
inline void force_to_global(const Level<B>& level, const Frames<B>& frames, Index p, const double* local,
                            double* global) {
  double kept[B];
  for (int k = 0; k < B; ++k) kept[k] = local[k];
  drop<B>(level.removed(p), kept);
  if (const double* N = frames.dual_at(p))
    block::product<B>(N, kept, global);
  else
    for (int k = 0; k < B; ++k) global[k] = kept[k];
}

/// local = D Q' global, D dropping the components that are off
template <int B>
inline void force_to_local(const LevelSystem<B>& level, Index q, const double* global, double* local) {
  if (const double* Q = level.frames.at(q))
    block::transposed_product<B>(Q, global, local);
  else
    for (int k = 0; k < B; ++k) local[k] = global[k];
  drop<B>(level.off[q], local);
}

/// M = N_p D_p A D_r N_r' for the matrix block A between p and r in local coordinates
template <int B>
inline void block_to_global(const Level<B>& level, const Frames<B>& frames, Index p, Index r, const double* A,
                            double* M) {
  const Flags removed_p = level.removed(p), removed_r = level.removed(r);
  double T[B * B];
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) T[i * B + j] = (removed_p >> i & 1u) || (removed_r >> j & 1u) ? 0 : A[i * B + j];
  const double *Np = frames.dual_at(p), *Nr = frames.dual_at(r);
  double S[B * B];
  if (Np)
    block::multiply<B>(Np, T, S);
  else
    for (int i = 0; i < B * B; ++i) S[i] = T[i];
  if (Nr)
    block::multiply_transposed<B>(S, Nr, M);
  else
    for (int i = 0; i < B * B; ++i) M[i] = S[i];
}

/// M = D_p Q_p' M Q_r D_r for a block M between p and r in global coordinates
template <int B>
inline void block_to_local(const LevelSystem<B>& level, Index p, Index r, Flags dropped_p, Flags dropped_r, double* M) {
  double S[B * B];
  if (const double* Q = level.frames.at(p)) {
    block::transposed_multiply<B>(Q, M, S);
    for (int i = 0; i < B * B; ++i) M[i] = S[i];
  }
  if (const double* Q = level.frames.at(r)) {
    block::multiply<B>(M, Q, S);
    for (int i = 0; i < B * B; ++i) M[i] = S[i];
  }
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j)
      if ((dropped_p >> i & 1u) || (dropped_r >> j & 1u)) M[i * B + j] = 0;
}

}  // namespace signorini::modifier
