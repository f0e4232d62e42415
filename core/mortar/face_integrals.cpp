#include "core/mortar/face_integrals.hpp"

#include <algorithm>

#include "core/mesh/quadrature.hpp"

namespace signorini::mortar {
namespace {

/// What of a face nothing is in front of, but for rounding.
constexpr double uncovered = 1e-9;

/// Exact for products of two basis functions, and times the radius or the distance of curved surfaces.
template <int K, int P>
std::span<const QuadraturePoint<K>> rule(bool curved) {
  if (K == 2 && P == 1 && !curved) return quadrature2<K>();
  return quadrature5<K>();
}

template <int D>
std::array<double, D> coordinates(const std::array<Affine<D - 1>, D>& shape, const Point<D - 1>& y) {
  std::array<double, D> out;
  for (int i = 0; i < D; ++i) out[i] = shape[i](y);
  return out;
}

/// By how much a curved element's face is off one of the flat faces that it is made of.
template <int D>
Point<D> bulge(const Point<D>& at, const std::array<Point<D>, D>& corner, const std::array<double, D>& barycentric) {
  Point<D> out = at;
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) out[k] -= barycentric[i] * corner[i][k];
  return out;
}

}  // namespace

template <int D, int P>
void FaceIntegrator<D, P>::add(ElementFace<D, P> face, FaceIntegrals<D, P>& to) {
  covered_.clear(), seen_.clear(), runs_.clear();
  surface_points_ = 0;
  for (Index child = 0; child < ElementFace<D, P>::parts; ++child) look(face, child, to);
  if (covered_.empty()) return;
  const bool of_surface = surface_points_ == covered_.size();
  const double size = P * finder_.frame().size;
  keep_nearest_sheet(slave_.normal[face.part(0)], size);
  const DualBasis<K, P> dual(covered_);
  to.lumped += dual.lumped();
  FaceRecord<D, P>& record = to.records.emplace_back();
  record.node = face.points(slave_);
  for (Index& p : record.node) p = slave_.number[p];
  record.share = dual.share();
  record.gap = {}, record.normal = {};
  Distances all;
  for (const Run& run : runs_) all.add(run.seen);
  record.nearest = all.nearest, record.farthest = all.farthest;
  record.size = size;
  record.first_part = to.parts.size();
  to.parts.insert(to.parts.end(), parts_.begin(), parts_.end());
  record.last_part = to.parts.size();
  record.first = to.entries.size();
  for (const Run& run : runs_) {
    const auto point = ElementFace<D, P>::with_part(run.part).points(master_);
    std::array<std::array<double, ElementFace<D, P>::nodes>, ElementFace<D, P>::nodes> sum{};  // per node of the master
    for (std::size_t i = run.first; i < run.last; ++i) {
      const auto value = basis<P>(seen_[i].master);
      auto r = dual(covered_[i].at);
      for (std::size_t p = 0; p < r.size(); ++p) {
        r[p] *= covered_[i].weight;
        record.gap[p] += r[p] * seen_[i].gap;
        for (int k = 0; k < D; ++k) record.normal[p][k] += r[p] * seen_[i].normal[k];
        for (std::size_t q = 0; q < r.size(); ++q) sum[q][p] += r[p] * value[q];
      }
    }
    for (std::size_t q = 0; q < point.size(); ++q) {
      FaceEntry<D, P>& to_node = entry(point[q], to);
      for (std::size_t p = 0; p < point.size(); ++p) to_node.value[p] += sum[q][p];
    }
  }
  record.last = to.entries.size();
  record.of_surface = of_surface;
  if (of_surface) record.normal = normals_at_nodes(face);
  const auto [least, most] = std::ranges::minmax(record.gap);
  record.kink = least < all.nearest || most > all.farthest ? kink(face, size) : 0;
}

