#include "core/fem/pressure_recovery.hpp"

#include <algorithm>
#include <cmath>

#include "core/fem/element.hpp"
#include "core/fem/fixes.hpp"
#include "core/fem/polynomial_fit.hpp"
#include "core/fem/revolution.hpp"

namespace signorini {
namespace {

constexpr int rings = 3;         // of neighbours that a fit looks at
constexpr int rings_beyond = 5;  // the same at the edge, where it goes on from further inside
constexpr int most_rings = 6;    // where there are few samples
constexpr double excess = 1.25;  // over the means around a node: a linear pressure at a corner has less
constexpr double falls = 0.5;    // from a node in contact to the next one: more is left under a punch
// Samples that a fit looks for, and without which it does not go on to the edge.
template <int D>
constexpr std::size_t enough = D == 2 ? 4 : 12;
constexpr Index unreachable = -1;  // number of a node that the obstacle says nothing of

/// The nodes of one obstacle, numbered in the order of ContactState::nodes, and the faces around those it presses.
template <int D, int B>
class PressedFaces {
 public:
  PressedFaces(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, Index obstacle, double least_force,
               std::vector<ContactNode<B>>& contact) {
    for (ContactNode<B>& node : contact)
      if (node.obstacle == obstacle) node_.push_back(&node);
    for (const ContactNode<B>* node : node_) {
      pressed_.push_back(node->contact && node->pressure * node->area > least_force);
      if (!pressed_.back()) continue;
      const std::vector<Index> faces = surface.faces(*node);
      faces_.insert(faces_.end(), faces.begin(), faces.end());
    }
    std::ranges::sort(faces_);
    faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
    connect(nodes);
  }

  Index size() const { return static_cast<Index>(node_.size()); }
  ContactNode<B>& node(Index k) const { return *node_[k]; }
  bool pressed(Index k) const { return k != unreachable && pressed_[k]; }
  /// In Mesh::boundary.
  const std::vector<Index>& faces() const { return faces_; }
  const std::array<Index, D>& corners(std::size_t face) const { return corners_[face]; }
  /// Nodes that share faces with one, in ascending order.
  const std::vector<Index>& around(Index k) const { return around_[k]; }
  /// One of the faces at a node that has neighbours.
  Index face_at(Index k) const { return face_at_[k]; }
  /// Whether all neighbours are pressed, too.
  bool inside(Index k) const {
    return pressed(k) && std::ranges::all_of(around_[k], [&](Index other) { return pressed(other); });
  }

 private:
  /// Of several numbers at a node that of a pressed one.
  Index number_of(Index vertex) const {
    auto found = std::ranges::lower_bound(node_, vertex, {}, [](const auto* node) { return node->vertex; });
    Index out = unreachable;
    for (; found != node_.end() && (*found)->vertex == vertex; ++found)
      if (const auto k = static_cast<Index>(found - node_.begin()); out == unreachable || pressed_[k]) out = k;
    return out;
  }

