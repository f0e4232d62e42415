#pragma once
#include <cmath>

#include "core/sdk/block.hpp"
#include "core/solver/prolongation.hpp"

/// What the weights of an interpolation do to vectors and blocks, whether they are scalars or blocks themselves.
namespace signorini::weights {

/// The same for all components.
template <int B>
struct Scalar {
  double w;

  double size() const { return std::fabs(w); }
  double mean() const { return w; }
  /// y += W x
  void add_value(const double* x, double* y) const {
    for (int i = 0; i < B; ++i) y[i] += w * x[i];
  }
  /// y += W' x
  void add_force(const double* x, double* y) const { add_value(x, y); }
  /// S += W' M
  void add_from_left(const double* M, double* S) const {
    for (int i = 0; i < B * B; ++i) S[i] += w * M[i];
  }
  /// S += M W
  void add_from_right(const double* M, double* S) const { add_from_left(M, S); }
};

/// A block, row-major.
template <int B>
struct Block {
  const double* W;

  double size() const {
    double largest = 0;
    for (int i = 0; i < B * B; ++i) largest = std::max(largest, std::fabs(W[i]));
    return largest;
  }
  /// Of the components' weights for themselves.
  double mean() const {
    double sum = 0;
    for (int i = 0; i < B; ++i) sum += W[i * (B + 1)];
    return sum / B;
  }
  void add_value(const double* x, double* y) const { block::add_product<B>(W, x, y); }
  void add_force(const double* x, double* y) const {
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) y[j] += W[i * B + j] * x[i];
  }
  void add_from_left(const double* M, double* S) const {
    double product[B * B];
    block::transposed_multiply<B>(W, M, product);
    for (int i = 0; i < B * B; ++i) S[i] += product[i];
  }
  void add_from_right(const double* M, double* S) const {
    double product[B * B];
    block::multiply<B>(M, W, product);
    for (int i = 0; i < B * B; ++i) S[i] += product[i];
  }
};

/// Calls action(weight), where weight(k) is entry k of the interpolation as one of the above.
template <int B, class Action>
decltype(auto) with(const Prolongation& P, Action&& action) {
  if constexpr (B > 1)
    if (!P.block.empty()) return action([&](Offset k) { return Block<B>{P.block.data() + k * B * B}; });
  return action([&](Offset k) { return Scalar<B>{P.weight[k]}; });
}

/// y_p += sum over row p of W_pq x_q
template <int B, class Weight>
inline void interpolate(const Prolongation& P, const Weight& weight, Index p, const double* x, double* y) {
  for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) weight(k).add_value(x + Offset{P.column[k]} * B, y);
}

}  // namespace signorini::weights
