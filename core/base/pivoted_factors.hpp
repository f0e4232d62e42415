#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace signorini {

/// A small symmetric matrix as P' L D L' P with the largest diagonal entries first, without memory of its own: for fits
/// at every node, which allocating would take longer than computing.
template <int N>
class PivotedFactors {
 public:
  using Vector = std::array<double, N>;

  PivotedFactors() = default;
  /// @param H rows; its lower triangle is read
  explicit PivotedFactors(const std::array<Vector, N>& H) : L_(H) {
    for (int k = 0; k < N; ++k) {
      bring_largest_to(k);
      Vector row;
      for (int j = 0; j < k; ++j) row[j] = L_[k][j] * L_[j][j];
      for (int i = k; i < N; ++i) {
        double sum = L_[i][k];
        for (int j = 0; j < k; ++j) sum -= L_[i][j] * row[j];
        L_[i][k] = i == k ? sum : sum / L_[k][k];
      }
      if (L_[k][k] == 0)
        for (int i = k + 1; i < N; ++i) L_[i][k] = 0;
    }
  }

  /// Whether all of D are larger than this part of the largest one.
  bool definite(double part) const {
    double least = L_[0][0], most = L_[0][0];
    for (int k = 1; k < N; ++k) {
      least = std::min(least, L_[k][k]);
      most = std::max(most, L_[k][k]);
    }
    return least > part * most;
  }

  Vector solve(const Vector& b) const {
    Vector y, x;
    for (int k = 0; k < N; ++k) {
      y[k] = b[place_[k]];
      for (int j = 0; j < k; ++j) y[k] -= L_[k][j] * y[j];
    }
    for (int k = N; k-- > 0;) {
      y[k] /= L_[k][k];
      for (int i = k + 1; i < N; ++i) y[k] -= L_[i][k] * y[i];
    }
    for (int k = 0; k < N; ++k) x[place_[k]] = y[k];
    return x;
  }

 private:
  /// Exchanges rows and columns of what is not factorised yet, whose diagonal is still that of H.
  void bring_largest_to(int k) {
    int at = k;
    for (int i = k + 1; i < N; ++i)
      if (std::abs(L_[i][i]) > std::abs(L_[at][at])) at = i;
    if (at == k) return;
    std::swap(place_[k], place_[at]);
    std::swap(L_[k][k], L_[at][at]);
    for (int j = 0; j < k; ++j) std::swap(L_[k][j], L_[at][j]);
    for (int i = k + 1; i < at; ++i) std::swap(L_[i][k], L_[at][i]);
    for (int i = at + 1; i < N; ++i) std::swap(L_[i][k], L_[i][at]);
  }

  static constexpr std::array<int, N> in_order() {
    std::array<int, N> out{};
    for (int k = 0; k < N; ++k) out[k] = k;
    return out;
  }

  std::array<Vector, N> L_{};  // and D on the diagonal
  std::array<int, N> place_ = in_order();
};

}  // namespace signorini
