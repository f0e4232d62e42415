#include "core/geometry/cgal/crease_spacing.hpp"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

// Edges granted where creases lie closer together than the size, and for each edge that the size asks for. As CGAL
// protects one crease, each of its balls sees those on others: the time grows with the square of their number.
constexpr double spare_edges = 800, most_per_edge = 10;

using Kernel = CGAL::Simple_cartesian<double>;
using Segments = std::vector<Kernel::Segment_3>;
using Primitive = CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>;
using AABBTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 cgal(const Point<3>& p) { return {p[0], p[1], p[2]}; }

double squared_distance(const Kernel::Point_3& p, const CGAL::Bbox_3& box) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double out = std::max({box.min(k) - p[k], p[k] - box.max(k), 0.0});
    sum += out * out;
  }
  return sum;
}

double length_of(const Polyline& crease) {
  double sum = 0;
  for (std::size_t i = 1; i < crease.size(); ++i) sum += length<3>(difference<3>(crease[i], crease[i - 1]));
  return sum;
}

/// A traversal of CGAL's trees that finds the nearest segment among those that count.
template <class Counts>
struct Nearest {
  const Counts& counts;
  double squared;

  bool go_further() const { return true; }
  void intersection(const Kernel::Point_3& p, const Primitive& segment) {
    if (counts(segment.id())) squared = std::min(squared, CGAL::squared_distance(p, segment.datum()));
  }
  template <class Node>
  bool do_intersect(const Kernel::Point_3& p, const Node& node) const {
    return squared_distance(p, node.bbox()) < squared;
  }
};

/// Walks along all creases, in steps as long as the size and the distance to the other creases let edges be; but not
/// next to the ends of creases, where they meet.
class Walk {
 public:
  double edges = 0;
  double close = 0;           ///< those where another crease is nearer than half the size that resolves the shape
  double asked = 0;           ///< the number of edges of the size asked for
  double closest = infinity;  ///< the least distance to another crease below the size there
  Point<3> place{};           ///< where that is

  /// Gives up after `most` steps.
  Walk(const std::vector<Polyline>& creases, const Sizing<3>& sizing, double most)
      : creases_(creases), sizing_(sizing), most_(most) {
    for (std::size_t c = 0; c < creases.size(); ++c)
      for (std::size_t i = 1; i < creases[c].size(); ++i) {
        segments_.emplace_back(cgal(creases[c][i - 1]), cgal(creases[c][i]));
        crease_.push_back(c);
      }
    tree_.insert(segments_.cbegin(), segments_.cend());
    tree_.build();
    for (std::size_t c = 0; c < creases.size(); ++c) follow(c);
  }

 private:
  void follow(std::size_t crease) {
    const Polyline& line = creases_[crease];
    const double whole = length_of(line);
    const double end = whole - std::min(sizing_(line.back()), whole / 3);
    double s = std::min(sizing_(line.front()), whole / 3);
    double before = 0;  // arc length at the start of the segment
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Point<3> direction = difference<3>(line[i], line[i - 1]);
      const double segment = length<3>(direction);
      while (s < std::min(before + segment, end) && edges < most_) {
        Point<3> p = line[i - 1];
        for (std::size_t k = 0; k < 3; ++k) p[k] += (s - before) / segment * direction[k];
        s += step(p, crease);
      }
      before += segment;
    }
  }

  double step(const Point<3>& p, std::size_t crease) {
    const double h = sizing_(p), gap = distance(p, crease, h);
    if (gap < h && gap < closest) {
      closest = gap;
      place = p;
    }
    ++edges;
    if (gap < h / 2) ++close;
    asked += gap / sizing_.asked(p);
    return gap;
  }

  // From a point of a crease to the nearest of the others; `reach` if there is none nearer.
  double distance(const Point<3>& p, std::size_t crease, double reach) const {
    const auto other = [&](Segments::const_iterator segment) {
      return crease_[static_cast<std::size_t>(segment - segments_.cbegin())] != crease;
    };
    Nearest<decltype(other)> nearest{other, reach * reach};
    tree_.traversal(cgal(p), nearest);
    return std::min(reach, std::sqrt(nearest.squared));
  }

  const std::vector<Polyline>& creases_;
  const Sizing<3>& sizing_;
  double most_;
  Segments segments_;
  std::vector<std::size_t> crease_;  // per segment
  AABBTree tree_;
};

}  // namespace

void check_crease_spacing(const Domain& domain, const Sizing<3>& sizing) {
  const std::vector<Polyline> creases = domain.creases();
  const Walk walk(creases, sizing, static_cast<double>(sizing.most_vertices()));
  if (walk.close <= spare_edges + most_per_edge * walk.asked) return;
  const double unit = domain.units().unit;
  const auto [x, y, z] = domain.units().given(walk.place);
  throw ShapeError(
      domain.name(), "size",
      fmt::format("sharp edges of the shape are only {:.3g} apart near [{:.6g}, {:.6g}, {:.6g}], where the size is "
                  "{:.3g}; expected a shape without gaps and angles so narrow, or a smaller size there",
                  walk.closest * unit, x, y, z, sizing.asked(walk.place) * unit));
}

}  // namespace signorini::geometry
