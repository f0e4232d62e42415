#include "amg/coarsening/hierarchy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "amg/coarsening/classical.hpp"
#include "amg/coarsening/fourth_order.hpp"
#include "amg/coarsening/mode_aggregation.hpp"
#include "amg/coarsening/quadratic.hpp"
#include "amg/coarsening/reach_from_twins.hpp"
#include "amg/coarsening/smoothed_aggregation.hpp"
#include "core/algebra/fill_in.hpp"
#include "core/base/error.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {

namespace {

constexpr double progress = 0.8;  // coarse over fine vectors above which coarsening has ended

/// @param product the Galerkin product that the matrix is
template <int B>
void adopt(const BlockMatrix<B>& known, BlockMatrix<B>& product) {
  std::vector<Offset> position(static_cast<std::size_t>(product.size()), -1);
  fill_in(known, product, position, [&](Index q, Index r) {
    input_error(fmt::format("coarse matrix of {} rows", known.size() * B),
                fmt::format("rows {} and {} are coupled, but not in the Galerkin product P'AP of the next finer one",
                            q * B + 1, r * B + 1));
  });
}

/// Goes down from level to level.
template <int B>
class Descent {
 public:
  Descent(const DiscreteProblem<B>& problem, const AlgebraicSettings& settings)
      : level_(finest_level(problem)), settings_(settings) {
    level_.clear_phases();
  }

  const Level<B>& level() const { return level_; }

  /// @param known the coarse matrix; null: to be computed
  void go_down(Prolongation P, Transfer<B>& transfer, const BlockMatrix<B>* known = nullptr) {
    P.algebraic = true;
    P.local = settings_.local;
    if (settings_.only_twins) reach_from_twins(level_.constraints.slot, P);
    Level<B> coarse;
    if (known) {
      transfer.prepare(level_, P, true, coarse);
      adopt(*known, coarse.own_matrix);
    } else {
      transfer.prepare_assembled(level_, P, true, coarse);
    }
    coarse.clear_phases();
    leave();
    prolongations_.push_back(std::move(P));
    level_ = std::move(coarse);
    level_.A = &level_.own_matrix;
  }

  AlgebraicLevels<B> levels() && {
    leave();
    std::ranges::reverse(prolongations_);
    std::ranges::reverse(matrices_);
    return {std::move(prolongations_), std::move(matrices_)};
  }

 private:
  void leave() {
    if (!prolongations_.empty()) matrices_.push_back({std::move(level_.own_matrix), std::move(level_.off)});
  }

  Level<B> level_;
  AlgebraicSettings settings_;
  std::vector<Prolongation> prolongations_;  // finest first
  std::vector<GalerkinMatrix<B>> matrices_;
};

/// Interpolations from fine to coarse.
template <int B>
class Chooser {
 public:
  Chooser(const AlgebraicSettings& settings, NearNullSpace modes, const Aggregator& aggregator)
      : coarsening_(settings.coarsening),
        stretched_(settings.stretched),
        modes_(std::move(modes)),
        aggregator_(aggregator) {}

  Prolongation next(const Level<B>& level) {
    if (std::exchange(finest_, false))
      if (auto linear = quadratic_interpolation(*level.A, level.off); linear && pass_modes_on(*linear))
        return std::move(*linear);
    const bool known = modes_.modes > 0;
    if (coarsening_ == Coarsening::classical || (coarsening_ == Coarsening::automatic && !known))
      return classical_interpolation(*level.A, level.off);
    if (!known) return smoothed_aggregation(*level.A, level.off, aggregator_);
    ModeAggregation found = mode_aggregation(level, modes_, group_, aggregator_, stretched_);
    modes_ = std::move(found.coarse);
    group_ = found.group;
    return std::move(found.prolongation);
  }

 private:
  /// To the twins; not where others are no means of theirs, even in the mean.
  bool pass_modes_on(const Prolongation& P) {
    NearNullSpace coarse{modes_.modes, {}};
    for (const Index p : P.twin) {
      if (!modes_.part.empty()) coarse.part.push_back(modes_.part[p]);
      for (int i = 0; i < B; ++i)
        coarse.value.insert(coarse.value.end(), modes_.at(Offset{p} * B + i),
                            modes_.at(Offset{p} * B + i) + modes_.modes);
    }
    double off = 0, all = 0;
    for (Index p = 0; p < P.fine(); ++p) {
      if (P.row[p + 1] - P.row[p] < 2) continue;
      for (Index at = 0; at < B * modes_.modes; ++at) {
        const double value = modes_.at(Offset{p} * B)[at];
        double mean = 0;
        for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) mean += P.weight[k] * coarse.at(Offset{P.column[k]} * B)[at];
        off += (value - mean) * (value - mean);
        all += value * value;
      }
    }
    if (off > not_linear * not_linear * all) return false;
    modes_ = std::move(coarse);
    return true;
  }

  static constexpr double not_linear = 0.01;
  Coarsening coarsening_;
  bool stretched_;
  bool finest_ = true;
  NearNullSpace modes_;  // of the level that comes next
  Index group_ = 1;      // of its vectors that belong together
  const Aggregator& aggregator_;
};

}  // namespace

