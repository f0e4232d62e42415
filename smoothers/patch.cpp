#include "smoothers/patch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <optional>

#include "core/sdk/projected_sweep.hpp"

namespace signorini {

namespace {

constexpr std::size_t most_vectors = 24;  // of a patch: long rows of algebraic levels would cost too much
constexpr double raised = 1e-10;          // part added to the diagonal, for patches that nothing holds

template <int B>
class PatchSweeps final : public LevelSmoother<B> {
 public:
  explicit PatchSweeps(const Level<B>& level) : level_(level), number_(static_cast<std::size_t>(level.vectors), -1) {
    std::vector<char> covered(number_.size(), 0);
    for (Index p = 0; p < level.vectors; ++p)
      if (!covered[p] && level.constraints.slot[p] < 0) {
        patches_.push_back({neighbours(p), std::nullopt});
        for (const Index q : patches_.back().vectors) covered[q] = 1;
      }
  }

  void add_passes(int steps, Side side, Passes& passes) override {
    const Order order = side == Side::descend ? Order::forward : Order::backward;
    if (side == Side::descend && !patches_.empty()) passes.add_whole([this] { renew_factors(); });
    for (int step = 0; step < steps; ++step) {
      passes.add(order, [this, order](Index first, Index last) { level_.sweep(order, first, last); });
      if (!patches_.empty()) passes.add_whole([this, order] { solve_all(order); });
    }
  }

 private:
  struct PatchOfVectors {
    std::vector<Index> vectors;
    std::optional<Eigen::LLT<Eigen::MatrixXd>> factor;  // once the matrix is known
  };

  // The vector itself first.
  std::vector<Index> neighbours(Index p) const {
    const BlockMatrix<B>& A = *level_.A;
    std::vector<Index> out;
    for (Offset k = A.row[p]; k < A.row[p + 1] && out.size() < most_vectors; ++k)
      if (level_.constraints.slot[A.column[k]] < 0) out.push_back(A.column[k]);
    return out;
  }

  // The first time all, then those with rows that are new since the last visit.
  void renew_factors() {
    std::vector<char> renewed(number_.size(), factorised_ ? 0 : 1);
    for (const Index p : level_.outdated.renewed) renewed[p] = 1;
    for (PatchOfVectors& patch : patches_)
      if (std::ranges::any_of(patch.vectors, [&](Index p) { return renewed[p] != 0; })) factorise(patch);
    factorised_ = true;
  }

  void factorise(PatchOfVectors& patch) {
    const BlockMatrix<B>& A = *level_.A;
    const auto count = static_cast<Index>(patch.vectors.size());
    for (Index i = 0; i < count; ++i) number_[patch.vectors[i]] = i;
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(count * B, count * B);
    for (Index i = 0; i < count; ++i)
      for (Offset k = A.row[patch.vectors[i]]; k < A.row[patch.vectors[i] + 1]; ++k)
        if (const Index j = number_[A.column[k]]; j >= 0)
          M.block<B, B>(i * B, j * B) =
              Eigen::Map<const Eigen::Matrix<double, B, B, B == 1 ? Eigen::ColMajor : Eigen::RowMajor>>(A.at(k));
    for (const Index p : patch.vectors) number_[p] = -1;
    M.diagonal() *= 1 + raised;
    patch.factor.emplace(M);
  }

  void solve_all(Order order) {
    const auto count = patches_.size();
    for (std::size_t i = 0; i < count; ++i) solve(patches_[order == Order::forward ? i : count - 1 - i]);
  }

  void solve(const PatchOfVectors& patch) {
    if (patch.factor->info() != Eigen::Success) return;
    const LevelView<B> view = level_.view();
    const auto count = static_cast<Index>(patch.vectors.size());
    r_.resize(count * B);
    for (Index i = 0; i < count; ++i) row_residual<B>(view, patch.vectors[i], r_.data() + i * B);
    patch.factor->solveInPlace(r_);
    for (Index i = 0; i < count; ++i)
      for (int k = 0; k < B; ++k) view.x[Offset{patch.vectors[i]} * B + k] += r_[i * B + k];
  }

  const Level<B>& level_;
  std::vector<PatchOfVectors> patches_;
  std::vector<Index> number_;  // per vector: its place in the patch at work, -1 elsewhere
  Eigen::VectorXd r_;
  bool factorised_ = false;
};

}  // namespace

template <int B>
std::unique_ptr<LevelSmoother<B>> Patch<B>::on(const Level<B>& level) const {
  return std::make_unique<PatchSweeps<B>>(level);
}

template class Patch<1>;
template class Patch<2>;
template class Patch<3>;

}  // namespace signorini
