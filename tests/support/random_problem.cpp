#include "tests/support/random_problem.hpp"
#include "core/base/dense.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <memory>

namespace signorini::test {

template <int B>
std::array<double, B * B> random_rotation(Random& random) {
  Eigen::Matrix<double, B, B, B == 1 ? Eigen::ColMajor : Eigen::RowMajor> M;
  for (int i = 0; i < B * B; ++i) M.data()[i] = random.between(-1, 1);
  Eigen::Matrix<double, B, B> full = M;
  Eigen::Matrix<double, B, B> Q = orthonormal_columns(full);
  std::array<double, B * B> out;
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) out[i * B + j] = Q(i, j);
  return out;
}

template <int B>
BlockMatrix<B> random_matrix(Random& random, Index n, int edges_per_vector, double shift) {
  using Block = Eigen::Matrix<double, B, B>;
  std::map<std::pair<Index, Index>, Block> blocks;
  const auto add = [&](Index p, Index q, const Block& M) {
    blocks.try_emplace({p, q}, Block::Zero()).first->second += M;
  };
  for (Index p = 0; p < n; ++p) add(p, p, shift * Block::Identity());
  for (Index e = 0; e < n * edges_per_vector; ++e) {
    const Index p = e % n, q = random.below(n);
    if (p == q) continue;
    Block G;
    for (int i = 0; i < B * B; ++i) G.data()[i] = random.between(-1, 1);
    const Block lower = (G.transpose() * G).template triangularView<Eigen::Lower>();
    Block K = lower.template selfadjointView<Eigen::Lower>();
    add(p, p, K);
    add(q, q, K);
    add(p, q, -K);
    add(q, p, -K);
  }
  BlockMatrix<B> A;
  const auto push = [&](Index column, const Block& M) {
    A.column.push_back(column);
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) A.value.push_back(M(i, j));
  };
  for (Index p = 0; p < n; ++p) {
    push(p, blocks.at({p, p}));
    for (auto it = blocks.lower_bound({p, 0}); it != blocks.end() && it->first.first == p; ++it)
      if (it->first.second != p) push(it->first.second, it->second);
    A.row.push_back(static_cast<Offset>(A.column.size()));
  }
  return A;
}

std::pair<double, double> random_interval(Random& random, double around, double width) {
  const double lower = around - width * random.unit(), upper = around + width * random.unit();
  switch (random.below(5)) {
    case 0:
      return {-infinity, infinity};
    case 1:
      return {lower, infinity};
    case 2:
      return {-infinity, upper};
    case 3:
      return {lower, upper};
    default:
      return {lower, lower};
  }
}

template <int B>
DiscreteProblem<B> random_problem(Random& random, Index n, double constrained) {
  DiscreteProblem<B> problem;
  problem.A = random_matrix<B>(random, n);
  const auto size = static_cast<std::size_t>(n);
  for (std::size_t i = 0; i < size * B; ++i) problem.b.push_back(random.between(-1, 1));
  problem.fixed.assign(size, 0);
  problem.start.assign(size * B, 0);
  problem.constraints.slot.assign(size, -1);
  for (Index p = 0; p < n; ++p) {
    if (!random.chance(constrained)) continue;
    problem.constraints.slot[p] = problem.constraints.size();
    problem.constraints.vector.push_back(p);
    for (int k = 0; k < B; ++k) {
      const auto [lower, upper] = random_interval(random, random.between(-0.5, 0.5), 0.5);
      problem.constraints.lower.push_back(lower);
      problem.constraints.upper.push_back(upper);
    }
  }
  problem.segments = {{0, n, std::make_shared<Box<B>>()}};
  return problem;
}

template <int B>
Frames<B> random_frames(Random& random, Index n) {
  Frames<B> frames;
  if (B == 1) return frames;
  using Block = Eigen::Matrix<double, B, B, B == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  for (Index p = 0; p < n; ++p) {
    if (random.chance(0.5)) continue;
    const auto rotation = random_rotation<B>(random);
    Block Q(rotation.data());
    if (random.chance(0.5))
      for (int i = 0; i < B; ++i) Q.col(i) *= random.between(0.5, 2), Q.col(0) += random.between(-1, 1) / B * Q.col(i);
    const Block N = Q.inverse().transpose();
    frames.add(static_cast<std::size_t>(n), p, Q.data(), N.data());
  }
  return frames;
}

Prolongation random_prolongation(Random& random, Index coarse, Index fine) {
  Prolongation P;
  P.coarse = coarse;
  for (Index p = 0; p < fine; ++p) {
    std::vector<Index> columns;
    if (p < coarse)
      columns = {p};
    else
      for (int k = 1 + random.below(3); k > 0; --k) columns.push_back(random.below(coarse));
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (const Index q : columns) {
      P.column.push_back(q);
      P.weight.push_back(p < coarse ? 1 : random.between(-1, 1.5));
    }
    P.row.push_back(static_cast<Offset>(P.column.size()));
  }
  return P;
}

#define SIGNORINI_INSTANTIATE(B)                                         \
  template std::array<double, B * B> random_rotation<B>(Random&);        \
  template BlockMatrix<B> random_matrix<B>(Random&, Index, int, double); \
  template DiscreteProblem<B> random_problem<B>(Random&, Index, double); \
  template Frames<B> random_frames<B>(Random&, Index);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)

}  // namespace signorini::test
