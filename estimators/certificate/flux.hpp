#pragma once
#include "core/fem/elements/gradient.hpp"
#include "core/fem/model/material.hpp"

namespace signorini {

template <std::size_t D, std::size_t B>
using Rows = std::array<std::array<double, D>, B>;  ///< Gradient<D, B>, with a size that can be deduced

/// What a gradient causes: the flux a grad u of a scalar, as the only row, or the stress of a displacement.
template <std::size_t D>
Rows<D, 1> flux(const Material<1>& material, const Rows<D, 1>& g) {
  Rows<D, 1> out = g;
  for (double& c : out[0]) c *= material.diffusion;
  return out;
}

template <std::size_t D>
Rows<D, D> flux(const Material<static_cast<int>(D)>& material, const Rows<D, D>& g) {
  Rows<D, D> out;
  double trace = 0;
  for (std::size_t i = 0; i < D; ++i) trace += g[i][i];
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j)
      out[i][j] = material.mu * (g[i][j] + g[j][i]) + (i == j ? material.lambda * trace : 0);
  return out;
}

/// The strain that causes a flux: the inverse of flux() on symmetric gradients.
template <std::size_t D>
Rows<D, 1> strain_of(const Material<1>& material, const Rows<D, 1>& q) {
  Rows<D, 1> out = q;
  for (double& c : out[0]) c /= material.diffusion;
  return out;
}

template <std::size_t D>
Rows<D, D> strain_of(const Material<static_cast<int>(D)>& material, const Rows<D, D>& s) {
  Rows<D, D> out = s;
  double trace = 0;
  for (std::size_t i = 0; i < D; ++i) trace += s[i][i];
  const double part = material.lambda / (2 * material.mu + static_cast<int>(D) * material.lambda) * trace;
  for (std::size_t i = 0; i < D; ++i) {
    out[i][i] -= part;
    for (std::size_t j = 0; j < D; ++j) out[i][j] /= 2 * material.mu;
  }
  return out;
}

/// flux(e_i (x) g) : (e_j (x) h) for all components i, j: row-major.
template <std::size_t D>
std::array<double, 1> stiffness_of(const Material<1>& material, const std::array<double, D>& g,
                                   const std::array<double, D>& h) {
  return {material.diffusion * dot(g, h)};
}

template <std::size_t D>
std::array<double, D * D> stiffness_of(const Material<static_cast<int>(D)>& material, const std::array<double, D>& g,
                                       const std::array<double, D>& h) {
  std::array<double, D * D> out;
  const double both = material.mu * dot(g, h);
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j)
      out[i * D + j] = (i == j ? both : 0) + material.mu * g[j] * h[i] + material.lambda * g[i] * h[j];
  return out;
}

template <std::size_t D, std::size_t B>
void add(double factor, const Rows<D, B>& from, Rows<D, B>& to) {
  for (std::size_t i = 0; i < B; ++i)
    for (std::size_t j = 0; j < D; ++j) to[i][j] += factor * from[i][j];
}

template <std::size_t D, std::size_t B>
double contract(const Rows<D, B>& a, const Rows<D, B>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < B; ++i) sum += dot(a[i], b[i]);
  return sum;
}

/// flux . vector
template <std::size_t D, std::size_t B>
std::array<double, B> applied(const Rows<D, B>& q, const std::array<double, D>& n) {
  std::array<double, B> out;
  for (std::size_t i = 0; i < B; ++i) out[i] = dot(q[i], n);
  return out;
}

}  // namespace signorini
