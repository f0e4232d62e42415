#include "core/mesh/curve.hpp"

#include <algorithm>

#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

constexpr double least_volume = 0.1;  // of the element before the move
constexpr double least_step = 1.0 / 16;

struct Touched {
  Index element;
  double volume;  // before the move
};

}  // namespace

template <int D>
Point<D> project(const Curve<D>& curve, const Point<D>& p) {
  Point<D> radial = difference<D>(p, curve.center);
  if (D == 3 && curve.along_z) radial[D - 1] = 0;
  const double distance = length<D>(radial);
  if (!(distance > 0)) return p;
  Point<D> q;
  for (int k = 0; k < D; ++k) q[k] = curve.center[k] + curve.radius / distance * radial[k];
  if (D == 3 && curve.along_z) q[D - 1] = p[D - 1];
  return q;
}

template <int D>
void move_vertices(Mesh<D>& mesh, const std::vector<Move<D>>& moves) {
  if (moves.empty()) return;
  std::vector<Index> move_of(mesh.points.size(), -1);
  std::vector<Point<D>> start;
  for (std::size_t m = 0; m < moves.size(); ++m) {
    move_of[moves[m].vertex] = static_cast<Index>(m);
    start.push_back(mesh.points[moves[m].vertex]);
  }
  std::vector<Touched> touched;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::ranges::any_of(mesh.elements[e], [&](Index v) { return move_of[v] >= 0; }))
      touched.push_back({static_cast<Index>(e), signed_volume<D>(corners<D>(mesh.points, mesh.elements[e]))});

  std::vector<double> step(moves.size(), 1);
  const auto place = [&](std::size_t m) {
    for (int k = 0; k < D; ++k)
      mesh.points[moves[m].vertex][k] =
          step[m] == 1 ? moves[m].target[k] : start[m][k] + step[m] * (moves[m].target[k] - start[m][k]);
  };
  for (std::size_t m = 0; m < moves.size(); ++m) place(m);

  // Every pass but the last shortens a step, and a step is shortened no more than five times.
  for (bool settled = false; !settled;) {
    settled = true;
    for (const Touched& t : touched) {
      if (signed_volume<D>(corners<D>(mesh.points, mesh.elements[t.element])) > least_volume * t.volume) continue;
      for (const Index v : mesh.elements[t.element])
        if (const Index m = move_of[v]; m >= 0 && step[m] > 0) {
          step[m] = step[m] > least_step ? step[m] / 2 : 0;
          place(m);
          settled = false;
        }
    }
  }
}

#define SIGNORINI_INSTANTIATE(D)                                  \
  template Point<D> project<D>(const Curve<D>&, const Point<D>&); \
  template void move_vertices(Mesh<D>&, const std::vector<Move<D>>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
