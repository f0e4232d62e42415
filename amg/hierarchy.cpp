#include "amg/hierarchy.hpp"

#include <algorithm>

#include "amg/classical.hpp"
#include "core/solver/multigrid.hpp"

namespace signorini {

namespace {

constexpr double progress = 0.8;  // coarse over fine vectors above which coarsening has ended

}  // namespace

template <int B>
std::vector<Prolongation> algebraic_hierarchy(const DiscreteProblem<B>& problem,
                                              const std::function<std::unique_ptr<Transfer<B>>()>& transfer,
                                              Index enough) {
  std::vector<Prolongation> finest_first;
  Level<B> fine = finest_level(problem);
  fine.clear_phases();
  while (fine.vectors > enough) {
    Prolongation P = classical_interpolation(*fine.A, fine.off);
    if (P.coarse == 0 || P.coarse > progress * fine.vectors) break;
    Level<B> coarse;
    const auto step = transfer();
    step->prepare(fine, P, true, coarse);
    coarse.clear_phases();
    step->assemble(fine, coarse);
    finest_first.push_back(std::move(P));
    fine = std::move(coarse);
    fine.A = &fine.own_matrix;
  }
  std::ranges::reverse(finest_first);
  return finest_first;
}

template std::vector<Prolongation> algebraic_hierarchy(const DiscreteProblem<1>&,
                                                       const std::function<std::unique_ptr<Transfer<1>>()>&, Index);
template std::vector<Prolongation> algebraic_hierarchy(const DiscreteProblem<2>&,
                                                       const std::function<std::unique_ptr<Transfer<2>>()>&, Index);
template std::vector<Prolongation> algebraic_hierarchy(const DiscreteProblem<3>&,
                                                       const std::function<std::unique_ptr<Transfer<3>>()>&, Index);

}  // namespace signorini
