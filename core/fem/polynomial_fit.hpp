#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/dense.hpp"

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

/// The polynomials that are nearest to samples by least squares.
/// @tparam Degree 1 or 2
template <int Degree, int K, int N = 1>
class PolynomialFit {
 public:
  explicit PolynomialFit(const std::vector<Sample<K, N>>& samples) {
    for (const auto& sample : samples)
      for (int i = 0; i < K; ++i) middle_[i] += sample.x[i] / static_cast<double>(samples.size());
    for (const auto& sample : samples)
      for (int i = 0; i < K; ++i) size_ = std::max(size_, std::abs(sample.x[i] - middle_[i]));
    if (!(size_ > 0)) return;
    Eigen::Matrix<double, terms, terms> H = decltype(H)::Zero();
    for (const auto& sample : samples) {
      const Row here = row(sample.x);
      H.noalias() += here * here.transpose();
      h_.noalias() += here * Eigen::Map<const Eigen::Matrix<double, 1, N>>(sample.value.data());
    }
    const SymmetricFactors factors(H);
    const Eigen::VectorXd pivots = factors.pivots();
    if (pivots.minCoeff() > dependent * pivots.maxCoeff()) factors_ = factors;
  }

  /// The values at a place. Nothing where the samples do not decide them.
  /// @param most_amplified nothing, either, where independent errors of the samples come out larger by more than that
  std::optional<std::array<double, N>> at(const std::array<double, K>& x,
                                          double most_amplified = std::numeric_limits<double>::infinity()) const {
    if (!factors_) return {};
    const Row here = row(x);
    const Row weights = factors_->solve(here);
    if (!(here.dot(weights) <= most_amplified * most_amplified)) return {};
    std::array<double, N> out;
    Eigen::Map<Eigen::Matrix<double, 1, N>>(out.data()) = weights.transpose() * h_;
    return out;
  }

 private:
  static constexpr int terms = polynomial_terms(K, Degree);
  static constexpr double dependent = 1e-9;
  using Row = Eigen::Matrix<double, terms, 1>;

  Row row(std::array<double, K> x) const {
    for (int i = 0; i < K; ++i) x[i] = (x[i] - middle_[i]) / size_;
    return monomials<Degree, K>(x);
  }

  std::array<double, K> middle_{};
  double size_ = 0;
  Eigen::Matrix<double, terms, N> h_ = Eigen::Matrix<double, terms, N>::Zero();
  std::optional<SymmetricFactors> factors_;  // where the samples decide
};

/// Whether there are samples enough for a quadratic polynomial: at least K more than coefficients.
template <int K, int N>
bool enough_for_quadratic(const std::vector<Sample<K, N>>& samples) {
  return std::ssize(samples) >= polynomial_terms(K, 2) + K;
}

/// The value at the place itself: quadratic where there are samples enough, else linear where there is one more than
/// coefficients.
template <int K>
std::optional<double> fitted_value(const std::vector<Sample<K>>& samples) {
  const auto only = [](const auto& values) { return values ? std::optional((*values)[0]) : std::nullopt; };
  if (enough_for_quadratic(samples))
    if (const auto values = PolynomialFit<2, K>(samples).at({})) return only(values);
  if (samples.size() > polynomial_terms(K, 1)) return only(PolynomialFit<1, K>(samples).at({}));
  return {};
}

}  // namespace signorini
