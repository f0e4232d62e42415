#pragma once
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "core/fem/conditions/directions.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/polynomial_fit.hpp"
#include "core/fem/recovery/contact_surface.hpp"
#include "core/mesh/mirror.hpp"

/// What recoveries of pressures and tractions have in common.
namespace signorini {

inline constexpr Index unreachable = -1;  ///< number of a node that the obstacle says nothing of

/// The nodes of one obstacle by ascending vertex, and the faces around those it presses. Where these have other nodes,
/// too, of which nothing is known as they are far from contact, these count as nodes without contact.
template <int D, int B>
class PressedFaces {
 public:
  PressedFaces(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, Index obstacle, double least_force,
               std::vector<ContactNode<B>>& contact) {
    for (std::size_t k = 0; k < contact.size(); ++k) {
      if (contact[k].obstacle != obstacle) continue;
      node_.push_back(&contact[k]);
    }
    for (const ContactNode<B>* node : node_) {
      pressed_.push_back(node->contact && node->pressure * node->area > least_force);
      if (!pressed_.back()) continue;
      const std::vector<Index> faces = surface.faces(*node);
      faces_.insert(faces_.end(), faces.begin(), faces.end());
    }
    std::ranges::sort(faces_);
    faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
    add_strangers(nodes, obstacle);
    connect(nodes);
    find_mirrors(nodes, surface);
    find_bends(nodes);
  }

  Index size() const { return static_cast<Index>(node_.size()); }
  ContactNode<B>& node(Index k) const { return *node_[k]; }
  bool pressed(Index k) const { return k != unreachable && pressed_[k]; }
  /// In Mesh::boundary.
  const std::vector<Index>& faces() const { return faces_; }
  const std::array<Index, D>& corners(std::size_t face) const { return corners_[face]; }
  /// Nodes that share faces with one, in ascending order; without those that another body is hardly in front of, where
  /// a contact ends as at an edge of the body.
  const std::vector<Index>& around(Index k) const { return around_[k]; }
  /// Whether another body ends beside a node.
  bool at_end(Index k) const { return at_end_[k]; }
  /// Whether the body's own surface ends at a node, and does not go on beyond a plane of symmetry, or the axis, as
  /// smoothly as it came: that of a cone ends in its tip.
  bool at_rim(Index k) const {
    bool goes_on = false;
    each_mirror(on_[k], [&](const Flat<D>& mirror) { goes_on = goes_on || B != D || is_smooth_across(k, mirror); });
    return at_rim_[k] && !goes_on;
  }
  /// Whether an edge or a tip of either side lies at a node or beside it: what was between the two at the start bends
  /// there as nowhere else in the contact, over the way between faces.
  bool at_kink(Index k) const {
    std::vector<double> all;
    for (Index other = 0; other < size(); ++other)
      if (pressed(other) && other != k && !std::ranges::binary_search(around_[k], other))
        all.push_back(bend_around(other));
    if (all.empty()) return false;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::ranges::nth_element(all, middle);
    return bend_around(k) > kinked * *middle;
  }
  /// How far contact reaches from pressed nodes towards one that is not, as part of the way: up to an edge, as what is
  /// left between the two and how steeply they part beyond that edge tell; half way where they do not.
  double reach(Index k) const { return reach_[k]; }
  /// One of the faces at a node that has neighbours.
  Index face_at(Index k) const { return face_at_[k]; }
  /// How far to go from a node in search of samples: so many rings of neighbours, more where they are few.
  struct Reach {
    int rings, most;
    std::size_t enough;
  };
  /// A node, or its image beyond planes of symmetry or the axis of a body of revolution: a bit for each of them that it
  /// is mirrored at.
  struct Reached {
    Index node;
    unsigned image = 0;
    bool operator==(const Reached&) const = default;
  };
  /// Pressed nodes that are reached through pressed ones, and that count: those of the whole body.
  template <class Counts>
  std::vector<Reached> around(Index from, const Reach& reach, const Counts& counts) const {
    std::vector<Reached> seen{{from}}, found;
    if (counts(from)) found.push_back({from});
    std::size_t first = 0;
    for (int ring = 1; ring <= reach.rings || (found.size() < reach.enough && ring <= reach.most); ++ring) {
      const std::size_t last = seen.size();
      for (; first < last; ++first)
        for (const Index other : around_[seen[first].node]) {
          if (!pressed(other)) continue;
          const Reached here = seen[first];
          each_side(on_[here.node], [&](unsigned across) {
            const Reached next{other, (here.image ^ across) & ~on_[other]};  // on a plane it is its own image
            if (!is_image(next.image) || std::ranges::find(seen, next) != seen.end()) return;
            seen.push_back(next);
            if (counts(other)) found.push_back(next);
          });
        }
    }
    return found;
  }

