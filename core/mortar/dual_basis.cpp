#include "core/mortar/dual_basis.hpp"

#include <algorithm>
#include <cmath>

namespace signorini::mortar {
namespace {

// Monomials are left out that are of less than this size over what is covered of a face, beside the whole of it.
constexpr double thin = 1e-6;

// Nor those of which no more is left once those before them are taken out, as of squares over two points.
constexpr double dependent = 1e-10;

template <int K, int P>
using Exponents = std::array<std::array<int, K>, element_nodes<K, P>>;

/// Of the monomials of degree P, by ascending degree.
template <int K, int P>
constexpr Exponents<K, P> exponents() {
  Exponents<K, P> out{};
  std::size_t at = 0;
  for (int degree = 0; degree <= P; ++degree)
    for (int second = 0; second <= (K == 1 ? 0 : degree); ++second) {
      out[at][0] = degree - second;
      if constexpr (K == 2) out[at][1] = second;
      ++at;
    }
  return out;
}

template <int K>
Point<K> reference(const std::array<double, K + 1>& barycentric) {
  Point<K> out;
  for (int k = 0; k < K; ++k) out[k] = barycentric[k + 1];
  return out;
}

}  // namespace

template <int K, int P>
DualBasis<K, P>::DualBasis(std::span<const CoveredPoint<K>> covered) {
  find_axes(covered);
  drop_thin();
  std::array<Values, nodes> gram{};
  for (const CoveredPoint<K>& x : covered) {
    const Values m = monomials(local(x.at)), phi = basis<P>(x.at);
    for (std::size_t i = 0; i < nodes; ++i) {
      share_[i] += x.weight * phi[i];
      for (std::size_t j = 0; j <= i; ++j) gram[i][j] += x.weight * m[i] * m[j];
    }
  }
  if constexpr (P == 1)  // not negative but for rounding
    for (double& share : share_) share = std::max(share, 0.0);
  for (std::size_t p = 0; p < nodes; ++p) factors_[p] = monomials(local(node_place<K>(p)));
  if constexpr (P == 2) {
    constexpr auto ends = simplex_edges<K>();
    for (std::size_t k = 0; k < ends.size(); ++k)
      for (std::size_t i = 0; i < nodes; ++i) {
        double& f = factors_[K + 1 + k][i];
        f = (f - (1 - midpoint_weight) / 2 * (factors_[ends[k][0]][i] + factors_[ends[k][1]][i])) / midpoint_weight;
      }
  }
  solve(gram);
}

/// The middle of ω, the principal directions of its second moments, and their roots.
template <int K, int P>
void DualBasis<K, P>::find_axes(std::span<const CoveredPoint<K>> covered) {
  double measure = 0;
  for (const CoveredPoint<K>& x : covered) {
    measure += x.weight;
    for (int k = 0; k < K; ++k) middle_[k] += x.weight * x.at[k + 1];
  }
  for (double& c : middle_) c /= measure;
  for (int k = 0; k < K; ++k) {
    axis_[k] = {};
    axis_[k][k] = 1;
  }
  if constexpr (K == 2) {
    double a = 0, b = 0, c = 0;
    for (const CoveredPoint<K>& x : covered) {
      const Point<K> y = local(x.at);
      a += x.weight * y[0] * y[0], b += x.weight * y[0] * y[1], c += x.weight * y[1] * y[1];
    }
    const double angle = 0.5 * std::atan2(2 * b, a - c);
    axis_ = {{{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}}};
  }
  // Once more, for what is exact along them.
  Point<K> width{};
  for (const CoveredPoint<K>& x : covered) {
    const Point<K> y = local(x.at);
    for (int k = 0; k < K; ++k) width[k] += x.weight * y[k] * y[k];
  }
  for (int k = 0; k < K; ++k) {
    double low = infinity, high = -infinity;
    for (int p = 0; p <= K; ++p) {
      const double y = local(node_place<K>(static_cast<std::size_t>(p)))[k];
      low = std::min(low, y), high = std::max(high, y);
    }
    width[k] = std::sqrt(width[k] / measure);
    relative_[k] = width[k] / (high - low);
    for (double& c : axis_[k]) c = width[k] > 0 ? c / width[k] : 0;
  }
}

template <int K, int P>
void DualBasis<K, P>::drop_thin() {
  constexpr Exponents<K, P> all = exponents<K, P>();
  for (std::size_t i = 0; i < nodes; ++i) {
    double size = 1;
    for (int k = 0; k < K; ++k)
      for (int e = 0; e < all[i][k]; ++e) size *= relative_[k];
    kept_[i] = size > thin;
    lumped_ = lumped_ || !kept_[i];
  }
}

/// Replaces the values of the nodes' functionals by their factors in the polynomials that represent them (Cholesky).
template <int K, int P>
void DualBasis<K, P>::solve(std::array<Values, nodes>& gram) {
  for (std::size_t i = 0; i < nodes; ++i) {
    const double whole = gram[i][i];
    for (std::size_t j = 0; j <= i; ++j) {
      double& g = gram[i][j];
      if (!kept_[j]) g = 0;
      for (std::size_t k = 0; k < j; ++k) g -= gram[i][k] * gram[j][k];
      if (j < i) g /= gram[j][j];
    }
    if (kept_[i] && !(gram[i][i] > dependent * whole)) kept_[i] = false, lumped_ = true;
    if (!kept_[i]) gram[i] = {}, gram[i][i] = 1;
    gram[i][i] = std::sqrt(gram[i][i]);
  }
  for (Values& f : factors_) {
    for (std::size_t i = 0; i < nodes; ++i) {
      if (!kept_[i]) f[i] = 0;
      for (std::size_t k = 0; k < i; ++k) f[i] -= gram[i][k] * f[k];
      f[i] /= gram[i][i];
    }
    for (std::size_t i = nodes; i-- > 0;) {
      for (std::size_t k = i + 1; k < nodes; ++k) f[i] -= gram[k][i] * f[k];
      f[i] /= gram[i][i];
    }
  }
}

template <int K, int P>
Point<K> DualBasis<K, P>::local(const std::array<double, K + 1>& barycentric) const {
  const Point<K> z = reference<K>(barycentric);
  Point<K> out{};
  for (int k = 0; k < K; ++k)
    for (int i = 0; i < K; ++i) out[k] += axis_[k][i] * (z[i] - middle_[i]);
  return out;
}

template <int K, int P>
typename DualBasis<K, P>::Values DualBasis<K, P>::monomials(const Point<K>& y) {
  constexpr Exponents<K, P> all = exponents<K, P>();
  Values out;
  for (std::size_t i = 0; i < nodes; ++i) {
    out[i] = 1;
    for (int k = 0; k < K; ++k)
      for (int e = 0; e < all[i][k]; ++e) out[i] *= y[k];
  }
  return out;
}

template <int K, int P>
typename DualBasis<K, P>::Values DualBasis<K, P>::operator()(const std::array<double, K + 1>& barycentric) const {
  const Values m = monomials(local(barycentric));
  Values out{};
  for (std::size_t p = 0; p < nodes; ++p)
    for (std::size_t i = 0; i < nodes; ++i) out[p] += factors_[p][i] * m[i];
  return out;
}

template class DualBasis<1, 1>;
template class DualBasis<1, 2>;
template class DualBasis<2, 1>;
template class DualBasis<2, 2>;

}  // namespace signorini::mortar
