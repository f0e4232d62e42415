#include "core/mesh/chords.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/base/dot.hpp"
#include "core/mesh/element_map.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

constexpr double least_turn = 1e-6, widest = 1.01 * std::numbers::pi / 3;  // angles
constexpr double same = 0.05, same_direction = 1e-3;
constexpr std::size_t round = 5;  // directions of faces
constexpr double beyond = 1.5;    // times a face: a flat part that reaches so far from an edge has more than one row

/// From what is opposite to a corner of a face to that corner, the shortest way.
Point<2> across(const Mesh<2>& mesh, const Face<2>& face, int tip) {
  return difference<2>(mesh.points[face.vertices[tip]], mesh.points[face.vertices[1 - tip]]);
}

Point<3> across(const Mesh<3>& mesh, const Face<3>& face, int tip) {
  const Point<3>&a = mesh.points[face.vertices[(tip + 1) % 3]], &b = mesh.points[face.vertices[(tip + 2) % 3]];
  const Point<3> along = difference<3>(b, a);
  Point<3> out = difference<3>(mesh.points[face.vertices[tip]], a);
  const double part = dot<3>(out, along) / dot<3>(along, along);
  for (int k = 0; k < 3; ++k) out[k] -= part * along[k];
  return out;
}

/// The face without one of its vertices, sorted.
template <int D>
std::array<Index, D - 1> joint(const Face<D>& face, int tip) {
  std::array<Index, D - 1> out;
  for (int i = 0; i < D - 1; ++i) out[i] = face.vertices[(tip + 1 + i) % D];
  return sorted(out);
}

/// Between two faces: the angle that they turn by, which is small where one continues the other.
template <int D>
double turn(const Point<D>& a, const Point<D>& b) {
  const double la = length<D>(a), lb = length<D>(b);
  Point<D> sum, apart;  // of the unit vectors a and -b
  for (int k = 0; k < D; ++k) {
    sum[k] = a[k] / la - b[k] / lb;
    apart[k] = a[k] / la + b[k] / lb;
  }
  return 2 * std::atan2(length<D>(apart), length<D>(sum));
}

/// Faces on both sides of an edge of the body.
template <int D>
struct WideJoint {
  double angle, across;
  std::array<Point<D>, 2> normal;
};

template <int D>
Point<D> direction(const Mesh<D>& mesh, const Face<D>& face) {
  std::array<Point<D>, D> corner;
  for (int k = 0; k < D; ++k) corner[k] = mesh.points[face.vertices[k]];
  Point<D> n = area_normal(corner);
  const double size = length<D>(n);
  for (double& x : n) x /= size;
  return n;
}

/// The largest sagitta of those that look like a round.
template <int D>
Chords widest_chords(const std::vector<WideJoint<D>>& joints) {
  std::map<double, std::vector<const WideJoint<D>*>> alike;  // by the logarithm of the angle
  for (const WideJoint<D>& joint : joints) alike[std::round(std::log(joint.angle) / same)].push_back(&joint);
  Chords out;
  for (const auto& [angle, group] : alike) {
    std::vector<Point<D>> directions;
    Chords here;
    for (const WideJoint<D>* joint : group) {
      for (const Point<D>& n : joint->normal) {
        const auto is_near = [&](const Point<D>& m) { return length<D>(difference<D>(m, n)) < same_direction; };
        if (directions.size() < round && std::ranges::none_of(directions, is_near)) directions.push_back(n);
      }
      if (const double off = joint->angle * joint->across / 8; off > here.sagitta) here = {off, joint->angle};
    }
    if (directions.size() >= round && here.sagitta > out.sagitta) out = here;
  }
  return out;
}

/// A face at an edge, and its corner opposite to that.
struct Side {
  Index face;
  int tip;
};

template <int D>
double turn(const Mesh<D>& mesh, const Side& a, const Side& b) {
  return turn<D>(across(mesh, mesh.boundary[a.face], a.tip), across(mesh, mesh.boundary[b.face], b.tip));
}

/// Calls use(side, other side) for what faces have in common, all of it marked.
template <int D, class Use>
void each_joint(const Mesh<D>& mesh, const std::vector<bool>& marked, const Use& use) {
  std::map<std::array<Index, D - 1>, Side> open;
  for (Index f = 0; f < static_cast<Index>(mesh.boundary.size()); ++f)
    for (int tip = 0; tip < D; ++tip) {
      const auto common = joint(mesh.boundary[f], tip);
      if (!std::ranges::all_of(common, [&](Index p) { return marked[p]; })) continue;
      const auto [found, first] = open.try_emplace(common, Side{f, tip});
      if (!first) use(Side{f, tip}, found->second);
    }
}

