#include "core/geometry/cgal/surface_distance.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/cgal/nearest.hpp"
#include "core/geometry/cgal/triangle_surface.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

double dot(const Point<3>& a, const Point<3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point<3> cross(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void add(Point<3>& sum, double factor, const Point<3>& a) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += factor * a[k];
}

/// a / |a|, or zero where a is zero.
Point<3> unit(const Point<3>& a) {
  const double l = length<3>(a);
  return l > 0 ? Point<3>{a[0] / l, a[1] / l, a[2] / l} : Point<3>{};
}

/// Signs by the inside of a closed surface, and for an open one by pseudonormals: the faces' normals at an edge, and
/// those weighted by angle at a vertex, tell the side wherever the nearest point lies [Baerentzen and Aanaes 2005].
class SurfaceDistance : public DistanceFunction {
 public:
  explicit SurfaceDistance(const std::string& file) : surface_(file) {
    const auto [low, high] = surface_.box();
    diameter_ = length<3>(difference<3>(high, low));
    vertex_normals_.assign(surface_.points().size(), Point<3>{});
    for (const auto& triangle : surface_.triangles()) {
      const auto p = corners(triangle);
      face_normals_.push_back(unit(cross(difference<3>(p[1], p[0]), difference<3>(p[2], p[0]))));
      for (std::size_t k = 0; k < 3; ++k) {
        const Point<3> u = difference<3>(p[(k + 1) % 3], p[k]), v = difference<3>(p[(k + 2) % 3], p[k]);
        add(vertex_normals_[triangle[k]], std::atan2(length<3>(cross(u, v)), dot(u, v)), face_normals_.back());
      }
    }
  }

  Distance at(const double* point, const double*, Status& status) const noexcept override {
    try {
      return distance({point[0], point[1], point[2]});
    } catch (const std::exception& error) {
      status.fail(static_cast<int>(Exit::input), error.what());
      return {};
    }
  }

 private:
  Distance distance(const Point<3>& p) const {
    for (const double x : p)
      if (!std::isfinite(x)) input_error(surface_.file(), "distance asked for at a point that is not finite");
    const Index t = surface_.nearest_triangle(p);
    const auto weights = nearest_weights(p, corners(surface_.triangles()[t]));
    const Point<3> offset = offset_of(p, t, weights);
    const double d = length<3>(offset);
    const Point<3> outer = pseudonormal(t, weights);
    const bool behind = surface_.closed() ? surface_.inside(p) : dot(offset, outer) < 0;
    const double sign = behind ? -1 : 1;
    Point<3> n = unit(d > 1e-12 * diameter_ ? offset : outer);
    if (d > 1e-12 * diameter_)
      for (double& x : n) x *= sign;
    return {sign * d, {n[0], n[1], n[2]}};
  }

  /// From the nearest point to p. Next to the inside of a face along its normal, which is exact however small it is.
  Point<3> offset_of(const Point<3>& p, Index t, const std::array<double, 3>& weights) const {
    const auto corner = corners(surface_.triangles()[t]);
    Point<3> offset{};
    if (std::count(weights.begin(), weights.end(), 0.0) == 0)
      add(offset, dot(difference<3>(p, corner[0]), face_normals_[t]), face_normals_[t]);
    else
      for (std::size_t k = 0; k < 3; ++k) add(offset, weights[k], difference<3>(p, corner[k]));
    return offset;
  }

  Point<3> pseudonormal(Index t, const std::array<double, 3>& weights) const {
    const auto zeros = std::count(weights.begin(), weights.end(), 0.0);
    if (zeros == 2) {
      const auto k = std::find(weights.begin(), weights.end(), 1.0) - weights.begin();
      return vertex_normals_[surface_.triangles()[t][k]];
    }
    Point<3> sum = face_normals_[t];
    if (zeros == 1) {
      const auto edge = std::find(weights.begin(), weights.end(), 0.0) - weights.begin();
      if (const Index other = surface_.neighbours()[t][edge]; other >= 0) add(sum, 1, face_normals_[other]);
    }
    return sum;
  }

  std::array<Point<3>, 3> corners(const std::array<Index, 3>& triangle) const {
    const auto& points = surface_.points();
    return {points[triangle[0]], points[triangle[1]], points[triangle[2]]};
  }

  TriangleSurface surface_;
  double diameter_;
  std::vector<Point<3>> face_normals_, vertex_normals_;
};

}  // namespace

std::unique_ptr<DistanceFunction> surface_distance(const std::string& file) {
  return std::make_unique<SurfaceDistance>(file);
}

}  // namespace signorini::geometry
