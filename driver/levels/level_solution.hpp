#pragma once
#include <vector>

#include "core/constraints/own_numbers.hpp"
#include "core/fem/recovery/joint_pressure.hpp"

namespace signorini {

/// What the next load step needs to know of a solution on a level.
template <int B>
struct LevelSolution {
  std::vector<double> u;  ///< global coordinates; of the last solve on the finest mesh, not accepted yet: none
  OwnNumbers<B> numbers;
  std::vector<double> pressure;
  Wetted wetted;  ///< by pressure in joints; on the finest mesh only
  double t = 0;   ///< the step parameter; likewise
};

}  // namespace signorini
