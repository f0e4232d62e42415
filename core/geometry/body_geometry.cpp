#include "core/geometry/body_geometry.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/dot.hpp"
#include "core/base/release.hpp"
#include "core/geometry/interfaces.hpp"
#include "core/geometry/recognise.hpp"
#include "core/mesh/bends.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/element_map.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/separate.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

// Of the size of a piece: what digits in a file round away, what is flat, and what "fit" takes for a shape.
constexpr double off_shape = 1e-6, flat = 1e-9, near = 1e-3;
constexpr double least_common = 0.8;  // cosine: faces around the tip of a cone have no normal in common

template <int D>
Point<D> unit_normal(const std::array<Point<D>, D>& corner) {
  Point<D> n = area_normal(corner);
  const double size = length<D>(n);
  for (double& x : n) x /= size;
  return n;
}

template <int D>
Point<D> unit_normal(const Mesh<D>& mesh, const Face<D>& face) {
  std::array<Point<D>, D> corner;
  for (int i = 0; i < D; ++i) corner[i] = mesh.points[face.vertices[i]];
  return unit_normal<D>(corner);
}

/// Of the edge between two corners of a face, which are counted within it.
template <int D>
const Point<D>& bend(const Mesh<D>& mesh, const Face<D>& face, int i, int j) {
  const Simplex<D>& element = mesh.elements[face.element];
  const auto at = [&](int k) {
    return static_cast<int>(std::ranges::find(element, face.vertices[k]) - element.begin());
  };
  return mesh.bends[face.element][edge_between<D>(at(i), at(j))];
}

/// Of a face, which may be curved, at a corner.
template <int D>
Point<D> corner_normal(const Mesh<D>& mesh, const Face<D>& face, int corner) {
  if (mesh.bends.empty()) return unit_normal(mesh, face);
  std::array<Point<D>, D> tangent_face;
  for (int i = 0; i < D; ++i) {
    tangent_face[i] = mesh.points[face.vertices[i]];
    for (int k = 0; k < D && i != corner; ++k) tangent_face[i][k] += 4 * bend(mesh, face, corner, i)[k];
  }
  return unit_normal<D>(tangent_face);
}

/// Of curved elements: see JointNormal. With the bends c of the edges, the derivative along edge ab at its end a is
/// b - a + 4 c_ab, and that of face abc from the middle of ab towards c is c - (a + b) / 2 + 2 c_ac + 2 c_bc - 2 c_ab.
template <int D>
Point<D> curved_normal(const Mesh<D>& mesh, std::size_t f, int tip) {
  const Face<D>& face = mesh.boundary[f];
  const auto bend = [&](int i, int j) { return geometry::bend(mesh, face, i, j); };
  const auto p = [&](int i) { return mesh.points[face.vertices[i]]; };
  const auto plus = [](Point<D> a, double factor, const Point<D>& b) {
    for (int k = 0; k < D; ++k) a[k] += factor * b[k];
    return a;
  };
  Point<D> n;
  if constexpr (D == 2) {
    const Point<D> along = plus(difference<D>(p(1), p(0)), tip == 1 ? 4 : -4, bend(0, 1));
    n = {along[1], -along[0]};
  } else {
    const int a = (tip + 1) % 3, b = (tip + 2) % 3;
    Point<D> up = difference<D>(p(tip), midpoint<D>(p(a), p(b)));
    up = plus(plus(plus(up, 2, bend(a, tip)), 2, bend(b, tip)), -2, bend(a, b));
    n = cross(difference<D>(p(b), p(a)), up);
  }
  const double size = length<D>(n);
  for (double& x : n) x /= size;
  return n;
}

/// The boundary of a body together with its images beyond planes: the faces of the body come first.
template <int D>
struct Continued {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D>> faces;

  void mirror_at(const Mirror& mirror) {
    std::vector<Index> image(points.size());
    for (std::size_t v = 0; v < image.size(); ++v) {
      const bool on = lies_on<D>(mirror, points[v]);
      image[v] = static_cast<Index>(on ? v : points.size());
      if (!on) points.push_back(reflected<D>(mirror, points[v]));
    }
    const std::size_t count = faces.size();
    for (std::size_t f = 0; f < count; ++f) {
      std::array<Index, D> face = faces[f];
      for (Index& v : face) v = image[v];
      std::swap(face[0], face[1]);  // turned by the reflection
      faces.push_back(face);
    }
  }
};