namespace {

/// The levels of an operator of second order, gently coarsened, whose interpolations are right next to prescribed
/// values and rounded off.
AlgebraicLevels<1> fourth_order_hierarchy(const DiscreteProblem<1>& problem, BlockMatrix<1> root,
                                          const TransferFactory<1>& transfer, Index enough,
                                          const AlgebraicSettings& settings) {
  DiscreteProblem<1> second;
  second.A = std::move(root);
  second.fixed = problem.fixed;
  second.b.assign(problem.b.size(), 0);
  second.start = second.b;
  Descent<1> descent(second, {});
  while (descent.level().vectors > enough) {
    Prolongation P = classical_interpolation(*descent.level().A, descent.level().off, true);
    if (P.coarse == 0 || P.coarse > progress * P.fine()) break;
    descent.go_down(std::move(P), *transfer());
  }
  AlgebraicLevels<1> levels = std::move(descent).levels();
  const std::vector<double> smooth = under_even_load(second.A, second.fixed, levels.prolongations, levels.matrices);
  std::vector<double> v = smooth;
  for (std::size_t k = levels.prolongations.size(); k-- > 0;) {
    fit_near_edges(v, levels.prolongations[k]);
    v = at_twins(v, levels.prolongations[k]);
  }
  levels = galerkin_hierarchy<1>(second, std::move(levels.prolongations), transfer);
  v = smooth;
  for (std::size_t k = levels.prolongations.size(); k-- > 0;) {
    const bool finest = k + 1 == levels.prolongations.size();
    const BlockMatrix<1>& L = finest ? second.A : levels.matrices[k + 1].A;
    const std::vector<Flags>& off = finest ? second.fixed : levels.matrices[k + 1].off;
    Prolongation& P = levels.prolongations[k];
    const double damping = kink_damping(L, off, P, v);
    v = at_twins(v, P);
    P = rounded_off(L, off, P, damping);
  }
  return galerkin_hierarchy<1>(problem, std::move(levels.prolongations), transfer, settings);
}

}  // namespace

template <int B>
AlgebraicLevels<B> algebraic_hierarchy(const DiscreteProblem<B>& problem, const TransferFactory<B>& transfer,
                                       Index enough, const AlgebraicSettings& settings, NearNullSpace near_null,
                                       const Aggregator& aggregator) {
  if constexpr (B == 1)
    if (near_null.modes == 0 && settings.coarsening == Coarsening::automatic && problem.A.size() > enough)
      if (auto root = second_order_root(problem.A, problem.fixed))
        return fourth_order_hierarchy(problem, std::move(*root), transfer, enough, settings);
  Descent<B> descent(problem, settings);
  Chooser<B> chooser(settings, std::move(near_null), aggregator);
  while (descent.level().vectors > enough) {
    Prolongation P = chooser.next(descent.level());
    if (P.coarse == 0 || P.coarse > progress * P.fine()) break;
    descent.go_down(std::move(P), *transfer());
  }
  return std::move(descent).levels();
}

template <int B>
AlgebraicLevels<B> galerkin_hierarchy(const DiscreteProblem<B>& problem, std::vector<Prolongation> prolongations,
                                      const TransferFactory<B>& transfer, const AlgebraicSettings& settings,
                                      std::vector<BlockMatrix<B>> known) {
  Descent<B> descent(problem, settings);
  for (std::size_t k = prolongations.size(); k-- > 0;)
    descent.go_down(std::move(prolongations[k]), *transfer(), known.empty() ? nullptr : &known[k]);
  return std::move(descent).levels();
}

template AlgebraicLevels<1> algebraic_hierarchy(const DiscreteProblem<1>&, const TransferFactory<1>&, Index,
                                                const AlgebraicSettings&, NearNullSpace, const Aggregator&);
template AlgebraicLevels<2> algebraic_hierarchy(const DiscreteProblem<2>&, const TransferFactory<2>&, Index,
                                                const AlgebraicSettings&, NearNullSpace, const Aggregator&);
template AlgebraicLevels<3> algebraic_hierarchy(const DiscreteProblem<3>&, const TransferFactory<3>&, Index,
                                                const AlgebraicSettings&, NearNullSpace, const Aggregator&);
template AlgebraicLevels<1> galerkin_hierarchy(const DiscreteProblem<1>&, std::vector<Prolongation>,
                                               const TransferFactory<1>&, const AlgebraicSettings&,
                                               std::vector<BlockMatrix<1>>);
template AlgebraicLevels<2> galerkin_hierarchy(const DiscreteProblem<2>&, std::vector<Prolongation>,
                                               const TransferFactory<2>&, const AlgebraicSettings&,
                                               std::vector<BlockMatrix<2>>);
template AlgebraicLevels<3> galerkin_hierarchy(const DiscreteProblem<3>&, std::vector<Prolongation>,
                                               const TransferFactory<3>&, const AlgebraicSettings&,
                                               std::vector<BlockMatrix<3>>);

}  // namespace signorini
