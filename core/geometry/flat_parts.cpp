#include "core/geometry/flat_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/dot.hpp"
#include "core/mesh/element_map.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

constexpr double coplanar = 1e-6;  // angle up to which faces with all of their digits are in one plane
constexpr double spread = 4;       // times what is rounded away: how far vertices are off a plane through others

/// Whether a number has no more decimal digits than that.
bool has_digits(double x, int digits) {
  if (x == 0) return true;
  const double scaled = x * std::pow(10, digits - 1 - std::floor(std::log10(std::abs(x))));
  return std::abs(scaled - std::round(scaled)) <= 1e-5;  // so many of a last digit are rounding's
}

template <int D>
class Finder {
 public:
  Finder(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
         const std::vector<Index>& across, const std::vector<std::uint8_t>& curved)
      : points_(points), faces_(faces), across_(across), curved_(curved), off_(spread * rounded_away<D>(points)) {
    out_.part.assign(faces.size(), -1);
    for (const auto& face : faces) {
      std::array<Point<D>, D> corner;
      double longest = 0;
      for (int i = 0; i < D; ++i) corner[i] = points[face[i]];
      for (int i = 0; i < D; ++i) longest = std::max(longest, length<D>(difference<D>(corner[(i + 1) % D], corner[i])));
      area_normal_.push_back(area_normal(corner));
      const double area = length<D>(area_normal_.back());
      tilt_.push_back(coplanar + (area > 0 ? off_ * (D == 3 ? longest / (2 * area) : 1 / area) : infinity));
    }
  }

  FlatParts<D> run() {
    std::vector<Index> by_size(faces_.size());
    std::iota(by_size.begin(), by_size.end(), Index{0});
    const auto area = [&](Index f) { return dot(area_normal_[f], area_normal_[f]); };
    std::ranges::stable_sort(by_size, [&](Index a, Index b) { return area(a) > area(b); });
    region_of_.assign(faces_.size(), -1);
    for (const Index f : by_size) {
      if (region_of_[f] >= 0 || !(area(f) > 0) || is_curved(f)) continue;
      const std::vector<Index> region = grown(f);
      if (curved_.empty() && !is_piece(region) && is_row(region)) continue;
      for (const Index g : region) out_.part[g] = static_cast<Index>(out_.normal.size());
      out_.normal.push_back(normal_of(region));
    }
    return std::move(out_);
  }

 private:
  bool is_curved(Index f) const { return !curved_.empty() && curved_[f] != 0; }

  Point<D> normal_of(const std::vector<Index>& region) const {
    Point<D> n{};
    for (const Index f : region)
      for (int k = 0; k < D; ++k) n[k] += area_normal_[f][k];
    return unit<D>(n);
  }

  /// Faces beside each other in the plane of one of them, and then, as long as there are more, in the plane of all.
  std::vector<Index> grown(Index first) {
    std::vector<Index> region{first};
    region_of_[first] = first;
    for (std::size_t before = 0; before < region.size();) {
      before = region.size();
      const Point<D> n = normal_of(region);
      const Point<D> at = points_[faces_[first][0]];
      for (std::size_t k = 0; k < region.size(); ++k)
        for (int tip = 0; tip < D; ++tip) {
          const Index beyond = across_[region[k] * D + tip];
          if (beyond < 0 || region_of_[beyond / D] >= 0 || is_curved(beyond / D)) continue;
          if (!lies_in(beyond / D, at, n)) continue;
          region_of_[beyond / D] = first;
          region.push_back(beyond / D);
        }
    }
    return region;
  }

  bool lies_in(Index f, const Point<D>& at, const Point<D>& n) const {
    const Point<D> own = unit<D>(area_normal_[f]);
    if (!(dot(own, n) > 0) || length<D>(difference<D>(own, n)) > tilt_[f]) return false;
    return std::ranges::all_of(faces_[f], [&](Index v) {
      return std::abs(dot(difference<D>(points_[v], at), n)) <=
             off_ + coplanar * length<D>(difference<D>(points_[v], at));
    });
  }