template <int D>
class Chooser {
 public:
  Chooser(Mesh<D>& mesh, Surfaces surfaces, double crease, std::span<const Mirror> beyond)
      : mesh_(mesh), surfaces_(surfaces), crease_(crease), beyond_(beyond) {
    for (const Face<D>& face : mesh.boundary) faces_.push_back(face.vertices);
  }

  /// @param moves whether vertices go onto shapes, and elements with several faces on one are divided
  void run(bool moves) {
    if (!mesh_.bends.empty() && surfaces_ == Surfaces::automatic) return keep_elements();
    release(mesh_.bends);
    mesh_.curves.clear();
    for (Face<D>& face : mesh_.boundary) face.curve = -1;
    smooth_ = smooth({});
    for (const std::vector<Index>& piece : pieces()) choose(piece);
    if (moves) move_onto_shapes();
    if (patches_) mesh_.patches = std::make_shared<const std::vector<CubicPatch<D>>>(std::move(smooth_.patches));
    if (moves) separate_curved_faces(mesh_);
  }

 private:
  SmoothBoundary<D> smooth(const JointNormal<D>& joint_normal) const {
    Continued<D> whole{mesh_.points, faces_};
    for (const Mirror& mirror : beyond_) whole.mirror_at(mirror);
    SmoothBoundary<D> out = smooth_boundary<D>(whole.points, whole.faces, crease_, joint_normal);
    out.patches.resize(faces_.size());
    out.piece.resize(faces_.size());
    out.pieces = faces_.empty() ? 0 : std::ranges::max(out.piece) + 1;
    return out;
  }

  /// Of a curved face of the body, or of its image: images of images have more planes between.
  Point<D> joint_normal(std::size_t face, int tip) const {
    const std::size_t image = face / faces_.size();
    if (image > 0 && tip < 2) tip = std::popcount(image) % 2 == 1 ? 1 - tip : tip;
    Point<D> n = curved_normal(mesh_, face % faces_.size(), tip);
    for (std::size_t m = 0; m < beyond_.size(); ++m)
      if (image >> m & 1u) n[beyond_[m].axis] *= -1;
    return n;
  }

  /// Curved faces that meet at an edge of the body are on different curves. Where all nodes are on a shape, that is
  /// what they were put on.
  void keep_elements() {
    smooth_ = smooth([&](std::size_t face, int tip) { return joint_normal(face, tip); });
    for (const Face<D>& face : mesh_.boundary) curved_.push_back(face.curve >= 0);
    mesh_.curves = {{.kind = CurveKind::elements}};  // what is not renumbered below
    for (const std::vector<Index>& piece : pieces()) {
      std::vector<Index> left = piece;
      find_shapes(left);
      if (left.empty()) continue;
      note("second order", left, off_of_elements(left));
      for (const Index f : left)
        if (curved_[f] != 0) mesh_.boundary[f].curve = static_cast<Index>(mesh_.curves.size());
      mesh_.curves.push_back({.kind = Curve<D>::Kind::elements});
    }
    const auto is_straight = [](const Bends<D>& bends) { return bends == Bends<D>{}; };
    if (std::ranges::any_of(curved_, [](std::uint8_t c) { return c != 0; }) ||
        !std::ranges::all_of(mesh_.bends, is_straight))
      return;
    release(mesh_.bends);
    mesh_.curves.clear();
    for (Face<D>& face : mesh_.boundary) face.curve = -1;
  }

  double off_of_elements(const std::vector<Index>& piece) const {
    double most = 0;
    for (const Index f : piece) {
      const Face<D>& face = mesh_.boundary[f];
      const Point<D> n = unit_normal(mesh_, face);
      constexpr auto edges = simplex_edges<D>();
      for (std::size_t k = 0; k < edges.size(); ++k) {
        const auto on_face = [&](int i) {
          return std::ranges::count(face.vertices, mesh_.elements[face.element][i]) > 0;
        };
        if (on_face(edges[k][0]) && on_face(edges[k][1]))
          most = std::max(most, std::abs(dot(mesh_.bends[face.element][k], n)));
      }
    }
    return most;
  }

