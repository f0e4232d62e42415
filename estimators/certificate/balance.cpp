#include "estimators/certificate/balance.hpp"

#include <algorithm>
#include <cmath>

#include "estimators/certificate/small_solve.hpp"

namespace signorini {
namespace {

Point<2> turned(const std::array<double, 1>& w, const Point<2>& x) { return {-w[0] * x[1], w[0] * x[0]}; }

/// Adds the force and the moment about `center` of a linear traction on a face, times `sign`.
template <int D, int B>
void add_traction(const TrueProblem<D, B>& problem, const FaceNumbers& values, Index face,
                  const std::array<Index, D>& vertices, const Point<D>& center, double sign, Imbalance<D, B>& out) {
  std::array<double, B> sum{};
  for (int k = 0; k < D; ++k)
    for (int i = 0; i < B; ++i) sum[i] += at<D, B>(values, face, k)[i];
  for (int i = 0; i < B; ++i) out.force[i] += sign * sum[i] / D;
  if constexpr (B == D)
    for (int k = 0; k < D; ++k) {  // int_F x x t, both linear
      std::array<double, B> t = sum;
      for (int i = 0; i < B; ++i) t[i] += at<D, B>(values, face, k)[i];
      const auto m = moment_of(difference<D>(problem.mesh.points[vertices[k]], center), t);
      for (std::size_t i = 0; i < m.size(); ++i) out.moment[i] += sign * m[i] / (D * (D + 1));
    }
}

template <int D, int B>
void add_source(const TrueProblem<D, B>& problem, const ContactForces<D, B>& contact, Index e, Imbalance<D, B>& out) {
  for (int a = 0; a <= D; ++a) {
    const auto f = problem.moment(e, a);
    for (int i = 0; i < B; ++i) out.force[i] += f[i];
    if (!contact.in_element.empty()) out.force[0] += contact.in_element[Offset{e} * (D + 1) + a];
  }
}

/// A linear traction on a face, as values at its vertices times its measure, with this force and moment about the
/// face's centroid: f + w x (x - c), w = I^-1 moment with the mean I of |x - c|^2 1 - (x - c)(x - c)'.
template <int D, int B>
std::array<std::array<double, B>, D> carrying(const std::array<Point<D>, D>& corner, const Imbalance<D, B>& load) {
  std::array<std::array<double, B>, D> out;
  out.fill(load.force);
  if constexpr (B == D) {
    Point<D> c{};
    for (const Point<D>& x : corner)
      for (int i = 0; i < D; ++i) c[i] += x[i] / D;
    std::array<double, D * D> second{};
    for (const Point<D>& x : corner)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) second[i * D + j] += (x[i] - c[i]) * (x[j] - c[j]) / (D * (D + 1));
    double trace = 0;
    for (int i = 0; i < D; ++i) trace += second[i * (D + 1)];
    std::array<double, Imbalance<D, B>::moments> w;
    if constexpr (D == 2) {
      w = {load.moment[0] / trace};
    } else {
      for (int i = 0; i < D * D; ++i) second[i] = (i % (D + 1) == 0 ? trace : 0) - second[i];
      w = solved(second, load.moment);
    }
    for (int k = 0; k < D; ++k) {
      const Point<D> x = difference<D>(corner[k], c);
      Point<D> by;
      if constexpr (D == 2)
        by = turned(w, x);
      else
        by = cross(w, x);
      for (int i = 0; i < B; ++i) out[k][i] += by[i];
    }
  }
  return out;
}

/// Elements in an order in which each one but the roots comes after the one it hands on to.
template <int D, int B>
class Tree {
 public:
  explicit Tree(const TrueProblem<D, B>& problem)
      : problem_(problem), way_(static_cast<std::size_t>(problem.elements()), unknown) {
    order_.reserve(way_.size());
    for (const OuterFace<D, B>& outer : problem.outer)
      if (outer.held()) reach(problem.incidence.sides[outer.face].element[0], outer.face);
    grow();
    for (Index e = 0; e < problem.elements(); ++e) {
      reach(e, none);
      grow();
    }
  }

