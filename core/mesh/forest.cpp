#include "core/mesh/forest.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <set>

#include "core/mesh/bends.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/placement.hpp"
#include "core/mesh/subsimplices.hpp"

namespace signorini {
namespace {

/// Of what half of its parent's volume an element keeps, where a vertex on a curve would squeeze it.
constexpr double least_part = 0.1;

/// A strict order of edges, the longest first. Edges that differ by rounding are equally long; numbers decide.
template <int D>
class EdgeOrder {
 public:
  explicit EdgeOrder(const std::vector<Point<D>>& points) : points_(points) {}
  bool operator()(Index a, Index b, Index c, Index d) const {
    const float ab = size(a, b), cd = size(c, d);
    if (ab != cd) return ab > cd;
    return std::minmax(a, b) < std::minmax(c, d);
  }

 private:
  float size(Index a, Index b) const {
    return static_cast<float>(length<D>(difference<D>(points_[std::max(a, b)], points_[std::min(a, b)])));
  }
  const std::vector<Point<D>>& points_;
};

/// Per element and vertex the boundary face opposite to it, -1: none.
template <int D>
std::vector<std::array<Index, D + 1>> faces_opposite(const Mesh<D>& mesh) {
  std::array<Index, D + 1> none;
  none.fill(-1);
  std::vector<std::array<Index, D + 1>> out(mesh.elements.size(), none);
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    const Face<D>& face = mesh.boundary[f];
    for (int i = 0; i <= D; ++i)
      if (std::ranges::count(face.vertices, mesh.elements[face.element][i]) == 0)
        out[face.element][i] = static_cast<Index>(f);
  }
  return out;
}

}  // namespace

template <int D>
Forest<D>::Forest(std::shared_ptr<const Mesh<D>> coarsest)
    : coarsest_(std::move(coarsest)),
      ids_(coarsest_->vertices()),
      points_(coarsest_->points),
      uses_(points_.size(), 0),
      on_faces_(ids_),
      in_elements_(ids_) {
  const EdgeOrder<D> longer(coarsest_->points);
  const auto faces = faces_opposite(*coarsest_);
  for (std::size_t e = 0; e < coarsest_->elements.size(); ++e) {
    tree_.push_back({first_of_all<D>(coarsest_->elements[e], faces[e], longer), static_cast<Index>(e)});
    for (const Index v : coarsest_->elements[e]) ++uses_[v];
  }
  find_leaves();
}

template <int D>
void Forest<D>::find_leaves() {
  leaf_.clear();
  std::vector<Index> stack;
  for (Index root = 0; root < static_cast<Index>(coarsest_->elements.size()); ++root) {
    stack.push_back(root);
    while (!stack.empty()) {
      const Index node = stack.back(), child = tree_[node].first_child;
      stack.pop_back();
      if (child < 0) {
        leaf_.push_back(node);
      } else {
        stack.push_back(child + 1);
        stack.push_back(child);
      }
    }
  }
}

template <int D>
Index Forest<D>::add_children(Index node, Index middle) {
  Index first = static_cast<Index>(tree_.size());
  if (free_.empty()) {
    tree_.resize(tree_.size() + 2);
  } else {
    first = free_.back();
    free_.pop_back();
  }
  Node& whole = tree_[node];
  whole.first_child = first;
  for (int side = 0; side < 2; ++side)
    tree_[first + side] = {half<D>(whole.simplex, side, middle),
                           whole.root,
                           -1,
                           middle,
                           static_cast<std::int16_t>(whole.generation + 1),
                           whole.wanted};
  for (const Index v : whole.simplex.vertex) --uses_[v];
  for (int side = 0; side < 2; ++side)
    for (const Index v : tree_[first + side].simplex.vertex) ++uses_[v];
  return first;
}

