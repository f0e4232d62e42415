#include "amg/linear/algebraic_cycle.hpp"

#include <algorithm>
#include <utility>

namespace signorini {

template <int B>
Components<B> symmetric_cycle(const Registry& registry) {
  return {registry.create<Smoother<B>>("smoother", "adjoint"),
          [&registry] { return registry.create<Transfer<B>>("transfer", "min_merge"); },
          registry.create<CoarseSolver<B>>("coarse", "newton")};
}

template <int B>
AlgebraicCycle<B>::AlgebraicCycle(Registry components, BlockMatrix<B> A, int sweeps)
    : registry_(std::move(components)) {
  const auto vectors = static_cast<std::size_t>(A.size());
  problem_.A = std::move(A);
  problem_.b.assign(vectors * B, 0.0);
  problem_.fixed.assign(vectors, 0);
  problem_.start.assign(vectors * B, 0.0);
  levels_ = algebraic_hierarchy<B>(problem_, symmetric_cycle<B>(registry_).transfer);
  problem_.galerkin = levels_.matrices;
  multigrid_ =
      std::make_unique<MonotoneMultigrid<B>>(problem_, levels_.prolongations, symmetric_cycle<B>(registry_),
                                             typename MonotoneMultigrid<B>::Settings{.pre = sweeps, .post = sweeps});
}

template <int B>
void AlgebraicCycle<B>::apply(const double* r, double* z) {
  std::copy_n(r, problem_.b.size(), problem_.b.begin());
  std::fill_n(z, problem_.b.size(), 0.0);
  multigrid_->cycle(z);
}

template class AlgebraicCycle<1>;
template class AlgebraicCycle<2>;
template class AlgebraicCycle<3>;
template Components<1> symmetric_cycle(const Registry&);
template Components<2> symmetric_cycle(const Registry&);
template Components<3> symmetric_cycle(const Registry&);

}  // namespace signorini
