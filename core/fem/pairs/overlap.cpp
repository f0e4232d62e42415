#include "core/fem/pairs/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/nearest_on_face.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/mesh/point_tree.hpp"
#include "core/mortar/face_frame.hpp"

namespace signorini {
namespace {

// Faces are equally near up to this part of the distance: those at an edge or a vertex that is the nearest point.
constexpr double as_near = 1e-9;
// A vertex is not behind a face whose nearest point is so much farther away than its plane: in the corner of a cube it
// is farther by the square root of 3.
constexpr double beside = 1.8;

// A direction that leads out of a face by less than this part of itself leads along it.
constexpr double along = 1e-9;
// So far from its corners, beside its size, points are inside a piece, whatever surfaces meet at these.
constexpr double pulled_in = 1e-6;

template <int D>
using Box = typename PointTree<D>::Box;
template <int D>
using Corners = std::array<Point<D>, D>;

template <int D>
Corners<D> corners_of(const Mesh<D>& mesh, std::span<const Point<D>> points, Index face) {
  Corners<D> out;
  for (int i = 0; i < D; ++i) out[i] = points[mesh.boundary[face].vertices[i]];
  return out;
}

template <int D>
Box<D> box_around(std::span<const Point<D>> points) {
  Box<D> out{points[0], points[0]};
  for (const Point<D>& x : points)
    for (int k = 0; k < D; ++k) out.low[k] = std::min(out.low[k], x[k]), out.high[k] = std::max(out.high[k], x[k]);
  return out;
}

/// Faces of a body to be asked which is nearest, and what stands in a way.
template <int D>
class FaceTree {
 public:
  FaceTree(const Mesh<D>& mesh, std::span<const Point<D>> points, std::span<const Index> faces) : faces_(faces) {
    for (const Index f : faces) {
      const Corners<D>& corner = corner_.emplace_back(corners_of<D>(mesh, points, f));
      normalise(normal_.emplace_back(area_normal(corner)));
      const Box<D> box = box_around<D>(corner);
      middle_.push_back(midpoint<D>(box.low, box.high));
      half_.push_back(difference<D>(box.high, middle_.back()));
    }
    std::vector<Index> numbers(faces.size());
    std::iota(numbers.begin(), numbers.end(), Index{0});
    tree_.emplace(middle_, half_, std::move(numbers));
  }

  const PointTree<D>& tree() const { return *tree_; }
  Index face(Index k) const { return faces_[k]; }
  const Corners<D>& corner(Index k) const { return corner_[k]; }
  const Point<D>& normal(Index k) const { return normal_[k]; }

  struct Nearest {
    Index face = -1;
    double distance = infinity;
    double height = 0;  ///< in front of the face; negative: behind
  };

  /// Of faces that are equally near the one that x is least beside: its side is the one that counts.
  Nearest nearest(const Point<D>& x) const {
    Nearest out;
    const auto near = [&](const Box<D>& box) {
      const double limit = out.distance * (1 + as_near);
      return PointTree<D>::squared_distance(box, x) <= limit * limit;
    };
    tree_->search_nearest(x, near, [&](Index k) {
      const double far = length<D>(difference<D>(x, nearest_on_face(corner_[k], x)));
      if (far > out.distance * (1 + as_near)) return;
      const double height = dot(difference<D>(x, corner_[k][0]), normal_[k]);
      if (far < out.distance * (1 - as_near) || std::abs(height) > std::abs(out.height))
        out = {faces_[k], std::min(far, out.distance), height};
    });
    return out;
  }

  /// Whether a face crosses the way from a to b between its ends, which may lie on faces.
  /// @param small rounding of positions
  bool blocked(const Point<D>& a, const Point<D>& b, double small) const {
    bool found = false;
    const Point<D> way = difference<D>(b, a);
    const auto meets = [&](const Box<D>& box) { return !found && on_way(box, a, way, small); };
    tree_->search(meets, [&](Index k) {
      if (found) return;
      const double from = dot(difference<D>(a, corner_[k][0]), normal_[k]);
      const double to = dot(difference<D>(b, corner_[k][0]), normal_[k]);
      if (std::min(std::abs(from), std::abs(to)) <= small || (from < 0) == (to < 0)) return;
      Point<D> x = a;
      for (int i = 0; i < D; ++i) x[i] += from / (from - to) * way[i];
      found = length<D>(difference<D>(x, nearest_on_face(corner_[k], x))) <= small;
    });
    return found;
  }

