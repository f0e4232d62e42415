#include "core/mesh/refine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/release.hpp"
#include "core/mesh/bends.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/layers.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/placement.hpp"
#include "core/mesh/red_refinement.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/subsimplices.hpp"

namespace signorini {
namespace {

constexpr double tie = 1e-6;  // squared diagonals that differ by less are equally long

/// The same element, numbered such that the diagonal to be cut along joins the midpoints of edges 02 and 13.
Simplex<3> put_shortest_diagonal_first(const std::vector<Point<3>>& points, const Simplex<3>& e) {
  const auto squared_diagonal = [&](int a, int b, int c, int d) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double x = points[e[a]][k] + points[e[b]][k] - points[e[c]][k] - points[e[d]][k];
      sum += x * x;
    }
    return sum;
  };
  const double d02 = squared_diagonal(0, 2, 1, 3), d03 = squared_diagonal(0, 3, 1, 2),
               d01 = squared_diagonal(0, 1, 2, 3);
  if (d02 <= (1 + tie) * std::min(d03, d01)) return e;
  return d03 <= (1 + tie) * d01 ? Simplex<3>{e[0], e[2], e[3], e[1]} : Simplex<3>{e[0], e[3], e[1], e[2]};
}

template <int D>
class Refiner {
 public:
  Refiner(const Mesh<D>& coarse, Mesh<D>& fine)
      : coarse_(coarse),
        fine_(fine),
        fathers_(coarse.elements),
        layer_(coarse.layer.empty() ? layers(coarse) : coarse.layer) {
    for (const auto& e : fathers_)
      for (const Index v : e) span_ = std::max(span_, layer_[v] - lowest_layer(e));
    if constexpr (D == 3)
      for (auto& e : fathers_) e = put_shortest_diagonal_first(coarse.points, e);
    edges_ = number_edges<D>(coarse.vertices(), fathers_);
    find_bends();
  }

  Refinement run() {
    check_size();
    refine_elements();
    refine_boundary();
    fine_.curves = coarse_.curves;
    fine_.patches = coarse_.patches;
    fine_.refinements = coarse_.refinements + 1;
    fine_.mirrors = coarse_.mirrors;
    bend();
    return std::move(refinement_);
  }

 private:
  static constexpr auto ends = simplex_edges<D>();
  static constexpr auto& children = RedRefinement<D>::children;
  static constexpr auto& face_children = RedRefinement<D - 1>::children;

  void check_size() const {
    const double limit = std::numeric_limits<Index>::max();
    const double elements = static_cast<double>(fathers_.size()) * children.size();
    const double vertices = static_cast<double>(coarse_.points.size()) + edges_.distinct;
    if (std::max(elements, vertices) > limit)
      input_error("refine.uniform", fmt::format("refinement would give {:.3g} elements and {:.3g} vertices, more than "
                                                "the {:.0f} that can be numbered",
                                                elements, vertices, limit));
  }

  /// The fine vertex at a corner (i <= D) or edge midpoint of a coarse element, made when it is first asked for.
  Index fine_vertex(Index element, int i) {
    const Simplex<D>& father = fathers_[element];
    const Index key =
        i <= D ? father[i]
               : coarse_.vertices() + edges_.number[static_cast<std::size_t>(element) * ends.size() + i - D - 1];
    Index& number = number_[key];
    if (number >= 0) return number;
    const Index a = i <= D ? father[i] : father[ends[i - D - 1][0]];
    const Index b = i <= D ? father[i] : father[ends[i - D - 1][1]];
    number = fine_.vertices();
    fine_.points.push_back(a == b ? coarse_.points[a] : midpoint<D>(coarse_.points[a], coarse_.points[b]));
    fine_.layer.push_back(layer_[a] + layer_[b]);
    refinement_.parents.push_back({a, b});
    return number;
  }

  Index lowest_layer(const Simplex<D>& element) const {
    Index lowest = layer_[element[0]];
    for (const Index v : element) lowest = std::min(lowest, layer_[v]);
    return lowest;
  }

