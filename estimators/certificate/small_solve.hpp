#pragma once
#include <array>

#include "core/fem/conditions/fixes.hpp"

namespace signorini {

/// Takes the part of v along fixed directions away.
template <std::size_t B>
void project(const FixedDirections<static_cast<int>(B)>& fixed, std::array<double, B>& v) {
  for (int k = 0; k < fixed.count; ++k) {
    double along = 0;
    for (std::size_t i = 0; i < B; ++i) along += fixed.direction[k][i] * v[i];
    for (std::size_t i = 0; i < B; ++i) v[i] -= along * fixed.direction[k][i];
  }
}

/// The symmetric B x B matrix A on what fixed directions leave, with the identity, times its trace, on them.
template <int B>
void keep_free(const FixedDirections<B>& fixed, std::array<double, static_cast<std::size_t>(B* B)>& A) {
  double trace = 0;
  for (int i = 0; i < B; ++i) trace += A[i * (B + 1)];
  for (int i = 0; i < B; ++i) {
    std::array<double, B> row;
    for (int j = 0; j < B; ++j) row[j] = A[i * B + j];
    project(fixed, row);
    for (int j = 0; j < B; ++j) A[i * B + j] = row[j];
  }
  for (int j = 0; j < B; ++j) {
    std::array<double, B> column;
    for (int i = 0; i < B; ++i) column[i] = A[i * B + j];
    project(fixed, column);
    for (int i = 0; i < B; ++i) A[i * B + j] = column[i];
  }
  for (int k = 0; k < fixed.count; ++k)
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) A[i * B + j] += trace * fixed.direction[k][i] * fixed.direction[k][j];
}

/// A^-1 v of a symmetric positive definite B x B matrix.
template <std::size_t N, std::size_t B>
std::array<double, B> solved(std::array<double, N> A, std::array<double, B> v) {
  static_assert(N == B * B);
  for (std::size_t k = 0; k < B; ++k)
    for (std::size_t i = k + 1; i < B; ++i) {
      const double factor = A[i * B + k] / A[k * B + k];
      for (std::size_t j = k; j < B; ++j) A[i * B + j] -= factor * A[k * B + j];
      v[i] -= factor * v[k];
    }
  for (std::size_t k = B; k-- > 0;) {
    for (std::size_t j = k + 1; j < B; ++j) v[k] -= A[k * B + j] * v[j];
    v[k] /= A[k * B + k];
  }
  return v;
}

}  // namespace signorini