  /// Where a point is in an image.
  Point<D> in_image(unsigned image, Point<D> x) const {
    each_mirror(image, [&](const Flat<D>& mirror) { x = reflected<D>(mirror, x); });
    return x;
  }
  /// Likewise a direction.
  Point<D> turned(unsigned image, const Point<D>& direction) const {
    return difference<D>(in_image(image, direction), in_image(image, {}));
  }
  /// Takes out of a direction at a node what leads across the planes that it lies on.
  void keep_within(Index k, Point<D>& direction) const {
    each_mirror(on_[k], [&](const Flat<D>& mirror) { subtract(dot(direction, mirror.normal), mirror, direction); });
  }
  /// The centroid of a node's basis function, which goes on beyond planes of symmetry. (Means around the axis are those
  /// of rings.)
  Point<D> middle(Index k, const ContactSurface<D, B>& surface) const {
    Point<D> out = surface.middle(*node_[k]);
    each_mirror(on_[k] & ~axis_, [&](const Flat<D>& mirror) {
      subtract(dot(difference<D>(out, mirror.point), mirror.normal), mirror, out);
    });
    return out;
  }

  /// Whether all neighbours are pressed, too.
  bool inside(Index k) const {
    return pressed(k) && !node_[k]->hardly_covered() &&
           std::ranges::all_of(around_[k], [&](Index other) { return pressed(other); });
  }

 private:
  /// Of several numbers at a node, for several directions, that of a pressed one that pushes against the face most.
  Index number_of(Index vertex, const Point<D>& normal) const {
    auto found = std::ranges::lower_bound(node_, vertex, {}, [](const auto* node) { return node->vertex; });
    Index out = unreachable;
    for (; found != node_.end() && (*found)->vertex == vertex; ++found)
      if (const auto k = static_cast<Index>(found - node_.begin()); out == unreachable || precedes(k, out, normal))
        out = k;
    return out;
  }

  bool precedes(Index k, Index other, const Point<D>& normal) const {
    if (pressed_[k] != pressed_[other]) return pressed_[k];
    if constexpr (B == D) return dot(normal, node_[k]->direction) < dot(normal, node_[other]->direction);
    return true;
  }

  /// But for those that lie beyond the end of another body, and those whose share is their neighbours'.
  void add_strangers(const Nodes<D>& nodes, Index obstacle) {
    std::vector<Index> strangers, beyond;
    for (const Index face : faces_) {
      const auto vertices = nodes.of_face(face);
      const bool ends = std::ranges::any_of(vertices, [&](Index v) {
        const Index k = number_of(v, {});
        return k != unreachable && (node_[k]->partly_covered() || node_[k]->taken > 0);
      });
      for (const Index v : vertices)
        if (number_of(v, {}) == unreachable) (ends ? beyond : strangers).push_back(v);
    }
    for (std::vector<Index>* list : {&strangers, &beyond}) std::ranges::sort(*list);
    strangers.erase(std::unique(strangers.begin(), strangers.end()), strangers.end());
    for (const Index v : strangers) {
      if (std::ranges::binary_search(beyond, v)) continue;
      ContactNode<B>& node = strangers_.emplace_back();
      node.vertex = v, node.obstacle = obstacle;
      const auto at = std::ranges::upper_bound(node_, v, {}, [](const auto* other) { return other->vertex; });
      pressed_.insert(pressed_.begin() + (at - node_.begin()), false);
      node_.insert(at, &node);
    }
  }

  /// Whether the contact of a node of a face ends there as at an edge of the body, or goes on to another one.
  bool goes_on(Index k, Index other) const {
    return other == unreachable ? !node_[k]->partly_covered() : !node_[other]->hardly_covered();
  }

