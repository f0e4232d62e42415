#include <algorithm>

#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/element_points.hpp"
#include "core/fem/assembly/resultant.hpp"

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

template <int D, int B>
void add(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load, Loaded<B>& out) {
  integrate_load(nodes, model, load, is_constant(load), [&](const auto& point) {
    const auto f = value(load, site<D>(point.x, model.t, point.normal));
    for (std::size_t a = 0; a < point.node.size(); ++a)
      for (int i = 0; i < B; ++i) out.b[Offset{point.node[a]} * B + i] += point.weight * point.value[a] * f[i];
    for (int i = 0; i < B; ++i) out.total[i] += point.weight * f[i];
  });
}

/// What thermal strains do, which need no force in total.
template <int D>
void add_thermal_load(const Nodes<D>& nodes, const Model<D>& model, std::vector<double>& b) {
  if (ThermalStrain<D>(model).none()) return;
  with_order(nodes, [&](auto order) {
    const auto& elements = nodes.template elements<order>();
    ElementPoints<D, order> element(nodes, model);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      element.move_to(e, true);
      const auto node = nodes.of(elements[e]);
      for (std::size_t a = 0; a < node.size(); ++a) element.add_thermal_load(a, b.data() + Offset{node[a]} * D);
    }
  });
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
  for (const Load<B>& given : model.loads) {
    const Load<B> load = distributed(nodes, model, given);
    out.total = {};
    if (load.where_open) {
      if (totals) totals->push_back(out.total);
      continue;
    }
    if (load.on || !is_zero(load)) add(nodes, model, load, out);
    if (totals) totals->push_back(out.total);
  }
  if constexpr (D == B) add_thermal_load(nodes, model, out.b);
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
