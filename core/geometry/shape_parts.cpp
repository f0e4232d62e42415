#include "core/geometry/shape_parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/dot.hpp"
#include "core/geometry/groups.hpp"
#include "core/geometry/profiles.hpp"
#include "core/geometry/recognise.hpp"
#include "core/mesh/curve.hpp"
#include "core/mesh/element_map.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

template <int D>
class ShapeFinder {
 public:
  ShapeFinder(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
              const std::vector<Index>& across, FlatParts<D>& flats, double crease, const Known<D>& known)
      : points_(points),
        faces_(faces),
        across_(across),
        flats_(flats),
        crease_(crease),
        known_(known),
        digits_(spread * rounded_away<D>(points)) {
    out_.part.assign(faces.size(), -1);
    mark_.assign(faces.size(), 0);
    tried_.assign(faces.size(), 0);
    for (const auto& face : faces) {
      const auto corner = corners_of(face);
      normal_.push_back(unit<D>(area_normal(corner)));
      double& longest = longest_.emplace_back(0);
      for (int i = 0; i < D; ++i) longest = std::max(longest, length<D>(difference<D>(corner[(i + 1) % D], corner[i])));
    }
  }

  /// @param beyond see find_shape_parts()
  ShapeParts<D> run(const std::vector<Index>& beyond) {
    std::vector<std::uint8_t> done(faces_.size(), 0);
    for (Index f = 0; f < static_cast<Index>(faces_.size()); ++f) {
      if (done[f] != 0) continue;
      const auto piece = connected({f}, [](Index) { return true; });
      for (const Index g : piece) done[g] = 1;
      look_at(piece);
    }
    take_in(beyond);
    return std::move(out_);
  }

 private:
  using Faces = std::vector<Index>;

  static constexpr double off_shape = 1e-6;                // of the size of a part: what counts as on a shape,
  static constexpr double spread = 4;                      // or times what digits round away
  static constexpr double coplanar = 1e-6;                 // angle
  static constexpr double least_common = 0.8;              // cosine: faces around a tip have no normal in common
  static constexpr double alike = 1.5;                     // turns of faces on one shape
  static constexpr int most_attempts = 100;                // from which faces of a piece
  static constexpr std::size_t few = D == 2 ? 6 : 16;      // vertices that tell a shape, beside each other,
  static constexpr std::size_t of_plates = 9, of_row = 8;  // or of three plates; or that a row may be on

  std::array<Point<D>, D> corners_of(const std::array<Index, D>& face) const {
    std::array<Point<D>, D> p;
    for (int i = 0; i < D; ++i) p[i] = points_[face[i]];
    return p;
  }

  bool is_open(Index f) const { return out_.part[f] < 0 && flats_.part[f] < 0; }

  void look_at(const Faces& piece) {
    if (std::ranges::all_of(piece, [&](Index f) { return flats_.part[f] >= 0; })) return;
    if (put(piece)) return;
    const bool some_flat = std::ranges::any_of(piece, [&](Index f) { return flats_.part[f] >= 0; });
    bool found = false;
    for (const bool by_name : {false, true})
      if (some_flat || by_name) found = put_groups(piece, by_name) || found;
    found = grow_some(piece, &ShapeFinder::near) || found;
    if constexpr (D == 3) {
      found = grow_some(piece, &ShapeFinder::plates) || found;
      found = part_rows(piece) || found;
    }
    if (found || some_flat) put_rest(piece);
    if (!(known_.fit > 0) || (!found && put(piece, known_.fit))) return;
    for (const bool by_name : {false, true}) put_groups(piece, by_name, known_.fit);
  }

  bool put_groups(const Faces& piece, bool by_name, double fit = 0) {
    bool found = false;
    if (!by_name || !known_.name.empty())
      for (const Faces& group : open_groups(piece, by_name)) found = put(group, fit) || found;
    return found;
  }