  void connect(const Nodes<D>& nodes) {
    around_.resize(node_.size());
    face_at_.resize(node_.size());
    for (const Index face : faces_) {
      const auto vertices = nodes.of_face(face);
      std::array<Index, D>& corners = corners_.emplace_back();
      std::ranges::transform(vertices, corners.begin(), [&](Index v) { return number_of(v); });
      for (const Index k : corners) {
        if (k == unreachable) continue;
        face_at_[k] = face;
        for (const Index other : corners)
          if (other != k) around_[k].push_back(other);
      }
    }
    for (std::vector<Index>& list : around_) {
      std::ranges::sort(list);
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  std::vector<ContactNode<B>*> node_;
  std::vector<bool> pressed_;
  std::vector<Index> faces_, face_at_;
  std::vector<std::array<Index, D>> corners_;
  std::vector<std::vector<Index>> around_;
};

template <int D, int B>
class Recovery {
 public:
  Recovery(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, const PressedFaces<D, B>& faces)
      : nodes_(nodes), plane_(surface.plane()), faces_(faces), square_(static_cast<std::size_t>(faces.size())) {
    for (Index k = 0; k < faces.size(); ++k) {
      inside_.push_back(faces.inside(k));
      middle_.push_back(inside_[k] ? surface.middle(faces.node(k)) : Point<D>{});
    }
  }

  void fit() {
    for (Index k = 0; k < faces_.size(); ++k) {
      if (!faces_.pressed(k)) continue;
      ContactNode<B>& node = faces_.node(k);
      square_[k] = fitted(k).value_or(node.pressure * node.pressure);
      node.recovered = limited(k, std::sqrt(std::max(square_[k], 0.0)));
    }
    for (Index k = 0; k < faces_.size(); ++k)
      if (!faces_.pressed(k) && !faces_.around(k).empty()) square_[k] = beyond(k);
  }

  double area() const {
    double sum = 0;
    for (std::size_t f = 0; f < faces_.faces().size(); ++f) sum += positive(f);
    return sum;
  }

 private:
  /// Nodes inside the contact within some rings of neighbours.
  std::vector<Index> neighbourhood(Index from) const {
    std::vector<Index> seen{from}, found;
    if (inside_[from]) found.push_back(from);
    std::size_t first = 0;
    const int wanted = inside_[from] ? rings : rings_beyond;
    for (int ring = 1; ring <= wanted || (found.size() < enough<D> && ring <= most_rings); ++ring) {
      const std::size_t last = seen.size();
      for (; first < last; ++first)
        for (const Index other : faces_.around(seen[first])) {
          if (!faces_.pressed(other) || std::ranges::find(seen, other) != seen.end()) continue;
          seen.push_back(other);
          if (inside_[other]) found.push_back(other);
        }
    }
    return found;
  }

  std::vector<Sample<D - 1>> samples(Index k) const {
    const Point<D>& origin = nodes_.at(faces_.node(k).vertex);
    Point<D> normal = area_normal(nodes_.mesh(), nodes_.mesh().boundary[faces_.face_at(k)]);
    normalise(normal);
    const auto axes = tangents(normal);
    const std::vector<Index> some = neighbourhood(k);
    const bool both_sides = plane_ == Plane::axisymmetric && std::ranges::any_of(some, [&](Index s) {
                              return nodes_.at(faces_.node(s).vertex)[0] == 0;
                            });
    std::vector<Sample<D - 1>> out;
    const auto add = [&](const Point<D>& at, double pressure) {
      const Point<D> from = difference<D>(at, origin);
      Sample<D - 1>& sample = out.emplace_back();
      for (int i = 0; i < D - 1; ++i) sample.x[i] = dot(from, axes[i]);
      sample.value = {pressure * pressure};
    };
    for (const Index s : some) {
      Point<D> at = middle_[s];
      add(at, faces_.node(s).pressure);
      at[0] = -at[0];
      if (both_sides) add(at, faces_.node(s).pressure);
    }
    return out;
  }

  /// At the edge of a punch: the pressure is larger than at all neighbours.
  bool rises(Index k) const {
    return !inside_[k] && std::ranges::all_of(faces_.around(k), [&](Index other) {
      return !faces_.pressed(other) || faces_.node(other).pressure < faces_.node(k).pressure;
    });
  }

  std::optional<double> fitted(Index k) const {
    const auto some = samples(k);
    if (!inside_[k] && (some.size() < enough<D> || (faces_.pressed(k) && rises(k)))) return {};
    return fitted_value(some);
  }

  double limited(Index k, double pressure) const {
    double least = faces_.node(k).pressure, largest = least;
    for (const Index other : faces_.around(k)) {
      const double mean = faces_.pressed(other) ? faces_.node(other).pressure : 0;
      least = std::min(least, mean);
      largest = std::max(largest, mean);
    }
    return std::clamp(pressure, least, excess * largest);
  }

  /// At a node without contact.
  double beyond(Index k) const {
    double sum = 0;
    int count = 0;
    bool punched = false;
    for (const Index other : faces_.around(k))
      if (faces_.pressed(other)) sum += square_[other], ++count, punched = punched || rises(other);
    const auto value = fitted(k);
    return value && !punched && *value <= falls * sum / count ? *value : -sum / count;
  }

  /// Measure of the part of a face where the linear function with the squares at its corners is positive.
  double positive(std::size_t f) const {
    const Face<D>& face = nodes_.mesh().boundary[faces_.faces()[f]];
    std::array<double, D> value;
    double sum = 0;
    int pressed = 0;
    for (int c = 0; c < D; ++c) {
      const Index k = faces_.corners(f)[c];
      value[c] = k == unreachable ? 0 : square_[k];
      if (faces_.pressed(k)) sum += value[c], ++pressed;
    }
    for (int c = 0; c < D; ++c)
      if (faces_.corners(f)[c] == unreachable) value[c] = -std::abs(sum) / pressed;
    const Point<D> normal = area_normal(nodes_.mesh(), face);
    return std::sqrt(dot(normal, normal)) * part(face, value);
  }

  double part(const Face<D>& face, const std::array<double, D>& value) const {
    const auto plus = std::ranges::count_if(value, [](double v) { return v > 0; });
    if (plus == 0) return 0;
    if (plus == D) return mean_circumference<D>(plane_, nodes_.mesh(), face.vertices);
    const auto alone = std::ranges::find_if(value, [&](double v) { return (v > 0) == (plus == 1); });
    double corner = 1;
    for (auto other = value.begin(); other != value.end(); ++other)
      if (other != alone) corner *= *alone / (*alone - *other);
    if (plane_ == Plane::axisymmetric) {
      std::array<double, D> middle;  // of what is cut off at the corner
      middle.fill(corner / D);
      middle[alone - value.begin()] = 1 - corner / D * (D - 1);
      const double whole = mean_circumference<D>(plane_, nodes_.mesh(), face.vertices);
      corner *= circumference<D>(plane_, combine<D>(nodes_.mesh(), face.vertices, middle));
      return plus == 1 ? corner : whole - corner;
    }
    return plus == 1 ? corner : 1 - corner;
  }

  const Nodes<D>& nodes_;
  const Plane plane_;
  const PressedFaces<D, B>& faces_;
  std::vector<bool> inside_;
  std::vector<Point<D>> middle_;  // of what lies inside
  std::vector<double> square_;    // of the pressure, per node; it goes on beyond the edge
};

}  // namespace

template <int D, int B>
double recover_pressure(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, Index obstacle, double least_force,
                        std::vector<ContactNode<B>>& contact) {
  const PressedFaces<D, B> faces(nodes, surface, obstacle, least_force, contact);
  Recovery<D, B> recovery(nodes, surface, faces);
  recovery.fit();
  return recovery.area();
}

#define SIGNORINI_INSTANTIATE(D, B)                                                             \
  template double recover_pressure(const Nodes<D>&, const ContactSurface<D, B>&, Index, double, \
                                   std::vector<ContactNode<B>>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
