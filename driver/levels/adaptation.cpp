#include "driver/levels/adaptation.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

/// So many cuts an element gets at once: all of its edges are halved twice. What is expected of further ones is not to
/// be relied on.
template <int D>
constexpr int cuts_at_once = 2 * D;

/// What is left to each half of an element's share of the error.
template <int D>
const double left_to_half = 0.5 * std::pow(2, -2.0 / D);

template <int D>
int cuts_down_to(double target, double share) {
  if (!(share > target)) return 0;
  const double cuts = std::ceil(std::log(target / share) / std::log(left_to_half<D>));
  return static_cast<int>(std::min(cuts, double{cuts_at_once<D>}));
}

/// How often each element is cut, so that their number grows by about so much and the largest share left is smallest.
template <int D>
std::vector<int> cuts(std::span<const double> share, double growth) {
  const auto elements = [&](double target) {
    double out = 0;
    for (const double s : share) out += std::ldexp(1.0, cuts_down_to<D>(target, s));
    return out;
  };
  const double largest = std::ranges::max(share);
  // What is below `low` would be too many, what is above `high` too few.
  double low = largest * std::pow(left_to_half<D>, cuts_at_once<D> + 1), high = largest;
  for (int step = 0; step < 60 && low < high; ++step) {
    const double middle = std::sqrt(low * high);
    (elements(middle) > growth * static_cast<double>(share.size()) ? low : high) = middle;
  }
  std::vector<int> out;
  for (const double s : share) out.push_back(cuts_down_to<D>(high, s));
  // Where all that may be cut is equally large: the first of it.
  if (std::ranges::all_of(out, [](int n) { return n == 0; })) out[std::ranges::max_element(share) - share.begin()] = 1;
  return out;
}

}  // namespace

template <int D>
Adaptation<D>::Adaptation(Mesh<D> coarsest, int uniform)
    : forest_(std::make_shared<const Mesh<D>>(std::move(coarsest))) {
  forest_.refine(std::vector<int>(static_cast<std::size_t>(forest_.leaves()), D * uniform));
  made_ = forest_.mesh();
}

template <int D>
void Adaptation<D>::refine(std::span<const double> share, double growth) {
  forest_.refine(cuts<D>(share, growth));
  before_ = std::move(made_.id);
  made_ = forest_.mesh();
}

template <int D>
std::vector<double> Adaptation<D>::carried_over(const std::vector<double>& u, int block) const {
  const auto width = static_cast<std::size_t>(block);
  std::vector<double> at((static_cast<std::size_t>(std::ranges::max(made_.id)) + 1) * width);
  std::vector<bool> known(at.size() / width, false);
  for (std::size_t v = 0; v < before_.size(); ++v) {
    std::copy_n(u.begin() + static_cast<Offset>(v * width), width, at.begin() + before_[v] * block);
    known[before_[v]] = true;
  }
  // Parents have lower ids than their children.
  std::vector<VertexId> in_order = made_.id;
  std::ranges::sort(in_order);
  for (const VertexId id : in_order) {
    if (known[id]) continue;
    const auto [a, b] = forest_.parents(id);
    for (int k = 0; k < block; ++k) at[id * block + k] = 0.5 * at[a * block + k] + 0.5 * at[b * block + k];
  }
  std::vector<double> out;
  out.reserve(made_.id.size() * width);
  for (const VertexId id : made_.id) out.insert(out.end(), at.begin() + id * block, at.begin() + (id + 1) * block);
  return out;
}

template class Adaptation<2>;
template class Adaptation<3>;

}  // namespace signorini
