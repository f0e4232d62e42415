#include "core/fem/recovery/contact_surface.hpp"

#include <algorithm>
#include <cmath>

#include "core/fem/elements/element.hpp"
#include "core/mortar/pairing.hpp"

namespace signorini {

template <int D, int B>
ContactSurface<D, B>::ContactSurface(const Nodes<D>& nodes, const Model<B>& model, Index obstacle)
    : nodes_(nodes), plane_(model.plane), extent_(extent(nodes.mesh())) {
  const ObstacleTerm<B>& term = model.obstacles[obstacle];
  if (!acts_on_faces(term))
    volumes_ = node_volumes(nodes, plane_);
  else
    surface_ = term.on ? surface(nodes, select_faces(nodes.mesh(), *term.on, model.t)) : surface(nodes);
  walls_ = signorini::walls<D, B>(nodes, model, surface_.nodes);
}

template <int D, int B>
bool ContactSurface<D, B>::counts(Index face, const ContactNode<B>& node) const {
  if constexpr (B == 1) return true;
  if constexpr (B > 1) {
    const Point<D> n = area_normal(nodes_.mesh(), nodes_.mesh().boundary[face]);
    return -dot(n, node.direction) >= facing * std::sqrt(dot(n, n));
  }
}

template <int D, int B>
std::vector<Index> ContactSurface<D, B>::faces(const ContactNode<B>& node) const {
  const auto found = std::lower_bound(surface_.nodes.begin(), surface_.nodes.end(), node.vertex);
  if (found == surface_.nodes.end() || *found != node.vertex) return {};
  const auto v = static_cast<std::size_t>(found - surface_.nodes.begin());
  const std::vector<Index> all(surface_.around.begin() + surface_.first[v],
                               surface_.around.begin() + surface_.first[v + 1]);
  std::vector<Index> out;
  std::ranges::copy_if(all, std::back_inserter(out), [&](Index face) { return counts(face, node); });
  return out.empty() ? all : out;
}

template <int D, int B>
double ContactSurface<D, B>::area(const ContactNode<B>& node) const {
  if (in_body()) return volumes_[node.vertex];
  double sum = 0;
  for (const Index face : faces(node)) sum += face_share(nodes_, face, node.vertex, plane_);
  return sum;
}

template <int D, int B>
Point<D> ContactSurface<D, B>::middle(const ContactNode<B>& node) const {
  Point<D> sum{};
  const double area = each_point(node, [&](const Point<D>& at, double weight) {
    for (int i = 0; i < D; ++i) sum[i] += weight * at[i];
  });
  if (!(area > 0)) return nodes_.at(node.vertex);
  for (double& x : sum) x /= area;
  return sum;
}

template class ContactSurface<2, 1>;
template class ContactSurface<3, 1>;
template class ContactSurface<2, 2>;
template class ContactSurface<3, 3>;

}  // namespace signorini
