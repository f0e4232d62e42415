#include "core/solver/local_coordinates.hpp"

#include <algorithm>

#include "core/sdk/block.hpp"

namespace signorini {
namespace {

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

template <int B>
void out_of_frames(const Frames<B>& frames, std::vector<double>& x) {
  for (Index p = 0; p < static_cast<Index>(frames.slot.size()); ++p)
    if (const double* Q = frames.at(p)) {
      double v[B];
      block::product<B>(Q, x.data() + Offset{p} * B, v);
      std::copy_n(v, B, x.data() + Offset{p} * B);
    }
}

template <int B>
void into_frames(const Frames<B>& frames, std::vector<double>& x) {
  for (Index p = 0; p < static_cast<Index>(frames.slot.size()); ++p)
    if (const double* N = frames.dual_at(p)) {
      double v[B];
      block::transposed_product<B>(N, x.data() + Offset{p} * B, v);
      std::copy_n(v, B, x.data() + Offset{p} * B);
    }
}

template <int B>
std::vector<double> local_forces(const DiscreteProblem<B>& problem, std::vector<double> forces) {
  if (problem.jumps) transform_forces(*problem.jumps, forces);
  rotate(forces, problem.frames);
  return forces;
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

#define SIGNORINI_INSTANTIATE(B)                                                             \
  template void rotate(BlockMatrix<B>&, const Frames<B>&);                                   \
  template void rotate(std::vector<double>&, const Frames<B>&);                              \
  template void prescribe(DiscreteProblem<B>&, Index, const double*);                        \
  template void out_of_frames(const Frames<B>&, std::vector<double>&);                       \
  template void into_frames(const Frames<B>&, std::vector<double>&);                         \
  template std::vector<double> local_forces(const DiscreteProblem<B>&, std::vector<double>); \
  template void eliminate(DiscreteProblem<B>&);                                              \
  template void eliminate(DiscreteProblem<B>&, std::span<const Index>);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