 private:
  static bool on_way(const Box<D>& box, const Point<D>& a, const Point<D>& way, double small) {
    double first = 0, last = 1;
    for (int k = 0; k < D; ++k) {
      const double low = box.low[k] - small - a[k], high = box.high[k] + small - a[k];
      if (std::abs(way[k]) <= small) {
        if (std::max(0.0, way[k]) < low || std::min(0.0, way[k]) > high) return false;
        continue;
      }
      first = std::max(first, std::min(low / way[k], high / way[k]));
      last = std::min(last, std::max(low / way[k], high / way[k]));
    }
    return first <= last;
  }

  std::span<const Index> faces_;
  std::vector<Corners<D>> corner_;
  std::vector<Point<D>> normal_, middle_, half_;
  std::optional<PointTree<D>> tree_;
};

/// Touching faces that reach into the box of a body, the longest first.
template <int D>
std::vector<Index> faces_in_box(const Mesh<D>& mesh, std::span<const Point<D>> points, const std::vector<Index>& faces,
                                const Box<D>& box, double small) {
  std::vector<Index> out;
  for (const Index f : faces) {
    const Box<D> own = box_around<D>(corners_of<D>(mesh, points, f));
    bool inside = true;
    for (int k = 0; k < D; ++k) inside = inside && own.high[k] > box.low[k] + small && own.low[k] < box.high[k] - small;
    if (inside) out.push_back(f);
  }
  std::ranges::stable_sort(out, [&](Index a, Index b) {
    return longest_edge(mesh, mesh.boundary[a]) > longest_edge(mesh, mesh.boundary[b]);
  });
  return out;
}

/// Visits the parts of faces inside a body. From there the way back from the face leads out of the body through one of
/// its faces, without crossing any other one: whether a point is inside needs no decision at edges and vertices, where
/// surfaces may coincide.
template <int D>
class PartsInside {
 public:
  static constexpr int K = D - 1;
  using Frame = mortar::FaceFrame<D>;
  using Piece = mortar::Piece<K>;

  PartsInside(const FaceTree<D>& body, double small) : body_(body), small_(small) {}

  /// Calls visit(point) at corners of the part of a flat face that is inside the body, and between these;
  /// `worth(face, longest way out)` says whether to look at what leads out through a face of the body.
  template <class Worth, class Visit>
  void visit(const Corners<D>& corner, const Worth& worth, const Visit& visit) const {
    Point<D> normal = area_normal(corner);
    normalise(normal);
    const Frame frame(corner, normal);
    const auto behind = [&](const Box<D>& box) { return reaches_behind(frame, box); };
    body_.tree().search(behind, [&](Index k) {
      if (dot(normal, body_.normal(k)) >= -along) return;
      mortar::Affine<K> out = frame.height;
      const Piece piece = seen(frame, body_.corner(k), out);
      if (piece.empty()) return;
      double longest = 0;
      for (int i = 0; i < piece.count; ++i) longest = std::max(longest, frame.size * out(piece.corner[i]));
      if (longest > small_ && worth(body_.face(k), longest)) visit_piece(frame, piece, out, visit);
    });
  }

 private:
  bool reaches_behind(const Frame& frame, const Box<D>& box) const {
    for (int k = 0; k < D; ++k) {
      double middle = 0, half = 0, low = infinity, high = -infinity;
      for (int i = 0; i < D; ++i) {
        middle += frame.axis[k][i] * (0.5 * (box.low[i] + box.high[i]) - frame.origin[i]);
        half += std::abs(frame.axis[k][i]) * (0.5 * (box.high[i] - box.low[i]));
        const double at = k < K ? frame.corner[i][std::min(k, K - 1)] : frame.corner_height[i];
        low = std::min(low, at), high = std::max(high, at);
      }
      if (middle - half > high || (k < K && middle + half < low)) return false;
    }
    return true;
  }

  /// What lies in front of a face of the body, seen from behind the frame's face.
  /// @param out how far it is from there, in units of the frame
  Piece seen(const Frame& frame, const Corners<D>& other, mortar::Affine<K>& out) const {
    std::array<Point<K>, D> corner;
    std::array<double, D> height;
    for (int i = 0; i < D; ++i) height[i] = frame.map(other[i], corner[i]);
    const auto shape = mortar::barycentric<K>(corner);
    for (int i = 0; i < D; ++i) out.add(-height[i], shape[i]);
    Piece piece(frame.corner);
    for (const auto& f : shape) piece = clipped(piece, f);
    piece = clipped(piece, out);
    return frame.size * width(piece) > small_ ? piece : Piece{};
  }

