#include "amg/masked_cg.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/products.hpp"

namespace signorini {

namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return s;
}

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

constexpr double without_energy = 1e-14;  // p'Ap below this part of p'Dp is rounding
constexpr double falling = 1e-9;          // part of all forces along a direction above which it is no rounding

}  // namespace

template <int B>
double force_norm(const BlockMatrix<B>& A, const std::vector<double>& r) {
  double sum = 0;
  for (Index q = 0; q < A.size(); ++q)
    for (int k = 0; k < B; ++k) {
      const double value = r[Offset{q} * B + k];
      sum += value * value / A.diagonal(q)[k * B + k];
    }
  return std::sqrt(sum);
}

template <int B>
void apply_mask(const std::vector<Flags>& mask, std::vector<double>& v) {
  for (std::size_t p = 0; p < mask.size(); ++p)
    for (int k = 0; mask[p] >> k; ++k)
      if (mask[p] >> k & 1u) v[p * B + k] = 0;
}

template <int B>
void symmetric_gauss_seidel(const BlockMatrix<B>& A, const std::vector<Flags>& mask, const std::vector<double>& r,
                            std::vector<double>& z) {
  z.assign(r.size(), 0.0);
  const auto relax = [&](Index p) {
    double rest[B], step[B];
    std::copy_n(r.data() + Offset{p} * B, B, rest);
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      block::subtract_product<B>(A.at(k), z.data() + Offset{A.column[k]} * B, rest);
    block::solve<B>(A.diagonal(p), rest, ~unsigned{mask[p]} & ((1u << B) - 1), step);
    for (int k = 0; k < B; ++k) z[Offset{p} * B + k] += step[k];
  };
  for (Index p = 0; p < A.size(); ++p) relax(p);
  for (Index p = A.size() - 1; p >= 0; --p) relax(p);
}

template <int B>
CgResult masked_cg(const BlockMatrix<B>& A, const std::vector<Flags>& mask, const Precondition& precondition,
                   double reduction, int limit, double force, std::vector<double>& r, std::vector<double>& d) {
  CgResult result;
  d.assign(r.size(), 0.0);
  std::vector<double> z(r.size()), p(r.size()), Ap(r.size());
  precondition(r, z);
  double rz = dot(r, z);
  const double start = rz;
  p = z;
  while (rz > reduction * reduction * start && rz > 0 && result.iterations < limit) {
    ++result.iterations;
    product<B>(A, p.data(), Ap.data());
    apply_mask<B>(mask, Ap);
    const double pAp = dot(p, Ap);
    const double pDp = diagonal_energy<B>(A, p);
    if (!(pAp > without_energy * pDp)) {
      result.singular = dot(r, p) > falling * std::sqrt(pDp) * force;
      if (result.singular) d = p;
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
  return result;
}

template double force_norm(const BlockMatrix<1>&, const std::vector<double>&);
template void apply_mask<1>(const std::vector<Flags>&, std::vector<double>&);
template double force_norm(const BlockMatrix<2>&, const std::vector<double>&);
template void apply_mask<2>(const std::vector<Flags>&, std::vector<double>&);
template double force_norm(const BlockMatrix<3>&, const std::vector<double>&);
template void apply_mask<3>(const std::vector<Flags>&, std::vector<double>&);
template void symmetric_gauss_seidel(const BlockMatrix<1>&, const std::vector<Flags>&, const std::vector<double>&,
                                     std::vector<double>&);
template void symmetric_gauss_seidel(const BlockMatrix<2>&, const std::vector<Flags>&, const std::vector<double>&,
                                     std::vector<double>&);
template void symmetric_gauss_seidel(const BlockMatrix<3>&, const std::vector<Flags>&, const std::vector<double>&,
                                     std::vector<double>&);
template CgResult masked_cg(const BlockMatrix<1>&, const std::vector<Flags>&, const Precondition&, double, int, double,
                            std::vector<double>&, std::vector<double>&);
template CgResult masked_cg(const BlockMatrix<2>&, const std::vector<Flags>&, const Precondition&, double, int, double,
                            std::vector<double>&, std::vector<double>&);
template CgResult masked_cg(const BlockMatrix<3>&, const std::vector<Flags>&, const Precondition&, double, int, double,
                            std::vector<double>&, std::vector<double>&);

}  // namespace signorini