/// Faces that continue each other without an angle.
template <int D>
class FlatParts {
 public:
  explicit FlatParts(const Mesh<D>& mesh) : mesh_(mesh), next_(mesh.boundary.size()) {
    each_joint(mesh, std::vector<bool>(mesh.points.size(), true), [&](const Side& a, const Side& b) {
      if (turn(mesh, a, b) > least_turn) return;
      next_[a.face].push_back(b.face);
      next_[b.face].push_back(a.face);
    });
  }

  /// Whether the part of a face at an edge has more rows than that face's: one that stands for a curve has not.
  bool has_rows(const Side& side) const {
    const Face<D>& face = mesh_.boundary[side.face];
    const Point<D> reach = across(mesh_, face, side.tip), &from = mesh_.points[face.vertices[(side.tip + 1) % D]];
    std::vector<Index> part{side.face};
    std::vector<bool> seen(next_.size());
    seen[side.face] = true;
    for (std::size_t k = 0; k < part.size(); ++k) {
      for (const Index v : mesh_.boundary[part[k]].vertices)
        if (dot(difference<D>(mesh_.points[v], from), reach) > beyond * dot(reach, reach)) return true;
      for (const Index f : next_[part[k]])
        if (!seen[f]) seen[f] = true, part.push_back(f);
    }
    return false;
  }

 private:
  const Mesh<D>& mesh_;
  std::vector<std::vector<Index>> next_;  // per face
};

/// Vertices of the coarsest mesh that marked ones were made from.
template <int D>
std::vector<bool> on_coarsest(const MeshHierarchy<D>& hierarchy, std::vector<bool> marked) {
  for (std::size_t k = hierarchy.refinements.size(); k-- > 0;) {
    std::vector<bool> coarser(hierarchy.levels[k].points.size());
    const auto& parents = hierarchy.refinements[k].parents;
    for (std::size_t v = 0; v < parents.size(); ++v)
      if (marked[v])
        for (const Index parent : parents[v]) coarser[parent] = true;
    marked = std::move(coarser);
  }
  return marked;
}

}  // namespace

double sagitta(double angle, double across) {
  return angle > least_turn && angle <= largest_turn ? angle * across / 8 : 0;
}

template <int D>
Chords chord_sagitta(const MeshHierarchy<D>& hierarchy, std::vector<bool> marked) {
  std::vector<WideJoint<D>> wide;
  Chords largest;
  SmoothedOver smooth;
  const Mesh<D>& mesh = hierarchy.levels.front();
  std::optional<FlatParts<D>> flat;
  each_joint(mesh, on_coarsest(hierarchy, std::move(marked)), [&](const Side& a, const Side& b) {
    const Face<D>&one = mesh.boundary[a.face], &other = mesh.boundary[b.face];
    const auto is_patch = [&](Index curve) { return curve >= 0 && mesh.curves[curve].kind == CurveKind::patches; };
    const bool smoothed = one.curve == other.curve && is_patch(one.curve);
    if (!smoothed && (one.curve >= 0 || other.curve >= 0 || (one.straight && other.straight))) return;
    const Point<D> here = across(mesh, one, a.tip), there = across(mesh, other, b.tip);
    const double size = std::min(length<D>(here), length<D>(there)), angle = turn(mesh, a, b);
    if (smoothed) {
      const SmoothedOver over{angle * size / 8, angle};
      if (over.error() > smooth.error()) smooth = over;
      return;
    }
    if (angle <= least_turn || angle > widest) return;
    if (!flat) flat.emplace(mesh);
    if (flat->has_rows(a) && flat->has_rows(b)) return;
    if (const double off = sagitta(angle, size); off > largest.sagitta) largest = {off, angle};
    if (angle > largest_turn) wide.push_back({angle, size, {direction(mesh, one), direction(mesh, other)}});
  });
  const Chords wider = widest_chords(wide);
  Chords out = wider.sagitta > largest.sagitta ? wider : largest;
  out.smoothed = smooth;
  return out;
}

template Chords chord_sagitta(const MeshHierarchy<2>&, std::vector<bool>);
template Chords chord_sagitta(const MeshHierarchy<3>&, std::vector<bool>);

}  // namespace signorini
