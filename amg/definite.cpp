#include "amg/definite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "amg/masked_cg.hpp"
#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {
namespace {

using Direction = std::vector<double>;  // empty: none

constexpr double rounding = 1e-12;  // of d'Ad, relative to d'Dd with the diagonal D of A
constexpr int steps = 10;           // as costly as a few cycles
constexpr int coarsest_steps = 200;

template <int B>
bool falls_along(const BlockMatrix<B>& A, const Direction& d) {
  Direction Ad(d.size());
  product<B>(A, d.data(), Ad.data());
  double energy = 0, size = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    energy += d[i] * Ad[i];
    size += std::abs(A.diagonal(static_cast<Index>(i / B))[i % B * (B + 1)]) * d[i] * d[i];
  }
  return energy < -rounding * size;
}

template <int B>
Direction falling_unit_vector(const Level<B>& level) {
  for (Index p = 0; p < level.vectors; ++p)
    for (int k = 0; k < B; ++k)
      if (level.A->diagonal(p)[k * B + k] < 0) {
        Direction d(static_cast<std::size_t>(level.vectors) * B, 0.0);
        d[Offset{p} * B + k] = 1;
        return d;
      }
  return {};
}

template <int B>
Direction falling_direction(const Level<B>& level, int iterations) {
  if (Direction d = falling_unit_vector(level); !d.empty()) return d;
  std::mt19937_64 random;
  Direction r(static_cast<std::size_t>(level.vectors) * B), d;
  for (double& value : r) value = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
  apply_mask<B>(level.off, r);
  const auto precondition = [&](const Direction& from, Direction& to) {
    symmetric_gauss_seidel<B>(*level.A, level.off, from, to);
  };
  const CgResult cg = masked_cg<B>(*level.A, level.off, precondition, {.iterations = iterations}, r, d);
  return cg.singular && falls_along(*level.A, d) ? d : Direction{};
}

template <int B>
Direction interpolated(const Prolongation& P, const Direction& coarse) {
  Direction fine(static_cast<std::size_t>(P.fine()) * B, 0.0);
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
      for (int i = 0; i < B; ++i) fine[Offset{p} * B + i] += P.weight[k] * coarse[Offset{P.column[k]} * B + i];
  return fine;
}

template <int B>
[[noreturn]] void refuse(const BlockMatrix<B>& A, const Direction& d) {
  Direction Ad(d.size());
  product<B>(A, d.data(), Ad.data());
  double energy = 0, squared = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    energy += d[i] * Ad[i];
    squared += d[i] * d[i];
  }
  const auto largest =
      std::max_element(d.begin(), d.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  input_error("matrix", fmt::format("indefinite: d'Ad = {:.3g} d'd for a direction d with its largest entry in row {}; "
                                    "expected a positive semidefinite matrix",
                                    energy / squared, largest - d.begin() + 1));
}

}  // namespace

template <int B>
void refuse_indefinite(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                       const std::function<std::unique_ptr<Transfer<B>>()>& transfer) {
  Level<B> fine = finest_level(problem);
  fine.clear_phases();
  for (std::size_t k = prolongations.size();; --k) {
    if (Direction d = falling_direction(fine, k > 0 ? steps : coarsest_steps); !d.empty()) {
      for (; k < prolongations.size(); ++k) d = interpolated<B>(prolongations[k], d);
      refuse(problem.A, d);
    }
    if (k == 0) return;
    Level<B> coarse;
    const auto step = transfer();
    step->prepare(fine, prolongations[k - 1], true, coarse);
    coarse.clear_phases();
    step->assemble(fine, coarse);
    fine = std::move(coarse);
    fine.A = &fine.own_matrix;
  }
}

template void refuse_indefinite(const DiscreteProblem<1>&, std::span<const Prolongation>,
                                const std::function<std::unique_ptr<Transfer<1>>()>&);
template void refuse_indefinite(const DiscreteProblem<2>&, std::span<const Prolongation>,
                                const std::function<std::unique_ptr<Transfer<2>>()>&);
template void refuse_indefinite(const DiscreteProblem<3>&, std::span<const Prolongation>,
                                const std::function<std::unique_ptr<Transfer<3>>()>&);

}  // namespace signorini