/// Leaves out what is behind that.
template <int D, int P>
void FaceIntegrator<D, P>::keep_nearest_sheet(const Point<D>& direction, double size) {
  parts_.clear();
  for (const Run& run : runs_) parts_.push_back({run.part, run.seen});
  merge_parts(parts_);
  sheet_.choose(parts_, direction, size);
  const auto kept = [this](const Run& run) {
    return std::ranges::lower_bound(parts_, run.part, {}, &SeenPart::part)->kept;
  };
  if (std::ranges::all_of(runs_, kept)) return;
  std::erase_if(runs_, [&](const Run& run) { return !kept(run); });
  std::size_t points = 0;
  for (Run& run : runs_) {
    for (std::size_t i = run.first; i < run.last; ++i, ++points) {
      covered_[points] = covered_[i];
      seen_[points] = seen_[i];
    }
    run.first = points - (run.last - run.first);
    run.last = points;
  }
  covered_.resize(points), seen_.resize(points);
}

/// By how much the distance may be off what is smooth: the largest difference of slopes on both sides of an edge of the
/// master, over the face's size; anything between sheets. Where these end within the face what goes on beyond is as
/// inclined as they are.
template <int D, int P>
double FaceIntegrator<D, P>::kink(ElementFace<D, P> face, double size) const {
  if (sheet_.apart()) return infinity;
  const Point<D>& direction = slave_.normal[face.part(0)];
  double slope = sheet_.kink(parts_, direction), measure = 0;
  for (const Run& run : runs_) measure += run.measure;
  if (measure < (1 - uncovered) * face.area(slave_))
    for (const Run& run : runs_) {
      const Point<D> normal = outer_normal<D, P>(master_, run.part, barycentre<K>(), direction);
      const double inclined = length<D>(difference<D>(slope_along<D>(normal, direction), direction));
      if (inclined > steepest) slope = std::max(slope, inclined);
    }
  return size * slope;
}

/// Adds what one of its parts sees.
template <int D, int P>
void FaceIntegrator<D, P>::look(ElementFace<D, P> face, Index child, FaceIntegrals<D, P>& to) {
  const Index part = face.part(child);
  if (!finder_.find(part)) return;
  to.layered += finder_.layered();
  const double scale = slave_.area[part] / finder_.frame().area;  // from the plane to the slave
  const ElementMap<D, K, P> map = face.map(slave_);
  for (const Segment<D>& segment : finder_.segments()) {
    runs_.push_back({segment.master, covered_.size(), covered_.size(), note_overlap(segment, part, to.deepest),
                     scale * measure(segment.piece)});
    add_points(segment, face, child, map, scale);
  }
}

/// Of the surface that the face stands for, at the nodes themselves. Means over a face are inclined to that, and
/// what is round and turns would come nearer by it.
template <int D, int P>
auto FaceIntegrator<D, P>::normals_at_nodes(ElementFace<D, P> face) const -> NodeNormals {
  NodeNormals out{};
  for (Index child = 0; child < ElementFace<D, P>::parts; ++child)
    for (int i = 0; i < D; ++i) {
      Barycentric corner{};
      corner[i] = 1;
      const Index part = face.part(child);
      const Point<D> n = outer_normal<D, P>(slave_, part, corner, slave_.normal[part]);
      for (int k = 0; k < D; ++k) out[ElementFace<D, P>::node(child, i)][k] += n[k];
    }
  for (Point<D>& n : out) {
    const double size = length<D>(n);
    for (double& c : n) c /= size;
  }
  return out;
}

