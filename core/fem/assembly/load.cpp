#include <algorithm>

#include "core/fem/assembly/assemble.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/fem/elements/select.hpp"
#include "core/mesh/quadrature.hpp"

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

/// On a simplex of dimension K; `simple`: a constant load on straight edges. The circumference of an axisymmetric body
/// is one degree more.
template <int D, int K, int P>
std::span<const QuadraturePoint<K>> rule_for(bool simple, bool axisymmetric) {
  if (axisymmetric) return simple && P == 1 ? quadrature2<K>() : quadrature5<K>();
  if (simple) return P == 1 ? midpoint_rule<K>() : quadrature2<K>();
  return P == 1 && K == D ? quadrature2<K>() : quadrature5<K>();
}

// Adds what a load does on a simplex of dimension K whose nodes of order P are these vertices.
template <int D, int K, int P, int B, class Measure>
void integrate(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load,
               const std::array<Index, element_nodes<K, P>>& vertices, const Measure& measure, Loaded<B>& out) {
  const ElementMap<D, K, P> map(nodes.mesh(), vertices);
  const auto node = nodes.of(vertices);
  const bool simple = is_constant(load) && !map.curved(), axisymmetric = model.plane == Plane::axisymmetric;
  for (const auto& [barycentric, weight] : rule_for<D, K, P>(simple, axisymmetric)) {
    Point<D> normal{};
    const Point<D> x = map(barycentric);
    const double part = weight * measure(map.flat(barycentric), normal) * circumference<D>(model.plane, x);
    const auto f = value(load, site<D>(x, model.t, normal));
    const auto values = basis<P>(barycentric);
    for (std::size_t a = 0; a < node.size(); ++a)
      for (int i = 0; i < B; ++i) out.b[Offset{node[a]} * B + i] += part * values[a] * f[i];
    for (int i = 0; i < B; ++i) out.total[i] += part * f[i];
  }
}

template <int D, int P, int B>
void add_body_force(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load, Loaded<B>& out) {
  const auto measure = [](const auto& corner, const Point<D>&) { return linear_element(corner).measure; };
  const auto& elements = nodes.template elements<P>();
  const auto [first, last] = load.regions;
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (first < 0 || (nodes.region(e) >= first && nodes.region(e) <= last))
      integrate<D, D, P>(nodes, model, load, elements[e], measure, out);
}

template <int D, int P, int B>
void add_traction(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load, Loaded<B>& out) {
  const auto measure = [](const auto& corner, Point<D>& normal) {
    normal = area_normal(corner);
    return normalise(normal);
  };
  const std::vector<Index> faces = select_faces(nodes.mesh(), *load.on, model.t);
  for (std::size_t k = 0; k < faces.size(); k += static_cast<std::size_t>(nodes.faces_per_element()))
    integrate<D, D - 1, P>(nodes, model, load, nodes.template element_face<P>(faces[k]), measure, out);
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
    with_order(nodes, [&](auto order) {
      if (load.on)
        add_traction<D, order>(nodes, model, load, out);
      else if (!is_zero(load))
        add_body_force<D, order>(nodes, model, load, out);
    });
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
