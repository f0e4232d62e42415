#include "core/io/cairo/sheet.hpp"

#include <cairo-svg.h>

#include <cassert>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "core/io/atomic_files.hpp"
#include "core/io/cairo/png.hpp"

namespace signorini {
namespace {
constexpr double font_size = 15, power_size = 11, power_rise = 6, marker_radius = 3.5;
constexpr std::array white{255, 255, 255};

void set_colour(cairo_t* cairo, const std::array<int, 3>& colour) {
  cairo_set_source_rgb(cairo, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
}

double width_of(cairo_t* cairo, const std::string& text, double size) {
  cairo_text_extents_t extents;
  cairo_set_font_size(cairo, size);
  cairo_text_extents(cairo, text.c_str(), &extents);
  return extents.x_advance;
}

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}
}  // namespace

Sheet::Sheet(int width, int height, std::filesystem::path file)
    : file_(std::move(file)),
      surface_(file_.extension() == ".svg" ? cairo_svg_surface_create_for_stream(append, &svg_, width, height)
                                           : cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
      cairo_(cairo_create(surface_.get())) {
  cairo_select_font_face(cairo_.get(), "sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  fill({0, 0}, width, height, white);
}

void Sheet::set(const Stroke& stroke) {
  constexpr std::array<double, 2> dashes{5, 4};
  set_colour(cairo_.get(), stroke.colour);
  cairo_set_line_width(cairo_.get(), stroke.width);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_dash(cairo_.get(), dashes.data(), stroke.dashed ? 2 : 0, 0);
}

void Sheet::line(Spot from, Spot to, const Stroke& stroke) { polyline(std::array{from, to}, stroke); }

void Sheet::polyline(std::span<const Spot> spots, const Stroke& stroke) {
  set(stroke);
  for (const Spot& spot : spots) cairo_line_to(cairo_.get(), spot.x, spot.y);
  cairo_stroke(cairo_.get());
}

void Sheet::mark(Spot at, Marker marker, const Stroke& stroke) {
  constexpr double r = marker_radius;
  set({stroke.colour, 1, false});
  if (marker == Marker::square)
    cairo_rectangle(cairo_.get(), at.x - r, at.y - r, 2 * r, 2 * r);
  else
    cairo_arc(cairo_.get(), at.x, at.y, r, 0, 2 * std::numbers::pi);
  if (marker == Marker::circle) {
    set_colour(cairo_.get(), white);  // no line goes through it
    cairo_fill_preserve(cairo_.get());
    set_colour(cairo_.get(), stroke.colour);
    cairo_stroke(cairo_.get());
  } else
    cairo_fill(cairo_.get());
}

void Sheet::fill(Spot corner, double width, double height, const std::array<int, 3>& colour) {
  set_colour(cairo_.get(), colour);
  cairo_rectangle(cairo_.get(), corner.x, corner.y, width, height);
  cairo_fill(cairo_.get());
}

void Sheet::frame(Spot corner, double width, double height) {
  set({});
  cairo_rectangle(cairo_.get(), corner.x, corner.y, width, height);
  cairo_stroke(cairo_.get());
}

void Sheet::text(Spot at, const std::string& text, Align align, const std::string& power) {
  cairo_t* cairo = cairo_.get();
  set_colour(cairo, {0, 0, 0});
  const double exponent = power.empty() ? 0 : width_of(cairo, power, power_size);
  const double width = width_of(cairo, text, font_size), height = 0.72 * font_size;  // that of a capital
  cairo_save(cairo);
  cairo_translate(cairo, at.x, at.y);
  if (align.turned) cairo_rotate(cairo, -std::numbers::pi / 2);
  cairo_move_to(cairo, -align.across * (width + exponent), align.up * height);
  cairo_show_text(cairo, text.c_str());
  if (!power.empty()) {
    cairo_rel_move_to(cairo, 0, -power_rise);
    cairo_set_font_size(cairo, power_size);
    cairo_show_text(cairo, power.c_str());
  }
  cairo_restore(cairo);
  cairo_new_path(cairo);
}

void Sheet::image(Spot corner, const Raster& raster) {
  std::vector<std::uint32_t> pixels;
  pixels.reserve(raster.rgb.size() / 3);
  for (int row = raster.height; row-- > 0;)
    for (int column = 0; column < raster.width; ++column) {
      const auto* rgb =
          reinterpret_cast<const unsigned char*>(&raster.rgb[3 * (std::size_t(row) * raster.width + column)]);
      pixels.push_back(std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2]);
    }
  cairo_surface_t* image =
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_RGB24,
                                          raster.width, raster.height, 4 * raster.width);
  cairo_set_source_surface(cairo_.get(), image, corner.x, corner.y);
  cairo_paint(cairo_.get());
  set_colour(cairo_.get(), {0, 0, 0});  // the surface is no longer needed
  cairo_surface_destroy(image);
}

void Sheet::write() {
  if (cairo_surface_get_type(surface_.get()) == CAIRO_SURFACE_TYPE_SVG) {
    cairo_surface_finish(surface_.get());
    return write_text(file_, svg_);
  }
  cairo_surface_flush(surface_.get());
  const int width = cairo_image_surface_get_width(surface_.get());
  const int height = cairo_image_surface_get_height(surface_.get());
  assert(cairo_image_surface_get_stride(surface_.get()) == 4 * width);
  const auto* pixels = reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface_.get()));
  write_text(file_, png({pixels, std::size_t(width) * height}, width, height));
}

}  // namespace signorini
