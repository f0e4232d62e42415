#include "apps/signorini/evenness.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select_nodes.hpp"
#include "core/mesh/quadrature.hpp"

namespace signorini {
namespace {

constexpr double of_rounding = 1e-6, of_curved_meshes = 0.02;  // of the moments of absolute values

/// Of weighted points: sums of w s, w s^3 and w s x_i, with s the distance from the plane.
template <int D>
class Moments {
 public:
  explicit Moments(const Mirror& plane) : plane_(plane) {}

  void add(const Point<D>& x, double weight) {
    const double s = x[plane_.axis] - plane_.at;
    add(0, weight * s);
    for (int i = 0; i < D; ++i) add(i + 1, weight * s * (i == plane_.axis ? s * s : x[i]));
  }
  bool vanish(double tolerance) const {
    for (std::size_t k = 0; k <= D; ++k)
      if (std::fabs(odd_[k]) > tolerance * size_[k]) return false;
    return true;
  }

 private:
  void add(int k, double value) {
    odd_[k] += value;
    size_[k] += std::fabs(value);
  }

  const Mirror& plane_;
  std::array<double, D + 1> odd_{}, size_{};
};

template <int D>
Moments<D> of_faces(const Mesh<D>& mesh, const std::vector<Index>& faces, const Mirror& plane) {
  Moments<D> out(plane);
  for (const Index f : faces) {
    const double measure = length<D>(area_normal(mesh, mesh.boundary[f]));
    for (const auto& [barycentric, weight] : quadrature5<D - 1>()) {
      Point<D> x{};
      for (int a = 0; a < D; ++a)
        for (int i = 0; i < D; ++i) x[i] += barycentric[a] * mesh.points[mesh.boundary[f].vertices[a]][i];
      out.add(x, weight * measure);
    }
  }
  return out;
}

}  // namespace

template <int D, int B>
bool is_even(const Mesh<D>& whole, const Model<B>& model, const Mirror& plane, bool any_shape) {
  const double tolerance = whole.curves.empty() ? of_rounding : of_curved_meshes;
  const Nodes<D> nodes(whole);
  const auto picked = [&](const std::optional<Selection>& on) {
    if (!on) return true;
    if (on->picks_faces()) return of_faces(whole, select_faces(whole, *on, model.t), plane).vanish(tolerance);
    Moments<D> points(plane);
    for (const Index p : select_nodes(nodes, *on, model.t)) points.add(nodes.at(p), 1);
    return points.vanish(tolerance);
  };
  const auto all = [&](const auto& conditions) {
    return std::ranges::all_of(conditions, [&](const auto& condition) { return picked(condition.on); });
  };
  return (!any_shape || of_faces(whole, surface(nodes).faces, plane).vanish(of_rounding)) && all(model.fixes) &&
         all(model.loads) && all(model.springs) && all(model.rigid) && all(model.obstacles) &&
         std::ranges::all_of(model.obstacles, [&](const auto& obstacle) { return picked(obstacle.other); });
}

template bool is_even(const Mesh<2>&, const Model<1>&, const Mirror&, bool);
template bool is_even(const Mesh<3>&, const Model<1>&, const Mirror&, bool);
template bool is_even(const Mesh<2>&, const Model<2>&, const Mirror&, bool);
template bool is_even(const Mesh<3>&, const Model<3>&, const Mirror&, bool);

}  // namespace signorini