  void connect(const Nodes<D>& nodes) {
    around_.resize(node_.size());
    face_at_.resize(node_.size());
    at_end_.resize(node_.size());
    std::map<std::array<Index, D - 1>, int> sides;  // and how many faces meet there
    for (const Index face : faces_) {
      const auto vertices = nodes.of_face(face);
      const Point<D> normal = area_normal(nodes.mesh(), nodes.mesh().boundary[face]);
      std::array<Index, D>& corners = corners_.emplace_back();
      std::ranges::transform(vertices, corners.begin(), [&](Index v) { return number_of(v, normal); });
      leave_out_beyond(corners);
      for (const Index k : corners) {
        if (k == unreachable) continue;
        face_at_[k] = face;
        for (const Index other : corners)
          if (other != k && goes_on(k, other))
            around_[k].push_back(other);
          else if (other != k)
            at_end_[k] = true;
      }
      for (int skip = 0; skip < D; ++skip) ++sides[side_of(corners, skip)];
    }
    at_rim_.resize(node_.size());
    for (const auto& [side, faces] : sides)
      if (faces == 1 && std::ranges::count(side, unreachable) == 0)
        for (const Index k : side) at_rim_[k] = true;
    for (std::vector<Index>& list : around_) {
      std::ranges::sort(list);
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  /// Where the part of the other body that presses ends at one of a face's corners, those without contact that another
  /// part of it is in front of, behind an edge or a step: contact ends where that part does, not within the face.
  void leave_out_beyond(std::array<Index, D>& corners) const {
    if (std::ranges::none_of(corners, [&](Index k) { return pressed(k) && node_[k]->partly_covered(); })) return;
    for (Index& k : corners)
      if (k != unreachable && !pressed_[k] && !node_[k]->partly_covered()) k = unreachable;
  }

  /// All corners of a face but one, in ascending order.
  static std::array<Index, D - 1> side_of(const std::array<Index, D>& corners, int skip) {
    std::array<Index, D - 1> side;
    for (int i = 0, at = 0; i < D; ++i)
      if (i != skip) side[at++] = corners[i];
    std::ranges::sort(side);
    return side;
  }

  void find_mirrors(const Nodes<D>& nodes, const ContactSurface<D, B>& surface) {
    const auto add = [&](const Mirror& mirror) {
      Flat<D>& plane = mirrors_.emplace_back();
      plane.point[mirror.axis] = mirror.at;
      plane.normal[mirror.axis] = 1;
      for (Index k = 0; k < size(); ++k)
        if (lies_on<D>(mirror, nodes.at(node_[k]->vertex))) on_[k] |= 1u << (mirrors_.size() - 1);
    };
    on_.resize(node_.size());
    for (const Mirror& mirror : nodes.mesh().mirrors) add(mirror);
    if (surface.plane() == Plane::axisymmetric) {
      axis_ = 1u << mirrors_.size();
      add({.axis = 0, .at = 0});
    }
    for (const Flat<D>& wall : surface.walls()) {
      if (mirrors_.size() == most_mirrors) break;
      mirrors_.push_back(wall);
      for (Index k = 0; k < size(); ++k)
        if (surface.lies_on(wall, node_[k]->vertex) && is_smooth_across(k, wall)) on_[k] |= 1u << (mirrors_.size() - 1);
    }
  }

  /// What presses turns no more from a node to its image's neighbours than it does to its own: no edge runs along the
  /// wall.
  bool is_smooth_across(Index k, const Flat<D>& wall) const {
    if constexpr (B == D) {
      const auto& own = node_[k]->direction;
      double turns = 0;
      for (const Index other : around_[k])
        if (pressed(other)) turns = std::max(turns, length<D>(difference<D>(own, node_[other]->direction)));
      return std::abs(dot(own, wall.normal)) <= turns + smooth;
    }
    return false;
  }

  /// At planes at right angles to each other: what is mirrored at others depends on the order.
  bool is_image(unsigned image) const {
    bool out = true;
    each_mirror(image, [&](const Flat<D>& a) {
      each_mirror(image,
                  [&](const Flat<D>& b) { out = out && (&a == &b || std::abs(dot(a.normal, b.normal)) < smooth); });
    });
    return out;
  }

  template <class Use>
  void each_mirror(unsigned some, const Use& use) const {
    for (std::size_t m = 0; m < mirrors_.size(); ++m)
      if (some >> m & 1u) use(mirrors_[m]);
  }

  static void subtract(double factor, const Flat<D>& mirror, Point<D>& from) {
    for (int i = 0; i < D; ++i) from[i] -= factor * mirror.normal[i];
  }

  /// Calls visit() for all subsets of planes.
  template <class Visit>
  static void each_side(unsigned planes, const Visit& visit) {
    for (unsigned some = planes;; some = (some - 1) & planes) {
      visit(some);
      if (some == 0) return;
    }
  }

  /// The slope of what is linear over a face: of what was between the two sides at the start. NaN where that is not
  /// known.
  Point<D> slope(const Nodes<D>& nodes, std::size_t face) const {
    const Index first = corners_[face][0];
    Point<D> out{};
    std::array<Point<D>, D - 1> way;
    std::array<double, D - 1> more;
    for (int i = 1; i < D; ++i) {
      const Index other = corners_[face][i];
      if (first == unreachable || other == unreachable) return not_known();
      way[i - 1] = difference<D>(nodes.at(node_[other]->vertex), nodes.at(node_[first]->vertex));
      more[i - 1] = node_[other]->start - node_[first]->start;
    }
    if constexpr (D == 2) {
      for (int i = 0; i < D; ++i) out[i] = way[0][i] * more[0] / dot(way[0], way[0]);
    } else {
      const double aa = dot(way[0], way[0]), ab = dot(way[0], way[1]), bb = dot(way[1], way[1]);
      const double a = (bb * more[0] - ab * more[1]) / (aa * bb - ab * ab);
      const double b = (aa * more[1] - ab * more[0]) / (aa * bb - ab * ab);
      for (int i = 0; i < D; ++i) out[i] = a * way[0][i] + b * way[1][i];
    }
    return out;
  }
  static Point<D> not_known() {
    Point<D> out;
    out.fill(unknown_gap);
    return out;
  }

  void find_bends(const Nodes<D>& nodes) {
    bend_.assign(node_.size(), 0);
    reach_.assign(node_.size(), half_way);
    if (B != D) return;
    std::vector<std::vector<std::size_t>> at(node_.size());
    std::vector<Point<D>> slopes, middles, normals;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Face<D>& face = nodes.mesh().boundary[faces_[f]];
      slopes.push_back(slope(nodes, f));
      middles.push_back(centroid<D>(nodes.mesh(), face.vertices));
      normals.push_back(area_normal(nodes.mesh(), face));
      normalise(normals.back());
      for (const Index k : corners_[f])
        if (k != unreachable) at[k].push_back(f);
    }
    for (Index k = 0; k < size(); ++k) {
      for (const std::size_t f : at[k])
        for (const std::size_t g : at[k])
          if (f < g) {
            add_bend(k, length<D>(difference<D>(slopes[f], slopes[g])),
                     length<D>(difference<D>(middles[f], middles[g])));
          }
      each_mirror(on_[k], [&](const Flat<D>& mirror) {  // and to the images of faces
        for (const std::size_t f : at[k])
          add_bend(k, 2 * std::abs(dot(slopes[f], mirror.normal)),
                   2 * std::abs(dot(difference<D>(middles[f], mirror.point), mirror.normal)));
      });
    }
    find_reach(nodes, at, normals);
  }

  /// What is not known, or rounding, bends nothing.
  void add_bend(Index k, double turn, double way) {
    if (turn > rounding) bend_[k] = std::max(bend_[k], turn / way);
  }

  double bend_around(Index k) const {
    double out = bend_[k];
    for (const Index other : around_[k])
      if (other != unreachable) out = std::max(out, bend_[other]);
    return out;
  }

  /// Beyond an edge the surface falls back from the pressed faces before it, or what it was pressed on does.
  void find_reach(const Nodes<D>& nodes, const std::vector<std::vector<std::size_t>>& at,
                  const std::vector<Point<D>>& normals) {
    for (Index k = 0; k < size(); ++k) {
      if (pressed(k)) continue;
      double falls = 0;
      bool edge = false;
      for (const std::size_t f : at[k])
        for (const Index from : corners_[f])
          if (pressed(from)) {
            falls = std::max(falls, fall(nodes, k, from, at, normals));
            edge = edge || turns_beyond(f, from, at, normals) || presses_otherwise(k, from);
          }
      if (!edge) continue;
      const double gap = node_[k]->gap;
      if (std::isnan(node_[k]->start))
        reach_[k] = 0;  // far off
      else if (gap <= steepest * falls)
        reach_[k] = std::clamp(1 - gap / falls, 0.0, 1.0);
    }
  }

  bool all_pressed(std::size_t face) const {
    return std::ranges::all_of(corners_[face], [&](Index k) { return pressed(k); });
  }

  /// Of a node, from the pressed faces around another one, or of the obstacle's own surface.
  double fall(const Nodes<D>& nodes, Index k, Index from, const std::vector<std::vector<std::size_t>>& at,
              const std::vector<Point<D>>& normals) const {
    const Point<D> way = difference<D>(nodes.at(node_[k]->vertex), nodes.at(node_[from]->vertex));
    double out = 0;
    bool inside = false;
    for (const std::size_t g : at[from]) {
      if (!all_pressed(g)) continue;
      inside = true;
      out = std::max(out, -dot(way, normals[g]));
    }
    if constexpr (B == D)
      if (inside) out = std::max(out, std::abs(dot(way, node_[k]->direction)));
    return out;
  }

  /// Whether what would press on a node does so along another direction than on one that it presses, as these do not
  /// differ among each other.
  bool presses_otherwise(Index k, Index from) const {
    if constexpr (B == D) {
      const auto turn = [&](Index a, Index b) {
        return length<D>(difference<D>(node_[a]->direction, node_[b]->direction));
      };
      double within = -1;
      for (const Index other : around_[from])
        if (pressed(other)) within = std::max(within, turn(from, other));
      return within >= 0 && !std::isnan(node_[k]->start) && turn(k, from) > kinked * within + rounding;
    }
    return false;
  }

  /// Whether a face turns away from the pressed ones beside it as none of these do from each other.
  bool turns_beyond(std::size_t face, Index from, const std::vector<std::vector<std::size_t>>& at,
                    const std::vector<Point<D>>& normals) const {
    const auto turn = [&](std::size_t f, std::size_t g) { return length<D>(difference<D>(normals[f], normals[g])); };
    for (const std::size_t g : at[from]) {
      if (!all_pressed(g)) continue;
      double within = -1;
      for (const Index corner : corners_[g])
        for (const std::size_t other : at[corner])
          if (other != g && all_pressed(other)) within = std::max(within, turn(g, other));
      if (within >= 0 && turn(face, g) > kinked * within + rounding) return true;
    }
    return false;
  }

  static constexpr std::size_t most_mirrors = 32;
  static constexpr double kinked = 3;       // times the bends elsewhere: smooth surfaces differ by less
  static constexpr double rounding = 1e-6;  // of slopes
  static constexpr double half_way = 0.5;
  static constexpr double steepest = 2;  // of the fall: what is farther off than that jumps
  static constexpr double smooth = 1e-6;
  std::vector<Flat<D>> mirrors_;
  unsigned axis_ = 0;         // the bit of that of a body of revolution
  std::vector<unsigned> on_;  // those that a node lies on
  std::deque<ContactNode<B>> strangers_;
  std::vector<ContactNode<B>*> node_;
  std::vector<bool> pressed_, at_end_, at_rim_;
  std::vector<Index> faces_, face_at_;
  std::vector<std::array<Index, D>> corners_;
  std::vector<std::vector<Index>> around_;
  std::vector<double> bend_, reach_;
};

/// Coordinates in a plane that touches the surface.
template <int D>
struct TangentPlane {
  Point<D> origin;
  std::array<Point<D>, D - 1> axes;

