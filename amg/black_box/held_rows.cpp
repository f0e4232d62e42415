#include "amg/black_box/held_rows.hpp"

#include <algorithm>

#include "core/sdk/block.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {

template <int B>
void HeldRows<B>::hold(DiscreteProblem<B>& problem, std::vector<Flags> fixed) {
  put_back(problem.A);
  vectors_.clear();
  value_.clear();
  problem.fixed.swap(fixed);
  if (std::ranges::all_of(problem.fixed, [](Flags f) { return f == 0; })) return;
  const BlockMatrix<B>& A = problem.A;
  for (Index p = 0; p < A.size(); ++p) {
    const auto begin = A.column.begin() + A.row[p], end = A.column.begin() + A.row[p + 1];
    if (std::none_of(begin, end, [&](Index q) { return problem.fixed[q] != 0; })) continue;
    vectors_.push_back(p);
    value_.insert(value_.end(), A.at(A.row[p]), A.at(A.row[p + 1]));
  }
}

template <int B>
void HeldRows<B>::prescribe(DiscreteProblem<B>& problem) const {
  put_back(problem.A);
  problem.prescribed_energy = problem.prescribed_work = 0;
  problem.coupled.clear();
  problem.coupling.clear();
  eliminate(problem, vectors_);
}

template <int B>
void HeldRows<B>::residual(const DiscreteProblem<B>& problem, const double* x, const double* b, double* r) const {
  const BlockMatrix<B>& A = problem.A;
  const double* value = value_.data();
  for (const Index p : vectors_) {
    const Offset count = A.row[p + 1] - A.row[p];
    double Ax[B];
    block::row_product<B>(value, A.column.data() + A.row[p], count, x, Ax);
    for (int i = 0; i < B; ++i) r[Offset{p} * B + i] = Ax[i] - b[Offset{p} * B + i];
    value += count * B * B;
  }
}

template <int B>
void HeldRows<B>::residual(const DiscreteProblem<B>& problem, const TwoDoubles* x, const double* b,
                           long double* r) const {
  const BlockMatrix<B>& A = problem.A;
  const double* value = value_.data();
  for (const Index p : vectors_) {
    TwoDoubles rest[B];
    for (int i = 0; i < B; ++i) rest[i] = TwoDoubles(b[Offset{p} * B + i]);
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k, value += B * B)
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) rest[i].add_product(-value[i * B + j], x[Offset{A.column[k]} * B + j]);
    for (int i = 0; i < B; ++i) r[Offset{p} * B + i] = rest[i].value();
  }
}

template <int B>
void HeldRows<B>::put_back(BlockMatrix<B>& A) const {
  const double* value = value_.data();
  for (const Index p : vectors_) {
    const Offset count = (A.row[p + 1] - A.row[p]) * B * B;
    std::copy_n(value, count, A.at(A.row[p]));
    value += count;
  }
}

template class HeldRows<1>;
template class HeldRows<2>;
template class HeldRows<3>;

}  // namespace signorini
