#pragma once
#include <cairo.h>

#include <array>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "core/io/raster.hpp"

namespace signorini {

/// Pixels from the left and from the top.
struct Spot {
  double x, y;
};

struct Stroke {
  std::array<int, 3> colour{0, 0, 0};
  double width = 1;
  bool dashed = false;
};

enum class Marker { disk, square, circle };

/// How a text lies about its spot: 0 begins there, 0.5 has its middle there, 1 ends there.
struct Align {
  double across = 0.5, up = 0.5;
  bool turned = false;  ///< by a right angle, reading upwards
};

/// A white sheet to draw on.
class Sheet {
 public:
  /// @param file where it is to be written: .svg or .png
  Sheet(int width, int height, std::filesystem::path file);

  void line(Spot from, Spot to, const Stroke& stroke);
  void polyline(std::span<const Spot> spots, const Stroke& stroke);
  void mark(Spot at, Marker marker, const Stroke& stroke);
  void fill(Spot corner, double width, double height, const std::array<int, 3>& colour);
  void frame(Spot corner, double width, double height);
  /// @param power written after it as an exponent
  void text(Spot at, const std::string& text, Align align, const std::string& power = "");
  /// @param corner the upper left one
  void image(Spot corner, const Raster& raster);

  /// Error(Exit::input) if it cannot be written.
  void write();

 private:
  template <class T, void (*destroy)(T*)>
  struct Destroy {
    void operator()(T* object) const { destroy(object); }
  };

  void set(const Stroke& stroke);

  std::filesystem::path file_;
  std::string svg_;  // as far as it is written
  std::unique_ptr<cairo_surface_t, Destroy<cairo_surface_t, cairo_surface_destroy>> surface_;
  std::unique_ptr<cairo_t, Destroy<cairo_t, cairo_destroy>> cairo_;
};

}  // namespace signorini
