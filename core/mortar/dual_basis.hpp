#pragma once
#include <cmath>
#include <vector>

#include "core/mortar/segments.hpp"

namespace signorini::mortar {

/// Integrals of dual basis functions over what is covered of one slave face.
///
/// They are ψ_p = D_p r_p with D_p = ∫ φ_p, and r_p(y) = 1 / |ω| + (y_p − c)' C⁻¹ (y − c), c and C being the centroid
/// and the second moments of what is covered, ω: ∫ r_p f = f(y_p) for every affine f, so that ∫ ψ_p φ_q = D_p δ_pq.
/// That is the matrix D_e M_e⁻¹ in a basis in which it is diagonal, exact for slivers as well.
template <int D>
class DualBasis {
 public:
  static constexpr int K = D - 1;

  /// @param segments at least one
  DualBasis(const FaceFrame<D>& frame, const std::vector<Segment<D>>& segments);

  /// D_p, in the plane of the frame.
  double share(int p) const { return share_[p]; }
  /// The ω is a strip that is too thin for moments across it; r_p is constant there.
  bool lumped() const { return lumped_; }

  /// ∫ r_p f over a segment.
  struct Integral {
    double one;      ///< of f = 1
    Point<K> slope;  ///< of f = y
  };
  /// @param m moments of the segment in axes()
  Integral integral(const Moments<K>& m, int p) const {
    const double at = 1 / measure_ - dot(slope_[p], off_);
    Integral out{at * m.measure + dot(slope_[p], m.first), {}};
    for (int k = 0; k < K; ++k) out.slope[k] = at * m.first[k] + dot(m.second[k], slope_[p]);
    return out;
  }
  /// The integral of f, given in the frame's coordinates.
  double of(const Integral& r, const Affine<K>& f) const {
    const Affine<K> turned = axes_.of(f);
    return turned.at * r.one + dot(turned.slope, r.slope);
  }
  const Axes<K>& axes() const { return axes_; }

 private:
  void turn(const Moments<K>& m);
  void invert(const FaceFrame<D>& frame, const Moments<K>& m);

  Axes<K> axes_;  // through c, along the principal directions of C
  // By how much their origin misses c: rounding, but not of a thin strip's moments.
  Point<K> off_{};
  double measure_ = 0;
  std::array<double, D> share_{};
  std::array<Point<K>, D> slope_{};  // of r_p
  bool lumped_ = false;
};

}  // namespace signorini::mortar
