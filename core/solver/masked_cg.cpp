#include "core/solver/masked_cg.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/products.hpp"
#include "core/base/dot.hpp"
#include "core/solver/rounding.hpp"

namespace signorini {

namespace {

// p'Dp with the diagonal D of A: the scale that energies are compared with.
template <int B>
double diagonal_energy(const BlockMatrix<B>& A, const std::vector<double>& p) {
  double sum = 0;
  for (Index q = 0; q < A.size(); ++q)
    for (int k = 0; k < B; ++k) {
      const Offset i = Offset{q} * B + k;
      sum += A.diagonal(q)[k * B + k] * p[i] * p[i];
    }
  return sum;
}

// Part of p'Dp below which p is smooth: rounding adds up along all of it, and would be answered by large steps.
constexpr double little_energy = 1e-5;

// Times the bound of what rounding does to work: how much it mostly is, and how much work has to be before a direction
// without energy is said to have no minimum.
constexpr double typical = 0.01, beyond_doubt = 100;

}  // namespace

template <int B>
void apply_mask(const std::vector<Flags>& mask, std::vector<double>& v) {
  for (std::size_t p = 0; p < mask.size(); ++p)
    for (int k = 0; mask[p] >> k; ++k)
      if (mask[p] >> k & 1u) v[p * B + k] = 0;
}

template <int B>
void symmetric_gauss_seidel(const BlockMatrix<B>& A, const std::vector<Flags>& mask, const std::vector<double>& b,
                            std::vector<double>& x) {
  constexpr unsigned all = (1u << B) - 1;
  const auto relax = [&](Index p) {
    if (mask[p] == all) return;
    double rest[B], step[B];
    std::copy_n(b.data() + Offset{p} * B, B, rest);
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      block::subtract_product<B>(A.at(k), x.data() + Offset{A.column[k]} * B, rest);
    block::solve<B>(A.diagonal(p), rest, ~unsigned{mask[p]} & all, step);
    for (int k = 0; k < B; ++k) x[Offset{p} * B + k] += step[k];
  };
  for (Index p = 0; p < A.size(); ++p) relax(p);
  for (Index p = A.size() - 1; p >= 0; --p) relax(p);
}

template <int B>
CgResult masked_cg(const BlockMatrix<B>& A, const std::vector<Flags>& mask, const Precondition& precondition,
                   const CgLimits& limits, std::vector<double>& r, std::vector<double>& d) {
  CgResult result;
  d.assign(r.size(), 0.0);
  std::vector<double> z(r.size()), p(r.size()), Ap(r.size());
  precondition(r, z);
  double rz = dot(r, z);
  const double start = rz;
  p = z;
  const double enough = limits.reduction * limits.reduction * start;
  while (rz > enough && rz > 0 && result.iterations < limits.iterations) {
    ++result.iterations;
    product<B>(A, p.data(), Ap.data());
    apply_mask<B>(mask, Ap);
    const double pAp = dot(p, Ap);
    if (limits.definite && !(pAp > 0)) return result;
    const double pDp = limits.definite ? 0 : diagonal_energy<B>(A, p);
    if (limits.rounding > 0 && !(pAp > little_energy * pDp)) {
      const double of_step =
          rounding_of_work<B>(mask, 0, A.size(), [&](Index q, int k) { return terms_of_product(A, d.data(), q, k); });
      const double noise = (limits.rounding + of_step) * max_norm(p);
      if (!(rz > (pAp > no_energy * pDp ? typical : beyond_doubt) * noise)) return result;
    }
    if (!(pAp > limits.without_energy * pDp)) {
      result.singular = true;
      d = p;
      return result;
    }
    const double alpha = rz / pAp;
    for (std::size_t i = 0; i < d.size(); ++i) {
      d[i] += alpha * p[i];
      r[i] -= alpha * Ap[i];
    }
    precondition(r, z);
    const double next = dot(r, z);
    for (std::size_t i = 0; i < d.size(); ++i) p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
  result.converged = rz >= 0 && rz <= enough;
  return result;
}

template void apply_mask<1>(const std::vector<Flags>&, std::vector<double>&);
template void apply_mask<2>(const std::vector<Flags>&, std::vector<double>&);
template void apply_mask<3>(const std::vector<Flags>&, std::vector<double>&);
template void symmetric_gauss_seidel(const BlockMatrix<1>&, const std::vector<Flags>&, const std::vector<double>&,
                                     std::vector<double>&);
template void symmetric_gauss_seidel(const BlockMatrix<2>&, const std::vector<Flags>&, const std::vector<double>&,
                                     std::vector<double>&);
template void symmetric_gauss_seidel(const BlockMatrix<3>&, const std::vector<Flags>&, const std::vector<double>&,
                                     std::vector<double>&);
template CgResult masked_cg(const BlockMatrix<1>&, const std::vector<Flags>&, const Precondition&, const CgLimits&,
                            std::vector<double>&, std::vector<double>&);
template CgResult masked_cg(const BlockMatrix<2>&, const std::vector<Flags>&, const Precondition&, const CgLimits&,
                            std::vector<double>&, std::vector<double>&);
template CgResult masked_cg(const BlockMatrix<3>&, const std::vector<Flags>&, const Precondition&, const CgLimits&,
                            std::vector<double>&, std::vector<double>&);

}  // namespace signorini
