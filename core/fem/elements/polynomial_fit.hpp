#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/pivoted_factors.hpp"

namespace signorini {

/// N numbers at a place on a line (K = 1), in a plane (K = 2) or in space, seen from the place that is asked for.
template <int K, int N = 1>
struct Sample {
  std::array<double, K> x;
  std::array<double, N> value;
  double weight = 1;  ///< of the square of what a fit leaves of it
};

/// Of the largest one, in factors of a normal matrix: what is less shows that samples do not decide a polynomial.
inline constexpr double dependent_samples = 1e-9;

/// Coefficients of polynomials of this degree in K variables.
constexpr int polynomial_terms(int K, int degree) { return degree == 1 ? K + 1 : (K + 1) * (K + 2) / 2; }

template <int Degree, int K>
std::array<double, polynomial_terms(K, Degree)> monomials(const std::array<double, K>& x) {
  std::array<double, polynomial_terms(K, Degree)> out;
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
  /// Keeps a reference to the samples.
  explicit PolynomialFit(const std::vector<Sample<K, N>>& samples) : samples_(samples) {
    for (const auto& sample : samples)
      for (int i = 0; i < K; ++i) middle_[i] += sample.x[i];
    for (double& m : middle_) m /= static_cast<double>(samples.size());
    double size = 0;
    for (const auto& sample : samples)
      for (int i = 0; i < K; ++i) size = std::max(size, std::abs(sample.x[i] - middle_[i]));
    if (!(size > 0)) return;
    scale_ = 1 / size;
    std::array<Row, terms> H{};
    for (const auto& sample : samples) {
      const Row here = row(sample.x);
      for (int i = 0; i < terms; ++i)
        for (int j = 0; j < terms; ++j) H[i][j] += sample.weight * here[i] * here[j];
    }
    factors_ = PivotedFactors<terms>(H);
    decides_ = factors_.definite(dependent_samples);
  }

  explicit PolynomialFit(std::vector<Sample<K, N>>&&) = delete;

  /// Before it is asked at many places.
  void sum_up() {
    summed_up_ = true;
    for (const auto& sample : samples_) {
      const Row here = row(sample.x);
      for (int i = 0; i < terms; ++i)
        for (int n = 0; n < N; ++n) moments_[i][n] += sample.weight * here[i] * sample.value[n];
    }
  }

  /// The values at a place. Nothing where the samples do not decide them.
  /// @param most_amplified nothing, either, where independent errors of the samples come out larger by more than that
  std::optional<std::array<double, N>> at(const std::array<double, K>& x,
                                          double most_amplified = std::numeric_limits<double>::infinity()) const {
    if (!decides_) return {};
    const Row here = row(x), weights = factors_.solve(here);
    if (!(product(here, weights) <= most_amplified * most_amplified)) return {};
    std::array<double, N> out{};
    const auto add = [&out](double weight, const std::array<double, N>& values) {
      for (int n = 0; n < N; ++n) out[n] += weight * values[n];
    };
    if (summed_up_)
      for (int i = 0; i < terms; ++i) add(weights[i], moments_[i]);
    else
      for (const auto& sample : samples_) add(sample.weight * product(weights, row(sample.x)), sample.value);
    return out;
  }

  /// What independent errors of the samples, as large as what is left of them beside the polynomials, do to the values
  /// at a place. Only after sum_up(), where the samples decide these and are more than coefficients.
  std::array<double, N> error(const std::array<double, K>& x) const {
    std::array<Row, N> coefficients;
    for (int n = 0; n < N; ++n) {
      Row moments;
      for (int i = 0; i < terms; ++i) moments[i] = moments_[i][n];
      coefficients[n] = factors_.solve(moments);
    }
    const Row influence = factors_.solve(row(x));
    std::array<double, N> left{};
    double amplified = 0, sum = 0;
    for (const auto& sample : samples_) {
      const Row there = row(sample.x);
      const double part = sample.weight * product(there, influence);
      amplified += part * part, sum += sample.weight;
      for (int n = 0; n < N; ++n) {
        const double off = sample.value[n] - product(there, coefficients[n]);
        left[n] += sample.weight * off * off;
      }
    }
    const auto count = static_cast<double>(samples_.size());
    for (double& square : left) square = std::sqrt(square / sum * count / (count - terms) * amplified);
    return left;
  }

 private:
  static constexpr int terms = polynomial_terms(K, Degree);
  using Row = std::array<double, terms>;

  static double product(const Row& a, const Row& b) {
    double sum = 0;
    for (int i = 0; i < terms; ++i) sum += a[i] * b[i];
    return sum;
  }

  Row row(std::array<double, K> x) const {
    for (int i = 0; i < K; ++i) x[i] = (x[i] - middle_[i]) * scale_;
    return monomials<Degree, K>(x);
  }

  const std::vector<Sample<K, N>>& samples_;
  std::array<double, K> middle_{};
  double scale_ = 0;
  PivotedFactors<terms> factors_;
  bool decides_ = false, summed_up_ = false;
  std::array<std::array<double, N>, terms> moments_{};
};

/// Whether there are samples enough for a quadratic polynomial: at least K more than coefficients.
template <int K, int N>
bool enough_for_quadratic(const std::vector<Sample<K, N>>& samples) {
  return std::ssize(samples) >= polynomial_terms(K, 2) + K;
}

/// A value, and what independent errors of the samples may do to it.
struct FittedValue {
  double value, error;
};

/// The value at the place itself: quadratic where there are samples enough, else linear where there is one more than
/// coefficients.
template <int K>
std::optional<FittedValue> fitted_value_and_error(const std::vector<Sample<K>>& samples) {
  const auto found = [&]<int Degree>(PolynomialFit<Degree, K> fit) -> std::optional<FittedValue> {
    fit.sum_up();
    const auto value = fit.at({});
    return value ? std::optional(FittedValue{(*value)[0], fit.error({})[0]}) : std::nullopt;
  };
  if (enough_for_quadratic(samples))
    if (const auto value = found(PolynomialFit<2, K>(samples))) return value;
  if (samples.size() > polynomial_terms(K, 1)) return found(PolynomialFit<1, K>(samples));
  return {};
}
template <int K>
std::optional<double> fitted_value(const std::vector<Sample<K>>& samples) {
  const auto found = fitted_value_and_error(samples);
  return found ? std::optional(found->value) : std::nullopt;
}

}  // namespace signorini