  /// The elements in the order of their lowest layers, and where those of each layer begin.
  std::pair<std::vector<Index>, std::vector<Offset>> sort_fathers() const {
    const Index last = layer_.empty() ? 0 : *std::ranges::max_element(layer_);
    std::vector<Offset> begin(static_cast<std::size_t>(last) + 3, 0);
    for (const auto& father : fathers_) ++begin[lowest_layer(father) + 2];
    for (std::size_t l = 2; l < begin.size(); ++l) begin[l] += begin[l - 1];
    std::vector<Index> order(fathers_.size());
    for (std::size_t e = 0; e < fathers_.size(); ++e)
      order[begin[lowest_layer(fathers_[e]) + 1]++] = static_cast<Index>(e);
    return {std::move(order), std::move(begin)};
  }

  /// The children whose lowest layer is the given one.
  void add_children(Index father, Index layer, Family<D>& node) {
    Family<D> layers;
    for (int i = 0; i <= D; ++i) layers[i] = 2 * layer_[fathers_[father][i]];
    for (std::size_t k = 0; k < ends.size(); ++k) layers[D + 1 + k] = (layers[ends[k][0]] + layers[ends[k][1]]) / 2;
    for (std::size_t c = 0; c < children.size(); ++c) {
      const auto& child = children[c];
      Index lowest = layers[child[0]];
      for (const int i : child) lowest = std::min(lowest, layers[i]);
      if (lowest != layer) continue;
      Simplex<D>& element = fine_.elements.emplace_back();
      for (int i = 0; i <= D; ++i) {
        if (node[child[i]] < 0) node[child[i]] = fine_vertex(father, child[i]);
        element[i] = node[child[i]];
      }
      refinement_.father.push_back(father);
      if (!coarse_.region.empty()) fine_.region.push_back(coarse_.region[father]);
      if (!bends_.empty()) fine_.bends.push_back(bends_of_child<D>(bends_[father], c));
    }
  }

  void refine_elements() {
    const std::size_t vertices = coarse_.points.size() + edges_.distinct;
    number_.assign(vertices, -1);
    fine_ = {};
    fine_.points.reserve(vertices);
    fine_.layer.reserve(vertices);
    refinement_.parents.reserve(vertices);
    fine_.elements.reserve(fathers_.size() * children.size());
    refinement_.father.reserve(fathers_.size() * children.size());
    fine_.families.resize(fathers_.size());
    for (Family<D>& family : fine_.families) family.fill(-1);
    first_child_.resize((span_ + 1) * fathers_.size());
    const auto [order, begin] = sort_fathers();
    if (!coarse_.region.empty())
      for (const Index father : order) fine_.family_region.push_back(coarse_.region[father]);
    const auto layers = static_cast<Index>(begin.size()) - 1;
    for (Index lowest = 0; lowest <= 2 * layers + span_; ++lowest)
      for (Index layer = std::max(0, (lowest - span_ + 1) / 2); layer < layers && 2 * layer <= lowest; ++layer)
        for (Offset i = begin[layer]; i < begin[layer + 1]; ++i) {
          first_child(order[i], lowest - 2 * layer) = static_cast<Index>(fine_.elements.size());
          add_children(order[i], lowest, fine_.families[i]);
        }
    assert(fine_.elements.size() == fathers_.size() * children.size());
  }

  /// The first child of an element whose lowest layer is so far above twice that of the element.
  Index& first_child(Index father, Index above) {
    return first_child_[static_cast<std::size_t>(father) * (span_ + 1) + above];
  }

  /// Fine vertex between two vertices of a coarse element.
  Index midpoint_vertex(Index element, Index a, Index b) {
    const Simplex<D>& father = fathers_[element];
    int edge = 0;
    while (std::minmax(father[ends[edge][0]], father[ends[edge][1]]) != std::minmax(a, b)) ++edge;
    return fine_vertex(element, D + 1 + edge);
  }

  Index child_with(Index father, const std::array<Index, D>& face) {
    for (Index above = 0; above <= span_; ++above)
      for (Index e = first_child(father, above);
           e < static_cast<Index>(fine_.elements.size()) && refinement_.father[e] == father; ++e)
        if (std::ranges::all_of(face, [&](Index v) { return std::ranges::count(fine_.elements[e], v) > 0; })) return e;
    assert(false && "a child of a face bounds a child of its element");
    return -1;
  }