/// Where the middle of an edge belongs.
/// @param root an element of the coarsest mesh that the edge is in
/// @param faces of the coarsest boundary that it is on
template <int D>
Point<D> Forest<D>::place(Index a, Index b, Index root, std::span<const Index> faces) {
  const Mesh<D>& mesh = *coarsest_;
  const Point<D> middle = midpoint<D>(points_[std::min(a, b)], points_[std::max(a, b)]);
  Placement<D> placement(mesh);
  for (const Index f : faces) placement.add(f);
  Point<D> out = middle;
  if (placement.shapes()) {
    out = placement.on_shapes(middle, length<D>(difference<D>(points_[a], points_[b])));
  } else if (const Index f = placement.patch(); f >= 0) {
    const auto from = on_faces_.of(f, mesh.boundary[f].vertices, a), to = on_faces_.of(f, mesh.boundary[f].vertices, b);
    std::array<double, D> at;
    for (int i = 0; i < D; ++i) at[i] = 0.5 * from[i] + 0.5 * to[i];
    out = (*mesh.patches)[f].at(at);
  } else if (!mesh.bends.empty()) {
    const Simplex<D>& corners = mesh.elements[root];
    const Point<D> bend =
        bend_of<D>(mesh.bends[root], in_elements_.of(root, corners, a), in_elements_.of(root, corners, b));
    for (int k = 0; k < D; ++k) out[k] += bend[k];
  }
  for (const Mirror& mirror : mesh.mirrors)
    if (lies_on<D>(mirror, middle)) out[mirror.axis] = mirror.at;
  return out;
}

/// One call of bisect(), round by round.
template <int D>
class Forest<D>::Cutting {
 public:
  explicit Cutting(Forest& forest) : forest_(forest) {}

  void run(std::span<const Index> leaves) {
    std::vector<Index> nodes;
    for (const Index leaf : leaves) nodes.push_back(forest_.leaf_[leaf]);
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    while (!nodes.empty()) {
      find_edges(nodes);
      make_vertices();
      for (const Index node : nodes) {
        const auto& v = forest_.tree_[node].simplex.vertex;
        made_.push_back(forest_.add_children(node, static_cast<Index>(forest_.ids_.known_midpoint(v[0], v[1]))));
        parent_.push_back(node);
      }
      forest_.find_leaves();
      nodes = with_a_cut_edge();
    }
    straighten();
  }

 private:
  struct Edge {
    std::array<Index, 2> ends;  // ascending
    Index root;
    std::array<Index, 2> faces{-1, -1};  // of the coarsest boundary
  };

  /// Those that the nodes are cut at and that no leaf has cut, in ascending order of their ends: vertices are then
  /// called the same in whatever order the nodes are.
  void find_edges(const std::vector<Index>& nodes) {
    edges_.clear();
    for (const Index node : nodes) {
      const auto& v = forest_.tree_[node].simplex.vertex;
      if (!is_cut(v[0], v[1]))
        edges_.push_back({{std::min(v[0], v[1]), std::max(v[0], v[1])}, forest_.tree_[node].root});
    }
    std::ranges::sort(edges_, {}, [](const Edge& e) { return std::pair(e.ends, e.root); });
    const auto same = [](const Edge& a, const Edge& b) { return a.ends == b.ends; };
    edges_.erase(std::unique(edges_.begin(), edges_.end(), same), edges_.end());
    find_faces();
  }

  /// Of all leaves, for those that are cut need not be the ones at the boundary.
  void find_faces() {
    touched_.resize(forest_.points_.size(), false);
    for (const Edge& edge : edges_)
      for (const Index end : edge.ends) touched_[end] = true;
    for (const Index node : forest_.leaf_) {
      const Bisected<D>& leaf = forest_.tree_[node].simplex;
      for (int i = 0; i <= D; ++i) {
        if (leaf.face[i] < 0) continue;
        for (const auto [a, b] : simplex_edges<D>())
          if (a != i && b != i && touched_[leaf.vertex[a]] && touched_[leaf.vertex[b]])
            add_face(leaf.vertex[a], leaf.vertex[b], leaf.face[i]);
      }
    }
  }

  void add_face(Index a, Index b, Index face) {
    const std::array ends{std::min(a, b), std::max(a, b)};
    const auto edge = std::ranges::lower_bound(edges_, ends, {}, &Edge::ends);
    if (edge == edges_.end() || edge->ends != ends) return;
    if (edge->faces[0] == face || edge->faces[1] == face) return;
    edge->faces[edge->faces[0] < 0 ? 0 : 1] = face;
    if (edge->faces[1] >= 0 && edge->faces[0] > edge->faces[1]) std::swap(edge->faces[0], edge->faces[1]);
  }

