#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/rounding.hpp"
#include "core/base/sorted_range.hpp"
#include "core/fem/conditions/bounds.hpp"
#include "core/fem/conditions/walls.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/recovery/contact_surface.hpp"

namespace signorini {

/// Whether unit vectors are one direction but for rounding.
template <int B>
bool push_the_same_way(const std::array<double, B>& a, const std::array<double, B>& b) {
  double apart = 0;
  for (int i = 0; i < B; ++i) apart = std::max(apart, std::abs(a[i] - b[i]));
  return apart < 1e-6;
}

/// Divides forces at nodes where faces meet that push the same way: those of several obstacles, or of an obstacle and
/// of a fix that prescribes the displacement along the obstacle's normal. The force of such a node is that of all, and
/// each has as much of it as its faces have of the node's area: where they press equally, that is exact. Of faces that
/// several obstacles act on those of the first one take all. Scalar obstacles without faces, and those between bodies,
/// stay as they are.
template <int D, int B>
class MeetingFaces {
 public:
  /// Keeps references.
  /// @param u in global coordinates
  /// @param contact by ascending vertex, with forces as pressures; where an obstacle touches beside the one whose bound
  /// is the node's, a node for it is added
  MeetingFaces(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization,
               const std::vector<double>& u, std::vector<ContactNode<B>>& contact)
      : nodes_(nodes),
        model_(model),
        discretization_(discretization),
        u_(u),
        contact_(contact),
        surfaces_(model.obstacles.size()) {}

  void divide() {
    if (add_hidden(); !meets_) return;
    for (auto first = contact_.begin(); first != contact_.end();) {
      auto last = first;
      while (last != contact_.end() && last->vertex == first->vertex) ++last;
      divide(first, last);
      first = last;
    }
    std::erase_if(contact_, [](const ContactNode<B>& node) { return node.obstacle < 0; });
  }

 private:
  static constexpr double across = 1e-6;  // of unit vectors: a direction has no part along another one
  using Iterator = typename std::vector<ContactNode<B>>::iterator;

  bool has_faces(Index obstacle) const {
    const ObstacleTerm<B>& term = model_.obstacles[obstacle];
    return !term.other && (B > 1 || term.on);
  }

  /// Whether obstacles with faces have nodes in common, per node.
  std::vector<char> shared_nodes() const {
    std::vector<char> count(static_cast<std::size_t>(nodes_.size()));
    for (const ObstacleTerm<B>& term : model_.obstacles) {
      if (!has_faces(static_cast<Index>(&term - model_.obstacles.data()))) continue;
      const Surface<D> on =
          term.on ? surface(nodes_, select_faces(nodes_.mesh(), *term.on, model_.t)) : surface(nodes_);
      for (const Index p : on.nodes) count[p] = static_cast<char>(std::min(count[p] + 1, 2));
    }
    return count;
  }

  /// Nodes of obstacles that touch beside others: bounds along one direction have become one.
  void add_hidden() {
    meets_ = B > 1 && !discretization_.held.empty();
    if (model_.obstacles.size() < 2) return;
    const std::vector<char> count = shared_nodes();
    const auto meets = [&](const ContactNode<B>& node) {
      return node.contact && has_faces(node.obstacle) && count[node.vertex] > 1;
    };
    if (std::ranges::none_of(contact_, meets)) return;
    meets_ = true;
    std::vector<FunctionalNumbers<B>> numbers;
    double size = extent(nodes_.mesh());
    for (const double v : u_) size = std::max(size, std::abs(v));
    std::vector<ContactNode<B>> hidden;
    for (const Bound<B>& bound : collect_bounds(nodes_, model_, numbers, discretization_.pairs.get())) {
      if (count[bound.vertex] < 2 || !has_faces(bound.obstacle)) continue;
      double value = 0;
      for (int i = 0; i < B; ++i) value += bound.direction[i] * u_[std::size_t(bound.vertex) * B + i];
      for (const double sign : {1.0, -1.0}) {
        const double limit = sign > 0 ? bound.lower : bound.upper, gap = sign * (value - limit);
        if (!(gap <= rounding_of_differences * std::max(size, std::abs(limit)))) continue;
        std::array<double, B> pushes = bound.direction;
        for (double& d : pushes) d *= sign;
        if (const ContactNode<B>* front = find(bound.vertex, bound.obstacle, pushes)) {
          ContactNode<B>& node = hidden.emplace_back(*front);
          node.obstacle = bound.obstacle;
          scale(0, node);  // until it is divided
        }
      }
    }
    contact_.insert(contact_.end(), hidden.begin(), hidden.end());
    std::ranges::stable_sort(contact_, {}, &ContactNode<B>::vertex);
  }

  /// The one in contact that pushes so, where none of the obstacle itself does.
  const ContactNode<B>* find(Index vertex, Index obstacle, const std::array<double, B>& pushes) const {
    const ContactNode<B>* out = nullptr;
    for (const ContactNode<B>& node : part_with(contact_, vertex, &ContactNode<B>::vertex)) {
      if (!node.contact || !push_the_same_way<B>(node.direction, pushes)) continue;
      if (node.obstacle == obstacle) return nullptr;
      if (!out && has_faces(node.obstacle)) out = &node;
    }
    return out;
  }

