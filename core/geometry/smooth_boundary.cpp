#include "core/geometry/smooth_boundary.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/dot.hpp"
#include "core/geometry/edges.hpp"
#include "core/geometry/flat_parts.hpp"
#include "core/geometry/groups.hpp"
#include "core/geometry/jet.hpp"
#include "core/geometry/recognise.hpp"
#include "core/geometry/shape_parts.hpp"
#include "core/geometry/tips.hpp"
#include "core/geometry/vector.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/element_map.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

constexpr double same_plane = 1 - 2e-4;  // cosine, of a degree
constexpr double least_rise = 0.25;      // cosine: how far a jet looks around the corner
constexpr double same_normal = 1e-3;     // angle between shapes: more is an edge

template <int D>
void add(Point<D>& sum, double factor, const Point<D>& p) {
  for (int k = 0; k < D; ++k) sum[k] += factor * p[k];
}

template <int D>
class Smoother {
 public:
  Smoother(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces, double crease,
           const Known<D>& known)
      : points_(points), faces_(faces), crease_(crease), cosine_(std::cos(crease)), known_(known) {
    for (const auto& face : faces) normal_.push_back(unit<D>(signorini::area_normal(corners_of(face))));
  }

  SmoothBoundary<D> run() {
    find_joints();
    flats_ = find_flat_parts<D>(points_, faces_, across_, known_.curved);
    part_shapes();
    find_tips();
    find_sides();
    if (!known_.second_order()) find_patches();
    out_.flat = std::move(flats_.part);
    out_.shape = std::move(shapes_.part);
    out_.shapes = std::move(shapes_.shapes);
    return std::move(out_);
  }

