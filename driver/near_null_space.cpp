#include "driver/near_null_space.hpp"

#include <vector>

namespace signorini {
namespace {

/// Modes of displacements become modes of unknowns that are jumps.
template <int B>
void to_jumps(const Jumps<B>& jumps, NearNullSpace& space) {
  std::vector<double> mode(space.value.size() / static_cast<std::size_t>(space.modes));
  for (Index k = 0; k < space.modes; ++k) {
    for (std::size_t i = 0; i < mode.size(); ++i) mode[i] = space.at(static_cast<Offset>(i))[k];
    to_jumps(jumps, mode);
    for (std::size_t i = 0; i < mode.size(); ++i) space.at(static_cast<Offset>(i))[k] = mode[i];
  }
}

}  // namespace

template <int D, int B>
NearNullSpace near_null_space(const Nodes<D>& nodes, const Jumps<B>* jumps) {
  if constexpr (B == 1) return {};
  std::vector<double> coordinates;
  for (Index p = 0; p < nodes.size(); ++p) {
    const Point<D> x = nodes.control_point(p);
    coordinates.insert(coordinates.end(), x.begin(), x.end());
  }
  NearNullSpace space = rigid_body_modes<D>(coordinates);
  if constexpr (D == B)
    if (jumps) to_jumps(*jumps, space);
  return space;
}

template NearNullSpace near_null_space<2, 1>(const Nodes<2>&, const Jumps<1>*);
template NearNullSpace near_null_space<2, 2>(const Nodes<2>&, const Jumps<2>*);
template NearNullSpace near_null_space<3, 1>(const Nodes<3>&, const Jumps<1>*);
template NearNullSpace near_null_space<3, 3>(const Nodes<3>&, const Jumps<3>*);

}  // namespace signorini