  /// Along surfaces that coincide rounding leaves strips.
  static double width(const Piece& piece) {
    double longest = 0;
    for (int i = 0; i < piece.count; ++i) {
      const Point<K> across = difference<K>(piece.corner[i], piece.corner[0]);
      longest = std::max(longest, std::sqrt(dot(across, across)));
    }
    if constexpr (K == 1) return longest;
    return longest > 0 ? measure(piece) / longest : 0;
  }

  template <class Visit>
  void visit_piece(const Frame& frame, const Piece& piece, const mortar::Affine<K>& out, const Visit& visit) const {
    Point<K> middle{};
    for (int i = 0; i < piece.count; ++i)
      for (int k = 0; k < K; ++k) middle[k] += piece.corner[i][k] / piece.count;
    const auto towards_middle = [&](const Point<K>& y, double part) {
      Point<K> z;
      for (int k = 0; k < K; ++k) z[k] = y[k] + part * (middle[k] - y[k]);
      return z;
    };
    const auto ask = [&](const Point<K>& y, const Point<K>& inner) {
      const double h = frame.height(inner);
      if (body_.blocked(frame.place(inner, h), frame.place(inner, h - out(inner)), small_)) return;
      visit(frame.place(y, frame.height(y)));
    };
    ask(middle, middle);
    for (int i = 0; i < piece.count; ++i) {
      const Point<K>& y = piece.corner[i];
      ask(y, towards_middle(y, pulled_in));
      ask(towards_middle(y, 0.5), towards_middle(y, 0.5));
    }
  }

  const FaceTree<D>& body_;
  const double small_;
};

template <int D>
std::vector<Point<D>> points_of_faces(const Mesh<D>& mesh, std::span<const Point<D>> points,
                                      const std::vector<Index>& faces) {
  std::vector<Point<D>> out;
  for (const Index f : faces)
    for (const Index v : mesh.boundary[f].vertices) out.push_back(points[v]);
  return out;
}

/// What positions in a box are known up to.
/// Lengths of less than this are rounding.
template <int D>
double rounding_in(const Box<D>& box) {
  double most = 0;
  for (int k = 0; k < D; ++k) most = std::max({most, std::abs(box.low[k]), std::abs(box.high[k])});
  return rounding_of_differences * most;
}

}  // namespace

template <int D>
Overlap<D> find_overlap(const Mesh<D>& mesh, std::span<const Point<D>> points, const BodyFaces& slave,
                        const BodyFaces& master, const std::function<double(const Point<D>&, Index)>& added) {
  Overlap<D> out;
  const auto look = [&](const BodyFaces& one, const BodyFaces& other, bool of_slave) {
    const Box<D> box = box_around<D>(points_of_faces<D>(mesh, points, other.all));
    const double small = rounding_in<D>(box);
    const std::vector<Index> faces = faces_in_box<D>(mesh, points, one.touching, box, small);
    if (faces.empty()) return;
    const FaceTree<D> body(mesh, points, other.all), touching(mesh, points, other.touching);
    const PartsInside<D> parts(body, small);
    const auto worth = [&](Index way_out, double longest) {  // the nearest face is no farther than one that may touch
      return added || longest > out.depth * (1 + as_near) || !std::ranges::binary_search(other.touching, way_out);
    };
    for (const Index face : faces)
      parts.visit(corners_of<D>(mesh, points, face), worth, [&](const Point<D>& x) {
        const auto found = touching.nearest(x);
        const Index slave_face = of_slave ? face : found.face;
        // In a corner the faces that meet there count, not the way to the corner; and none that it is not behind.
        if (found.distance > beside * std::abs(found.height)) return;
        const double depth = std::abs(found.height) - (added ? added(x, slave_face) : 0);
        if (depth > out.depth * (1 + as_near)) out = {depth, x, slave_face};
      });
  };
  look(slave, master, true);
  look(master, slave, false);
  return out;
}

template Overlap<2> find_overlap<2>(const Mesh<2>&, std::span<const Point<2>>, const BodyFaces&, const BodyFaces&,
                                    const std::function<double(const Point<2>&, Index)>&);
template Overlap<3> find_overlap<3>(const Mesh<3>&, std::span<const Point<3>>, const BodyFaces&, const BodyFaces&,
                                    const std::function<double(const Point<3>&, Index)>&);

}  // namespace signorini