  std::vector<std::vector<Index>> pieces() const {
    std::vector<std::vector<Index>> out(static_cast<std::size_t>(smooth_.pieces));
    for (std::size_t f = 0; f < faces_.size(); ++f) out[smooth_.piece[f]].push_back(static_cast<Index>(f));
    return out;
  }

  static const char* flat_kind() { return D == 2 ? "line" : "plane"; }

  double size_of(const std::vector<Index>& piece) const {
    Point<D> low, high;
    low.fill(infinity);
    high.fill(-infinity);
    for (const Index f : piece)
      for (const Index v : faces_[f])
        for (int k = 0; k < D; ++k) {
          low[k] = std::min(low[k], mesh_.points[v][k]);
          high[k] = std::max(high[k], mesh_.points[v][k]);
        }
    return length<D>(difference<D>(high, low));
  }

  void note(const std::string& kind, const std::vector<Index>& piece, double deviation,
            const Curve<D>* curve = nullptr) {
    SurfacePiece& out = mesh_.pieces.emplace_back(SurfacePiece{kind, static_cast<Index>(piece.size()), deviation});
    out.size = size_of(piece);
    if (!curve) return;
    out.center.assign(curve->center.begin(), curve->center.end());
    if (curve->kind != Curve<D>::Kind::round) out.axis.assign(curve->axis.begin(), curve->axis.end());
    out.radius = curve->radius;
    out.second = curve->second;
  }

  void choose(const std::vector<Index>& piece) {
    const double size = size_of(piece);
    // What is flat on this side of a plane of symmetry may be one half of a surface that is bent there.
    const bool may_bend = surfaces_ == Surfaces::automatic || surfaces_ == Surfaces::smooth;
    const bool bent = may_bend && !beyond_.empty() && off_patches(piece) > flat * size;
    if (const double off = off_plane(piece); !bent && off <= (surfaces_ == Surfaces::fit ? near : off_shape) * size)
      return note(flat_kind(), piece, off);
    if (surfaces_ == Surfaces::facets) return note("facets", piece, off_patches(piece));
    if (surfaces_ == Surfaces::smooth) return make_smooth(piece);
    std::vector<Index> left = piece;
    find_shapes(left, bent);
    if (left.empty()) return;
    if (surfaces_ == Surfaces::fit) return note("facets", left, off_patches(left));
    make_smooth(left);
  }

  /// What faces of one group have in common, beside that they are connected.
  enum class Grouping { none, flatness, parts };

  /// Leaves those faces that are on no shape, neither with all others nor with some.
  /// @param bent what is flat as a whole goes on bent beyond planes
  void find_shapes(std::vector<Index>& faces, bool bent = false) {
    for (const Grouping by : {Grouping::none, Grouping::flatness, Grouping::parts})
      if (!bent || by != Grouping::none) fit_groups(faces, by);
    if (surfaces_ == Surfaces::automatic) grow_shapes(faces);
  }

  /// Shapes that some faces beside each other are on, with all that is on these farther away.
  void grow_shapes(std::vector<Index>& faces) {
    constexpr int most_attempts = 100;
    constexpr std::size_t few = D == 2 ? 6 : 16;  // vertices
    std::set<Index> open(faces.begin(), faces.end()), tried;
    const Neighbours at = neighbours(faces);
    int attempts = 0;
    for (const Index first : faces) {
      if (!open.contains(first) || tried.contains(first) || attempts >= most_attempts) continue;
      std::vector<Index> group = connected(first, at, [&](Index f, const std::vector<Index>& so_far) {
        return open.contains(f) && vertices_of(so_far).size() < few;
      });
      if (vertices_of(group).size() < few) continue;
      ++attempts;
      std::optional<Recognised<D>> found = shape_of(group);
      for (std::size_t before = 0; found && before < group.size();) {
        before = group.size();
        const double reach = off_shape * size_of(group);
        group = connected(first, at, [&](Index f, const std::vector<Index>&) {
          return open.contains(f) && is_on(found->curve, f, reach);
        });
        found = group.size() < before ? std::nullopt : shape_of(group);
      }
      tried.insert(group.begin(), group.end());
      if (!found) continue;
      put_on(*found, group);
      for (const Index f : group) open.erase(f);
    }
    faces.assign(open.begin(), open.end());
  }

