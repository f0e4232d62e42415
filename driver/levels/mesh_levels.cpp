#include "driver/levels/mesh_levels.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "core/mesh/vertex_ids.hpp"

namespace signorini {
namespace {

/// What is known at the nodes of one mesh, for those of another one.
template <int D, int B>
class CarriedOver {
 public:
  CarriedOver(const VertexIds& ids, const std::vector<VertexId>& from, const Nodes<D>& from_nodes) : ids_(ids) {
    for (std::size_t v = 0; v < from.size(); ++v) node_.emplace(from[v], from_nodes.of_vertex(static_cast<Index>(v)));
  }

  LevelSolution<B> operator()(const LevelSolution<B>& known, const std::vector<VertexId>& to,
                              const Nodes<D>& nodes) const {
    LevelSolution<B> out;
    std::vector<Index> source(static_cast<std::size_t>(nodes.size()), -1);
    if (!known.u.empty()) out.u.resize(static_cast<std::size_t>(nodes.size()) * B);
    for (std::size_t v = 0; v < to.size(); ++v) {
      const Index p = nodes.of_vertex(static_cast<Index>(v));
      source[p] = node_.at(nearest(to[v]));
      if (known.u.empty()) continue;
      const Point<B> u = value(known.u, to[v]);
      std::copy(u.begin(), u.end(), out.u.begin() + Offset{p} * B);
    }
    out.numbers = known.numbers.at_nodes(source);
    return out;
  }

 private:
  Point<B> value(const std::vector<double>& u, VertexId id) const {
    Point<B> out;
    if (const auto found = node_.find(id); found != node_.end()) {
      std::copy_n(u.begin() + Offset{found->second} * B, B, out.begin());
      return out;
    }
    const auto [a, b] = ids_.parents(id);
    const Point<B> from = value(u, a), to = value(u, b);
    for (int k = 0; k < B; ++k) out[k] = 0.5 * (from[k] + to[k]);
    return out;
  }
  VertexId nearest(VertexId id) const { return node_.contains(id) ? id : nearest(ids_.parents(id)[0]); }

  const VertexIds& ids_;
  std::unordered_map<VertexId, Index> node_;
};

}  // namespace

template <int D, int B>
MeshLevels<D, B>::MeshLevels(const MeshHierarchy<D>& hierarchy, std::vector<Nodes<D>> nodes) {
  for (std::size_t k = 0; k < hierarchy.levels.size(); ++k)
    levels_.emplace_back(hierarchy.levels[k], k > 0 ? &hierarchy.refinements[k - 1] : nullptr, std::move(nodes[k]));
}

template <int D, int B>
std::vector<const Mesh<D>*> MeshLevels<D, B>::meshes() const {
  std::vector<const Mesh<D>*> out;
  for (const MeshLevel<D, B>& level : levels_) out.push_back(level.mesh);
  return out;
}

template <int D, int B>
void MeshLevels<D, B>::append(const Mesh<D>& mesh, const Refinement& refinement, Nodes<D> nodes) {
  levels_.emplace_back(mesh, &refinement, std::move(nodes));
}

/// What is kept of the coarser mesh lacks its matrix, which was among those below the finest one.
template <int D, int B>
void MeshLevels<D, B>::drop_finest() {
  levels_.pop_back();
  levels_.back().kept.reset();
}

template <int D, int B>
void MeshLevels<D, B>::replace_finest(const Mesh<D>& mesh, const Refinement& refinement, Nodes<D> nodes) {
  VertexIds ids(levels_.front().mesh->vertices());
  std::vector<VertexId> coarse = ids.coarsest();
  for (std::size_t k = 1; k + 1 < levels_.size(); ++k) coarse = ids.refined(coarse, *levels_[k].refinement);
  const std::vector<VertexId> from = ids.refined(coarse, *finest().refinement), to = ids.refined(coarse, refinement);
  MeshLevel<D, B> next(mesh, &refinement, std::move(nodes));
  const CarriedOver<D, B> carried_over(ids, from, finest().nodes);
  next.before = carried_over(finest().before, to, next.nodes);
  next.now = carried_over(finest().now, to, next.nodes);
  levels_.pop_back();
  levels_.push_back(std::move(next));
}

template class MeshLevels<2, 1>;
template class MeshLevels<3, 1>;
template class MeshLevels<2, 2>;
template class MeshLevels<3, 3>;

}  // namespace signorini