 private:
  void find_patches() {
    if constexpr (D == 3) find_crease_tangents();
    find_normals();
    if constexpr (D == 3) keep_in_planes();
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      out_.patches.push_back(patch(f));
      auto& normals = out_.normals.emplace_back();
      for (int i = 0; i < D; ++i) normals[i] = side_normal_[side_[f * D + i]];
    }
  }

  std::array<Point<D>, D> corners_of(const std::array<Index, D>& face) const {
    std::array<Point<D>, D> p;
    for (int i = 0; i < D; ++i) p[i] = points_[face[i]];
    return p;
  }

  /// What faces have in common without an edge of the body.
  void find_joints() {
    all_ = geometry::find_joints<D>(static_cast<Index>(points_.size()), faces_);
    edges_ = find_edges<D>(points_, faces_, all_, crease_, known_.normal);
    if (!known_.second_order()) join_parts(find_flat_parts<D>(points_, faces_, all_.beyond).part);
    find_across();
  }

  /// Within a plane or a shape there are no edges, whatever thin faces in it show once digits have been rounded away.
  void join_parts(const std::vector<Index>& parts) {
    for (std::size_t i = 0; i < all_.beyond.size(); ++i)
      if (const Index part = parts[i / D]; all_.beyond[i] >= 0 && part >= 0 && part == parts[all_.beyond[i] / D])
        edges_.sharp[all_.number[i]] = 0;
  }

  void find_across() {
    across_ = all_.beyond;
    out_.turn.assign(faces_.size(), 0);
    for (std::size_t i = 0; i < across_.size(); ++i)
      if (edges_.sharp[all_.number[i]] != 0)
        across_[i] = -1;
      else if (across_[i] >= 0)
        out_.turn[i / D] = std::max(out_.turn[i / D], edges_.angle[i]);
  }

  /// Shapes and planes that meet at an angle meet at an edge, whatever the faces beside it show.
  void part_shapes() {
    shapes_ = find_shape_parts<D>(points_, faces_, across_, all_.beyond, flats_, crease_, known_);
    join_parts(shapes_.part);
    find_across();
    for (const Index i : shapes_.edges) edges_.sharp[all_.number[i]] = 1;
    for (std::size_t i = 0; i < across_.size(); ++i) {
      if (across_[i] < 0) continue;
      const auto f = static_cast<Index>(i) / D, g = across_[i] / D;
      if (shapes_.part[f] >= 0 && shapes_.part[f] == shapes_.part[g]) continue;
      for (const Index v : joint_of<D>(faces_[f], static_cast<int>(i % D)))
        if (const auto a = told_normal(f, v), b = told_normal(g, v);
            a && b && length<D>(difference<D>(*a, *b)) > same_normal)
          edges_.sharp[all_.number[i]] = 1;
    }
    find_across();
  }

  /// Of the plane or shape that a face is of, at a vertex; on the face's side.
  std::optional<Point<D>> told_normal(Index f, Index v) const {
    if (const Index part = flats_.part[f]; part >= 0) return flats_.normal[part];
    const Index part = shapes_.part[f];
    if (part < 0) return {};
    const double size = length<D>(difference<D>(points_[faces_[f][1]], points_[faces_[f][0]]));
    const auto off = height<D>(shapes_.shapes[part], points_[v]);
    if (!off || geometry::is_tip<D>(shapes_.shapes[part], points_[v], size)) return {};
    return scaled<D>(dot(off->normal, normal_[f]) < 0 ? -1 : 1, off->normal);
  }

  void find_tips() {
    is_tip_.assign(points_.size(), 0);
    if constexpr (D == 3) {
      if (known_.second_order()) return;
      is_tip_ = geometry::find_tips(points_, faces_, all_, edges_.sharp, crease_);
      find_fans();
      for (std::size_t f = 0; f < faces_.size(); ++f) {
        if (shapes_.part[f] < 0) continue;
        const Curve<D>& shape = shapes_.shapes[shapes_.part[f]];
        for (int i = 0; i < D; ++i) {
          const Point<D>&p = points_[faces_[f][i]], &q = points_[faces_[f][(i + 1) % D]];
          is_tip_[faces_[f][i]] = geometry::is_tip<D>(shape, p, length<D>(difference<D>(q, p)));
        }
      }
    }
  }

  /// What all edges lead to an edge of the body from is the tip of a cone: they are straight.
  void find_fans() {
    std::vector<std::uint8_t> rim(points_.size(), 0), inner(points_.size(), 1);
    for (std::size_t i = 0; i < across_.size(); ++i)
      if (across_[i] < 0)
        for (const Index v : joint_of<D>(faces_[i / D], static_cast<int>(i % D))) rim[v] = 1;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (int i = 0; i < D; ++i) {
        const Index v = faces_[f][i];
        if (rim[v] != 0 || flats_.part[f] >= 0 || rim[faces_[f][(i + 1) % D]] == 0 || rim[faces_[f][(i + 2) % D]] == 0)
          inner[v] = 0;
      }
    for (const auto& face : faces_)
      for (const Index v : face)
        if (inner[v] != 0) is_tip_[v] = 1;
  }

  /// Corners of faces that belong together: at one vertex, and not across a crease. At tips each is one of its own.
  void find_sides() {
    Groups sides(faces_.size() * D), pieces(faces_.size());
    for (Index i = 0; i < static_cast<Index>(across_.size()); ++i) {
      if (across_[i] < i) continue;
      const Index f = i / D, g = across_[i] / D;
      pieces.join(f, g);
      for (int a = 0; a < D; ++a)
        for (int b = 0; b < D; ++b)
          if (faces_[f][a] == faces_[g][b] && is_tip_[faces_[f][a]] == 0) sides.join(f * D + a, g * D + b);
    }
    out_.piece = pieces.numbered(out_.pieces);
    side_ = sides.numbered(count_);
    of_side_.resize(static_cast<std::size_t>(count_));
    for (std::size_t i = 0; i < side_.size(); ++i) of_side_[side_[i]].push_back(static_cast<Index>(i));
  }

  void find_normals() {
    side_normal_.resize(static_cast<std::size_t>(count_));
    side_flat_.resize(static_cast<std::size_t>(count_), 0);
    for (Index s = 0; s < count_; ++s) side_normal_[s] = normal_of_side(s);
  }

  Point<D> normal_of_side(Index s) {
    const auto& corners = of_side_[s];
    if (is_tip_[vertex_of(s)] != 0) return normal_[corners[0] / D];
    Point<D> mean{};
    std::optional<Point<D>> told;
    bool one = true;
    for (const Index i : corners) {
      const Index f = i / D;
      add<D>(mean, angle_at(i), normal_[f]);
      const auto own = told_normal(f, vertex_of(s));
      if (!own) continue;
      if (told && length<D>(difference<D>(*own, *told)) > same_normal) one = false;
      const bool flat = flats_.part[f] >= 0;
      if (!told || (flat && side_flat_[s] == 0)) told = own;
      if (flat) side_flat_[s] = 1;
    }
    mean = unit<D>(mean);
    if (!one) side_flat_[s] = 0;
    if (told) return one ? *told : mean;
    if constexpr (D == 3)
      if (const auto across = row_normal(corners, mean)) return *across;
    if constexpr (D == 2)
      if (const auto near_end = end_normal(corners)) return *near_end;
    const Point<D> first = jet_normal(s, mean);
    return dot(first, mean) < same_plane ? jet_normal(s, first) : first;  // beside creases the mean is turned away
  }

  /// The vertices from that of a side along a curve, at most so many, as far as no crease comes.
  std::vector<Point<2>> walk(const std::vector<Index>& corners, bool forward, std::size_t most) const {
    const int ahead = forward ? 1 : 0;  // the end of a face that is reached first, and the tip across from there
    std::vector<Point<2>> out;
    for (Index i : corners) {
      if (i % 2 == ahead) continue;
      for (Index f = i / 2; f >= 0 && out.size() < most;) {
        out.push_back(points_[faces_[f][ahead]]);
        const Index next = across_[2 * f + (1 - ahead)];
        f = next < 0 ? -1 : next / 2;
      }
    }
    return out;
  }

  /// Of a curve near its ends, where there are no two vertices on either side.
  std::optional<Point<2>> end_normal(const std::vector<Index>& corners) const {
    auto on = walk(corners, true, 3), back = walk(corners, false, 3);
    if (on.size() >= 2 && back.size() >= 2) return {};
    const bool reversed = back.size() > on.size();
    if (reversed) std::swap(on, back);
    if (on.size() < 2) return {};
    std::vector<Point<2>> row{points_[faces_[corners[0] / D][corners[0] % D]]};
    if (!back.empty()) row.insert(row.begin(), back[0]);
    row.insert(row.end(), on.begin(), on.end());
    const auto t = end_tangent(row, back.empty() ? 0 : 1);
    if (!t) return {};
    const double sign = reversed ? -1 : 1;
    return Point<2>{sign * (*t)[1], -sign * (*t)[0]};
  }

  double angle_at(Index corner) const {
    if constexpr (D == 2) {
      return 1;
    } else {
      const auto p = corners_of(faces_[corner / D]);
      const int k = corner % D;
      const Point<3> u = difference<3>(p[(k + 1) % 3], p[k]), v = difference<3>(p[(k + 2) % 3], p[k]);
      return std::atan2(length<3>(cross(u, v)), dot(u, v));
    }
  }

  /// The vertices around that of a side, by so many rings of faces on its side of creases.
  std::vector<Index> around(Index side, const Point<D>& up, int rings) const {
    std::vector<Index> faces, sides{side}, vertices;
    const auto insert = [](std::vector<Index>& into, Index i) {
      if (std::ranges::find(into, i) != into.end()) return false;
      into.push_back(i);
      return true;
    };
    for (std::size_t first = 0, last = 1; rings > 0; --rings, first = last, last = sides.size())
      for (std::size_t k = first; k < last; ++k)
        for (const Index i : of_side_[sides[k]]) {
          const Index f = i / D;
          if (flats_.part[f] >= 0 || dot(normal_[f], up) < least_rise || !insert(faces, f)) continue;
          for (int corner = 0; corner < D; ++corner) {
            insert(vertices, faces_[f][corner]);
            insert(sides, side_[f * D + corner]);
          }
        }
    std::erase(vertices, vertex_of(side));
    std::ranges::sort(vertices);
    return vertices;
  }

  Index vertex_of(Index side) const { return faces_[of_side_[side][0] / D][of_side_[side][0] % D]; }

  /// Of the highest polynomial that there are vertices enough for around a side; `up` where there are none.
  Point<D> jet_normal(Index side, const Point<D>& up) const {
    const Point<D>& center = points_[vertex_of(side)];
    for (int degree = highest_jet<D>; degree >= 2; --degree)
      for (int rings = 2; rings <= (D == 2 ? 4 : 3); ++rings) {
        const std::vector<Index> vertices = around(side, up, rings);
        if (vertices.size() < points_for_jet<D>(degree)) continue;
        std::vector<Point<D>> near;
        near.reserve(vertices.size());
        for (const Index v : vertices) near.push_back(difference<D>(points_[v], center));
        if (const auto n = signorini::geometry::jet_normal<D>(near, up, degree, digits_); n && dot(*n, up) >= cosine_)
          return *n;
        break;
      }
    return up;
  }

  /// In a row of faces from edge to edge: across the edge's tangent and what leads straight to the other one. Where
  /// several lead there, as between triangles, that which each of them turns about as much.
  std::optional<Point<3>> row_normal(const std::vector<Index>& corners, const Point<3>& up) const {
    const Index v = faces_[corners[0] / 3][corners[0] % 3];
    if (!on_crease_[v] || crease_tangent_[v] == Point<3>{}) return {};
    Point<3> ruling{};
    for (const Index i : corners)
      for (const Index k : {1, 2}) {
        const Index at = i / 3 * 3 + (i % 3 + k) % 3, far = faces_[i / 3][(i % 3 + 3 - k) % 3];
        if (across_[at] < 0) continue;
        if (!on_crease_[far] && is_tip_[far] == 0) return {};
        add<3>(ruling, edges_.angle[at], unit<3>(difference<3>(points_[far], points_[v])));
      }
    const Point<3> n = cross(crease_tangent_[v], unit<3>(ruling));
    if (!(length<3>(n) > least_rise)) return {};
    return unit<3>(dot(n, up) < 0 ? scaled<3>(-1, n) : n);
  }

  /// Along creases and borders: the tangent of the circle through three vertices that follow each other; within the
  /// planes of flat parts.
  void find_crease_tangents() {
    std::vector<std::vector<std::pair<Index, Index>>> ends(points_.size());  // joint and other end
    is_crease_.assign(static_cast<std::size_t>(all_.count), 0);
    for (Index i = 0; i < static_cast<Index>(across_.size()); ++i) {
      if (across_[i] >= 0 || is_crease_[all_.number[i]]++) continue;
      const auto [a, b] = joint_of<D>(faces_[i / D], i % D);
      ends[a].push_back({all_.number[i], b});
      ends[b].push_back({all_.number[i], a});
    }
    crease_tangent_.assign(points_.size(), {});
    for (const auto& at : ends) on_crease_.push_back(at.empty() ? 0 : 1);
    for (std::size_t v = 0; v < ends.size(); ++v) {
      if (ends[v].size() != 2) continue;
      const Point<D> in = difference<D>(points_[v], points_[ends[v][0].second]),
                     on = difference<D>(points_[ends[v][1].second], points_[v]);
      const double a = length<D>(in), b = length<D>(on);
      if (dot(in, on) < cosine_ * a * b) continue;
      Point<D> t = scaled<D>(b / a, in);
      add<D>(t, a / b, on);
      crease_tangent_[v] = unit<D>(t);
    }
  }

  void keep_in_planes() {
    for (std::size_t i = 0; i < side_.size(); ++i) {
      const std::size_t f = i / D;
      Point<D>& t = crease_tangent_[faces_[f][i % D]];
      if (!side_flat_[side_[i]] || t == Point<D>{}) continue;
      add<D>(t, -dot(t, side_normal_[side_[i]]), side_normal_[side_[i]]);
      t = unit<D>(t);
    }
  }

  /// The unit direction in which an edge of a face leaves its end a, turned to the other end b.
  Point<D> direction(std::size_t f, int a, int b, const Point<D>& chord) const {
    if constexpr (D == 3) {
      const int tip = 3 - a - b;
      if (is_crease_[all_.number[f * D + tip]]) {
        const auto turned = [&](Point<D> t) { return dot(t, chord) < 0 ? scaled<D>(-1, t) : t; };
        if (const Point<D> t = crease_tangent_[faces_[f][a]]; t != Point<D>{}) return turned(t);
        Point<D> t = crease_tangent_[faces_[f][b]];
        if (t == Point<D>{}) return chord;
        t = turned(t);
        Point<D> mirrored = scaled<D>(2 * dot(t, chord), chord);
        add<D>(mirrored, -1, t);
        return mirrored;
      }
    }
    const Point<D>& n = side_normal_[side_[f * D + a]];
    Point<D> t = chord;
    add<D>(t, -dot(chord, n), n);
    return length<D>(t) > least_rise ? unit<D>(t) : chord;
  }

  CubicPatch<D> patch(std::size_t f) const {
    const auto corner = corners_of(faces_[f]);
    std::array<std::array<Point<D>, D>, D> tangent{};
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) {
        if (a == b) continue;
        const Point<D> edge = difference<D>(corner[b], corner[a]);
        const double size = length<D>(edge);
        const Point<D> chord = scaled<D>(1 / size, edge), t = direction(f, a, b, chord);
        // So long that arcs of circles come out best: 4 tan(angle / 4) radii, the angle that of the arc.
        tangent[a][b] = scaled<D>(2 * size / (1 + std::max(0.0, dot(t, chord))), t);
      }
    CubicPatch<D> out = patch_with_tangents<D>(corner, tangent);
    if constexpr (D == 3) put_middle(f, out);
    return out;
  }

  /// Moves the middle of a patch onto the shape, or to where a line from a tip to its other side has it.
  void put_middle(std::size_t f, CubicPatch<3>& patch) const {
    constexpr double share = 2.0 / 9;  // of the middle control point there
    constexpr double third = 1.0 / 3;
    const Point<3> middle = patch.at({third, third, third});
    Point<3> target = middle;
    const Index part = shapes_.part[f];
    if (part >= 0) target = project<3>(shapes_.shapes[part], middle);
    for (int i = 0; i < 3 && part < 0; ++i) {
      if (is_tip_[faces_[f][i]] == 0) continue;
      std::array<double, 3> across{0.5, 0.5, 0.5};
      across[i] = 0;
      target = scaled<3>(third, points_[faces_[f][i]]);
      add<3>(target, 2 * third, patch.at(across));
    }
    add<3>(patch.control.back(), 1 / share, difference<3>(target, middle));
  }

  std::span<const Point<D>> points_;
  const std::vector<std::array<Index, D>>& faces_;
  double crease_, cosine_;
  const Known<D>& known_;
  std::vector<Point<D>> normal_;  // of the flat faces
  Joints<D> all_;
  Edges edges_;
  Index count_ = 0;
  std::vector<Index> across_;  // per face and tip, the face and tip beyond; -1 at creases and borders
  std::vector<Index> side_;    // per face and corner
  std::vector<std::vector<Index>> of_side_;
  FlatParts<D> flats_;
  ShapeParts<D> shapes_;
  double digits_ = rounded_away<D>(points_);  // length
  std::vector<std::uint8_t> is_crease_, on_crease_, side_flat_;
  std::vector<std::uint8_t> is_tip_;  // per vertex
  std::vector<Point<D>> side_normal_, crease_tangent_;
  SmoothBoundary<D> out_;
};

}  // namespace

template <int D>
SmoothBoundary<D> smooth_boundary(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
                                  double crease, const Known<D>& known) {
  return Smoother<D>(points, faces, crease, known).run();
}

// A patch lies in the convex hull of its control points, the flat one in that of the same points on the face.
template <int D>
double bulge(const CubicPatch<D>& patch) {
  std::array<Point<D>, D> corner;
  std::copy_n(patch.control.begin(), D, corner.begin());
  const CubicPatch<D> flat = flat_patch<D>(corner);
  double largest = 0;
  for (std::size_t k = D; k < CubicPatch<D>::size; ++k)
    largest = std::max(largest, length<D>(difference<D>(patch.control[k], flat.control[k])));
  return largest;
}

#define SIGNORINI_INSTANTIATE(D)                                                                                     \
  template SmoothBoundary<D> smooth_boundary<D>(std::span<const Point<D>>, const std::vector<std::array<Index, D>>&, \
                                                double, const Known<D>&);                                            \
  template double bulge<D>(const CubicPatch<D>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini::geometry