  std::set<Index> vertices_of(const std::vector<Index>& faces) const {
    std::set<Index> out;
    for (const Index f : faces) out.insert(faces_[f].begin(), faces_[f].end());
    return out;
  }

  /// Whether a face lies along a curve, with all its nodes within `reach`.
  bool is_on(const Curve<D>& curve, Index f, double reach) const {
    std::vector<Point<D>> points, normals;
    for (const Index v : faces_[f]) points.push_back(mesh_.points[v]);
    if (!mesh_.bends.empty()) add_middles({f}, points, normals);
    return is_along(curve, {f}) && std::ranges::all_of(points, [&](const Point<D>& p) {
             const auto off = height<D>(curve, p);
             return off && std::abs(off->distance) <= reach;
           });
  }

  /// Leaves those faces whose group is no shape.
  void fit_groups(std::vector<Index>& faces, Grouping by) {
    std::vector<Index> left;
    for (const std::vector<Index>& group : groups(faces, by)) {
      if (const double off = is_curved(group) ? infinity : off_plane(group); off <= off_shape * size_of(group))
        note(flat_kind(), group, off);
      else if (!fit(group))
        left.insert(left.end(), group.begin(), group.end());
    }
    faces = std::move(left);
  }

  bool is_curved(const std::vector<Index>& faces) const {
    return !curved_.empty() && std::ranges::any_of(faces, [&](Index f) { return curved_[f] != 0; });
  }
  /// Of a second-order file, whose nodes tell it, or by its neighbours.
  bool is_flat(Index f) const { return curved_.empty() ? smooth_.flat[f] != 0 : curved_[f] == 0; }

  using Neighbours = std::map<std::array<Index, D - 1>, std::vector<Index>>;
  Neighbours neighbours(const std::vector<Index>& faces) const {
    Neighbours out;
    for (const Index f : faces)
      for (int tip = 0; tip < D; ++tip) out[joint(f, tip)].push_back(f);
    return out;
  }

  /// The faces that are reached from one through others that belong to it as well.
  /// @param belongs (face, those found so far)
  template <class Belongs>
  std::vector<Index> connected(Index first, const Neighbours& at, const Belongs& belongs) const {
    std::vector<Index> group{first};
    std::set<Index> seen{first};
    for (std::size_t i = 0; i < group.size(); ++i)
      for (int tip = 0; tip < D; ++tip)
        for (const Index g : at.at(joint(group[i], tip)))
          if (!seen.contains(g) && belongs(g, group)) {
            seen.insert(g);
            group.push_back(g);
          }
    return group;
  }

  std::vector<std::vector<Index>> groups(const std::vector<Index>& faces, Grouping by) {
    if (parts_of_.empty()) {
      parts_of_.resize(faces_.size());
      for (std::size_t k = 0; k < mesh_.parts.size(); ++k)
        for (const Index f : mesh_.parts[k].faces) parts_of_[f].push_back(static_cast<Index>(k));
    }
    const Neighbours at = neighbours(faces);
    std::set<Index> open(faces.begin(), faces.end());
    std::vector<std::vector<Index>> out;
    for (const Index first : faces) {
      if (!open.contains(first)) continue;
      std::vector<Index> group = connected(first, at, [&](Index f, const std::vector<Index>&) {
        return open.contains(f) && (by == Grouping::none || is_flat(f) == is_flat(first)) &&
               (by != Grouping::parts || parts_of_[f] == parts_of_[first]);
      });
      for (const Index f : group) open.erase(f);
      out.push_back(std::move(group));
    }
    return out;
  }

  std::array<Index, D - 1> joint(Index f, int tip) const {
    std::array<Index, D - 1> out;
    for (int i = 0; i < D - 1; ++i) out[i] = faces_[f][(tip + 1 + i) % D];
    return sorted(out);
  }

