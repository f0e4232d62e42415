#include "core/fem/cut_faces.hpp"

#include <algorithm>
#include <numeric>

#include "core/fem/element.hpp"
#include "core/fem/select.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/curve.hpp"

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

/// A face of the coarsest mesh, at whose points an expression is asked for.
template <int D>
class CoarsestFace {
 public:
  CoarsestFace(const Mesh<D>& mesh, Index number)
      : mesh_(mesh), face_{.vertices = coarsest_face(mesh, number), .element = -1} {
    face_.curve = mesh.boundary[number * faces_per_coarsest(mesh)].curve;
    normal_ = area_normal(mesh, face_);
    measure_ = normalise(normal_);
  }

  double measure() const { return measure_; }

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

  Point<D> point(const std::array<double, D>& barycentric) const {
    Point<D> x{};
    for (int a = 0; a < D; ++a)
      for (int i = 0; i < D; ++i) x[i] += barycentric[a] * mesh_.points[face_.vertices[a]][i];
    return face_.curve < 0 ? x : project<D>(mesh_.curves[face_.curve], x);
  }

  const Mesh<D>& mesh_;
  Face<D> face_;
  Point<D> normal_;
  double measure_;
};

template <int D>
CutSelection cut(const Mesh<D>& mesh, const Selection& selection, double t) {
  CutSelection out{&selection, 0, 0};
  const Index children = faces_per_coarsest(mesh);
  const std::vector<Index> among = select_faces(mesh, {selection.part, {}, selection.origin}, t),
                           picked = select_faces(mesh, selection, t);
  auto next = picked.begin();
  for (auto f = among.begin(); f != among.end(); f += children) {
    const CoarsestFace<D> face(mesh, *f / children);
    if (next != picked.end() && *next == *f) {
      out.picked += face.measure();
      next += children;
    } else {
      out.missed += face.where(*selection.where, t);
    }
  }
  return out;
}

}  // namespace

template <int D, int B>
std::vector<CutSelection> cut_selections(const Mesh<D>& mesh, const Model<B>& model) {
  std::vector<CutSelection> out;
  const auto add = [&](const Selection& selection) {
    if (!selection.where) return;
    if (const CutSelection found = cut(mesh, selection, model.t); found.missed > 0) out.push_back(found);
  };
  for (const Fix<B>& fix : model.fixes) add(fix.on);
  for (const Load<B>& load : model.loads)
    if (load.on) add(*load.on);
  for (const ObstacleTerm<B>& term : model.obstacles)
    if (term.on) add(*term.on);
  return out;
}

template std::vector<CutSelection> cut_selections(const Mesh<2>&, const Model<1>&);
template std::vector<CutSelection> cut_selections(const Mesh<3>&, const Model<1>&);
template std::vector<CutSelection> cut_selections(const Mesh<2>&, const Model<2>&);
template std::vector<CutSelection> cut_selections(const Mesh<3>&, const Model<3>&);

}  // namespace signorini