  void make_vertices() {
    for (const Edge& edge : edges_) {
      const auto [a, b] = edge.ends;
      const auto id = static_cast<std::size_t>(forest_.ids_.midpoint(a, b));
      if (id < forest_.points_.size()) continue;  // it was there before, and is where it was
      const auto faces = std::ranges::count_if(edge.faces, [](Index f) { return f >= 0; });
      forest_.points_.push_back(forest_.place(a, b, edge.root, std::span(edge.faces).first(faces)));
      forest_.uses_.push_back(0);
    }
  }

  bool is_cut(Index a, Index b) const {
    const VertexId middle = forest_.ids_.known_midpoint(a, b);
    return middle >= 0 && forest_.uses_[middle] > 0;
  }

  std::vector<Index> with_a_cut_edge() const {
    std::vector<Index> out;
    for (const Index node : forest_.leaf_) {
      const auto& v = forest_.tree_[node].simplex.vertex;
      if (std::ranges::count_if(v, [&](Index w) { return w < std::ssize(touched_) && touched_[w]; }) < 2) continue;
      if (std::ranges::any_of(simplex_edges<D>(), [&](const auto& edge) { return is_cut(v[edge[0]], v[edge[1]]); }))
        out.push_back(node);
    }
    return out;
  }

  double volume(Index node) const {
    const Bisected<D>& s = forest_.tree_[node].simplex;
    return (s.mirrored ? -1 : 1) * signed_volume<D>(corners<D>(forest_.points_, s.vertex));
  }

  /// Puts vertices that squeeze an element back to the middles of their edges.
  void straighten() {
    for (bool again = true; again;) {
      again = false;
      for (std::size_t k = 0; k < made_.size(); ++k) {
        const Index m = forest_.tree_[made_[k]].newest;
        const double least = least_part * volume(parent_[k]) / 2;
        if (volume(made_[k]) >= least && volume(made_[k] + 1) >= least) continue;
        const auto [a, b] = forest_.ids_.parents(m);
        const Point<D> middle = midpoint<D>(forest_.points_[a], forest_.points_[b]);
        if (forest_.points_[m] == middle) continue;
        forest_.points_[m] = middle;
        ++forest_.straightened_;
        again = true;
      }
    }
  }

  Forest& forest_;
  std::vector<Edge> edges_;    // new ones of this round
  std::vector<bool> touched_;  // by id: ends of those of this and all rounds before
  std::vector<Index> made_;    // first ones of pairs of nodes
  std::vector<Index> parent_;  // of each pair
};

template <int D>
void Forest<D>::bisect(std::span<const Index> leaves) {
  Cutting(*this).run(leaves);
}

template <int D>
void Forest<D>::refine(std::span<const int> cuts) {
  assert(cuts.size() == leaf_.size());
  for (std::size_t k = 0; k < leaf_.size(); ++k) {
    Node& node = tree_[leaf_[k]];
    node.wanted = static_cast<std::int16_t>(node.generation + cuts[k]);
  }
  for (std::vector<Index> some{0}; !some.empty();) {
    some.clear();
    for (Index leaf = 0; leaf < leaves(); ++leaf)
      if (tree_[leaf_[leaf]].generation < tree_[leaf_[leaf]].wanted) some.push_back(leaf);
    bisect(some);
  }
}

template <int D>
Index Forest<D>::coarsen(const std::vector<bool>& may_go) {
  assert(may_go.size() == leaf_.size());
  std::vector<bool> stays(points_.size(), false);
  for (std::size_t k = 0; k < leaf_.size(); ++k) {
    const Node& leaf = tree_[leaf_[k]];
    for (const Index v : leaf.simplex.vertex)
      if (!may_go[k] || v != leaf.newest) stays[v] = true;
  }
  std::set<Index> gone;
  for (std::size_t node = 0; node < tree_.size(); ++node) {
    const Index child = tree_[node].first_child;
    if (child < 0 || tree_[child].first_child >= 0 || tree_[child + 1].first_child >= 0) continue;
    if (stays[tree_[child].newest]) continue;
    gone.insert(tree_[child].newest);
    for (int side = 0; side < 2; ++side)
      for (const Index v : tree_[child + side].simplex.vertex) --uses_[v];
    for (const Index v : tree_[node].simplex.vertex) ++uses_[v];
    tree_[node].first_child = -1;
    free_.push_back(child);
  }
  find_leaves();
  return static_cast<Index>(gone.size());
}

#define SIGNORINI_INSTANTIATE(D) template class Forest<D>;
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
