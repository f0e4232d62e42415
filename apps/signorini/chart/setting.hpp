#pragma once
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace signorini::chart {

/// A way to solve a scene that is the more accurate the more it costs: a curve of the chart.
struct Setting {
  std::string name;               ///< "quadratic elements"
  std::vector<std::string> keys;  ///< as after --set
  std::string finer;              ///< the key that makes it more accurate
  std::vector<std::string> values;
  bool has_bounds = false;  ///< of the energy error, where the scene has them

  /// All keys of its k-th run.
  std::vector<std::string> keys_of(std::size_t k) const;
};

/// Linear and quadratic elements on meshes that are refined uniformly, linear ones where the error is, and what less of
/// the solver's tolerance would save. The first one is what the reference is taken from.
std::vector<Setting> settings(const Scene& scene);

}  // namespace signorini::chart
