#include <Eigen/Core>
#include <algorithm>

#include "core/base/dense.hpp"
#include "estimators/certificate/balance.hpp"

namespace signorini {
namespace {

/// Forces and moments about the middle of the body, these over its size.
template <int D>
struct Wrench {
  static constexpr int count = D * (D + 1) / 2;
  using Vector = Eigen::Matrix<double, count, 1>;

  explicit Wrench(const Mesh<D>& mesh) {
    Point<D> low = mesh.points.front(), high = low;
    for (const Point<D>& x : mesh.points)
      for (int i = 0; i < D; ++i) low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
    middle = midpoint<D>(low, high);
    size = length<D>(difference<D>(high, low));
  }

  /// Of a force at x.
  Vector of(const Point<D>& x, const Point<D>& force) const {
    Vector out;
    const auto moment = moment_of(difference<D>(x, middle), force);
    for (int i = 0; i < D; ++i) out[i] = force[i];
    for (std::size_t i = 0; i < moment.size(); ++i) out[D + static_cast<int>(i)] = moment[i] / size;
    return out;
  }

  Point<D> middle;
  double size;
};

template <int D>
Point<D> direction_of(const OuterFace<D, D>& outer, int k) {
  Point<D> d;
  std::copy_n(outer.fixed.direction[k], D, d.begin());
  return d;
}

}  // namespace

template <int D>
void balance_whole(const TrueProblem<D, D>& problem, const ContactForces<D, D>& contact, FaceNumbers& values) {
  using Vector = typename Wrench<D>::Vector;
  if (std::ranges::any_of(problem.outer, [](const auto& outer) { return outer.held(); })) return;
  const Wrench<D> wrench(problem.mesh);
  Vector missing = Vector::Zero();
  for (Index e = 0; e < problem.elements(); ++e) {
    const Imbalance<D, D> here = imbalance(problem, contact, values, e);
    missing += wrench.of(centroid<D>(problem.mesh, problem.mesh.elements[e]), here.force);
    for (std::size_t i = 0; i < here.moment.size(); ++i)
      missing[D + static_cast<int>(i)] += here.moment[i] / wrench.size;
  }
  // Tractions d (g(x) . q) along fixed directions d, g(x) the wrench of d at x: their own is the integral of g g' q.
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(missing.size(), missing.size());
  const auto each = [&](const auto& use) {
    for (const OuterFace<D, D>& outer : problem.outer)
      for (int k = 0; k < outer.fixed.count; ++k)
        use(outer, direction_of(outer, k), face_vertices<D>(problem.mesh, problem.incidence.sides[outer.face]));
  };
  each([&](const OuterFace<D, D>& outer, const Point<D>& d, const std::array<Index, D>& v) {
    Vector sum = Vector::Zero();
    const double mass = length<D>(outer.normal) / (D * (D + 1));
    for (const Index p : v) {
      const Vector g = wrench.of(problem.mesh.points[p], d);
      sum += g;
      M += mass * g * g.transpose();
    }
    M += mass * sum * sum.transpose();
  });
  const Eigen::VectorXd q = smallest_solution(M, -missing);
  each([&](const OuterFace<D, D>& outer, const Point<D>& d, const std::array<Index, D>& v) {
    for (int m = 0; m < D; ++m) {
      const double t = length<D>(outer.normal) * wrench.of(problem.mesh.points[v[m]], d).dot(q);
      for (int i = 0; i < D; ++i) at<D, D>(values, outer.face, m)[i] += t * d[i];
    }
  });
}

template void balance_whole(const TrueProblem<2, 2>&, const ContactForces<2, 2>&, FaceNumbers&);
template void balance_whole(const TrueProblem<3, 3>&, const ContactForces<3, 3>&, FaceNumbers&);

}  // namespace signorini
