#include "core/algebra/local_basis.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/sdk/block.hpp"

namespace signorini {
namespace {

// Q <- Q H with the reflection H in the coordinates i..B-1 that takes axis i to Q'd. The columns before i stay,
// provided that d is orthogonal to them. 1 - c_i is computed without cancellation.
template <int B>
void reflect(const double* d, int i, double* Q) {
  double w[B] = {}, tail = 0, c[B];
  block::transposed_product<B>(Q, d, c);
  for (int j = i + 1; j < B; ++j) {
    w[j] = -c[j];
    tail += c[j] * c[j];
  }
  w[i] = c[i] > 0 ? tail / (1 + c[i]) : 1 - c[i];
  const double norm = w[i] * w[i] + tail;
  if (norm == 0) return;
  for (int row = 0; row < B; ++row) {
    double s = 0;
    for (int j = i; j < B; ++j) s += Q[row * B + j] * w[j];
    for (int j = i; j < B; ++j) Q[row * B + j] -= 2 * s / norm * w[j];
  }
}

// Gram-Schmidt on unit vectors. Returns the length that the last one had left; what is dependent becomes zero.
template <int B>
double orthonormalise(double* vectors, int count) {
  double length = 1;
  for (int k = 1; k < count; ++k) {
    double* v = vectors + k * B;
    for (int j = 0; j < k; ++j) {
      double c = 0;
      for (int i = 0; i < B; ++i) c += v[i] * vectors[j * B + i];
      for (int i = 0; i < B; ++i) v[i] -= c * vectors[j * B + i];
    }
    length = block::norm<B>(v);
    for (int i = 0; i < B; ++i) v[i] = length > 0 ? v[i] / length : 0;
  }
  return length;
}

}  // namespace

template <int B>
void local_basis(const double* leading, int leading_count, const double* trailing, int trailing_count, double* Q,
                 double* N) {
  const int given = leading_count + trailing_count;
  double H[B * B] = {}, orthonormal[B * B];
  std::copy_n(leading, leading_count * B, orthonormal);
  orthonormalise<B>(orthonormal, leading_count);
  for (int i = 0; i < B; ++i) H[i * B + i] = 1;
  // Trailing vectors are brought to their place one by one: first all given vectors in front, then a cyclic shift of
  // the columns behind the leading ones.
  for (int i = 0; i < given; ++i) {
    const double* d = i < leading_count ? orthonormal + i * B : trailing + (i - leading_count) * B;
    reflect<B>(d, i, H);
    for (int row = 0; row < B; ++row) H[row * B + i] = d[row];
  }
  for (int row = 0; row < B; ++row) {
    std::rotate(H + row * B + leading_count, H + row * B + given, H + row * B + B);
    std::copy_n(H + row * B, B, Q + row * B);
  }
  std::copy_n(Q, B * B, N);
  if (leading_count < 2) return;
  for (int i = 0; i < B; ++i)
    for (int k = 0; k < leading_count; ++k) N[i * B + k] = leading[k * B + i];
  using Block = Eigen::Matrix<double, B, B, B == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  Eigen::Map<Block> dual(N);
  Eigen::Map<Block>(Q, B, B) = dual.inverse().transpose();
}

template <int B>
double separation(const double* directions, int count) {
  double least = 1;
  for (int k = 0; k < count; ++k) {
    double turned[B * B];
    std::copy_n(directions, count * B, turned);
    std::swap_ranges(turned + k * B, turned + (k + 1) * B, turned + (count - 1) * B);
    least = std::min(least, orthonormalise<B>(turned, count));
  }
  return least;
}

#define SIGNORINI_INSTANTIATE(B)                                                          \
  template void local_basis<B>(const double*, int, const double*, int, double*, double*); \
  template double separation<B>(const double*, int);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
