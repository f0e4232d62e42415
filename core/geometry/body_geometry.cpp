#include "core/geometry/body_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/dot.hpp"
#include "core/base/release.hpp"
#include "core/geometry/interfaces.hpp"
#include "core/geometry/vector.hpp"
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

template <int D>
Point<D> unit_normal(const Mesh<D>& mesh, const Face<D>& face) {
  std::array<Point<D>, D> corner;
  for (int i = 0; i < D; ++i) corner[i] = mesh.points[face.vertices[i]];
  return unit<D>(area_normal(corner));
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

/// Of curved elements: see Known. With the bends c of the edges, the derivative along edge ab at its end a is
/// b - a + 4 c_ab, and that of face abc from the middle of ab towards c is c - (a + b) / 2 + 2 c_ac + 2 c_bc - 2 c_ab.
template <int D>
Point<D> curved_normal(const Mesh<D>& mesh, std::size_t f, int tip) {
  const Face<D>& face = mesh.boundary[f];
  const auto bend = [&](int i, int j) { return geometry::bend(mesh, face, i, j); };
  const auto p = [&](int i) { return mesh.points[face.vertices[i]]; };
  if constexpr (D == 2) {
    const Point<D> along = plus<D>(difference<D>(p(1), p(0)), tip == 1 ? 4 : -4, bend(0, 1));
    return unit<D>({along[1], -along[0]});
  } else {
    const int a = (tip + 1) % 3, b = (tip + 2) % 3;
    Point<D> up = difference<D>(p(tip), midpoint<D>(p(a), p(b)));
    up = plus<D>(plus<D>(plus<D>(up, 2, bend(a, tip)), 2, bend(b, tip)), -2, bend(a, b));
    return unit<D>(cross(difference<D>(p(b), p(a)), up));
  }
}

/// The boundary of a body together with its images beyond planes: the faces of the body come first.
template <int D>
struct Continued {
  std::vector<Point<D>> points;
  std::vector<std::array<Index, D>> faces;
  Known<D> known;

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
      if (!known.name.empty()) known.name.push_back(known.name[f]);
      if (known.second_order()) mirror_curved(f, mirror);
    }
  }

  void mirror_curved(std::size_t f, const Mirror& mirror) {
    known.curved.push_back(known.curved[f]);
    auto middle = known.middle[f];
    for (Point<D>& p : middle) p = reflected<D>(mirror, p);
    auto normal = known.normal[f];
    for (Point<D>& n : normal) n[mirror.axis] *= -1;
    if constexpr (D == 3) std::swap(middle[0], middle[1]);
    std::swap(normal[0], normal[1]);
    known.middle.push_back(middle);
    known.normal.push_back(normal);
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
    const bool keeps = !mesh_.bends.empty() && surfaces_ == Surfaces::automatic;
    if (keeps) {
      know_curved_faces();
      mesh_.curves = {{.kind = CurveKind::elements}};  // what is not renumbered below
    } else {
      forget_curves();
    }
    know_names();
    smooth_ = smooth();
    for (const std::vector<Index>& piece : pieces()) choose(piece);
    if (keeps) return keep_elements();
    if (moves) move_onto_shapes();
    if (patches_) mesh_.patches = std::make_shared<const std::vector<CubicPatch<D>>>(std::move(smooth_.patches));
    if (moves) separate_curved_faces(mesh_);
  }

 private:
  void forget_curves() {
    release(mesh_.bends);
    mesh_.curves.clear();
    for (Face<D>& face : mesh_.boundary) face.curve = -1;
  }

  void know_curved_faces() {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Face<D>& face = mesh_.boundary[f];
      known_.curved.push_back(face.curve >= 0 ? 1 : 0);
      auto& middle = known_.middle.emplace_back();
      for (std::size_t k = 0; k < middle.size(); ++k) {
        const int a = D == 2 ? 0 : static_cast<int>(k + 1) % 3, b = D == 2 ? 1 : static_cast<int>(k + 2) % 3;
        middle[k] = plus<D>(midpoint<D>(mesh_.points[face.vertices[a]], mesh_.points[face.vertices[b]]), 1,
                            bend(mesh_, face, a, b));
      }
      auto& normal = known_.normal.emplace_back();
      for (int tip = 0; tip < D; ++tip) normal[tip] = curved_normal(mesh_, f, tip);
    }
  }

  void know_names() {
    std::vector<std::vector<Index>> parts(faces_.size());
    for (std::size_t k = 0; k < mesh_.parts.size(); ++k)
      for (const Index f : mesh_.parts[k].faces) parts[f].push_back(static_cast<Index>(k));
    std::map<std::vector<Index>, Index> number;
    for (const auto& of_face : parts)
      known_.name.push_back(number.try_emplace(of_face, static_cast<Index>(number.size())).first->second);
    if (number.size() < 2) known_.name.clear();  // nothing is told apart
    if (surfaces_ == Surfaces::fit) known_.fit = near;
  }

  SmoothBoundary<D> smooth() const {
    Continued<D> whole{mesh_.points, faces_, known_};
    for (const Mirror& mirror : beyond_) whole.mirror_at(mirror);
    SmoothBoundary<D> out = smooth_boundary<D>(whole.points, whole.faces, crease_, whole.known);
    out.patches.resize(faces_.size());
    out.piece.resize(faces_.size());
    out.pieces = faces_.empty() ? 0 : std::ranges::max(out.piece) + 1;
    return out;
  }

  /// Where all is straight, there is nothing to keep.
  void keep_elements() {
    const auto is_straight = [](const Bends<D>& bends) { return bends == Bends<D>{}; };
    if (std::ranges::none_of(known_.curved, [](std::uint8_t c) { return c != 0; }) &&
        std::ranges::all_of(mesh_.bends, is_straight))
      forget_curves();
  }

  double off_of_elements(const std::vector<Index>& piece) const {
    double most = 0;
    for (const Index f : piece) {
      const Face<D>& face = mesh_.boundary[f];
      const Point<D>&at = mesh_.points[face.vertices[0]], n = unit_normal(mesh_, face);
      for (const Point<D>& p : known_.middle[f]) most = std::max(most, std::abs(dot(difference<D>(p, at), n)));
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
    const bool told = surfaces_ == Surfaces::automatic || surfaces_ == Surfaces::fit;
    if (is_plane(piece)) return note(flat_kind(), piece, off_plane(piece));
    std::map<Index, std::vector<Index>> of_shape, of_plane;
    std::vector<Index> left;
    for (const Index f : piece) {
      const Index shape = told ? smooth_.shape[f] : -1, plane = told ? smooth_.flat[f] : -1;
      (shape >= 0 ? of_shape[shape] : plane >= 0 ? of_plane[plane] : left).push_back(f);
    }
    for (const auto& [shape, faces] : of_shape) put_on(smooth_.shapes[shape], faces);
    for (const auto& [plane, faces] : of_plane) note(flat_kind(), faces, off_plane(faces));
    if (left.empty()) return;
    if (known_.second_order()) return put_on_elements(left);
    if (surfaces_ == Surfaces::facets || surfaces_ == Surfaces::fit) return note("facets", left, off_patches(left));
    make_smooth(left);
  }

  /// What is flat on this side of a plane of symmetry may be one half of a surface that is bent there.
  bool is_plane(const std::vector<Index>& piece) const {
    if (known_.second_order()) return false;
    const double size = size_of(piece);
    const bool may_bend = surfaces_ == Surfaces::automatic || surfaces_ == Surfaces::smooth;
    if (may_bend && !beyond_.empty() && off_patches(piece) > flat * size) return false;
    return off_plane(piece) <= (surfaces_ == Surfaces::fit ? near : off_shape) * size;
  }

  void put_on_elements(const std::vector<Index>& piece) {
    note("second order", piece, off_of_elements(piece));
    for (const Index f : piece)
      if (known_.curved[f] != 0) mesh_.boundary[f].curve = static_cast<Index>(mesh_.curves.size());
    mesh_.curves.push_back({.kind = CurveKind::elements});
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

  void put_on(const Curve<D>& shape, const std::vector<Index>& piece) {
    double deviation = 0;
    const auto add = [&](const Point<D>& p) {
      if (const auto off = height<D>(shape, p)) deviation = std::max(deviation, std::abs(off->distance));
    };
    for (const Index f : piece) {
      for (const Index v : faces_[f]) add(mesh_.points[v]);
      if (known_.second_order()) std::ranges::for_each(known_.middle[f], add);
      mesh_.boundary[f].curve = static_cast<Index>(mesh_.curves.size());
    }
    mesh_.curves.push_back(shape);
    note(name(shape.kind), piece, deviation, &shape);
  }

  static const char* name(CurveKind kind) {
    using enum CurveKind;
    if (kind == round) return D == 2 ? "circle" : "sphere";
    return kind == cylinder ? "cylinder" : kind == cone ? "cone" : "torus";
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
  Known<D> known_;
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
