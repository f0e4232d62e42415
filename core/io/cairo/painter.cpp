#include "core/io/cairo/painter.hpp"

extern "C" __attribute__((visibility("default"))) const signorini::Painter* signorini_painter() {
  static constexpr signorini::Painter painter{signorini::draw_convergence, signorini::draw_panels};
  return &painter;
}
