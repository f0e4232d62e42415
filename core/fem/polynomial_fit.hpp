#pragma once
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace signorini {

/// A number at a place on a line (K = 1) or in a plane (K = 2), seen from the place that is asked for.
template <int K>
struct Sample {
  std::array<double, K> x;
  double value;
};

/// The value at the place itself of the polynomial that is nearest to the samples by least squares. Nothing where these
/// do not decide it.
/// @tparam Terms its coefficients: K + 1 of a linear one, (K + 1)(K + 2) / 2 of a quadratic one
template <int K, int Terms>
std::optional<double> polynomial_value(const std::vector<Sample<K>>& samples) {
  using Vector = Eigen::Matrix<double, Terms, 1>;
  constexpr double dependent = 1e-9;
  double size = 0;
  for (const Sample<K>& sample : samples)
    for (const double x : sample.x) size = std::max(size, std::abs(x));
  if (!(size > 0)) return {};
  Eigen::Matrix<double, Terms, Terms> H = decltype(H)::Zero();
  Vector h = Vector::Zero();
  for (const Sample<K>& sample : samples) {
    Vector row = Vector::Zero();
    row[0] = 1;
    for (int i = 0; i < K; ++i) row[i + 1] = sample.x[i] / size;
    if constexpr (Terms > K + 1)
      for (int i = 0, term = K + 1; i < K; ++i)
        for (int j = 0; j <= i; ++j) row[term++] = row[i + 1] * row[j + 1];
    H += row * row.transpose();
    h += sample.value * row;
  }
  Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Terms, Terms>> qr(H);
  qr.setThreshold(dependent);
  if (qr.rank() < Terms) return {};
  const Vector c = qr.solve(h);
  return c[0];
}

/// Quadratic where there are enough samples, at least K more than coefficients, else linear where there is one more.
template <int K>
std::optional<double> fitted_value(const std::vector<Sample<K>>& samples) {
  constexpr int quadratic = (K + 1) * (K + 2) / 2;
  if (samples.size() >= quadratic + K)
    if (const auto value = polynomial_value<K, quadratic>(samples)) return value;
  if (samples.size() > K + 1) return polynomial_value<K, K + 1>(samples);
  return {};
}

}  // namespace signorini
