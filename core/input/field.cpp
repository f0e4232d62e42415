#include "core/input/field.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace signorini {

double Field::operator()(const Site& site) const {
  if (uses_normal_ && site.n[0] == 0 && site.n[1] == 0 && site.n[2] == 0)
    input_error(origin_, fmt::format("'{}' uses nx, ny or nz, and there is no normal at x = [{:g}, {:g}, {:g}]", text_,
                                     site.x[0], site.x[1], site.x[2]));
  const double value = function_ ? function_(site) : constant_;
  if (!std::isfinite(value))
    input_error(origin_.empty() ? "value" : origin_,
                fmt::format("found {} for '{}' at x = [{:g}, {:g}, {:g}], expected a finite number", value, text(),
                            site.x[0], site.x[1], site.x[2]));
  return value;
}

bool Field::same(double t, const Field& other, double t_other) const {
  if (!function_ || !other.function_) return !function_ && !other.function_ && constant_ == other.constant_;
  return !text_.empty() && text_ == other.text_ && (t == t_other || !(uses_t_ || other.uses_t_));
}

std::optional<double> Field::constant() const { return function_ ? std::nullopt : std::optional<double>(constant_); }

std::string Field::text() const { return function_ ? text_ : fmt::format("{}", constant_); }

}  // namespace signorini