/// Seen from flat parts of faces, distances are those of the surfaces that these stand for, else of curved elements.
template <int D, int P>
void FaceIntegrator<D, P>::add_points(const Segment<D>& segment, ElementFace<D, P> face, Index child,
                                      const ElementMap<D, K, P>& slave, double scale) {
  const FaceFrame<D>& frame = finder_.frame();
  const auto other = ElementFace<D, P>::with_part(segment.master);
  const Index other_child = segment.master - other.part(0);
  const ElementMap<D, K, P> master = other.map(master_);
  const Index part = face.part(child);
  const bool along_own = along_normals_ && !finder_.along_plane();
  const bool on_surface = slave_.stands_for_surface(part), to_surface = master_.stands_for_surface(segment.master);
  each_simplex(segment.piece, [&](const std::array<Point<K>, D>& simplex) {
    const double measure = scale * signed_measure<K>(simplex);
    for (const QuadraturePoint<K>& q : rule<K, P>(on_surface || to_surface)) {
      Point<K> y{};
      for (int i = 0; i < D; ++i)
        for (int k = 0; k < K; ++k) y[k] += q.barycentric[i] * simplex[i][k];
      const Barycentric here = coordinates<D>(frame.shape, y), there = coordinates<D>(segment.shape, y);
      CoveredPoint<K>& point = covered_.emplace_back();
      point.at = ElementFace<D, P>::coordinates(child, here);
      point.weight = q.weight * measure;
      if (axisymmetric_) point.weight *= slave(point.at)[0];
      Seen& seen = seen_.emplace_back();
      seen.master = ElementFace<D, P>::coordinates(other_child, there);
      seen.gap = frame.size * segment.gap(y);
      seen.normal = frame.direction;
      if (on_surface) {
        const SurfacePoint<D> at = slave_.surface(part, here, frame.direction);
        seen.gap -= at.height;
        if (along_own) seen.normal = at.normal, ++surface_points_;
      } else if (slave.curved()) {
        seen.gap -= dot(frame.direction, bulge<D>(slave(point.at), slave_.corner[part], here));
        if (along_own) seen.normal = unit_normal<D>(slave.flat(point.at));
      }
      Point<D> facing = master_.normal[segment.master];
      if (to_surface) {
        const SurfacePoint<D> at = master_.surface(segment.master, there, frame.direction);
        seen.gap += at.height;
        facing = at.normal;
      } else if (master.curved()) {
        seen.gap += dot(frame.direction, bulge<D>(master(seen.master), master_.corner[segment.master], there));
        facing = unit_normal<D>(master.flat(seen.master));
      }
      // Along the normal, not the direction in which the face looks, it is as far to the plane that touches the master.
      if (on_surface || slave.curved()) seen.gap *= dot(frame.direction, facing) / dot(seen.normal, facing);
      runs_.back().seen.add(seen.gap);
    }
  });
  runs_.back().last = covered_.size();
}

// That of a point in the last record.
template <int D, int P>
FaceEntry<D, P>& FaceIntegrator<D, P>::entry(Index point, FaceIntegrals<D, P>& to) {
  const Index q = master_.number[point];
  if (place_[q] < to.records.back().first || place_[q] >= to.entries.size() || to.entries[place_[q]].master != q) {
    place_[q] = to.entries.size();
    to.entries.push_back({q, {}});
  }
  return to.entries[place_[q]];
}

/// To the distance, at a point of the plane.
template <int D, int P>
double FaceIntegrator<D, P>::added(Index part, const Point<K>& y) const {
  double sum = 0;
  for (int i = 0; i < D && !added_gap_.empty(); ++i)
    sum += finder_.frame().shape[i](y) * added_gap_[slave_.faces[part][i]];
  return sum;
}

/// Along the direction in which a part of the slave looks, at a point of the plane.
template <int D, int P>
double FaceIntegrator<D, P>::distance(const Segment<D>& segment, Index part, const Point<K>& y) const {
  const FaceFrame<D>& frame = finder_.frame();
  double out = frame.size * segment.gap(y);
  if (slave_.stands_for_surface(part))
    out -= slave_.surface(part, coordinates<D>(frame.shape, y), frame.direction).height;
  if (master_.stands_for_surface(segment.master))
    out += master_.surface(segment.master, coordinates<D>(segment.shape, y), frame.direction).height;
  return out;
}

/// @return the distances at the corners of a segment, of flat elements and of those that stand for surfaces
template <int D, int P>
auto FaceIntegrator<D, P>::note_overlap(const Segment<D>& segment, Index part, DeepestOverlap<D>& deepest) const
    -> Distances {
  const FaceFrame<D>& frame = finder_.frame();
  Distances out;
  for (int i = 0; i < segment.piece.count; ++i) {
    const Point<D - 1>& y = segment.piece.corner[i];
    const double here = distance(segment, part, y), depth = -here - added(part, y);
    out.add(here);
    if (depth > deepest.depth) deepest = {depth, frame.place(y, frame.height(y)), part, segment.master};
  }
  return out;
}

template class FaceIntegrator<2, 1>;
template class FaceIntegrator<2, 2>;
template class FaceIntegrator<3, 1>;
template class FaceIntegrator<3, 2>;

}  // namespace signorini::mortar