  void divide(Iterator first, Iterator last) {
    for (auto node = first; node != last; ++node) {
      if (!node->contact || node->area > 0 || !has_faces(node->obstacle)) continue;
      std::vector<Iterator> meet;
      for (auto other = node; other != last; ++other)
        if (other->contact && has_faces(other->obstacle) && push_the_same_way<B>(node->direction, other->direction))
          meet.push_back(other);
      if (meet.size() > 1 || node->held) divide(meet);
    }
  }

  void divide(const std::vector<Iterator>& meet) {
    std::vector<double> areas;
    std::vector<Index> taken;
    double sum = 0;
    for (const Iterator node : meet) {
      areas.push_back(take(surface_of(node->obstacle).faces(*node), node->vertex, taken));
      sum += areas.back();
    }
    if (meet.front()->held) sum += take(faces_of_fixes(*meet.front()), meet.front()->vertex, taken);
    if (!(sum > 0)) return;
    // Of nearly parallel ones each has a force of its own, and keeps it. Held ones have the whole force each.
    const bool held = meet.front()->held;
    const auto added = [](const Iterator node) { return node->pressure == 0; };
    const auto pressing = std::ranges::find_if_not(meet, added);
    if (pressing == meet.end() || (!held && std::ranges::none_of(meet, added))) return;
    const ContactNode<B> whole = **pressing;
    for (std::size_t k = 0; k < meet.size(); ++k) {
      ContactNode<B>& node = *meet[k];
      if (!held && meet[k] != *pressing && !added(meet[k])) continue;
      if (k > 0 && areas[k] == 0) node.obstacle = -1, node.contact = false;
      node.area = sum;  // done
      node.pressure = whole.pressure, node.force = whole.force;
      if constexpr (B > 1) node.dissipated = whole.dissipated, node.tangential = whole.tangential;
      scale(areas[k] / sum, node);
    }
  }

  static void scale(double part, ContactNode<B>& node) {
    node.pressure *= part;
    for (double& f : node.force) f *= part;
    if constexpr (B > 1) {
      node.dissipated *= part;
      for (double& f : node.tangential) f *= part;
    }
  }

  /// The area at a vertex of those that are not taken yet.
  double take(const std::vector<Index>& faces, Index vertex, std::vector<Index>& taken) const {
    double sum = 0;
    for (const Index face : faces) {
      if (std::ranges::find(taken, face) != taken.end()) continue;
      taken.push_back(face);
      sum += face_share(nodes_, face, vertex, model_.plane);
    }
    return sum;
  }

  /// Of those that prescribe what the node would do along its direction: their faces at the node, as far as they lie
  /// across it.
  std::vector<Index> faces_of_fixes(const ContactNode<B>& node) {
    const auto& fixes = discretization_.fixes;
    const auto fixed = std::ranges::lower_bound(fixes, node.vertex, {}, &FixedDirections<B>::vertex);
    std::vector<Index> out;
    if (fixed == fixes.end() || fixed->vertex != node.vertex) return out;
    for (int k = 0; k < fixed->count; ++k) {
      double along = 0;
      for (int i = 0; i < B; ++i) along += fixed->direction[k][i] * node.direction[i];
      if (fixed->fix[k] < 0 || std::abs(along) < across) continue;
      for (const Index face : around(fixed->fix[k], node.vertex))
        if (lies_across(face, node.direction)) out.push_back(face);
    }
    return out;
  }

  bool lies_across(Index face, const std::array<double, B>& direction) const {
    if constexpr (B == D) {
      const Point<D> n = area_normal(nodes_.mesh(), nodes_.mesh().boundary[face]);
      return -dot(n, direction) >= 0.5 * std::sqrt(dot(n, n));  // within 60 degrees, as faces of obstacles
    }
    return true;
  }

  std::vector<Index> around(Index fix, Index vertex) {
    if (!model_.fixes[fix].on.picks_faces()) return {};
    if (fixes_.empty()) fixes_.resize(model_.fixes.size());
    std::optional<Surface<D>>& on = fixes_[fix];
    if (!on) on = surface(nodes_, select_faces(nodes_.mesh(), model_.fixes[fix].on, model_.t));
    const auto found = std::ranges::lower_bound(on->nodes, vertex);
    if (found == on->nodes.end() || *found != vertex) return {};
    const auto v = found - on->nodes.begin();
    return {on->around.begin() + on->first[v], on->around.begin() + on->first[v + 1]};
  }

  const ContactSurface<D, B>& surface_of(Index obstacle) {
    if (!surfaces_[obstacle]) surfaces_[obstacle].emplace(nodes_, model_, obstacle);
    return *surfaces_[obstacle];
  }

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  const Discretization<B>& discretization_;
  const std::vector<double>& u_;
  std::vector<ContactNode<B>>& contact_;
  std::vector<std::optional<ContactSurface<D, B>>> surfaces_;
  std::vector<std::optional<Surface<D>>> fixes_;
  bool meets_ = false;
};

/// Of the area at a vertex of all that is in contact and pushes the same way as a node, that of the node.
/// @param all by ascending vertex
template <int B>
double part_of_meeting(const std::vector<ContactNode<B>>& all, const ContactNode<B>& node) {
  double sum = 0;
  for (const ContactNode<B>& other : part_with(all, node.vertex, &ContactNode<B>::vertex))
    if (other.contact && push_the_same_way<B>(other.direction, node.direction)) sum += other.area;
  return node.contact && sum > 0 ? node.area / sum : 1;
}

}  // namespace signorini
