#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>

#include "core/geometry/geometry.hpp"
#include "core/mesh/validate.hpp"

namespace signorini::geometry {

inline void require_positive(const std::string& shape, const std::string& key, double value) {
  if (!std::isfinite(value) || value <= 0)
    throw ShapeError(shape, key, fmt::format("found {:g}, expected a positive number", value));
}

template <std::size_t N>
void require_finite(const std::string& shape, const std::string& key, const std::array<double, N>& value) {
  for (const double x : value)
    if (!std::isfinite(x))
      throw ShapeError(shape, key, fmt::format("found [{:g}], expected finite numbers", fmt::join(value, ", ")));
}

/// What has come out of a mesher is a mesh, see validate().
template <int D>
void require_valid(const std::string& shape, const Mesh<D>& mesh) {
  try {
    validate(mesh, "mesh");
  } catch (const Error& error) {
    throw ShapeError(shape, "",
                     fmt::format("{}; expected another size, or a shape without such details", error.what()));
  }
}

}  // namespace signorini::geometry
