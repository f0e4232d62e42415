#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/solver/summary.hpp"

namespace signorini {

/// A triangle of a surface and a value at each corner. Flat pictures have z = 0.
struct Patch {
  double corner[3][3];
  double value[3];
};

/// How a panel is drawn.
enum class View {
  space,  ///< a surface in true proportions, seen from direction `from`
  flat,   ///< a plane figure, z = 0
  graph,  ///< a function of two variables: x and y in true proportions, z not
  curve   ///< `curve`, a function of one variable
};

/// One picture beside others, coloured by the values of its patches.
struct Panel {
  std::string title;
  std::string label;  ///< what the values are
  View view = View::flat;
  std::vector<Patch> patches;
  std::vector<std::array<double, 2>> curve;
  double from[3] = {0.433, -0.75, 0.5};  ///< unit vector towards the viewer
};

/// Draws pictures. A library of its own, signorini_pictures, does it, which is loaded with the first one.
struct Painter {
  /// Residual, algebraic error and contact nodes over the iterations, as a PNG file.
  void (*convergence)(const std::filesystem::path& picture, const std::vector<IterationRecord>& history);
  /// Panels side by side, likewise.
  void (*panels)(const std::filesystem::path& picture, const std::vector<Panel>& panels);
};

/// Error(Exit::plugin) where the library cannot be loaded.
const Painter& load_painter(const std::filesystem::path& library);
/// From the library beside the core's.
const Painter& painter();

}  // namespace signorini
