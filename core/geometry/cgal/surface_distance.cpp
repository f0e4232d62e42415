#include "core/geometry/cgal/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/geometry/cgal/nearest.hpp"
#include "core/geometry/cgal/patch_foot.hpp"
#include "core/geometry/cgal/shape_foot.hpp"
#include "core/geometry/cgal/triangle_surface.hpp"
#include "core/geometry/faceted_distance.hpp"
#include "core/geometry/smooth_boundary.hpp"
#include "core/mesh/chords.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

void add(Point<3>& sum, double factor, const Point<3>& a) {
  for (std::size_t k = 0; k < 3; ++k) sum[k] += factor * a[k];
}

/// a / |a|, or zero where a is zero.
Point<3> unit(const Point<3>& a) {
  const double l = length<3>(a);
  return l > 0 ? Point<3>{a[0] / l, a[1] / l, a[2] / l} : Point<3>{};
}

/// The point of a triangle, or of the patch on it, nearest to another point.
struct Foot {
  Index triangle;
  Point<3> at;
  Point<3> offset;  ///< from there to the point
  double distance;
  bool perpendicular;  ///< the offset is along the triangle's normal
  Point<3> normal;     ///< of unit length
  std::array<double, 3> weights;
};

/// Signs by the inside of a closed surface, and for an open one by pseudonormals: the faces' normals at an edge, and
/// those weighted by angle at a vertex, tell the side wherever the nearest point lies [Baerentzen and Aanaes 2005].
/// Normals are the gradient of the distance, on the surface pseudonormals. Where several points of the surface are
/// nearest, on the bisector of a valley, -u'n_k <= d for each of them, and so for the mean: with its unit vector n the
/// distance is that along n, longer than d. What is within rounding counts as the same.
///
/// On a smooth surface the same holds for its patches, and for shapes that these stand for. Next to it, where the
/// triangles do not tell the inside, signs are those of an open surface.
class SurfaceDistance : public FacetedDistance {
 public:
  SurfaceDistance(const std::string& file, std::optional<double> crease)
      : surface_(file, TriangleSurface::Coordinates::centred) {
    const auto [low, high] = surface_.box();
    const double diameter = length<3>(difference<3>(high, low));
    rounding_ = 16 * std::numeric_limits<double>::epsilon() * (diameter + length<3>(surface_.units().origin));
    same_ = std::max(1e-9 * diameter, rounding_);
    for (std::size_t t = 0; t < surface_.triangles().size(); ++t) {
      const auto p = corners(static_cast<Index>(t));
      face_normals_.push_back(unit(cross(difference<3>(p[1], p[0]), difference<3>(p[2], p[0]))));
    }
    if (crease) smooth(*crease);
  }

  double sagitta_at(const double* point) const noexcept override {
    if (!patches_.empty()) return 0;
    try {
      const Point<3> p = difference<3>({point[0], point[1], point[2]}, surface_.units().origin);
      const Index t = surface_.nearest_triangle(p);
      double largest = 0;
      for (std::size_t k = 0; k < 3; ++k)
        if (const Index other = surface_.neighbours()[t][k]; other >= 0) {
          const Point<3>&a = face_normals_[t], &b = face_normals_[other];
          largest = std::max(largest, sagitta(std::atan2(length<3>(cross(a, b)), dot(a, b)),
                                              std::min(height(t, other), height(other, t))));
        }
      return largest;
    } catch (const std::exception&) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }

