#pragma once
#include "core/solver/multigrid.hpp"
#include "tests/support/random_problem.hpp"
#include "transfer/merge.hpp"

namespace signorini::test {

/// The interpolation from `coarse` to `fine` as one dense matrix, written down from its definition: block (p, q) is
/// D_p R_p^-1 W_pq C_q D_q with the weights W, the frames R_p, C_q, and D dropping what does not interpolate.
template <int B>
Eigen::MatrixXd interpolation(const Level<B>& fine, const Prolongation& P, const Level<B>& coarse) {
  using Block = Eigen::Matrix<double, B, B>;
  const auto basis = [](const Level<B>& level, Index p) {
    Block Q = Block::Identity();
    if (const double* at = level.frames.at(p))
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) Q(i, j) = at[i * B + j];
    return Q;
  };
  const auto kept = [](Flags removed) {
    Block D = Block::Identity();
    for (int i = 0; i < B; ++i)
      if (removed >> i & 1) D(i, i) = 0;
    return D;
  };
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(fine.vectors * B, coarse.vectors * B);
  for (Index p = 0; p < fine.vectors; ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
      const Index q = P.column[k];
      Block W = Block::Identity();
      for (int i = 0; i < B * B; ++i)
        W(i / B, i % B) = P.block.empty() ? W(i / B, i % B) * P.weight[k] : P.block[k * B * B + i];
      T.block(p * B, q * B, B, B) =
          kept(fine.removed(p)) * basis(fine, p).inverse() * W * basis(coarse, q) * kept(coarse.off[q]);
    }
  return T;
}

/// New truncation flags of a level, listed as changed where they differ.
template <int B>
void truncate(Level<B>& level, const std::vector<Flags>& critical) {
  for (Index p = 0; p < level.vectors; ++p) level.truncate(p, critical[p]);
}

template <int B>
std::vector<Flags> random_flags(Random& random, Index n, double probability) {
  std::vector<Flags> flags(static_cast<std::size_t>(n), 0);
  for (Flags& f : flags)
    for (int k = 0; k < B; ++k)
      if (random.chance(probability)) f |= static_cast<Flags>(1u << k);
  return flags;
}

/// Random blocks in place of the weights, but for the twins; for B > 1.
template <int B>
void make_blocks(Random& random, Prolongation& P) {
  P.twin = P.twins();
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
      for (int i = 0; i < B * B; ++i)
        P.block.push_back(p < P.coarse ? double(i % (B + 1) == 0) : P.weight[k] * random.between(-1, 1));
  P.weight.clear();
}

/// A fine level with random matrix, frames and remaining distances, and the coarse one below it.
template <int B, template <int> class Restriction = MinMerge>
struct TwoLevels {
  DiscreteProblem<B> problem;
  Prolongation P;
  Level<B> fine, coarse;
  Restriction<B> transfer;
  std::vector<double> x;

  TwoLevels(Random& random, Index n, bool rotate, bool blocks = false) {
    problem = random_problem<B>(random, n, 0.4);
    problem.frames = random_frames<B>(random, n);
    P = random_prolongation(random, n / 3, n);
    if (B > 1 && blocks) make_blocks<B>(random, P);
    fine = finest_level(problem);
    x.assign(problem.b.size(), 0.0);
    fine.x = x.data();
    fine.clear_phases();
    transfer.prepare(fine, P, rotate, coarse);
    coarse.clear_phases();
    for (std::size_t i = 0; i < fine.phases.lower.size(); ++i) {
      const auto [lower, upper] = random_interval(random, 0, 1);
      fine.phases.lower[i] = std::min(lower, 0.0);
      fine.phases.upper[i] = std::max(upper, 0.0);
    }
    fine.constraints.lower = fine.phases.lower;
    fine.constraints.upper = fine.phases.upper;
  }

  /// coarse.b from a residual on the whole fine level.
  void restrict_residual(const std::vector<double>& r) {
    transfer.begin_restriction(coarse);
    transfer.restrict_residual(fine, 0, fine.vectors, r.data(), coarse);
    transfer.end_restriction(coarse);
  }

  /// x += interpolation of coarse.x.
  void prolongate() {
    transfer.begin_prolongation(coarse);
    transfer.prolongate(coarse, fine, 0, fine.vectors);
  }
};

}  // namespace signorini::test
