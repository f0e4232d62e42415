#pragma once
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace signorini {

/// N numbers at a place on a line (K = 1), in a plane (K = 2) or in space, seen from the place that is asked for.
template <int K, int N = 1>
struct Sample {
  std::array<double, K> x;
  std::array<double, N> value;
};

/// Coefficients of polynomials of this degree in K variables.
constexpr int polynomial_terms(int K, int degree) { return degree == 1 ? K + 1 : (K + 1) * (K + 2) / 2; }

template <int Degree, int K>
Eigen::Matrix<double, polynomial_terms(K, Degree), 1> monomials(const std::array<double, K>& x) {
  Eigen::Matrix<double, polynomial_terms(K, Degree), 1> out;
  out[0] = 1;
  for (int i = 0; i < K; ++i) out[i + 1] = x[i];
  if constexpr (Degree > 1)
    for (int i = 0, term = K + 1; i < K; ++i)
      for (int j = 0; j <= i; ++j) out[term++] = x[i] * x[j];
  return out;
}

/// The values at the place itself of the polynomials that are nearest to the samples by least squares. Nothing where
/// these do not decide them.
/// @tparam Degree 1 or 2
/// @param most_amplified nothing, either, where independent errors of the samples come out larger by more than that
template <int Degree, int K, int N>
std::optional<std::array<double, N>> polynomial_values(
    const std::vector<Sample<K, N>>& samples, double most_amplified = std::numeric_limits<double>::infinity()) {
  constexpr int terms = polynomial_terms(K, Degree);
  constexpr double dependent = 1e-9;
  std::array<double, K> middle{};
  double size = 0;
  for (const auto& sample : samples)
    for (int i = 0; i < K; ++i) middle[i] += sample.x[i] / static_cast<double>(samples.size());
  for (const auto& sample : samples)
    for (int i = 0; i < K; ++i) size = std::max(size, std::abs(sample.x[i] - middle[i]));
  if (!(size > 0)) return {};
  const auto row = [&](std::array<double, K> x) {
    for (int i = 0; i < K; ++i) x[i] = (x[i] - middle[i]) / size;
    return monomials<Degree, K>(x);
  };
  Eigen::Matrix<double, terms, terms> H = decltype(H)::Zero();
  Eigen::Matrix<double, terms, N> h = decltype(h)::Zero();
  for (const auto& sample : samples) {
    const auto here = row(sample.x);
    H.noalias() += here * here.transpose();
    h.noalias() += here * Eigen::Map<const Eigen::Matrix<double, 1, N>>(sample.value.data());
  }
  const Eigen::LDLT<Eigen::Matrix<double, terms, terms>> factors(H);
  if (!(factors.vectorD().minCoeff() > dependent * factors.vectorD().maxCoeff())) return {};
  const auto here = row({});
  const Eigen::Matrix<double, terms, 1> weights = factors.solve(here);
  if (!(here.dot(weights) <= most_amplified * most_amplified)) return {};
  std::array<double, N> out;
  Eigen::Map<Eigen::Matrix<double, 1, N>>(out.data()) = weights.transpose() * h;
  return out;
}

/// Quadratic where there are enough samples, at least K more than coefficients, else linear where there is one more.
template <int K>
std::optional<double> fitted_value(const std::vector<Sample<K>>& samples) {
  const auto only = [](const auto& values) { return values ? std::optional((*values)[0]) : std::nullopt; };
  if (samples.size() >= polynomial_terms(K, 2) + K)
    if (const auto values = polynomial_values<2>(samples)) return only(values);
  if (samples.size() > polynomial_terms(K, 1)) return only(polynomial_values<1>(samples));
  return {};
}

}  // namespace signorini
