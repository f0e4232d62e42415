#pragma once
#include <span>

#include "core/mesh/element_map.hpp"

namespace signorini::mortar {

/// A point of a quadrature rule over what is covered of a face, by its barycentric coordinates there.
template <int K>
struct CoveredPoint {
  std::array<double, K + 1> at;
  double weight;
};

/// The dual basis over what is covered of a face of order P, ω.
///
/// Its functions are ψ_p = D_p r_p with D_p = ∫ φ_p, and ∫ r_p f is the coefficient at node p of every polynomial f of
/// degree P, so that ∫ ψ_p φ_q = D_p δ_pq. That is the matrix D_e M_e⁻¹, but in polynomials about the middle of ω,
/// along its principal directions and over its width, in which it is well conditioned for slivers as well. The D_p of
/// quadratic faces may be negative where little of them is covered.
template <int K, int P>
class DualBasis {
 public:
  static constexpr std::size_t nodes = element_nodes<K, P>;
  using Values = std::array<double, nodes>;

  /// @param covered of a rule that is exact for polynomials of degree 2 P; at least one point
  explicit DualBasis(std::span<const CoveredPoint<K>> covered);

  /// D_p
  const Values& share() const { return share_; }
  /// The ω is a strip that is too thin for polynomials of full degree across it: the r_p are of a lower one there.
  bool lumped() const { return lumped_; }
  /// The r_p at a point.
  Values operator()(const std::array<double, K + 1>& barycentric) const;

 private:
  Point<K> local(const std::array<double, K + 1>& barycentric) const;
  static Values monomials(const Point<K>& y);
  void find_axes(std::span<const CoveredPoint<K>> covered);
  void drop_thin();
  void solve(std::array<Values, nodes>& gram);

  Point<K> middle_{};
  std::array<Point<K>, K> axis_;  // over the width of ω along them
  Point<K> relative_;             // that width over the face's
  Values share_{};
  std::array<bool, nodes> kept_;         // of the monomials
  std::array<Values, nodes> factors_{};  // of the monomials in r_p
  bool lumped_ = false;
};

}  // namespace signorini::mortar
