#include "core/input/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace signorini {

Field::Field(std::function<double(const Site&)> function, std::string text, std::string origin, bool uses_normal,
             bool uses_t)
    : Field(
          [function = std::move(function)](std::span<const Site> sites, double* out) {
            for (const Site& site : sites) *out++ = function(site);
          },
          std::move(text), std::move(origin), uses_normal, uses_t) {}

double Field::operator()(const Site& site) const {
  double value = 0;
  values({&site, 1}, &value);
  return value;
}

void Field::values(std::span<const Site> sites, double* out) const {
  if (uses_normal_)
    for (const Site& site : sites)
      if (site.n[0] == 0 && site.n[1] == 0 && site.n[2] == 0)
        input_error(origin_, fmt::format("'{}' uses nx, ny or nz, and there is no normal at x = [{:g}, {:g}, {:g}]",
                                         text_, site.x[0], site.x[1], site.x[2]));
  if (function_)
    function_(sites, out);
  else
    std::fill_n(out, sites.size(), constant_);
  for (std::size_t k = 0; k < sites.size(); ++k)
    if (!std::isfinite(out[k]))
      input_error(origin_.empty() ? "value" : origin_,
                  fmt::format("found {} for '{}' at x = [{:g}, {:g}, {:g}], expected a finite number", out[k], text(),
                              sites[k].x[0], sites[k].x[1], sites[k].x[2]));
}

bool Field::same(double t, const Field& other, double t_other) const {
  if (!function_ || !other.function_) return !function_ && !other.function_ && constant_ == other.constant_;
  return !text_.empty() && text_ == other.text_ && (t == t_other || !(uses_t_ || other.uses_t_));
}

std::optional<double> Field::constant() const { return function_ ? std::nullopt : std::optional<double>(constant_); }

std::string Field::text() const { return function_ ? text_ : fmt::format("{}", constant_); }

}  // namespace signorini
