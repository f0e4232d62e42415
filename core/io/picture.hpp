#pragma once
#include <sys/types.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/solver/summary.hpp"

namespace signorini {

/// A run of the gnuplot program in the background, with its data in a folder of its own.
class Gnuplot {
 public:
  Gnuplot();
  ~Gnuplot();  ///< ends the program if it still runs, and removes the folder
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  /// Adds a file which the script may name.
  void add_data(const std::string& name, const std::string& text);
  /// Starts the program, which is to write the PNG file `picture`.
  void start(const std::string& script, const std::filesystem::path& picture, int width, int height);
  /// Waits for it; "" or a sentence saying why there is no picture (gnuplot missing, failing or taking too long).
  std::string finish(double timeout_seconds = 30);

 private:
  std::filesystem::path folder_, picture_;
  std::string problem_;
  pid_t child_ = -1;
};

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

/// Residual, algebraic error and contact nodes over the iterations.
void draw_convergence(Gnuplot& gnuplot, const std::filesystem::path& picture,
                      const std::vector<IterationRecord>& history);

/// Panels side by side.
void draw_panels(Gnuplot& gnuplot, const std::filesystem::path& picture, const std::vector<Panel>& panels);

}  // namespace signorini