  void refine_boundary() {
    constexpr auto face_ends = simplex_edges<D - 1>();
    fine_.boundary.reserve(coarse_.boundary.size() * face_children.size());
    for (const Face<D>& face : coarse_.boundary) {
      std::array<Index, D + face_ends.size()> node;
      for (int i = 0; i < D; ++i) node[i] = number_[face.vertices[i]];
      for (std::size_t k = 0; k < face_ends.size(); ++k)
        node[D + k] = midpoint_vertex(face.element, face.vertices[face_ends[k][0]], face.vertices[face_ends[k][1]]);
      for (const auto& child : face_children) {
        Face<D> fine{.vertices = {}, .element = -1, .curve = face.curve, .straight = face.straight};
        for (int i = 0; i < D; ++i) fine.vertices[i] = node[child[i]];
        fine.element = child_with(face.element, fine.vertices);
        fine_.boundary.push_back(fine);
      }
    }
    const auto per_face = static_cast<Index>(face_children.size());
    for (const Part& part : coarse_.parts) {
      Part& fine = fine_.parts.emplace_back(Part{part.name, {}});
      fine.faces.reserve(part.faces.size() * per_face);
      for (const Index f : part.faces)
        for (Index k = 0; k < per_face; ++k) fine.faces.push_back(f * per_face + k);
    }
  }

  /// Of the elements as they are numbered here.
  void find_bends() {
    bends_ = coarse_.bends;
    for (std::size_t e = 0; e < bends_.size(); ++e) {
      std::array<int, D + 1> was;
      for (int i = 0; i <= D; ++i)
        was[i] = static_cast<int>(std::ranges::find(coarse_.elements[e], fathers_[e][i]) - coarse_.elements[e].begin());
      bends_[e] = permuted<D>(bends_[e], was);
    }
  }

  /// Puts midpoints where curved elements and boundaries have them.
  void bend() {
    std::vector<Move<D>> moves;
    std::vector<std::uint8_t> seen(fine_.points.size(), 0);
    const auto add = [&](Index v, Point<D> target) {
      if (seen[v]++ != 0) return;
      for (const Mirror& mirror : coarse_.mirrors)
        if (lies_on<D>(mirror, fine_.points[v])) target[mirror.axis] = mirror.at;
      moves.push_back({v, target});
    };
    if (!fine_.curves.empty()) add_moves_of_boundary(add);
    add_moves_of_elements(add);
    refinement_.straightened = move_vertices(fine_, moves);
  }

  template <class Add>
  void add_moves_of_elements(const Add& add) {
    for (std::size_t e = 0; e < bends_.size(); ++e)
      for (std::size_t k = 0; k < ends.size(); ++k) {
        if (bends_[e][k] == Point<D>{}) continue;
        const Index v = fine_vertex(static_cast<Index>(e), static_cast<int>(D + 1 + k));
        Point<D> target = fine_.points[v];
        for (int i = 0; i < D; ++i) target[i] += bends_[e][k][i];
        add(v, target);
      }
  }

  template <class Add>
  void add_moves_of_boundary(const Add& add) {
    const auto per_face = static_cast<Index>(face_children.size());
    const std::vector<std::array<Index, 2>> around = faces_of_new_vertices();
    for (Index f = 0; f < static_cast<Index>(coarse_.boundary.size()); ++f) {
      const Index curve = coarse_.boundary[f].curve;
      if (curve < 0 || coarse_.curves[curve].kind == CurveKind::elements) continue;
      for (Index child = per_face * f; child < per_face * (f + 1); ++child)
        for (const Index v : fine_.boundary[child].vertices)
          if (const auto [a, b] = refinement_.parents[v]; a != b) add(v, place(v, around[v]));
    }
  }

  /// Per fine vertex the coarse boundary faces that it is new on, at most two (of a hinge, some two); -1: none.
  std::vector<std::array<Index, 2>> faces_of_new_vertices() const {
    const auto per_face = static_cast<Index>(face_children.size());
    std::vector<std::array<Index, 2>> out(fine_.points.size(), {-1, -1});
    for (Index child = 0; child < static_cast<Index>(fine_.boundary.size()); ++child)
      for (const Index v : fine_.boundary[child].vertices) {
        const auto [a, b] = refinement_.parents[v];
        if (a == b || out[v][0] == child / per_face) continue;
        out[v][out[v][0] < 0 ? 0 : 1] = child / per_face;
      }
    return out;
  }

