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
  lines   ///< `lines`, over two axes
};

/// Points that are joined by a line, or marked alone. One that is no number interrupts the line.
struct Line {
  std::vector<std::array<double, 2>> points;
  std::string name = {};  ///< for the key; empty: not in it
  bool joined = true;
  bool marked = true;  ///< joined points have marks where they are few
  bool dashed = false;
  int style = -1;  ///< number of a colour and a marker, for lines that belong together; -1: the line's own number
};

/// One picture beside others, coloured by the values of its patches.
struct Panel {
  std::string title;
  std::string label;  ///< what the values are
  View view = View::flat;
  std::vector<Patch> patches;
  std::vector<Line> lines;
  bool logarithmic = false;              ///< both axes of the lines, of which points that are not positive are left out
  std::string across;                    ///< label of their first axis; `label` is that of the second
  std::vector<std::string> words;        ///< what the values 0, 1, 2... mean, for a legend of these in place of numbers
  double from[3] = {0.433, -0.75, 0.5};  ///< unit vector towards the viewer
};

/// Draws pictures. A library of its own, signorini_pictures, does it, which is loaded with the first one.
struct Painter {
  /// Residual, algebraic error and contact nodes over the iterations, as a PNG file.
  void (*convergence)(const std::filesystem::path& picture, const std::vector<IterationRecord>& history);
  /// Panels side by side, as a PNG or an SVG file, as its name says.
  void (*panels)(const std::filesystem::path& picture, const std::vector<Panel>& panels);
};

/// Error(Exit::plugin) where the library cannot be loaded.
const Painter& load_painter(const std::filesystem::path& library);
/// From the library beside the core's.
const Painter& painter();

}  // namespace signorini