  /// Whether it ends at edges and borders alone.
  bool is_piece(const std::vector<Index>& region) const {
    return std::ranges::all_of(region, [&](Index f) {
      for (int tip = 0; tip < D; ++tip)
        if (const Index beyond = across_[f * D + tip]; beyond >= 0 && region_of_[beyond / D] != region_of_[f])
          return false;
      return true;
    });
  }

  bool is_row(const std::vector<Index>& region) const {
    if constexpr (D == 2) {
      return region.size() < 2;
    } else {
      std::vector<Index> vertices;
      for (const Index f : region) vertices.insert(vertices.end(), faces_[f].begin(), faces_[f].end());
      std::ranges::sort(vertices);
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      // Of three corners of a face two are on one of the lines.
      const auto& [a, b, c] = faces_[region.front()];
      return on_two_lines(vertices, a, b) || on_two_lines(vertices, b, c) || on_two_lines(vertices, c, a);
    }
  }

  /// Whether all that is off the line through two of them is on another one.
  bool on_two_lines(const std::vector<Index>& vertices, Index a, Index b) const {
    std::vector<Index> off;
    for (const Index v : vertices)
      if (!on_line(v, a, b)) off.push_back(v);
    if (off.size() <= 2) return true;
    const Index far = *std::ranges::max_element(off, {}, [&](Index v) { return distance(v, off.front()); });
    return std::ranges::all_of(off, [&](Index v) { return on_line(v, off.front(), far); });
  }

  double distance(Index a, Index b) const { return length<D>(difference<D>(points_[a], points_[b])); }

  bool on_line(Index v, Index a, Index b) const {
    constexpr double straight = 1e-3;  // sine of an angle
    const Point<D> along = difference<D>(points_[b], points_[a]), to = difference<D>(points_[v], points_[a]);
    if constexpr (D == 3)
      return length<3>(cross(along, to)) <= straight * length<3>(along) * length<3>(to) + off_ * length<3>(along);
    return true;
  }

  std::span<const Point<D>> points_;
  const std::vector<std::array<Index, D>>& faces_;
  const std::vector<Index>& across_;
  const std::vector<std::uint8_t>& curved_;
  double off_;
  std::vector<Point<D>> area_normal_;  // per face
  std::vector<double> tilt_;           // by which rounding turns it
  std::vector<Index> region_of_;       // per face the first face of the region it is in, or -1
  FlatParts<D> out_;
};

}  // namespace

template <int D>
double rounded_away(std::span<const Point<D>> points) {
  constexpr int fewest = 6, most = 9;  // decimal digits
  double largest = 0;
  bool single = true;
  int digits = fewest;
  for (const Point<D>& p : points)
    for (const double x : p) {
      largest = std::max(largest, std::abs(x));
      single = single && x == static_cast<double>(static_cast<float>(x));
      while (digits <= most && !has_digits(x, digits)) ++digits;
    }
  if (digits <= most) return 0.5 * std::pow(10, 1 - digits) * largest;
  return (single ? 0.5 * std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon()) * largest;
}

template <int D>
FlatParts<D> find_flat_parts(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
                             const std::vector<Index>& across, const std::vector<std::uint8_t>& curved) {
  return Finder<D>(points, faces, across, curved).run();
}

template double rounded_away<2>(std::span<const Point<2>>);
template double rounded_away<3>(std::span<const Point<3>>);
template FlatParts<2> find_flat_parts<2>(std::span<const Point<2>>, const std::vector<std::array<Index, 2>>&,
                                         const std::vector<Index>&, const std::vector<std::uint8_t>&);
template FlatParts<3> find_flat_parts<3>(std::span<const Point<3>>, const std::vector<std::array<Index, 3>>&,
                                         const std::vector<Index>&, const std::vector<std::uint8_t>&);

}  // namespace signorini::geometry
