#include "core/fem/recovery/cut_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "core/base/dot.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

/// Barycentric coordinates of the centroids of n or n^2 equal parts of a face.
template <int D>
std::vector<std::array<double, D>> centroids(int n) {
  std::vector<std::array<double, D>> all;
  for (int i = 0; i < n; ++i)
    if constexpr (D == 2) {
      all.push_back({(i + 0.5) / n, 1 - (i + 0.5) / n});
    } else {
      for (int j = 0; i + j < n; ++j)
        for (int k = 1; k <= 2 && i + j + k <= n; ++k)
          all.push_back({(i + k / 3.0) / n, (j + k / 3.0) / n, 1 - (i + j + 2 * k / 3.0) / n});
    }
  return all;
}

/// Equal parts along an edge of a face that is picked: the more the fewer faces there are.
template <int D>
int parts_of_picked(std::size_t faces) {
  const double samples = 1e5 / static_cast<double>(faces);
  return D == 2 ? static_cast<int>(std::clamp(samples, 4.0, 256.0))
                : static_cast<int>(std::clamp(std::sqrt(samples), 2.0, 16.0));
}

/// A face of the coarsest mesh, at whose points an expression is asked for.
template <int D>
class CoarsestFace {
 public:
  CoarsestFace(const Mesh<D>& mesh, Index number)
      : mesh_(mesh), face_{.vertices = coarsest_face(mesh, number), .element = -1} {
    const Index curve = mesh.boundary[number * faces_per_coarsest(mesh)].curve;
    if (curve >= 0) curve_ = &mesh.curves[curve];
    if (curve_ && curve_->kind == Curve<D>::Kind::patches) patch_ = &(*mesh.patches)[number];
    normal_ = area_normal(mesh, face_);
    measure_ = normalise(normal_);
  }

  double measure() const { return measure_; }
  const Point<D>& normal() const { return normal_; }
  const std::array<Index, D>& vertices() const { return face_.vertices; }
  bool curved() const { return patch_ || (curve_ && curve_->is_shape()); }

  /// The part of its measure on which the expression holds nowhere near.
  double without(const Field& expression, double t, const std::vector<std::array<double, D>>& samples) const {
    const auto fails = [&](const std::array<double, D>& barycentric) {
      return !holds_near(expression, t, barycentric);
    };
    return measure_ * static_cast<double>(std::ranges::count_if(samples, fails)) / static_cast<double>(samples.size());
  }

  /// The part of its measure on which the expression holds.
  double where(const Field& expression, double t) const {
    static const auto few = centroids<D>(2), many = centroids<D>(D == 2 ? 256 : 16);
    const auto holds = [&](const std::array<double, D>& barycentric) {
      return expression(site<D>(point(barycentric), t, normal_)) != 0;
    };
    if (!at_a_corner(expression, t) && std::ranges::none_of(few, holds)) return 0;
    return measure_ * static_cast<double>(std::ranges::count_if(many, holds)) / static_cast<double>(many.size());
  }

 private:
  bool at_a_corner(const Field& expression, double t) const {
    return std::ranges::any_of(face_.vertices,
                               [&](Index v) { return expression(site<D>(mesh_.points[v], t, normal_)) != 0; });
  }

  /// At the point, or as little off the face as rounding may have taken it.
  bool holds_near(const Field& expression, double t, const std::array<double, D>& barycentric) const {
    constexpr double rounding = 1e-9;
    const double off = rounding * std::pow(measure_, 1.0 / (D - 1));
    return std::ranges::any_of(std::array{0.0, off, -off}, [&](double distance) {
      Point<D> x = point(barycentric);
      for (int i = 0; i < D; ++i) x[i] += distance * normal_[i];
      return expression(site<D>(x, t, normal_)) != 0;
    });
  }

  /// Exactly on the plane of a face that is orthogonal to an axis.
  Point<D> point(const std::array<double, D>& barycentric) const {
    if (patch_) return patch_->at(barycentric);
    Point<D> x{};
    for (int i = 0; i < D; ++i) {
      const auto at = [&](int a) { return mesh_.points[face_.vertices[a]][i]; };
      bool same = true;
      for (int a = 0; a < D; ++a) {
        x[i] += barycentric[a] * at(a);
        same = same && at(a) == at(0);
      }
      if (same) x[i] = at(0);
    }
    return curve_ ? project<D>(*curve_, x) : x;
  }

  const Mesh<D>& mesh_;
  Face<D> face_;
  const Curve<D>* curve_ = nullptr;
  const CubicPatch<D>* patch_ = nullptr;
  Point<D> normal_;
  double measure_;
};

constexpr double at_an_edge = 0.7;  // the cosine of about 45 degrees, at which faces meet at an edge