  double off_plane(const std::vector<Index>& piece) const {
    Point<D> n{}, middle{};
    double count = 0;
    for (const Index f : piece) {
      const Point<D> own = unit_normal(mesh_, mesh_.boundary[f]);
      for (int k = 0; k < D; ++k) n[k] += own[k];
      for (const Index v : faces_[f]) {
        for (int k = 0; k < D; ++k) middle[k] += mesh_.points[v][k];
        ++count;
      }
    }
    for (double& x : middle) x /= count;
    const double size = length<D>(n);
    double most = 0;
    for (const Index f : piece)
      for (const Index v : faces_[f])
        most = std::max(most, std::abs(dot(difference<D>(mesh_.points[v], middle), n)) / size);
    return size > 0 ? most : infinity;
  }

  double off_patches(const std::vector<Index>& piece) const {
    double most = 0;
    for (const Index f : piece) most = std::max(most, bulge<D>(smooth_.patches[f]));
    return most;
  }

  void make_smooth(const std::vector<Index>& piece) {
    const double off = off_patches(piece);
    bool any = false;
    for (const Index f : piece) {
      if (bulge<D>(smooth_.patches[f]) <= flat * size_of({f})) continue;
      mesh_.boundary[f].curve = static_cast<Index>(mesh_.curves.size());
      any = true;
    }
    note(any ? "smooth" : "facets", piece, off);
    for (const Index f : piece)
      if (any && mesh_.boundary[f].curve >= 0)
        mesh_.pieces.back().second = std::max(mesh_.pieces.back().second, smooth_.turn[f]);
    if (any) mesh_.curves.push_back({.kind = Curve<D>::Kind::patches});
    patches_ = patches_ || any;
  }

  bool fit(const std::vector<Index>& piece) {
    const auto found = shape_of(piece);
    if (found) put_on(*found, piece);
    return found.has_value();
  }

  std::optional<Recognised<D>> shape_of(const std::vector<Index>& piece) const {
    std::vector<Point<D>> points, normals;
    std::map<Index, Point<D>> at;  // the sum of the normals of faces around a vertex
    for (const Index f : piece)
      for (const Index v : faces_[f]) {
        const Point<D> n = unit_normal(mesh_, mesh_.boundary[f]);
        Point<D>& sum = at[v];
        if (dot(sum, n) < least_common * length<D>(sum)) continue;
        for (int k = 0; k < D; ++k) sum[k] += n[k];
      }
    for (auto& [v, n] : at) {
      const double size = length<D>(n);
      for (double& x : n) x /= size;
      points.push_back(mesh_.points[v]);
      normals.push_back(n);
    }
    if (!mesh_.bends.empty()) add_middles(piece, points, normals);
    const double size = size_of(piece);
    auto found =
        recognise<D>(points, normals, off_shape * size, (surfaces_ == Surfaces::fit ? near : off_shape) * size);
    if (found && !is_along(found->curve, piece)) found.reset();
    return found;
  }

  void put_on(const Recognised<D>& shape, const std::vector<Index>& piece) {
    const auto number = static_cast<Index>(mesh_.curves.size());
    mesh_.curves.push_back(shape.curve);
    for (const Index f : piece) mesh_.boundary[f].curve = number;
    note(name(shape.curve.kind), piece, shape.deviation, &shape.curve);
  }

  /// Of the edges of curved faces.
  void add_middles(const std::vector<Index>& piece, std::vector<Point<D>>& points,
                   std::vector<Point<D>>& normals) const {
    constexpr auto edges = simplex_edges<D>();
    for (const Index f : piece) {
      const Face<D>& face = mesh_.boundary[f];
      const Simplex<D>& element = mesh_.elements[face.element];
      const auto on_face = [&](int i) { return std::ranges::count(face.vertices, element[i]) > 0; };
      for (std::size_t k = 0; k < edges.size(); ++k) {
        if (!on_face(edges[k][0]) || !on_face(edges[k][1])) continue;
        Point<D> p = midpoint<D>(mesh_.points[element[edges[k][0]]], mesh_.points[element[edges[k][1]]]);
        for (int d = 0; d < D; ++d) p[d] += mesh_.bends[face.element][k][d];
        points.push_back(p);
        normals.push_back(unit_normal(mesh_, face));
      }
    }
  }