  SmoothedOver smoothed_at(const double* point) const noexcept override {
    if (patches_.empty()) return {};
    try {
      const Index t = surface_.nearest_triangle(difference<3>({point[0], point[1], point[2]}, surface_.units().origin));
      return {bulge_[t], turn_[t]};
    } catch (const std::exception&) {
      return {};
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
  Distance distance(const Point<3>& given) const {
    for (const double x : given)
      if (!std::isfinite(x)) input_error(surface_.file(), "distance asked for at a point that is not finite");
    const Point<3> p = difference<3>(given, surface_.units().origin);
    const std::vector<Foot> feet = nearest(p);
    const Point<3> outer = pseudonormal(feet);
    const bool told = surface_.closed() && (patches_.empty() || feet[0].distance > most_bulge_);
    const bool behind = told ? surface_.inside(p) : dot(feet[0].offset, outer) < 0;
    const double sign = behind ? -1 : 1;
    if (feet[0].distance <= same_) return {sign * feet[0].distance, {outer[0], outer[1], outer[2]}};
    const Point<3> mean = gradient(feet, sign), n = unit(mean);
    return {sign * feet[0].distance / length<3>(mean), {n[0], n[1], n[2]}};
  }

  /// On the triangles that are no farther away than the nearest one, next to the surface on all that are within what
  /// counts as the same point. Nearest first; where several are at one distance, perpendicular ones.
  std::vector<Foot> nearest(const Point<3>& p) const {
    std::vector<Foot> feet;
    double least = infinity;
    const auto reach = [&] { return least + (least > same_ ? rounding_ : same_); };
    surface_.approach(p, [&](Index t) {
      Foot found = foot(p, t);
      if (!is_flat(t)) {
        if (found.distance - bulge_[t] > reach()) return reach() + most_bulge_;
        found = curved_foot(p, found);
      }
      least = std::min(least, found.distance);
      if (found.distance <= reach()) feet.push_back(found);
      return reach() + most_bulge_;
    });
    std::erase_if(feet, [limit = reach()](const Foot& f) { return f.distance > limit; });
    const auto near = [&](const Foot& f) { return f.distance <= least + rounding_; };
    std::ranges::stable_sort(feet, [&](const Foot& a, const Foot& b) {
      if (near(a) && near(b) && a.perpendicular != b.perpendicular) return a.perpendicular;
      return a.distance < b.distance;
    });
    return feet;
  }

  Foot foot(const Point<3>& p, Index t) const {
    const auto corner = corners(t);
    const auto weights = nearest_weights(p, corner);
    Point<3> offset{}, at = p;
    for (std::size_t k = 0; k < 3; ++k) add(offset, weights[k], difference<3>(p, corner[k]));
    // Along the normal it is exact however small it is.
    const double height = dot(difference<3>(p, corner[0]), face_normals_[t]);
    Point<3> aside = offset;
    add(aside, -height, face_normals_[t]);
    const bool perpendicular = length<3>(aside) <= rounding_;
    if (perpendicular) add(offset = {}, height, face_normals_[t]);
    add(at, -1, offset);
    return {t, at, offset, length<3>(offset), perpendicular, face_normals_[t], weights};
  }

  bool is_flat(Index t) const { return patches_.empty() || bulge_[t] <= rounding_; }

  /// On the patch or the shape that it is of, from that on its triangle.
  Foot curved_foot(const Point<3>& p, const Foot& flat) const {
    const PatchFoot on = shape_[flat.triangle] >= 0 ? nearest_on_shape(shape_patch(flat.triangle), p, flat.weights)
                                                    : nearest_on_patch(patches_[flat.triangle], p, flat.weights);
    const Point<3> offset = difference<3>(p, on.at);
    return {flat.triangle, on.at, offset, length<3>(offset), on.inside, unit(on.normal), on.weights};
  }

  ShapePatch shape_patch(Index t) const {
    ShapePatch out{patches_[t], shapes_[shape_[t]], side_of(t), bulge_[t]};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index beyond = surface_.neighbours()[t][k];
      out.goes_on[k] = beyond >= 0 && shape_[beyond] == shape_[t];
    }
    return out;
  }

  /// Whether a triangle looks out of its shape (1) or into it.
  double side_of(Index t) const {
    Point<3> middle{};
    for (const Point<3>& p : corners(t)) add(middle, 1.0 / 3, p);
    const auto off = signorini::height<3>(shapes_[shape_[t]], middle);
    return off && dot(off->normal, face_normals_[t]) < 0 ? -1 : 1;
  }

  void smooth(double crease) {
    SmoothBoundary<3> smooth = smooth_boundary<3>(surface_.points(), surface_.triangles(), crease);
    patches_ = std::move(smooth.patches);
    turn_ = std::move(smooth.turn);
    shape_ = std::move(smooth.shape);
    shapes_ = std::move(smooth.shapes);
    for (const CubicPatch<3>& patch : patches_) bulge_.push_back(bulge<3>(patch));
    most_bulge_ = bulge_.empty() ? 0 : *std::ranges::max_element(bulge_);
  }

  /// The mean of the normals around the nearest point, weighted by the angle that each face takes there.
  Point<3> pseudonormal(const std::vector<Foot>& feet) const {
    Point<3> sum{};
    for (const Foot& f : feet)
      if (length<3>(difference<3>(f.at, feet[0].at)) <= 2 * same_) add(sum, angle_at(f), f.normal);
    return length<3>(sum) > 1e-9 ? unit(sum) : feet[0].normal;
  }

  /// Of a triangle at a point of it: at an edge half a turn, inside a full one.
  double angle_at(const Foot& foot) const {
    const auto p = corners(foot.triangle);
    const bool curved = !is_flat(foot.triangle);
    double angle = 2 * std::numbers::pi;
    for (std::size_t k = 0; k < 3; ++k) {
      if (curved && foot.weights[(k + 2) % 3] == 0) angle = std::numbers::pi;
      const Point<3> u = difference<3>(p[(k + 1) % 3], p[k]), v = difference<3>(p[(k + 2) % 3], p[k]);
      const Point<3> x = difference<3>(foot.at, p[k]);
      if (length<3>(x) <= same_) return std::atan2(length<3>(cross(u, v)), dot(u, v));
      if (!curved && length<3>(cross(u, x)) <= same_ * length<3>(u)) angle = std::numbers::pi;
    }
    return angle;
  }

  /// The mean over the nearest points of the unit vectors away from them. Each point counts once: feet on faces around
  /// an edge or a vertex are one.
  Point<3> gradient(const std::vector<Foot>& feet, double sign) const {
    const double apart = 2 * std::sqrt(2 * feet[0].distance * rounding_) + 2 * same_;
    std::vector<Point<3>> points;
    Point<3> sum{};
    for (const Foot& f : feet) {
      if (std::ranges::any_of(points, [&](const Point<3>& q) { return length<3>(difference<3>(f.at, q)) < apart; }))
        continue;
      points.push_back(f.at);
      add(sum, sign / f.distance, f.offset);
    }
    for (double& x : sum) x /= static_cast<double>(points.size());
    if (length<3>(sum) > 1e-3) return sum;
    Point<3> first{};  // in the middle, with points of the surface all around
    add(first, sign / feet[0].distance, feet[0].offset);
    return unit(first);
  }

  /// Of a triangle over the edge between it and another.
  double height(Index t, Index other) const {
    const auto p = corners(t);
    const auto& around = surface_.neighbours()[t];
    const auto k = static_cast<std::size_t>(std::ranges::find(around, other) - around.begin());
    const Point<3> edge = difference<3>(p[(k + 2) % 3], p[(k + 1) % 3]);
    return length<3>(cross(edge, difference<3>(p[k], p[(k + 1) % 3]))) / length<3>(edge);
  }

  std::array<Point<3>, 3> corners(Index t) const {
    const auto& points = surface_.points();
    const auto& [a, b, c] = surface_.triangles()[t];
    return {points[a], points[b], points[c]};
  }

  TriangleSurface surface_;
  double rounding_, same_;  ///< lengths up to which positions are one: computed, and on the surface
  std::vector<Point<3>> face_normals_;
  std::vector<CubicPatch<3>> patches_;  ///< per triangle of a smooth surface
  std::vector<Index> shape_;            ///< of each the number of the shape that it stands for, or -1
  std::vector<Curve<3>> shapes_;
  std::vector<double> turn_;   ///< of each the largest angle that was smoothed over
  std::vector<double> bulge_;  ///< of each, and the largest
  double most_bulge_ = 0;
};

}  // namespace

std::unique_ptr<DistanceFunction> surface_distance(const std::string& file, std::optional<double> crease) {
  return std::make_unique<SurfaceDistance>(file, crease);
}

}  // namespace signorini::geometry