  /// A single edge in the plane is flat if it has a name of its own.
  void put_rest(const Faces& piece) {
    for (const bool by_name : {false, true}) {
      if (by_name && known_.name.empty()) continue;
      for (const Faces& group : open_groups(piece, by_name))
        if (!put(group) && (D == 3 || (by_name && is_all_of_a_name(group))) && is_plane(group)) put_flat(group);
    }
  }

  bool is_all_of_a_name(const Faces& group) {
    const Index name = known_.name[group[0]];
    return connected({group[0]}, [&](Index f) { return known_.name[f] == name; }).size() == group.size();
  }

  /// The faces that are reached from some through others that belong to it, too; the first ones first.
  template <class Belongs>
  Faces connected(Faces group, const Belongs& belongs) {
    ++stamp_;
    for (const Index f : group) mark_[f] = stamp_;
    for (std::size_t k = 0; k < group.size(); ++k)
      for (int tip = 0; tip < D; ++tip) {
        const Index beyond = across_[group[k] * D + tip];
        if (beyond < 0 || mark_[beyond / D] == stamp_ || !belongs(beyond / D)) continue;
        mark_[beyond / D] = stamp_;
        group.push_back(beyond / D);
      }
    return group;
  }

  std::vector<Faces> open_groups(const Faces& piece, bool by_name) {
    std::vector<Faces> out;
    std::vector<Index> sorted_ones;
    for (const Index f : piece) {
      if (!is_open(f) || std::ranges::binary_search(sorted_ones, f)) continue;
      out.push_back(
          connected({f}, [&](Index g) { return is_open(g) && (!by_name || known_.name[g] == known_.name[f]); }));
      sorted_ones.insert(sorted_ones.end(), out.back().begin(), out.back().end());
      std::ranges::sort(sorted_ones);
    }
    return out;
  }

