#include "core/algebra/local_coordinates.hpp"

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

// The block with entry M[i][j] kept where both components are free.
template <int B>
void erase_fixed(double* M, Flags row, Flags column) {
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j)
      if ((row >> i | column >> j) & 1) M[i * B + j] = 0;
}

template <int B>
void eliminate_row(DiscreteProblem<B>& problem, Index p) {
  BlockMatrix<B>& A = problem.A;
  const std::vector<Flags>& fixed = problem.fixed;
  double Av[B] = {};
  bool coupled = false;
  for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) {
    const Index q = A.column[k];
    if (!(fixed[p] | fixed[q])) continue;
    if (fixed[q]) block::add_product<B>(A.at(k), problem.start.data() + Offset{q} * B, Av);
    coupled = coupled || fixed[q];
    erase_fixed<B>(A.at(k), fixed[p], fixed[q]);
  }
  if (fixed[p] || coupled) prescribe(problem, p, Av);
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

template <int B>
void rotate(BlockMatrix<B>& A, const Frames<B>& frames) {
  if (frames.slot.empty()) return;
  for (Index p = 0; p < A.size(); ++p) {
    const double* Qp = frames.at(p);
    double M[B * B];
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) {
      if (Qp) {
        block::transposed_multiply<B>(Qp, A.at(k), M);
        std::copy_n(M, B * B, A.at(k));
      }
      if (const double* Qq = frames.at(A.column[k])) {
        block::multiply<B>(A.at(k), Qq, M);
        std::copy_n(M, B * B, A.at(k));
      }
    }
  }
}

template <int B>
void rotate(std::vector<double>& b, const Frames<B>& frames) {
  for (Index p = 0; p < static_cast<Index>(frames.slot.size()); ++p)
    if (const double* Q = frames.at(p)) {
      double f[B];
      block::transposed_product<B>(Q, b.data() + Offset{p} * B, f);
      std::copy_n(f, B, b.data() + Offset{p} * B);
    }
}

// Row p of A v for the prescribed values v is known: free components lose it, fixed ones get their values.
template <int B>
void prescribe(DiscreteProblem<B>& problem, Index p, const double* Av) {
  const double* v = problem.start.data() + Offset{p} * B;
  double* b = problem.b.data() + Offset{p} * B;
  problem.coupled.push_back(p);
  for (int i = 0; i < B; ++i) {
    const bool fixed = problem.fixed[p] >> i & 1;
    problem.coupling.push_back(fixed ? 0 : Av[i]);
    if (!fixed) {
      b[i] -= Av[i];
      continue;
    }
    problem.prescribed_energy += Av[i] * v[i];
    problem.prescribed_work += b[i] * v[i];
    b[i] = v[i];
    problem.A.at(problem.A.row[p])[i * B + i] = 1;
  }
}

template <int B>
void eliminate(DiscreteProblem<B>& problem) {
  for (Index p = 0; p < problem.A.size(); ++p) eliminate_row(problem, p);
}

template <int B>
void eliminate(DiscreteProblem<B>& problem, std::span<const Index> vectors) {
  for (const Index p : vectors) eliminate_row(problem, p);
}

#define SIGNORINI_INSTANTIATE(B)                                                          \
  template void local_basis<B>(const double*, int, const double*, int, double*, double*); \
  template double separation<B>(const double*, int);                                      \
  template void rotate(BlockMatrix<B>&, const Frames<B>&);                                \
  template void rotate(std::vector<double>&, const Frames<B>&);                           \
  template void prescribe(DiscreteProblem<B>&, Index, const double*);                     \
  template void eliminate(DiscreteProblem<B>&);                                           \
  template void eliminate(DiscreteProblem<B>&, std::span<const Index>);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