  std::array<double, D - 1> operator()(const Point<D>& x) const {
    const Point<D> from = difference<D>(x, origin);
    std::array<double, D - 1> out;
    for (int i = 0; i < D - 1; ++i) out[i] = dot(from, axes[i]);
    return out;
  }
};

/// Means around nodes as samples for a fit at one of them.
template <int D, int B>
class SurfaceSamples {
 public:
  /// Keeps references.
  SurfaceSamples(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, const PressedFaces<D, B>& faces)
      : nodes_(nodes), surface_(surface), faces_(faces), middle_(static_cast<std::size_t>(faces.size())) {}

  /// The plane that touches at a node.
  TangentPlane<D> plane_at(Index k) const {
    const Point<D>& origin = nodes_.at(faces_.node(k).vertex);
    Point<D> normal = area_normal(nodes_.mesh(), nodes_.mesh().boundary[faces_.face_at(k)]);
    faces_.keep_within(k, normal);
    normalise(normal);
    return {origin, tangents(normal)};
  }

  using Reached = typename PressedFaces<D, B>::Reached;

  /// At the middles of what was reached, seen from node k in the plane that touches there.
  /// @param value value(reached)
  template <class Value>
  std::vector<Sample<D - 1>> around(Index k, const std::vector<Reached>& some, const Value& value) const {
    const TangentPlane<D> plane = plane_at(k);
    std::vector<Sample<D - 1>> out;
    out.reserve(some.size());
    for (const Reached& s : some) {
      out.push_back({plane(faces_.in_image(s.image, middle(s.node))), {value(s)}});
    }
    return out;
  }

  const Point<D>& middle(Index k) const {
    if (!middle_[k]) middle_[k] = faces_.middle(k, surface_);
    return *middle_[k];
  }

 private:
  const Nodes<D>& nodes_;
  const ContactSurface<D, B>& surface_;
  const PressedFaces<D, B>& faces_;
  mutable std::vector<std::optional<Point<D>>> middle_;  // once it was asked for
};

}  // namespace signorini