  std::vector<Index> vertices_of(const Faces& group) const {
    std::vector<Index> out;
    for (const Index f : group) out.insert(out.end(), faces_[f].begin(), faces_[f].end());
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  /// @param fit see Known
  double reach_of(const Faces& group, double fit = 0) const {
    Point<D> low, high;
    low.fill(infinity);
    high.fill(-infinity);
    for (const Index f : group)
      for (const Index v : faces_[f])
        for (int k = 0; k < D; ++k) {
          low[k] = std::min(low[k], points_[v][k]);
          high[k] = std::max(high[k], points_[v][k]);
        }
    return std::max(std::max(off_shape, fit) * length<D>(difference<D>(high, low)), digits_);
  }

  std::optional<Curve<D>> shape_of(const Faces& group, double fit = 0) const {
    const std::vector<Index> vertices = vertices_of(group);
    std::vector<Point<D>> points, normals(vertices.size());
    for (const Index v : vertices) points.push_back(points_[v]);
    for (const Index f : group)
      for (const Index v : faces_[f]) {
        Point<D>& n = normals[static_cast<std::size_t>(std::ranges::lower_bound(vertices, v) - vertices.begin())];
        n = dot(n, normal_[f]) < least_common * length<D>(n) ? n : plus<D>(n, 1, normal_[f]);
      }
    for (Point<D>& n : normals) n = unit<D>(n);
    for (const Index f : group)
      for (const Point<D>& p : middles(f)) {
        points.push_back(p);
        normals.push_back(normal_[f]);
      }
    const double reach = reach_of(group, fit);
    const auto found = recognise<D>(points, normals, reach_of(group), reach);
    if (!found) return {};
    const double side = side_of(found->curve, group[0]);
    if (std::ranges::any_of(group, [&](Index f) { return !is_on(found->curve, f, side, reach); })) return {};
    return found->curve;
  }

  std::span<const Point<D>> middles(Index f) const {
    if (known_.second_order()) return known_.middle[f];
    return {};
  }

  struct Site {
    Point<D> at, normal;
  };
  /// Where a face may lie along a shape: its corners, or where a curved one meets others.
  std::array<Site, D> sites(Index f) const {
    std::array<Site, D> out;
    for (int i = 0; i < D; ++i) {
      out[i] = {points_[faces_[f][i]], normal_[f]};
      if (!known_.second_order()) continue;
      if constexpr (D == 2) out[i].at = points_[faces_[f][1 - i]];
      if constexpr (D == 3) out[i].at = known_.middle[f][i];
      out[i].normal = known_.normal[f][i];
    }
    return out;
  }

  /// Whether a face looks out of the shape, or into it.
  double side_of(const Curve<D>& curve, Index f) const {
    double sum = 0;
    for (const Site& site : sites(f))
      if (const auto off = height<D>(curve, site.at)) sum += dot(off->normal, site.normal);
    return sum > 0 ? 1 : -1;
  }

  /// Whether its nodes are, and it lies along the shape there.
  bool is_on(const Curve<D>& curve, Index f, double side, double reach) const {
    const double cosine = std::cos((D == 2 ? 0.6 : 0.8) * crease_);  // of a side, and of a triangle's longest
    const auto is_near = [&](const Point<D>& p) {
      const auto off = height<D>(curve, p);
      return off && std::abs(off->distance) <= reach;
    };
    return std::ranges::all_of(corners_of(faces_[f]), is_near) && std::ranges::all_of(middles(f), is_near) &&
           std::ranges::all_of(sites(f), [&](const Site& site) {
             return is_tip<D>(curve, site.at, longest_[f]) ||
                    side * dot(height<D>(curve, site.at)->normal, site.normal) >= cosine;
           });
  }

  bool has_tip(const Curve<D>& curve, Index f) const {
    return std::ranges::any_of(faces_[f], [&](Index v) { return is_tip<D>(curve, points_[v], longest_[f]); });
  }

  /// The angle between a face and a shape that its corners are on, at most.
  double turn_of(const Curve<D>& curve, Index f, double side) const {
    double least = 1;
    for (const Site& site : sites(f))
      if (const auto off = height<D>(curve, site.at); off && !is_tip<D>(curve, site.at, longest_[f]))
        least = std::min(least, side * dot(off->normal, site.normal));
    return std::acos(least);
  }

  /// Faces beside those on a shape, which edges have cut off: alone, or as a flat part.
  void take_in(const std::vector<Index>& beyond) {
    std::vector<Faces> of_shape(out_.shapes.size()), of_flat(flats_.normal.size());
    for (Index f = 0; f < static_cast<Index>(faces_.size()); ++f) {
      if (out_.part[f] >= 0) of_shape[out_.part[f]].push_back(f);
      if (flats_.part[f] >= 0) of_flat[flats_.part[f]].push_back(f);
    }
    for (std::size_t k = 0; k < of_shape.size(); ++k) {
      Faces& faces = of_shape[k];
      const Curve<D>& shape = out_.shapes[k];
      const double side = side_of(shape, faces[0]), reach = reach_of(faces);
      double most = 0;
      for (const Index f : faces) most = std::max(most, alike * turn_of(shape, f, side));
      const auto fits = [&](Index f) {  // few faces go all around a tip
        return is_on(shape, f, side, reach) && (has_tip(shape, f) || turn_of(shape, f, side) <= most);
      };
      for (std::size_t at = 0; at < faces.size(); ++at)
        for (int tip = 0; tip < D; ++tip) {
          const Index there = beyond[faces[at] * D + tip], g = there < 0 ? -1 : there / D;
          if (g < 0 || out_.part[g] >= 0 || dot(normal_[g], normal_[faces[at]]) < std::cos(crease_)) continue;
          const Faces alone{g}, &group = flats_.part[g] < 0 ? alone : of_flat[flats_.part[g]];
          if (!std::ranges::all_of(group, fits)) continue;
          for (const Index f : group) {
            flats_.part[f] = -1;
            out_.part[f] = static_cast<Index>(k);
          }
          faces.insert(faces.end(), group.begin(), group.end());
        }
    }
  }

  bool put(const Faces& group, double fit = 0) {
    const auto found = shape_of(group, fit);
    if (found) put_on(*found, group);
    return found.has_value();
  }

  void put_on(const Curve<D>& shape, const Faces& group) {
    for (const Index f : group) out_.part[f] = static_cast<Index>(out_.shapes.size());
    out_.shapes.push_back(shape);
  }

  bool is_plane(const Faces& group) const {
    const Point<D>& n = normal_[group[0]];
    const double reach = reach_of(group);
    const auto is_near = [&](const Point<D>& p) {
      return std::abs(dot(difference<D>(p, points_[faces_[group[0]][0]]), n)) <= reach;
    };
    return std::ranges::all_of(group, [&](Index f) {
      return std::ranges::all_of(corners_of(faces_[f]), is_near) && std::ranges::all_of(middles(f), is_near);
    });
  }

  void put_flat(const Faces& group) {
    Point<D> n{};
    for (const Index f : group) {
      flats_.part[f] = static_cast<Index>(flats_.normal.size());
      n = plus<D>(n, 1, area_normal(corners_of(faces_[f])));
    }
    flats_.normal.push_back(unit<D>(n));
  }

  /// Shapes that some faces beside each other are on, with all that is on these farther away.
  bool grow_some(const Faces& piece, std::vector<Faces> (ShapeFinder::*seeds)(Index)) {
    std::ranges::fill(tried_, std::uint8_t{0});
    bool any = false;
    int attempts = 0;
    for (const Index first : piece) {
      if (!is_open(first) || tried_[first] != 0) continue;
      for (const Faces& seed : (this->*seeds)(first)) {
        if (++attempts > most_attempts) return any;
        if (!grow(seed)) continue;
        any = true;
        break;
      }
    }
    return any;
  }

  bool grow(const Faces& seed) {
    auto found = shape_of(seed);
    Faces group = seed;
    for (std::size_t before = 0; found && before < group.size();) {
      before = group.size();
      const double side = side_of(*found, seed[0]), reach = reach_of(group);
      group = connected({seed[0]}, [&](Index f) { return is_open(f) && is_on(*found, f, side, reach); });
      found = group.size() < before ? std::nullopt : shape_of(group);
    }
    if (found) put_on(*found, group);
    return found.has_value();
  }

  std::vector<Faces> near(Index first) {
    std::vector<Index> vertices;
    Faces out = connected({first}, [&](Index f) {
      if (!is_open(f) || vertices.size() >= few) return false;
      for (const Index v : faces_[f])
        if (std::ranges::find(vertices, v) == vertices.end()) vertices.push_back(v);
      return true;
    });
    for (const Index f : out) tried_[f] = 1;
    if (vertices.size() < few) return {};
    return {std::move(out)};
  }

  /// Cuts rows around an axis apart where their profile has corners.
  bool part_rows(const Faces& piece) requires(D == 3) {
    std::vector<Row> rows;
    std::vector<std::uint8_t> in_row(faces_.size(), 0);
    const auto add = [&](const Faces& seed) {
      const auto found = shape_of(seed);
      if (!found || (found->kind != CurveKind::cylinder && found->kind != CurveKind::cone)) return false;
      const double side = side_of(*found, seed[0]), reach = reach_of(seed);
      Row row{*found, connected({seed[0]}, [&](Index f) {
                return is_open(f) && in_row[f] == 0 && is_on(*found, f, side, reach);
              })};
      if (vertices_of(row.faces).size() <= of_row) return false;
      const auto better = shape_of(row.faces);
      if (!better) return false;
      row.shape = *better;
      for (const Index f : row.faces) in_row[f] = 1;
      rows.push_back(std::move(row));
      return true;
    };
    int attempts = 0;
    for (const Index first : piece) {
      if (!is_open(first) || in_row[first] != 0) continue;
      for (const Faces& seed : row_seeds(first)) {
        if (++attempts > most_attempts || add(seed)) break;
      }
    }
    const auto cuts = find_profile_edges(points_, faces_, across_, rows, crease_, digits_);
    for (const Index i : cuts) across_[i] = -1;
    out_.edges.insert(out_.edges.end(), cuts.begin(), cuts.end());
    return !cuts.empty();
  }

  std::vector<Faces> plates(Index first) {
    const Faces plate = plate_of(first);
    for (const Index f : plate) tried_[f] = 1;
    if (vertices_of(plate).size() <= static_cast<std::size_t>(D + 1)) return {};
    return triples(plate, of_plates);
  }

  /// Plates beside each other, or around a tip.
  std::vector<Faces> row_seeds(Index first) {
    std::vector<Faces> out = triples(plate_of(first), of_row);
    for (const Index v : faces_[first])
      out.push_back(connected({first}, [&](Index f) { return is_open(f) && std::ranges::count(faces_[f], v) > 0; }));
    return out;
  }

  /// A plate with two beside it.
  std::vector<Faces> triples(const Faces& plate, std::size_t least) {
    std::vector<Faces> out, beside;
    for (const Index f : plate)
      for (int tip = 0; tip < D; ++tip) {
        const Index beyond = across_[f * D + tip];
        if (beyond < 0 || !is_open(beyond / D) || std::ranges::find(plate, beyond / D) != plate.end()) continue;
        if (std::ranges::none_of(beside, [&](const Faces& p) { return std::ranges::find(p, beyond / D) != p.end(); }))
          beside.push_back(plate_of(beyond / D));
      }
    for (std::size_t i = 0; i < beside.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        Faces all = plate;
        all.insert(all.end(), beside[i].begin(), beside[i].end());
        all.insert(all.end(), beside[k].begin(), beside[k].end());
        if (vertices_of(all).size() >= least) out.push_back(std::move(all));
      }
    return out;
  }

  /// Open faces in the plane of one.
  Faces plate_of(Index first) {
    const Point<D>& n = normal_[first];
    const Point<D>& at = points_[faces_[first][0]];
    return connected({first}, [&](Index f) {
      return is_open(f) && std::ranges::all_of(faces_[f], [&](Index v) {
               const Point<D> off = difference<D>(points_[v], at);
               return std::abs(dot(off, n)) <= digits_ + coplanar * length<D>(off);
             });
    });
  }

  std::span<const Point<D>> points_;
  const std::vector<std::array<Index, D>>& faces_;
  std::vector<Index> across_;
  FlatParts<D>& flats_;
  double crease_;
  const Known<D>& known_;
  double digits_;
  std::vector<Point<D>> normal_;
  std::vector<double> longest_;  // side of a face
  std::vector<std::uint8_t> tried_;
  std::vector<Index> mark_;
  Index stamp_ = 0;
  ShapeParts<D> out_;
};

}  // namespace

template <int D>
ShapeParts<D> find_shape_parts(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
                               const std::vector<Index>& across, const std::vector<Index>& beyond, FlatParts<D>& flats,
                               double crease, const Known<D>& known) {
  return ShapeFinder<D>(points, faces, across, flats, crease, known).run(beyond);
}

template ShapeParts<2> find_shape_parts<2>(std::span<const Point<2>>, const std::vector<std::array<Index, 2>>&,
                                           const std::vector<Index>&, const std::vector<Index>&, FlatParts<2>&, double,
                                           const Known<2>&);
template ShapeParts<3> find_shape_parts<3>(std::span<const Point<3>>, const std::vector<std::array<Index, 3>>&,
                                           const std::vector<Index>&, const std::vector<Index>&, FlatParts<3>&, double,
                                           const Known<3>&);

}  // namespace signorini::geometry
