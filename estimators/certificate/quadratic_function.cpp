#include "estimators/certificate/quadratic_function.hpp"

#include <algorithm>
#include <utility>

namespace signorini {
namespace {

/// Which node is the midpoint between two corners of quadratic elements.
template <int D>
class Midpoints {
 public:
  explicit Midpoints(const Nodes<D>& nodes) {
    for (Index p = 0; p < nodes.size(); ++p)
      if (const auto [a, b] = nodes.ends(p); a != b) of_.push_back({std::minmax(a, b), p});
    std::ranges::sort(of_);
  }
  Index operator()(Index a, Index b) const {
    const std::pair<Index, Index> wanted = std::minmax(a, b);
    return std::ranges::lower_bound(of_, wanted, {}, [](const auto& entry) { return entry.first; })->second;
  }

 private:
  std::vector<std::pair<std::pair<Index, Index>, Index>> of_;
};

/// The way along an edge between nodes, in barycentric coordinates of the element: half of it for each end.
struct Way {
  std::array<Index, 4> corner;
  std::array<double, 4> by{};
  int count = 0;

  void add(const std::array<Index, 2>& ends, double half) {
    for (const Index c : ends) {
      const auto at = std::find(corner.begin(), corner.begin() + count, c);
      if (at == corner.begin() + count) corner[static_cast<std::size_t>(count++)] = c;
      by[static_cast<std::size_t>(at - corner.begin())] += half;
    }
  }
};

}  // namespace

/// With the bubbles' coefficients c_ij of the element the second derivative along a way d is 8 sum of c_ij d_i d_j, and
/// the coefficient of an edge -1/8 of it.
template <int D, int B>
QuadraticFunction quadratic_function(const Nodes<D>& nodes, const Incidence<D>& incidence,
                                     const std::vector<double>& u) {
  if (nodes.order() == 1) return {u, {}};
  QuadraticFunction out{nodes.at_vertices(u, B), std::vector<double>(static_cast<std::size_t>(incidence.edges) * B)};
  const std::vector<double>& value = out.at_vertex;
  const Midpoints<D> midpoint(nodes);
  constexpr auto edges = simplex_edges<D>();
  for (Index edge = 0; edge < incidence.edges; ++edge) {
    const Index at = incidence.at_edge[incidence.first_at_edge[edge]];
    const auto [a, b] = edges[at % Index{edges.size()}];
    const Simplex<D>& v = nodes.mesh().elements[at / Index{edges.size()}];
    Way way;
    way.add(nodes.ends(v[a]), -0.5);
    way.add(nodes.ends(v[b]), 0.5);
    for (int i = 0; i < way.count; ++i)
      for (int j = 0; j < i; ++j) {
        if (way.by[i] * way.by[j] == 0) continue;
        const Offset p = Offset{way.corner[i]} * B, q = Offset{way.corner[j]} * B,
                     m = Offset{midpoint(way.corner[i], way.corner[j])} * B;
        for (int k = 0; k < B; ++k)
          out.of_edge[Offset{edge} * B + k] -=
              way.by[i] * way.by[j] * (value[m + k] - (value[p + k] + value[q + k]) / 2);
      }
  }
  return out;
}

/// The nodes of any child are corners, or between corners, that are all those of the father.
template <int D>
std::vector<Index> fathers(const Nodes<D>& nodes) {
  const Mesh<D>& mesh = nodes.mesh();
  std::vector<std::pair<Simplex<D>, Index>> father;
  for (std::size_t f = 0; f < mesh.families.size(); ++f) {
    Simplex<D> corners;
    std::copy_n(mesh.families[f].begin(), D + 1, corners.begin());
    father.push_back({sorted(corners), static_cast<Index>(f)});
  }
  std::ranges::sort(father);
  std::vector<Index> out;
  for (const Simplex<D>& child : mesh.elements) {
    std::array<Index, 2 * (D + 1)> ends;
    for (std::size_t a = 0; a <= D; ++a)
      for (std::size_t k = 0; k < 2; ++k) ends[2 * a + k] = nodes.ends(child[a])[k];
    std::ranges::sort(ends);
    Simplex<D> corners;
    std::unique_copy(ends.begin(), ends.end(), corners.begin());
    out.push_back(std::ranges::lower_bound(father, corners, {}, [](const auto& entry) { return entry.first; })->second);
  }
  return out;
}

template std::vector<Index> fathers(const Nodes<2>&);
template std::vector<Index> fathers(const Nodes<3>&);
template QuadraticFunction quadratic_function<2, 1>(const Nodes<2>&, const Incidence<2>&, const std::vector<double>&);
template QuadraticFunction quadratic_function<3, 1>(const Nodes<3>&, const Incidence<3>&, const std::vector<double>&);
template QuadraticFunction quadratic_function<2, 2>(const Nodes<2>&, const Incidence<2>&, const std::vector<double>&);
template QuadraticFunction quadratic_function<3, 3>(const Nodes<3>&, const Incidence<3>&, const std::vector<double>&);

}  // namespace signorini