/// Parts of the boundary of the coarsest mesh that no sharp edge divides.
template <int D>
class Pieces {
 public:
  explicit Pieces(const Mesh<D>& mesh)
      : parent_(mesh.boundary.size() / static_cast<std::size_t>(faces_per_coarsest(mesh))) {
    std::iota(parent_.begin(), parent_.end(), 0);
    std::map<std::array<Index, D - 1>, Index> first;
    std::vector<Point<D>> normal;
    for (Index f = 0; f < std::ssize(parent_); ++f) {
      const CoarsestFace<D> face(mesh, f);
      normal.push_back(face.normal());
      for (int opposite = 0; opposite < D; ++opposite) {
        std::array<Index, D - 1> ridge;
        for (int k = 0, i = 0; k < D; ++k)
          if (k != opposite) ridge[i++] = face.vertices()[k];
        const auto [entry, is_new] = first.try_emplace(sorted(ridge), f);
        if (!is_new && dot(normal[f], normal[entry->second]) > at_an_edge) parent_[root(f)] = root(entry->second);
      }
    }
  }

  /// A face that stands for the piece of a face.
  Index root(Index f) const {
    while (parent_[f] != f) f = parent_[f];
    return f;
  }

 private:
  std::vector<Index> parent_;
};

/// Vertices where faces meet at an angle as small as those of facets that stand for a curved surface.
template <int D>
class FacettedVertices {
 public:
  explicit FacettedVertices(const Mesh<D>& mesh) : normal_(mesh.points.size()), is_(mesh.points.size(), false) {
    const auto faces = static_cast<Index>(mesh.boundary.size()) / faces_per_coarsest(mesh);
    for (Index f = 0; f < faces; ++f) {
      const CoarsestFace<D> face(mesh, f);
      for (const Index v : face.vertices()) add(v, face.normal());
    }
  }

  bool has_any(const std::array<Index, D>& vertices) const {
    return std::ranges::any_of(vertices, [&](Index v) { return bool{is_[v]}; });
  }

 private:
  void add(Index v, const Point<D>& normal) {
    constexpr double flat = 1 - 1e-10;  // of about a thousandth of a degree
    double cosine = 0;
    for (int i = 0; i < D; ++i) cosine += normal_[v][i] * normal[i];
    if (cosine > at_an_edge && cosine < flat) is_[v] = true;
    normal_[v] = normal;
  }

  std::vector<Point<D>> normal_;  // of the face seen last; zero before
  std::vector<bool> is_;
};

// Part of a face beside the one that is meant which an expression such as z > 0.99 for z = 1 holds on as well.
constexpr double few_missed = 0.05;

template <int D>
CutSelection cut(const Mesh<D>& mesh, const Selection& selection, const FacettedVertices<D>& facetted,
                 const Pieces<D>& pieces, double t) {
  CutSelection out{&selection, 0, 0, 0};
  const Index children = faces_per_coarsest(mesh);
  const std::vector<Index> among = select_faces(mesh, {selection.part, {}, selection.origin}, t),
                           picked = select_faces(mesh, selection, t);
  const auto samples = centroids<D>(parts_of_picked<D>(picked.size() / static_cast<std::size_t>(children)));
  struct Measure {
    double all = 0, picked = 0, missed = 0;
  };
  std::map<Index, Measure> of_piece;
  auto next = picked.begin();
  for (auto f = among.begin(); f != among.end(); f += children) {
    const CoarsestFace<D> face(mesh, *f / children);
    Measure& piece = of_piece[pieces.root(*f / children)];
    piece.all += face.measure();
    if (next != picked.end() && *next == *f) {
      out.picked += face.measure();
      piece.picked += face.measure();
      if (face.curved() || !facetted.has_any(face.vertices())) out.wrong += face.without(*selection.where, t, samples);
      next += children;
    } else {
      piece.missed += face.where(*selection.where, t);
    }
  }
  for (const auto& [root, piece] : of_piece)
    if (piece.picked > 0 || piece.missed > few_missed * piece.all) out.missed += piece.missed;
  return out;
}

}  // namespace

template <int D, int B>
std::vector<CutSelection> cut_selections(const Mesh<D>& mesh, const Model<B>& model) {
  std::vector<CutSelection> out;
  std::optional<FacettedVertices<D>> facetted;
  std::optional<Pieces<D>> pieces;
  const auto add = [&](const Selection& selection) {
    if (!selection.where || selection.where->origin().empty()) return;  // the program's own is of whole faces
    if (!facetted) facetted.emplace(mesh), pieces.emplace(mesh);
    const CutSelection found = cut(mesh, selection, *facetted, *pieces, model.t);
    if (found.missed > 0 || found.wrong > 0) out.push_back(found);
  };
  for (const Fix<B>& fix : model.fixes) add(fix.on);
  for (const RigidPart<B>& part : model.rigid) add(part.on);
  for (const Load<B>& load : model.loads)
    if (load.on) add(*load.on);
  for (const Spring<B>& spring : model.springs) add(spring.on);
  for (const ObstacleTerm<B>& term : model.obstacles)
    if (term.on) add(*term.on);
  return out;
}

template std::vector<CutSelection> cut_selections(const Mesh<2>&, const Model<1>&);
template std::vector<CutSelection> cut_selections(const Mesh<3>&, const Model<1>&);
template std::vector<CutSelection> cut_selections(const Mesh<2>&, const Model<2>&);
template std::vector<CutSelection> cut_selections(const Mesh<3>&, const Model<3>&);

}  // namespace signorini
