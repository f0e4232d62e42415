#include "core/algebra/energy_along.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace signorini {

void refuse_if_negative(const EnergyAlong& energy, Offset row) {
  if (!(energy.of_matrix < -rounding_of_energy * energy.of_diagonal)) return;
  input_error("matrix",
              fmt::format("indefinite: d'Ad is {:.3g} times d'Dd, D its diagonal, for a direction d with the largest "
                          "entry in row {}; expected a positive semidefinite matrix",
                          energy.of_matrix / energy.of_diagonal, row + 1));
}

}  // namespace signorini
