#include "driver/levels/adaptation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace signorini {
namespace {

/// So many cuts an element gets at once: all of its edges are halved twice. What is expected of further ones is not to
/// be relied on.
template <int D>
constexpr int cuts_at_once = 2 * D;

template <int D>
int cuts_down_to(double target, double share, double left_to_half) {
  if (!(share > target)) return 0;
  const double cuts = std::ceil(std::log(target / share) / std::log(left_to_half));
  return static_cast<int>(std::min(cuts, double{cuts_at_once<D>}));
}

/// How often each element is cut, so that their number grows by about so much and the largest share left is smallest.
/// @param left_to_half of a share
template <int D>
std::vector<int> cuts(std::span<const double> share, double growth, double left_to_half) {
  const auto elements = [&](double target) {
    double out = 0;
    for (const double s : share) out += std::ldexp(1.0, cuts_down_to<D>(target, s, left_to_half));
    return out;
  };
  const double largest = std::ranges::max(share);
  // What is below `low` would be too many, what is above `high` too few.
  double low = largest * std::pow(left_to_half, cuts_at_once<D> + 1), high = largest;
  for (int step = 0; step < 60 && low < high; ++step) {
    const double middle = std::sqrt(low * high);
    (elements(middle) > growth * static_cast<double>(share.size()) ? low : high) = middle;
  }
  std::vector<int> out;
  for (const double s : share) out.push_back(cuts_down_to<D>(high, s, left_to_half));
  // Where all that may be cut is equally large: the first of it.
  if (std::ranges::all_of(out, [](int n) { return n == 0; })) out[std::ranges::max_element(share) - share.begin()] = 1;
  return out;
}

}  // namespace

template <int D>
Adaptation<D>::Adaptation(Mesh<D> coarsest, int uniform, int order)
    : forest_(std::make_shared<const Mesh<D>>(std::move(coarsest))),
      left_to_half_(0.5 * std::pow(2, -2.0 * order / D)) {
  forest_.refine(std::vector<int>(static_cast<std::size_t>(forest_.leaves()), D * uniform));
  made_ = forest_.mesh();
}

template <int D>
std::vector<typename Adaptation<D>::Leaf> Adaptation<D>::leaves(const SolvedOn<D>& solved) const {
  using Corners = std::array<Index, D + 1>;
  const auto by_corners = [](std::vector<Corners> elements) {
    for (Corners& corners : elements) std::ranges::sort(corners);
    std::vector<Index> order(elements.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](Index e) { return elements[e]; });
    return order;
  };
  std::vector<Corners> corners;  // of elements, as vertices of the mesh
  with_order(solved.nodes, [&](auto order) {
    for (const auto& vertices : solved.nodes.template elements<order>()) {
      std::copy_n(vertices.begin(), D + 1, corners.emplace_back().begin());
      if (order == 1) continue;
      for (Index& v : corners.back()) v = solved.meshes.refinements.back().parents[v][0];
    }
  });
  const std::vector<Index> leaf = by_corners(made_.mesh.elements), element = by_corners(corners);
  std::vector<Leaf> out(leaf.size());
  for (std::size_t k = 0; k < leaf.size(); ++k) {
    Leaf& one = out[leaf[k]] = {element[k], corners[element[k]], forest_.generation(leaf[k])};
    for (Index& v : one.corner) v = static_cast<Index>(made_.id[v]);
  }
  return out;
}

template <int D>
void Adaptation<D>::refine(const SolvedOn<D>& solved, std::span<const double> share, double growth) {
  before_ = leaves(solved);
  std::vector<double> of_leaf;
  for (const Leaf& leaf : before_) of_leaf.push_back(share[leaf.element]);
  forest_.refine(cuts<D>(of_leaf, growth, left_to_half_));
  made_ = forest_.mesh();
}

template <int D>
std::vector<double> Adaptation<D>::carried_over(const SolvedOn<D>& before, const std::vector<double>& u,
                                                const SolvedOn<D>& now, int block) const {
  std::vector<double> out(now.nodes.mesh().points.size() * static_cast<std::size_t>(block));
  Barycentric<D> within(forest_.ids());
  with_order(before.nodes, [&](auto order) {
    const auto& coarse = before.nodes.template elements<order>();
    const auto& fine = now.nodes.template elements<order>();
    // Leaves are numbered depth first: those that an element was cut into follow each other, and fill it.
    std::size_t father = 0;
    double filled = 0;
    for (const Leaf& leaf : leaves(now)) {
      const Leaf& whole = before_[father];
      std::array<std::array<double, D + 1>, D + 1> corner;
      for (int a = 0; a <= D; ++a) corner[a] = within.of(static_cast<Index>(father), whole.corner, leaf.corner[a]);
      const auto node = before.nodes.of(coarse[whole.element]);
      const auto& vertices = fine[leaf.element];
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        const auto place = node_place<D>(k);
        std::array<double, D + 1> at{};
        for (int a = 0; a <= D; ++a)
          for (int i = 0; i <= D; ++i) at[i] += place[a] * corner[a][i];
        const auto value = basis<order>(at);
        double* there = out.data() + Offset{vertices[k]} * block;
        std::fill_n(there, block, 0.0);
        for (std::size_t b = 0; b < node.size(); ++b)
          for (int i = 0; i < block; ++i) there[i] += value[b] * u[Offset{node[b]} * block + i];
      }
      filled += std::ldexp(1.0, whole.generation - leaf.generation);
      if (filled < 1) continue;
      filled = 0;
      ++father;
    }
  });
  return out;
}

template class Adaptation<2>;
template class Adaptation<3>;

}  // namespace signorini