  /// From the leaves on: use(element, face that it hands on through; -1: nowhere).
  template <class Use>
  void each(const Use& use) const {
    for (auto e = order_.rbegin(); e != order_.rend(); ++e) use(*e, way_[*e]);
  }

 private:
  static constexpr Index unknown = -2, none = -1;

  void reach(Index e, Index through) {
    if (way_[e] != unknown) return;
    way_[e] = through;
    order_.push_back(e);
  }
  void grow() {
    for (; next_ < order_.size(); ++next_)
      for (int k = 0; k <= D; ++k) {
        const Index face = problem_.incidence.face[Offset{order_[next_]} * (D + 1) + k];
        const auto& element = problem_.incidence.sides[face].element;
        const Index other = element[0] == order_[next_] ? element[1] : element[0];
        if (other >= 0) reach(other, face);
      }
  }

  const TrueProblem<D, B>& problem_;
  std::vector<Index> way_, order_;
  std::size_t next_ = 0;
};

}  // namespace

template <int D, int B>
Imbalance<D, B> imbalance(const TrueProblem<D, B>& problem, const ContactForces<D, B>& contact,
                          const FaceNumbers& values, Index e) {
  Imbalance<D, B> out;
  add_source(problem, contact, e, out);
  const Point<D> center = centroid<D>(problem.mesh, problem.mesh.elements[e]);
  for (int k = 0; k <= D; ++k) {
    const Index face = problem.incidence.face[Offset{e} * (D + 1) + k];
    const auto& sides = problem.incidence.sides[face];
    add_traction<D, B>(problem, values, face, face_vertices<D>(problem.mesh, sides), center,
                       sides.element[0] == e ? 1 : -1, out);
  }
  return out;
}

template <int D, int B>
double largest_imbalance(const TrueProblem<D, B>& problem, const ContactForces<D, B>& contact,
                         const FaceNumbers& values) {
  double missing = 0, acting = 0;
  for (const double t : values) acting = std::max(acting, std::fabs(t));
  for (Index e = 0; e < problem.elements(); ++e) {
    const Imbalance<D, B> here = imbalance(problem, contact, values, e);
    for (const double f : here.force) missing = std::max(missing, std::fabs(f));
    const double h = longest_edge<D>(corners<D>(problem.mesh.points, problem.mesh.elements[e]));
    for (const double m : here.moment) missing = std::max(missing, std::fabs(m) / h);
  }
  return acting > 0 ? missing / acting : missing;
}

template <int D, int B>
void balance_along_tree(const TrueProblem<D, B>& problem, const ContactForces<D, B>& contact, FaceNumbers& values) {
  Tree<D, B>(problem).each([&](Index e, Index face) {
    if (face < 0) return;
    const auto& sides = problem.incidence.sides[face];
    const double sign = sides.element[0] == e ? -1 : 1;
    Imbalance<D, B> load = imbalance(problem, contact, values, e);
    const auto corner = points_of(problem.mesh, face_vertices<D>(problem.mesh, sides));
    if constexpr (B == D) {  // from the element's centroid to that of the face
      Point<D> arm = centroid<D>(problem.mesh, problem.mesh.elements[e]);
      for (const Point<D>& x : corner)
        for (int i = 0; i < D; ++i) arm[i] -= x[i] / D;
      const auto more = moment_of(arm, load.force);
      for (std::size_t i = 0; i < more.size(); ++i) load.moment[i] += more[i];
    }
    const auto by = carrying<D, B>(corner, load);
    for (int k = 0; k < D; ++k)
      for (int i = 0; i < B; ++i) at<D, B>(values, face, k)[i] += sign * by[k][i];
  });
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                                    \
  template Imbalance<D, B> imbalance(const TrueProblem<D, B>&, const ContactForces<D, B>&, const FaceNumbers&, Index); \
  template double largest_imbalance(const TrueProblem<D, B>&, const ContactForces<D, B>&, const FaceNumbers&);         \
  template void balance_along_tree(const TrueProblem<D, B>&, const ContactForces<D, B>&, FaceNumbers&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
