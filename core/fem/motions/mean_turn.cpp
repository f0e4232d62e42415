#include "core/fem/motions/mean_turn.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/base/dense.hpp"

namespace signorini {
namespace {

/// Sums over the vertices of a body: their number, their positions, and the moments of both.
template <int D>
struct Sums {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Square = Eigen::Matrix<double, D, D>;

  double count = 0;
  Vector x = Vector::Zero(), u = Vector::Zero();
  Square xx = Square::Zero(), ux = Square::Zero();

  void add(const Point<D>& at, const double* displacement) {
    const Eigen::Map<const Vector> r(at.data()), d(displacement);
    ++count;
    x += r;
    u += d;
    xx += r * r.transpose();
    ux += d * r.transpose();
  }

  // Of the linear displacement next to u the part that is a rotation.
  MeanTurn turn() const {
    const Square inertia = xx - x * x.transpose() / count, moment = ux - u * x.transpose() / count;
    const Square gradient = SymmetricFactors(inertia).solve(moment.transpose()).transpose();
    return {0.5 * (gradient - gradient.transpose()).norm() / std::sqrt(2.0), std::sqrt(inertia.trace() / count)};
  }
};

}  // namespace

template <int D>
std::vector<MeanTurn> mean_turns(const Nodes<D>& nodes, const std::vector<Index>& of_node,
                                 const std::vector<double>& u) {
  const Index bodies = of_node.empty() ? 1 : *std::max_element(of_node.begin(), of_node.end()) + 1;
  std::vector<Sums<D>> sums(static_cast<std::size_t>(bodies));
  const Point<D> origin = nodes.at(0);  // positions far from zero would leave nothing of the differences
  for (Index p = 0; p < nodes.size(); ++p) {
    if (nodes.ends(p)[0] != nodes.ends(p)[1]) continue;
    Point<D> r = nodes.at(p);
    for (int i = 0; i < D; ++i) r[i] -= origin[i];
    sums[of_node.empty() ? 0 : of_node[p]].add(r, u.data() + Offset{p} * D);
  }
  std::vector<MeanTurn> out(sums.size());
  std::ranges::transform(sums, out.begin(), [](const Sums<D>& of) { return of.turn(); });
  return out;
}

template std::vector<MeanTurn> mean_turns(const Nodes<2>&, const std::vector<Index>&, const std::vector<double>&);
template std::vector<MeanTurn> mean_turns(const Nodes<3>&, const std::vector<Index>&, const std::vector<double>&);

}  // namespace signorini
