#pragma once
#include <cmath>

#include "core/base/types.hpp"

/// Dense B x B blocks, row-major, sizes known at compile time so that every loop unrolls.
namespace signorini::block {

/// x, or the bound that it lies beyond. NaN stays visible.
inline double clamp(double x, double lower, double upper) {
  const double above = x < lower ? lower : x;
  return above > upper ? upper : above;
}

/// a'b
template <int B>
inline double dot(const double* a, const double* b) {
  double sum = 0;
  for (int i = 0; i < B; ++i) sum += a[i] * b[i];
  return sum;
}

/// y += M x
template <int B>
inline void add_product(const double* M, const double* x, double* y) {
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) y[i] += M[i * B + j] * x[j];
}

/// y -= M x
template <int B>
inline void subtract_product(const double* M, const double* x, double* y) {
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) y[i] -= M[i * B + j] * x[j];
}

/// y = sum of the products of `count` consecutive blocks M with the vectors number column[k] of x. Every entry of a
/// block has a sum of its own, scalars have two, so that no multiplication waits for another.
template <int B>
inline void row_product(const double* M, const Index* column, Offset count, const double* x, double* y) {
  if constexpr (B == 1) {
    double even = 0, odd = 0;
    Offset k = 0;
    for (; k + 1 < count; k += 2) {
      even += M[k] * x[column[k]];
      odd += M[k + 1] * x[column[k + 1]];
    }
    if (k < count) even += M[k] * x[column[k]];
    *y = even + odd;
    return;
  }
  double sum[B * B] = {};
  for (Offset k = 0; k < count; ++k, M += B * B) {
    const double* v = x + Offset{column[k]} * B;
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) sum[i * B + j] += M[i * B + j] * v[j];
  }
  for (int i = 0; i < B; ++i) {
    y[i] = sum[i * B];
    for (int j = 1; j < B; ++j) y[i] += sum[i * B + j];
  }
}

/// y = M x
template <int B>
inline void product(const double* M, const double* x, double* y) {
  for (int i = 0; i < B; ++i) {
    y[i] = 0;
    for (int j = 0; j < B; ++j) y[i] += M[i * B + j] * x[j];
  }
}

/// y = M^T x
template <int B>
inline void transposed_product(const double* M, const double* x, double* y) {
  for (int i = 0; i < B; ++i) {
    y[i] = 0;
    for (int j = 0; j < B; ++j) y[i] += M[j * B + i] * x[j];
  }
}

/// C = M N
template <int B>
inline void multiply(const double* M, const double* N, double* C) {
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) {
      double s = 0;
      for (int k = 0; k < B; ++k) s += M[i * B + k] * N[k * B + j];
      C[i * B + j] = s;
    }
}

/// C = M^T N
template <int B>
inline void transposed_multiply(const double* M, const double* N, double* C) {
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) {
      double s = 0;
      for (int k = 0; k < B; ++k) s += M[k * B + i] * N[k * B + j];
      C[i * B + j] = s;
    }
}

/// C = M N^T
template <int B>
inline void multiply_transposed(const double* M, const double* N, double* C) {
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) {
      double s = 0;
      for (int k = 0; k < B; ++k) s += M[i * B + k] * N[j * B + k];
      C[i * B + j] = s;
    }
}

template <int B>
inline double norm(const double* x) {
  double s = 0;
  for (int k = 0; k < B; ++k) s += x[k] * x[k];
  return std::sqrt(s);
}

/// NaN stays visible.
inline double larger(double a, double b) { return a > b || std::isnan(a) ? a : b; }

/// Solves M y = r on the components whose bit is set in `kept`, the others of y are zero. M is symmetric positive
/// semidefinite; a component whose pivot falls below rounding is dropped as well, so that y always is a descent
/// direction of 1/2 y'My - r'y.
template <int B>
inline void solve(const double* M, const double* r, unsigned kept, double* y) {
  double L[B][B], pivot[B];
  for (int i = 0; i < B; ++i) {
    pivot[i] = 0;
    y[i] = 0;
    if (!(kept >> i & 1u)) continue;
    double d = M[i * B + i];
    for (int j = 0; j < i; ++j) {
      L[i][j] = 0;
      if (pivot[j] == 0) continue;
      double s = M[i * B + j];
      for (int k = 0; k < j; ++k)
        if (pivot[k] != 0) s -= L[i][k] * L[j][k] * pivot[k];
      L[i][j] = s / pivot[j];
      d -= L[i][j] * L[i][j] * pivot[j];
    }
    if (!(d > 1e-14 * M[i * B + i])) continue;
    pivot[i] = d;
    y[i] = r[i];
    for (int j = 0; j < i; ++j)
      if (pivot[j] != 0) y[i] -= L[i][j] * y[j];
  }
  for (int i = 0; i < B; ++i) y[i] = pivot[i] != 0 ? y[i] / pivot[i] : 0;
  for (int i = B - 1; i >= 0; --i)
    if (pivot[i] != 0)
      for (int j = i + 1; j < B; ++j)
        if (pivot[j] != 0) y[i] -= L[j][i] * y[j];
}

/// Inverse of a symmetric positive semidefinite block; rows and columns of zero diagonal entries are zero. The diagonal
/// of a block that is singular to within 1e-8 is raised by that part of itself: the entries of a larger inverse would
/// turn rounding into energy, while M^-1 r with a raised M lowers it.
template <int B>
inline void invert(const double* M, double* inverse) {
  double raised[B * B];
  for (int i = 0; i < B * B; ++i) raised[i] = M[i];
  for (const double raise : {1e-8, 0.0}) {
    bool regular = true;
    for (int j = 0; j < B; ++j) {
      double unit[B] = {}, column[B];
      unit[j] = 1;
      solve<B>(raised, unit, (1u << B) - 1, column);
      for (int i = 0; i < B; ++i) inverse[i * B + j] = column[i];
      const double d = M[j * B + j] * column[j];  // 1 / (1 - R^2) for the correlation R of j with the others
      regular = regular && (M[j * B + j] == 0 || (d > 0 && d < 1e8));
    }
    if (regular) return;
    for (int i = 0; i < B; ++i) raised[i * B + i] += raise * M[i * B + i];
  }
}

}  // namespace signorini::block
