#include "core/fem/conditions/bounds.hpp"

#include <algorithm>

#include "core/component/failure.hpp"
#include "core/constraints/bound_collector.hpp"
#include "core/fem/conditions/model_places.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"

namespace signorini {
namespace {

constexpr double asks_for_distance = 0;  // a SurfaceVertex::measure

// The nodes an obstacle may touch; on the boundary with normals of the faces it may touch.
template <int D>
struct Candidates {
  Surface<D> surface;
  std::vector<Point<D>> normals;
  bool everywhere;
  std::vector<double> areas, volumes;  // per node of the surface or of all: SurfaceVertex::measure for functionals

  template <int B>
  Candidates(const Nodes<D>& nodes, const Model<B>& model, const ObstacleTerm<B>& term)
      : surface(term.on ? signorini::surface(nodes, select_faces(nodes.mesh(), *term.on, model.t))
                        : signorini::surface(nodes)),
        normals(node_normals(nodes, surface)),
        everywhere(!term.on) {
    if (!term.obstacle->functional()) return;
    if (B == 1 && everywhere)
      volumes = node_volumes(nodes, model.plane);
    else
      areas = node_areas(nodes, surface, model.plane);
  }

  Index size(const Nodes<D>& nodes) const {
    return everywhere ? nodes.size() : static_cast<Index>(surface.nodes.size());
  }

  // Calls use(node, normal, measure) by ascending node.
  template <class Use>
  void each(const Nodes<D>& nodes, const Use& use) const {
    const auto on_surface = static_cast<Index>(surface.nodes.size());
    Index next = 0;
    for (Index k = 0; k < size(nodes); ++k) {
      const Index p = everywhere ? k : surface.nodes[k];
      const bool here = next < on_surface && surface.nodes[next] == p;
      const double measure = !volumes.empty() ? volumes[p] : here && !areas.empty() ? areas[next] : 0;
      use(p, here ? normals[next] : Point<D>{}, measure);
      next += here;
    }
  }
};

template <int D>
SurfaceVertex vertex_at(const Nodes<D>& nodes, Index p, const Point<D>& normal, double measure) {
  SurfaceVertex v{};
  v.measure = measure;
  v.vertex = nodes.vertex(p);
  std::copy_n(nodes.at(p).data(), D, v.position);
  std::copy_n(normal.data(), D, v.normal);
  return v;
}

/// Between bodies: the nodes that the other body is in front of.
template <int D, int B>
void collect_paired(const Nodes<D>& nodes, const Candidates<D>& candidates, const PairedBodies<B>& pairing,
                    Index obstacle, BoundCollector<B>& collector) {
  auto next = std::ranges::find(pairing.nodes, obstacle, &PairedNode<B>::obstacle);
  candidates.each(nodes, [&](Index p, const Point<D>& normal, double measure) {
    if (next == pairing.nodes.end() || next->obstacle != obstacle || next->node != p) return;
    SurfaceVertex v = vertex_at<D>(nodes, p, normal, measure);
    v.gap = next->gap;
    std::copy_n(next->away.data(), B, v.away);
    collector.push(p, v, next++->part);
  });
}

/// Bounds about the displaced body, of which the first one's number is given, as bounds of the whole displacement.
template <int B>
void count_from_rest(const ObstacleTerm<B>& term, std::size_t first, std::vector<Bound<B>>& bounds) {
  for (std::size_t k = first; k < bounds.size(); ++k) {
    const double by = dot(bounds[k].direction, term.moved);
    bounds[k].lower += by;
    bounds[k].upper += by;
    bounds[k].gap += by;
  }
}

/// What a functional counts on, such as a coefficient of friction, is that of where the body was drawn.
template <int B>
void take_numbers(const ObstacleTerm<B>& term, const std::vector<SurfaceVertex>& drawn, const std::vector<Index>& of,
                  std::vector<FunctionalNumbers<B>>& numbers) {
  std::vector<LocalConstraint<B>> constraints(drawn.size());
  Status status;
  term.obstacle->assemble(drawn.data(), drawn.size(), constraints.data(), status);
  if (!status.ok()) throw_failure(status, term.origin);
  for (std::size_t k = 0; k < of.size(); ++k)
    std::copy(std::begin(constraints[k].data), std::end(constraints[k].data), numbers[of[k]].data.begin());
}

template <int D, int B>
void collect(const Nodes<D>& nodes, const Model<B>& model, const PairedBodies<B>* pairing, Index obstacle,
             std::vector<Bound<B>>& bounds, std::vector<FunctionalNumbers<B>>& numbers) {
  const std::size_t first = bounds.size();
  const ModelPlaces<D, B> places(nodes, model);
  const Candidates<D> candidates(nodes, model, model.obstacles[obstacle]);
  if (bounds.empty()) bounds.reserve(static_cast<std::size_t>(candidates.size(nodes)));
  BoundCollector<B> collector(places, obstacle, bounds, numbers);
  const ObstacleTerm<B>& term = model.obstacles[obstacle];
  const bool moved = term.moved != std::array<double, B>{};
  if (term.other)
    collect_paired(nodes, candidates, *pairing, obstacle, collector);
  else
    candidates.each(nodes, [&](Index p, const Point<D>& normal, double measure) {
      SurfaceVertex v = vertex_at<D>(nodes, p, normal, moved ? asks_for_distance : measure);
      move<D>(term, v);
      collector.push(p, v);
    });
  collector.flush();
  if (!moved) return;
  count_from_rest(term, first, bounds);
  std::vector<SurfaceVertex> drawn;
  std::vector<Index> of;
  std::size_t next = first;
  candidates.each(nodes, [&](Index p, const Point<D>& normal, double measure) {
    for (; next < bounds.size() && bounds[next].vertex == p; ++next)
      if (bounds[next].data >= 0) {
        drawn.push_back(vertex_at<D>(nodes, p, normal, measure));
        of.push_back(bounds[next].data);
      }
  });
  take_numbers(term, drawn, of, numbers);
}

}  // namespace

template <int D, int B>
std::vector<Bound<B>> collect_bounds(const Nodes<D>& nodes, const Model<B>& model,
                                     std::vector<FunctionalNumbers<B>>& numbers, const PairedBodies<B>* pairing) {
  std::vector<Bound<B>> bounds;
  for (std::size_t k = 0; k < model.obstacles.size(); ++k)
    collect(nodes, model, pairing, static_cast<Index>(k), bounds, numbers);
  if (model.obstacles.size() > 1)
    std::stable_sort(bounds.begin(), bounds.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  return bounds;
}

template <int D, int B>
std::vector<Bound<B>> bounds_of(const Nodes<D>& nodes, const Model<B>& model, Index obstacle) {
  std::vector<Bound<B>> bounds;
  std::vector<FunctionalNumbers<B>> numbers;
  collect<D, B>(nodes, model, nullptr, obstacle, bounds, numbers);
  return bounds;
}

template std::vector<Bound<2>> bounds_of(const Nodes<2>&, const Model<2>&, Index);
template std::vector<Bound<3>> bounds_of(const Nodes<3>&, const Model<3>&, Index);

#define SIGNORINI_INSTANTIATE(D, B)                                                                                   \
  template std::vector<Bound<B>> collect_bounds(const Nodes<D>&, const Model<B>&, std::vector<FunctionalNumbers<B>>&, \
                                                const PairedBodies<B>*);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
