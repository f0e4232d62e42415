#include "core/fem/assembly/springs.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

#include "core/fem/conditions/directions.hpp"
#include "core/fem/elements/across.hpp"
#include "core/fem/elements/integrate.hpp"
#include "core/fem/elements/select.hpp"

namespace signorini {
namespace {

/// Calls use(IntegrationPoint, whole) on the faces of a spring.
template <int D, int B, class Use>
void each_spring_point(const Nodes<D>& nodes, const Model<B>& model, const Spring<B>& spring, const Use& use) {
  const std::vector<Index> faces = select_faces(nodes.mesh(), spring.on, model.t);
  const double whole = spring_whole(nodes, model, spring);
  with_order(nodes, [&](auto order) {
    integrate_faces<D, order>(nodes, model.plane, faces, false, [&](const auto& point) { use(point, whole); });
  });
}

/// Calls use(IntegrationPoint, traction) where a spring pulls, with the traction -K u.
template <int D, int B, class Use>
void each_spring_traction(const Nodes<D>& nodes, const Model<B>& model, const Spring<B>& spring,
                          const std::vector<double>& u, const Use& use) {
  each_spring_point(nodes, model, spring, [&](const auto& point, double whole) {
    const auto K = spring_matrix<D, B>(spring, whole, point.x, point.normal, model.t);
    std::array<double, B> v{}, traction{};
    for (std::size_t a = 0; a < point.node.size(); ++a)
      for (int i = 0; i < B; ++i) v[i] += point.value[a] * u[Offset{point.node[a]} * B + i];
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) traction[i] -= K[i * B + j] * v[j];
    use(point, traction);
  });
}

template <int B>
void add(BlockMatrix<B>& A, Index p, Index q, double factor, const std::array<double, B * B>& K) {
  const auto begin = A.column.begin() + A.row[p], end = A.column.begin() + A.row[p + 1];
  const auto found = p == q ? begin : std::lower_bound(begin + 1, end, q);
  assert(found != end && *found == q && "the matrix couples the nodes of a face");
  double* entry = A.at(found - A.column.begin());
  for (int k = 0; k < B * B; ++k) entry[k] += factor * K[k];
}

}  // namespace

template <int D, int B>
double spring_whole(const Nodes<D>& nodes, const Model<B>& model, const Spring<B>& spring) {
  if (!spring.total) return 1;
  const std::vector<Index> faces = select_faces(nodes.mesh(), spring.on, model.t);
  double measure = 0;
  with_order(nodes, [&](auto order) {
    integrate_faces<D, order>(nodes, model.plane, faces, false, [&](const auto& point) { measure += point.weight; });
  });
  return measure * (1 << std::popcount(planes_across(nodes, {spring.on}, model.t)));
}

template <int D, int B>
std::array<double, B * B> spring_matrix(const Spring<B>& spring, double whole, const Point<D>& x,
                                        const Point<D>& normal, double t) {
  const auto direction = directions<D, B>(spring.frame, x, normal);
  std::array<double, B * B> K{};
  for (int c = 0; c < B; ++c) {
    const double k = spring.stiffness[c](site<D>(x, t, normal)) / whole;
    for (int i = 0; i < B; ++i)
      for (int j = 0; j <= i; ++j) K[i * B + j] += k * direction[c][i] * direction[c][j];
  }
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < i; ++j) K[j * B + i] = K[i * B + j];
  return K;
}

template <int D, int B>
void add_springs(const Nodes<D>& nodes, const Model<B>& model, BlockMatrix<B>& A) {
  for (const Spring<B>& spring : model.springs)
    each_spring_point(nodes, model, spring, [&](const auto& point, double whole) {
      const auto K = spring_matrix<D, B>(spring, whole, point.x, point.normal, model.t);
      for (std::size_t a = 0; a < point.node.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b) {
          const double factor = point.weight * point.value[a] * point.value[b];
          add(A, point.node[a], point.node[b], factor, K);
          if (a != b) add(A, point.node[b], point.node[a], factor, K);
        }
    });
}

template <int D, int B>
void add_spring_forces(const Nodes<D>& nodes, const Model<B>& model, const Spring<B>& spring,
                       const std::vector<double>& u, std::vector<double>& forces) {
  each_spring_traction<D, B>(nodes, model, spring, u, [&](const auto& point, const std::array<double, B>& traction) {
    for (std::size_t a = 0; a < point.node.size(); ++a)
      for (int i = 0; i < B; ++i) forces[Offset{point.node[a]} * B + i] += point.weight * point.value[a] * traction[i];
  });
}

template <int D, int B>
void add_spring_forces(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                       std::vector<double>& forces) {
  for (const Spring<B>& spring : model.springs) add_spring_forces(nodes, model, spring, u, forces);
}

template <int D, int B>
void each_spring_hold(const Nodes<D>& nodes, const Model<B>& model,
                      const std::function<void(const SpringHold<B>&)>& use) {
  SpringHold<B> hold;
  for (const Spring<B>& spring : model.springs)
    each_spring_point(nodes, model, spring, [&](const auto& point, double) {
      hold.nodes.clear();
      for (std::size_t a = 0; a < point.node.size(); ++a) hold.nodes.emplace_back(point.node[a], point.value[a]);
      const auto direction = directions<D, B>(spring.frame, point.x, point.normal);
      for (int c = 0; c < B; ++c) {
        if (!(spring.stiffness[c](site<D>(point.x, model.t, point.normal)) > 0)) continue;
        hold.direction = direction[c];
        use(hold);
      }
    });
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                                    \
  template void add_springs(const Nodes<D>&, const Model<B>&, BlockMatrix<B>&);                                        \
  template void add_spring_forces(const Nodes<D>&, const Model<B>&, const Spring<B>&, const std::vector<double>&,      \
                                  std::vector<double>&);                                                               \
  template void add_spring_forces(const Nodes<D>&, const Model<B>&, const std::vector<double>&, std::vector<double>&); \
  template void each_spring_hold(const Nodes<D>&, const Model<B>&, const std::function<void(const SpringHold<B>&)>&);  \
  template std::array<double, B * B> spring_matrix<D, B>(const Spring<B>&, double, const Point<D>&, const Point<D>&,   \
                                                         double);                                                      \
  template double spring_whole(const Nodes<D>&, const Model<B>&, const Spring<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
