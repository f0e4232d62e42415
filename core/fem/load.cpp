#include <algorithm>

#include "core/fem/assemble.hpp"
#include "core/fem/element.hpp"
#include "core/fem/quadrature.hpp"
#include "core/fem/revolution.hpp"
#include "core/fem/select.hpp"

namespace signorini {
namespace {

template <int B>
bool is_constant(const Load<B>& load) {
  return std::all_of(load.value.begin(), load.value.end(), [](const Field& f) { return f.constant().has_value(); });
}

template <int B>
std::array<double, B> value(const Load<B>& load, const Site& where) {
  std::array<double, B> f;
  for (int i = 0; i < B; ++i) f[i] = load.value[i](where);
  return f;
}

/// What loads become: the integrals of their products with the basis functions, B per node, and of one load itself.
template <int B>
struct Loaded {
  std::vector<double> b;
  std::array<double, B> total{};
};

// Adds what a load does on a simplex with K + 1 corners and these nodes.
template <int D, int B, int K, class SimplexNodes>
void integrate(const Mesh<D>& mesh, const Model<B>& model, const Load<B>& load, const std::array<Index, K + 1>& corners,
               const SimplexNodes& nodes, double measure, const Point<D>& normal,
               std::span<const QuadraturePoint<K>> rule, Loaded<B>& out) {
  for (const auto& [barycentric, part] : rule) {
    const Point<D> x = combine<D>(mesh, corners, barycentric);
    const double weight = part * circumference<D>(model.plane, x);
    const auto f = value(load, site<D>(x, model.t, normal));
    const auto& values = basis(barycentric);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (int i = 0; i < B; ++i) out.b[Offset{nodes[a]} * B + i] += weight * measure * values[a] * f[i];
    for (int i = 0; i < B; ++i) out.total[i] += weight * measure * f[i];
  }
}

template <int K>
std::span<const QuadraturePoint<K>> midpoint_rule() {
  static const QuadraturePoint<K> rule = [] {
    QuadraturePoint<K> q{{}, 1};
    q.barycentric.fill(1.0 / (K + 1));
    return q;
  }();
  return {&rule, 1};
}

// Where a load is constant, and the circumference too, one point is enough; where one of them is linear, few are.
template <int K, int B>
std::span<const QuadraturePoint<K>> rule(const Model<B>& model, const Load<B>& load,
                                         std::span<const QuadraturePoint<K>> varying) {
  if (!is_constant(load)) return model.plane == Plane::axisymmetric ? quadrature5<K>() : varying;
  return model.plane == Plane::axisymmetric ? quadrature2<K>() : midpoint_rule<K>();
}

template <int D, int B>
void add_body_force(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load, Loaded<B>& out) {
  const Mesh<D>& mesh = nodes.mesh();
  const auto points = rule<D>(model, load, quadrature2<D>());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const Simplex<D>& vertices = mesh.elements[e];
    integrate<D, B, D>(mesh, model, load, vertices, nodes.of_element(e), linear_element(mesh, vertices).measure, {},
                       points, out);
  }
}

template <int D, int B>
void add_traction(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load, Loaded<B>& out) {
  const Mesh<D>& mesh = nodes.mesh();
  const auto points = rule<D - 1>(model, load, quadrature5<D - 1>());
  for (const Index f : select_faces(mesh, *load.on, model.t)) {
    const Face<D>& face = mesh.boundary[f];
    Point<D> normal = area_normal(mesh, face);
    const double measure = normalise(normal);
    integrate<D, B, D - 1>(mesh, model, load, face.vertices, nodes.of_face(f), measure, normal, points, out);
  }
}

template <int B>
bool is_zero(const Load<B>& load) {
  return std::all_of(load.value.begin(), load.value.end(), [](const Field& f) { return f.constant() == 0.0; });
}

}  // namespace

template <int D, int B>
std::vector<double> load_vector(const Nodes<D>& nodes, const Model<B>& model,
                                std::vector<std::array<double, B>>* totals) {
  Loaded<B> out{std::vector<double>(static_cast<std::size_t>(nodes.size()) * B)};
  if (totals) totals->clear();
  for (const Load<B>& load : model.loads) {
    out.total = {};
    if (load.on)
      add_traction(nodes, model, load, out);
    else if (!is_zero(load))
      add_body_force(nodes, model, load, out);
    if (totals) totals->push_back(out.total);
  }
  return std::move(out.b);
}

#define SIGNORINI_INSTANTIATE(D, B) \
  template std::vector<double> load_vector<D, B>(const Nodes<D>&, const Model<B>&, std::vector<std::array<double, B>>*);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
