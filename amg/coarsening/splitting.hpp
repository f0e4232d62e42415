#pragma once
#include <vector>

#include "amg/coarsening/strength.hpp"

namespace signorini {

enum class VectorKind : std::uint8_t { coarse, fine };

/// The first pass of Ruge and Stueben (Multigrid Methods, SIAM 1987, ch. 4.6), in linear time: vectors become coarse in
/// the order of how many open ones would interpolate from them, most first, and those then are fine. Vectors without
/// any coupling are `alone`.
std::vector<VectorKind> split(const StrengthGraph& needs, VectorKind alone);

/// The coarse ones among the vectors of a graph.
struct CoarseVectors {
  std::vector<Index> number;  ///< per vector, -1: fine
  std::vector<Index> vector;  ///< per coarse vector, ascending

  explicit CoarseVectors(const std::vector<VectorKind>& part);
  Index size() const { return static_cast<Index>(vector.size()); }
};

/// How the coarse vectors are coupled among themselves, directly or through one vector between them: couplings by
/// several paths count, those by a single one of many do not. With the couplings of a five-point stencil these are the
/// diagonal neighbours of a checkerboard (aggressive coarsening: Stueben, J. Comput. Appl. Math. 128, 2001).
/// @param by_several leave out also couplings by a single path that are the largest of their row
StrengthGraph couplings_among(const CoarseVectors& coarse, const StrengthGraph& graph, bool by_several = false);

}  // namespace signorini
