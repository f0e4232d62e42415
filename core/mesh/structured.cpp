#include "core/mesh/structured.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

template <int D>
using Cell = std::array<Index, D>;

template <int D>
void check(const Point<D>& from, const Point<D>& to, const Cell<D>& cells, const char* shape) {
  double vertices = 1, elements = D == 2 ? 2 : 6;
  for (int k = 0; k < D; ++k) {
    if (!std::isfinite(from[k]) || !std::isfinite(to[k]) || !(from[k] < to[k]) || !std::isfinite(to[k] - from[k]))
      input_error(shape,
                  fmt::format("'from' must be less than 'to' in every direction, found from = {}, to = {}", from, to));
    if (cells[k] < 1) input_error(shape, fmt::format("'cells' must be at least 1 in every direction, found {}", cells));
    if (!(from[k] + (to[k] - from[k]) / cells[k] > from[k]) || !(to[k] - (to[k] - from[k]) / cells[k] < to[k]))
      input_error(shape, fmt::format("cells = {} between {} and {} are smaller than rounding errors", cells, from, to));
    vertices *= cells[k] + 1.0;
    elements *= cells[k];
  }
  if (std::max(vertices, elements) > std::numeric_limits<Index>::max())
    input_error(shape, fmt::format("cells = {} give {:.3g} elements, more than the {} that can be numbered", cells,
                                   elements, std::numeric_limits<Index>::max()));
}

/// Calls visit(i) for all 0 <= i < n in lexicographic order, the first component fastest.
template <int D, class Visit>
void for_each_cell(const Cell<D>& n, const Visit& visit) {
  Cell<D> i{};
  for (int k = 0; k < D;) {
    visit(i);
    for (k = 0; k < D && ++i[k] == n[k]; ++k) i[k] = 0;
  }
}

template <int D>
std::vector<Point<D>> grid_points(const Point<D>& from, const Point<D>& to, const Cell<D>& cells) {
  std::vector<Point<D>> points;
  Cell<D> n = cells;
  for (Index& c : n) ++c;
  for_each_cell<D>(n, [&](const Cell<D>& i) {
    Point<D> p;
    for (int k = 0; k < D; ++k) p[k] = i[k] == cells[k] ? to[k] : from[k] + (to[k] - from[k]) * i[k] / cells[k];
    points.push_back(p);
  });
  return points;
}

/// One simplex per permutation of the directions: the path from the lowest to the highest corner of a cell.
template <int D>
std::vector<Simplex<D>> kuhn_simplices(const Cell<D>& cells) {
  Cell<D> stride{1};
  for (int k = 1; k < D; ++k) stride[k] = stride[k - 1] * (cells[k - 1] + 1);

  std::vector<Simplex<D>> pattern;
  std::array<int, D> direction;
  std::iota(direction.begin(), direction.end(), 0);
  do {
    Simplex<D> path{};
    int inversions = 0;
    for (int k = 0; k < D; ++k) {
      path[k + 1] = path[k] + stride[direction[k]];
      for (int l = 0; l < k; ++l) inversions += direction[l] > direction[k];
    }
    if (inversions % 2 == 1) flip<D>(path);
    pattern.push_back(path);
  } while (std::next_permutation(direction.begin(), direction.end()));

  std::vector<Simplex<D>> elements;
  for_each_cell<D>(cells, [&](const Cell<D>& i) {
    const Index lowest = std::inner_product(i.begin(), i.end(), stride.begin(), Index{0});
    for (Simplex<D> simplex : pattern) {
      for (Index& v : simplex) v += lowest;
      elements.push_back(simplex);
    }
  });
  return elements;
}

/// The parts lie at the lower and upper end of each direction in turn.
template <int D>
void name_sides(Mesh<D>& mesh, const Cell<D>& cells, const std::array<const char*, 2 * D>& names) {
  for (const char* name : names) mesh.parts.push_back({name, {}});
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    Index stride = 1;
    for (int k = 0; k < D; stride *= cells[k++] + 1)
      for (const int end : {0, 1})
        if (std::ranges::all_of(mesh.boundary[f].vertices,
                                [&](Index v) { return v / stride % (cells[k] + 1) == end * cells[k]; }))
          mesh.parts[2 * k + end].faces.push_back(static_cast<Index>(f));
  }
}

template <int D>
Mesh<D> kuhn_grid(const Point<D>& from, const Point<D>& to, const Cell<D>& cells, const char* shape,
                  const std::array<const char*, 2 * D>& names) {
  check<D>(from, to, cells, shape);
  Mesh<D> mesh;
  mesh.points = grid_points<D>(from, to, cells);
  mesh.elements = kuhn_simplices<D>(cells);
  mesh.boundary = find_boundary<D>(mesh.vertices(), mesh.elements);
  name_sides<D>(mesh, cells, names);
  return mesh;
}

}  // namespace

Mesh<2> rectangle(Point<2> from, Point<2> to, std::array<Index, 2> cells) {
  return kuhn_grid<2>(from, to, cells, "rectangle", {"left", "right", "bottom", "top"});
}

Mesh<3> box(Point<3> from, Point<3> to, std::array<Index, 3> cells) {
  return kuhn_grid<3>(from, to, cells, "box", {"left", "right", "front", "back", "bottom", "top"});
}

}  // namespace signorini
