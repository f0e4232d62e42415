#include "core/geometry/profiles.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/dot.hpp"
#include "core/geometry/edges.hpp"
#include "core/geometry/joints.hpp"
#include "core/geometry/vector.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

/// Rows that follow each other along an axis, as a polyline.
class Profiles {
 public:
  Profiles(std::span<const Point<3>> points, const std::vector<std::array<Index, 3>>& faces,
           const std::vector<Index>& across, const std::vector<Row>& rows, double crease, double digits)
      : points_(points), faces_(faces), across_(across), rows_(rows), crease_(crease), digits_(digits) {
    row_of_.assign(faces.size(), -1);
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (const Index f : rows[r].faces) row_of_[f] = static_cast<Index>(r);
    beside_.resize(rows.size());
    for (std::size_t i = 0; i < across.size(); ++i) {
      const Index r = row_of_[i / 3];
      if (r < 0 || across[i] < 0) continue;
      const Index other = row_of_[across[i] / 3];
      if (other >= 0 && other != r && std::ranges::find(beside_[r], other) == beside_[r].end())
        beside_[r].push_back(other);
    }
  }

  std::vector<Index> run() {
    std::vector<std::uint8_t> done(rows_.size(), 0);
    for (std::size_t first = 0; first < rows_.size(); ++first) {
      if (done[first] != 0 || beside_[first].size() != 1) continue;
      std::vector<Index> chain{static_cast<Index>(first)};
      for (Index at = chain[0]; done[at] == 0;) {
        done[at] = 1;
        for (const Index next : beside_[at])
          if (done[next] == 0 && beside_[next].size() <= 2) chain.push_back(next);
        at = chain.back();
      }
      find_corners(chain);
    }
    return std::move(out_);
  }

 private:
  /// Radius and height about the axis of a row.
  static Point<2> section(const Curve<3>& shape, const Point<3>& p) {
    const Point<3> from = difference<3>(p, shape.center);
    const double height = dot(from, shape.axis);
    return {length<3>(plus<3>(from, -height, shape.axis)), height};
  }

  /// The one point of the profile where two rows meet; nothing where they meet anyhow.
  std::optional<Point<2>> meeting(const Curve<3>& shape, Index row, Index other, double reach) const {
    std::optional<Point<2>> out;
    for (const Index f : rows_[row].faces)
      for (int tip = 0; tip < 3; ++tip) {
        const Index beyond = across_[3 * f + tip];
        if (beyond < 0 || row_of_[beyond / 3] != other) continue;
        for (const Index v : joint_of<3>(faces_[f], tip)) {
          const Point<2> p = section(shape, points_[v]);
          if (!out) out = p;
          if (length<2>(difference<2>(p, *out)) > reach) return {};
        }
      }
    return out;
  }

  /// The other end of a row.
  std::optional<Point<2>> end(const Curve<3>& shape, Index row, const Point<2>& from, double reach) const {
    std::optional<Point<2>> out;
    for (const Index f : rows_[row].faces)
      for (const Index v : faces_[f]) {
        const Point<2> p = section(shape, points_[v]);
        if (length<2>(difference<2>(p, from)) <= reach) continue;
        if (!out) out = p;
        if (length<2>(difference<2>(p, *out)) > reach) return {};
      }
    return out;
  }

  void find_corners(const std::vector<Index>& chain) {
    constexpr double spread = 10;  // times the digits
    const Curve<3>& shape = rows_[chain[0]].shape;
    const double reach = spread * digits_;
    std::vector<Point<2>> profile;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      const auto p = meeting(shape, chain[k], chain[k + 1], reach);
      if (!p) return;
      profile.push_back(*p);
    }
    if (profile.empty()) return;
    const auto first = end(shape, chain.front(), profile.front(), reach),
               last = end(shape, chain.back(), profile.back(), reach);
    if (!first || !last) return;
    profile.insert(profile.begin(), *first);
    profile.push_back(*last);
    const std::size_t added = continue_beyond_axis(profile, reach);
    const std::vector<std::uint8_t> sharp = corners_of(profile);
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      if (sharp[added + k + 1] != 0) cut(chain[k], chain[k + 1]);
  }

  /// What begins or ends on the axis goes on there as its own image.
  static std::size_t continue_beyond_axis(std::vector<Point<2>>& profile, double reach) {
    const std::vector<Point<2>> own = profile;
    const auto image = [](const Point<2>& p) { return Point<2>{-p[0], p[1]}; };
    if (own.back()[0] <= reach)
      for (std::size_t k = own.size() - 1; k-- > 0;) profile.push_back(image(own[k]));
    if (own.front()[0] > reach) return 0;
    for (std::size_t k = 1; k < own.size(); ++k) profile.insert(profile.begin(), image(own[k]));
    return own.size() - 1;
  }

  std::vector<std::uint8_t> corners_of(const std::vector<Point<2>>& profile) const {
    std::vector<std::array<Index, 2>> edges;
    for (std::size_t k = 0; k + 1 < profile.size(); ++k)
      edges.push_back({static_cast<Index>(k), static_cast<Index>(k + 1)});
    const Joints<2> joints = find_joints<2>(static_cast<Index>(profile.size()), edges);
    return find_edges<2>(profile, edges, joints, crease_).sharp;
  }

  void cut(Index row, Index other) {
    for (const Index f : rows_[row].faces)
      for (int tip = 0; tip < 3; ++tip)
        if (const Index beyond = across_[3 * f + tip]; beyond >= 0 && row_of_[beyond / 3] == other) {
          out_.push_back(3 * f + tip);
          out_.push_back(beyond);
        }
  }

  std::span<const Point<3>> points_;
  const std::vector<std::array<Index, 3>>& faces_;
  const std::vector<Index>& across_;
  const std::vector<Row>& rows_;
  double crease_, digits_;
  std::vector<Index> row_of_;
  std::vector<std::vector<Index>> beside_;
  std::vector<Index> out_;
};

}  // namespace

std::vector<Index> find_profile_edges(std::span<const Point<3>> points, const std::vector<std::array<Index, 3>>& faces,
                                      const std::vector<Index>& across, const std::vector<Row>& rows, double crease,
                                      double digits) {
  return Profiles(points, faces, across, rows, crease, digits).run();
}

}  // namespace signorini::geometry
