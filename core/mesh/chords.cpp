#include "core/mesh/chords.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/dot.hpp"
#include "core/mesh/element_map.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

constexpr double least_turn = 1e-6, widest = 1.01 * std::numbers::pi / 3;  // angles
constexpr double same = 0.05, same_direction = 1e-3;
constexpr std::size_t round = 5;  // directions of faces

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

/// Calls use(mesh, side, other side) for what faces of the coarsest mesh have in common, all of it marked.
template <int D, class Use>
void each_marked_joint(const MeshHierarchy<D>& hierarchy, std::vector<bool> marked, const Use& use) {
  if (hierarchy.refinements.empty()) return;
  for (std::size_t k = hierarchy.refinements.size(); k-- > 0;) {
    std::vector<bool> coarser(hierarchy.levels[k].points.size());
    const auto& parents = hierarchy.refinements[k].parents;
    for (std::size_t v = 0; v < parents.size(); ++v)
      if (marked[v])
        for (const Index parent : parents[v]) coarser[parent] = true;
    marked = std::move(coarser);
  }
  const Mesh<D>& mesh = hierarchy.levels.front();
  std::map<std::array<Index, D - 1>, Side> open;
  for (Index f = 0; f < static_cast<Index>(mesh.boundary.size()); ++f)
    for (int tip = 0; tip < D; ++tip) {
      const auto common = joint(mesh.boundary[f], tip);
      if (!std::ranges::all_of(common, [&](Index p) { return marked[p]; })) continue;
      const auto [found, first] = open.try_emplace(common, Side{f, tip});
      if (!first) use(mesh, Side{f, tip}, found->second);
    }
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
  each_marked_joint(hierarchy, std::move(marked), [&](const Mesh<D>& mesh, const Side& a, const Side& b) {
    const Face<D>&one = mesh.boundary[a.face], &other = mesh.boundary[b.face];
    const auto is_patch = [&](Index curve) { return curve >= 0 && mesh.curves[curve].kind == CurveKind::patches; };
    const bool smoothed = one.curve == other.curve && is_patch(one.curve);
    if (!smoothed && (one.curve >= 0 || other.curve >= 0)) return;
    const Point<D> here = across(mesh, one, a.tip), there = across(mesh, other, b.tip);
    const double size = std::min(length<D>(here), length<D>(there)), angle = turn<D>(here, there);
    if (smoothed) {
      const SmoothedOver over{angle * size / 8, angle};
      if (over.error() > smooth.error()) smooth = over;
      return;
    }
    if (const double off = sagitta(angle, size); off > largest.sagitta) largest = {off, angle};
    if (angle > largest_turn && angle <= widest)
      wide.push_back({angle, size, {direction(mesh, one), direction(mesh, other)}});
  });
  const Chords wider = widest_chords(wide);
  Chords out = wider.sagitta > largest.sagitta ? wider : largest;
  out.smoothed = smooth;
  return out;
}

template Chords chord_sagitta(const MeshHierarchy<2>&, std::vector<bool>);
template Chords chord_sagitta(const MeshHierarchy<3>&, std::vector<bool>);

}  // namespace signorini