  static const char* name(CurveKind kind) {
    using enum CurveKind;
    if (kind == round) return D == 2 ? "circle" : "sphere";
    return kind == cylinder ? "cylinder" : kind == cone ? "cone" : "torus";
  }

  /// Whether faces lie along the shape, and it does not turn far over one, or a curved one turns with it: points alone
  /// may be on shapes that they do not stand for.
  bool is_along(const Curve<D>& curve, const std::vector<Index>& piece) const {
    const double cosine = std::cos((D == 2 ? 0.6 : 0.8) * crease_);  // of a side, and of a triangle's longest
    int side = 0;
    return std::ranges::all_of(piece, [&](Index f) {
      for (int i = 0; i < D; ++i) {
        const Point<D>& p = mesh_.points[faces_[f][i]];
        if (is_tip<D>(curve, p, size_of({f}))) continue;
        const auto off = height<D>(curve, p);
        if (!off) return false;
        const double along = dot(off->normal, corner_normal(mesh_, mesh_.boundary[f], i));
        const int here = along > 0 ? 1 : -1;
        if (side == 0) side = here;
        if (here != side || std::abs(along) < cosine) return false;
      }
      return true;
    });
  }

  /// Vertices where shapes and planes meet go to all of them.
  void move_onto_shapes() {
    std::map<Index, std::vector<Index>> faces_at;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (const Index v : faces_[f]) faces_at[v].push_back(static_cast<Index>(f));
    std::vector<Move<D>> moves;
    for (const auto& [v, faces] : faces_at) {
      std::vector<const Curve<D>*> shapes;
      std::vector<Flat<D>> planes;
      double near_by = 0;
      for (const Index f : faces) {
        const Index number = mesh_.boundary[f].curve;
        if (number >= 0 && !mesh_.curves[number].is_shape()) continue;
        near_by = std::max(near_by, size_of({f}));
        if (number >= 0) {
          if (std::ranges::count(shapes, &mesh_.curves[number]) == 0) shapes.push_back(&mesh_.curves[number]);
        } else {
          planes.push_back({mesh_.points[v], unit_normal(mesh_, mesh_.boundary[f])});
        }
      }
      if (shapes.empty()) continue;
      for (const Mirror& mirror : beyond_)
        if (lies_on<D>(mirror, mesh_.points[v])) {
          Point<D> across{};
          across[mirror.axis] = 1;
          planes.push_back({mesh_.points[v], across});
        }
      const Point<D> target = project<D>(shapes, planes, mesh_.points[v], near_by);
      if (length<D>(difference<D>(target, mesh_.points[v])) > 1e-13 * near_by) moves.push_back({v, target});
    }
    move_vertices(mesh_, moves);
  }

  Mesh<D>& mesh_;
  Surfaces surfaces_;
  double crease_;
  std::span<const Mirror> beyond_;
  std::vector<std::array<Index, D>> faces_;
  SmoothBoundary<D> smooth_;
  std::vector<std::uint8_t> curved_;  // per face, of second-order files
  std::vector<std::vector<Index>> parts_of_;
  bool patches_ = false;
};

}  // namespace

template <int D>
void give_geometry(Mesh<D>& mesh, Surfaces surfaces, double crease, std::span<const Mirror> beyond) {
  const bool told = !mesh.bends.empty() && surfaces == Surfaces::automatic;  // inside, too
  Chooser<D>(mesh, surfaces, crease, beyond).run(true);
  if (told || surfaces == Surfaces::facets) return;
  for (const auto& [region, other] : neighbouring_regions(mesh)) {
    Mesh<D> inner;
    inner.points = mesh.points;
    inner.elements = mesh.elements;
    inner.boundary = faces_between(mesh, region, other);
    Chooser<D>(inner, surfaces, crease, beyond).run(false);
    bend_elements(mesh, inner);
    for (SurfacePiece& piece : inner.pieces) {
      piece.kind = "inner " + piece.kind;
      mesh.pieces.push_back(std::move(piece));
    }
  }
}

template void give_geometry(Mesh<2>&, Surfaces, double, std::span<const Mirror>);
template void give_geometry(Mesh<3>&, Surfaces, double, std::span<const Mirror>);

}  // namespace signorini::geometry
