#include "core/fem/assembly/magnitude.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "core/base/error.hpp"

namespace signorini {
namespace {

template <int D, int B>
[[noreturn]] void refuse(const Point<D>& at, const Model<B>& model, const char* what, const char* quantities) {
  input_error(model.origin, fmt::format("{} at ({}), expected {} in units that keep it within the range of numbers",
                                        what, fmt::join(at, ", "), quantities));
}

}  // namespace

template <int D, int B>
void check_lengths(const Mesh<D>& mesh, const Model<B>& model) {
  constexpr double limit = 1e100;  // its cube is finite with room for factors
  for (const Point<D>& point : mesh.points)
    for (const double x : point)
      if (!(std::fabs(x) <= limit)) refuse<D, B>(point, model, "too large a coordinate", "lengths");
}

template <int D, int B>
void check_stiffness(const Nodes<D>& nodes, const Model<B>& model, const BlockMatrix<B>& A) {
  const char* moduli = B == 1                      ? "lengths and 'diffusion'"
                       : model.orthotropic.empty() ? "lengths and 'young'"
                                                   : "lengths and moduli";
  for (Index p = 0; p < A.size(); ++p) {
    bool good = A.row[p] < A.row[p + 1] && A.column[A.row[p]] == p;
    for (int k = 0; good && k < B; ++k) {
      const double d = A.diagonal(p)[k * (B + 1)];
      good = std::isfinite(d) && std::isfinite(1 / d);
    }
    if (!good) refuse<D, B>(nodes.at(p), model, "the stiffness overflows or vanishes by underflow", moduli);
  }
}

template <int D, int B>
void check_load(const Nodes<D>& nodes, const Model<B>& model, const DiscreteProblem<B>& problem) {
  double squares = 0, energy = 0;
  for (Index p = 0; p < problem.A.size(); ++p) {
    for (int k = 0; k < B; ++k) {
      const double b = problem.b[Offset{p} * B + k];
      squares += b * b;
      energy += b * (b / problem.A.diagonal(p)[k * (B + 1)]);
    }
    if (!std::isfinite(squares) || !std::isfinite(energy))
      refuse<D, B>(nodes.at(p), model, "the energy of the load overflows", "lengths, loads and prescribed values");
  }
}

#define SIGNORINI_INSTANTIATE(D, B)                                                       \
  template void check_lengths(const Mesh<D>&, const Model<B>&);                           \
  template void check_stiffness(const Nodes<D>&, const Model<B>&, const BlockMatrix<B>&); \
  template void check_load(const Nodes<D>&, const Model<B>&, const DiscreteProblem<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