  /// Where a new vertex on one or two boundary faces belongs.
  Point<D> place(Index v, const std::array<Index, 2>& faces) const {
    Placement<D> placement(coarse_);
    for (const Index f : faces)
      if (f >= 0) placement.add(f);
    const Point<D>& middle = fine_.points[v];
    if (!placement.shapes()) return placement.patch() < 0 ? middle : on_patch(v, placement.patch());
    const auto [a, b] = refinement_.parents[v];
    return placement.on_shapes(middle, length<D>(difference<D>(coarse_.points[a], coarse_.points[b])));
  }

  /// At the middle of an edge of coarse face f, which is the middle of one of a patch's.
  Point<D> on_patch(Index v, Index f) const {
    const auto corner = in_coarsest_face<D>(f, coarse_.refinements);
    std::array<double, D> at{};
    for (int i = 0; i < D; ++i)
      for (const Index end : refinement_.parents[v])
        if (coarse_.boundary[f].vertices[i] == end)
          for (int k = 0; k < D; ++k) at[k] += 0.5 * corner[i][k];
    return (*coarse_.patches)[f >> ((D - 1) * coarse_.refinements)].at(at);
  }

  const Mesh<D>& coarse_;
  Mesh<D>& fine_;
  std::vector<Simplex<D>> fathers_;
  std::vector<Bends<D>> bends_;  // of the fathers
  Numbering edges_;
  std::vector<Index> layer_;        // per coarse vertex
  Index span_ = 0;                  // of the layers of an element; so far above twice its lowest one may a child's be
  std::vector<Index> first_child_;  // of each coarse element, by its lowest layer
  std::vector<Index> number_;       // fine number of each coarse vertex, then of each coarse edge
  Refinement refinement_;
};

}  // namespace

template <int D>
Refinement refine_uniformly(const Mesh<D>& coarse, Mesh<D>& fine) {
  return Refiner<D>(coarse, fine).run();
}

template <int D>
MeshHierarchy<D> hierarchy(Mesh<D> coarsest, int uniform) {
  MeshHierarchy<D> result;
  result.levels.push_back(std::move(coarsest));
  for (int k = 0; k < uniform; ++k) {
    Mesh<D> fine;
    result.refinements.push_back(refine_uniformly(result.levels.back(), fine));
    for (const Index v : result.refinements.back().straightened) result.straightened.push_back(fine.points[v]);
    release(result.refinements.back().father);
    if (k + 1 == uniform) release(fine.bends);
    result.levels.push_back(std::move(fine));
  }
  return result;
}

template <int D>
HierarchySize hierarchy_size(const Mesh<D>& coarsest, int uniform) {
  double vertices = coarsest.vertices(), elements = coarsest.elements.size(), boundary = coarsest.boundary.size();
  double in_parts = 0, families = 0;
  for (const Part& part : coarsest.parts) in_parts += part.faces.size();
  double edges = uniform > 0 ? number_edges<D>(coarsest.vertices(), coarsest.elements).distinct : 0;

  const auto level_bytes = [&] {
    return vertices * (sizeof(Point<D>) + sizeof(Index) + sizeof(Refinement::parents[0])) +
           elements * sizeof(Simplex<D>) + families * sizeof(Family<D>) + boundary * sizeof(Face<D>) +
           in_parts * sizeof(Index);
  };
  const double bends_per_element = coarsest.bends.empty() ? 0 : sizeof(Bends<D>);
  double bytes = level_bytes();
  for (int k = 0; k < uniform; ++k) {
    bytes += elements * bends_per_element;  // the finest mesh has none
    vertices += edges;
    if constexpr (D == 2) {
      edges = 2 * edges + 3 * elements;
    } else {
      const double faces = (4 * elements + boundary) / 2;  // each is cut by three edges, each octahedron by one
      edges = 2 * edges + 3 * faces + elements;
    }
    families = elements;
    elements *= RedRefinement<D>::children.size();
    boundary *= RedRefinement<D - 1>::children.size();
    in_parts *= RedRefinement<D - 1>::children.size();
    bytes += level_bytes();
  }
  return {vertices, elements, bytes};
}

#define SIGNORINI_INSTANTIATE(D)                                  \
  template Refinement refine_uniformly(const Mesh<D>&, Mesh<D>&); \
  template MeshHierarchy<D> hierarchy(Mesh<D>, int);              \
  template HierarchySize hierarchy_size(const Mesh<D>&, int);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
