#include "core/fem/nested.hpp"

#include <algorithm>

#include "core/fem/discretize.hpp"
#include "core/solver/weights.hpp"

namespace signorini {

Prolongation prolongation(const Refinement& refinement, Index coarse_vertices) {
  Prolongation out;
  out.coarse = coarse_vertices;
  out.midpoints = refinement.uniform;
  out.row.reserve(refinement.parents.size() + 1);
  out.column.reserve(2 * refinement.parents.size());
  out.weight.reserve(2 * refinement.parents.size());
  for (const auto& [a, b] : refinement.parents) {
    out.column.push_back(std::min(a, b));
    out.weight.push_back(a == b ? 1.0 : 0.5);
    if (a != b) {
      out.column.push_back(std::max(a, b));
      out.weight.push_back(0.5);
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

template <int B>
std::vector<double> interpolate(const DiscreteProblem<B>& coarse, const std::vector<double>& x,
                                const Prolongation& prolongation, const DiscreteProblem<B>& fine) {
  const std::vector<double> u = to_global(coarse, x);
  std::vector<double> out(Offset{prolongation.fine()} * B);
  weights::with<B>(prolongation, [&](const auto& weight) {
    for (Index p = 0; p < prolongation.fine(); ++p)
      weights::interpolate<B>(prolongation, weight, p, u.data(), out.data() + Offset{p} * B);
  });
  out = to_local(fine, std::move(out));
  for (std::size_t k = 0; k < out.size(); ++k)
    if (fine.fixed[k / B] >> (k % B) & 1) out[k] = fine.start[k];
  return out;
}

#define SIGNORINI_INSTANTIATE(B)                                                                                       \
  template std::vector<double> interpolate(const DiscreteProblem<B>&, const std::vector<double>&, const Prolongation&, \
                                           const DiscreteProblem<B>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
