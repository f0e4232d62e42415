#include "core/algebra/near_null_space.hpp"

#include <array>
#include <utility>

namespace signorini {

template <int B>
NearNullSpace rigid_body_modes(std::span<const double> coordinates) {
  const auto vectors = static_cast<Offset>(coordinates.size()) / B;
  std::array<double, B> center{};
  for (Offset k = 0; k < vectors * B; ++k) center[k % B] += coordinates[k] / static_cast<double>(vectors);
  NearNullSpace out;
  out.modes = B * (B + 1) / 2;
  out.value.assign(static_cast<std::size_t>(vectors * B * out.modes), 0.0);
  for (Offset p = 0; p < vectors; ++p) {
    for (int i = 0; i < B; ++i) out.at(p * B + i)[i] = 1;
    int mode = B;
    for (int i = 0; i < B; ++i)  // in the plane of the axes i and j
      for (int j = i + 1; j < B; ++j, ++mode) {
        out.at(p * B + i)[mode] = center[j] - coordinates[p * B + j];
        out.at(p * B + j)[mode] = coordinates[p * B + i] - center[i];
      }
  }
  return out;
}

template NearNullSpace rigid_body_modes<1>(std::span<const double>);
template NearNullSpace rigid_body_modes<2>(std::span<const double>);
template NearNullSpace rigid_body_modes<3>(std::span<const double>);

}  // namespace signorini
