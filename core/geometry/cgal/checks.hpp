#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string_view>

#include "core/base/error.hpp"
#include "core/base/types.hpp"

namespace signorini::geometry {

inline void require_positive(std::string_view shape, std::string_view key, double value) {
  if (!std::isfinite(value) || value <= 0)
    input_error(shape, fmt::format("{}: found {:g}, expected a positive number", key, value));
}

template <std::size_t N>
void require_finite(std::string_view shape, std::string_view key, const std::array<double, N>& value) {
  for (const double x : value)
    if (!std::isfinite(x))
      input_error(shape, fmt::format("{}: found [{:g}], expected finite numbers", key, fmt::join(value, ", ")));
}

}  // namespace signorini::geometry
