#include "amg/black_box/given_bounds.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace signorini {
namespace {

void check(const char* what, std::span<const double> bounds, std::size_t n) {
  if (!bounds.empty() && bounds.size() != n)
    input_error(what, fmt::format("found {} bounds, expected {}, one per row of the matrix", bounds.size(), n));
  for (std::size_t i = 0; i < bounds.size(); ++i)
    if (std::isnan(bounds[i]))
      input_error(what, fmt::format("found NaN in row {}, expected a number, inf or -inf", i + 1));
}

void refuse_empty(const GivenBounds& bounds, std::size_t n) {
  constexpr std::size_t most = 5;  // rows in the message
  std::size_t count = 0;
  std::string rows;
  for (std::size_t i = 0; i < n; ++i)
    if (const Interval found = bounds[i]; found.empty() && ++count <= most)
      rows += fmt::format("{}row {}: {} and {}", count == 1 ? "" : ", ", i + 1, found.lower, found.upper);
  if (count > 0)
    throw Error(Exit::no_solution, fmt::format("infeasible bounds: no number lies between the lower and the upper "
                                               "bound in {} {}: {}{}",
                                               count, count == 1 ? "row" : "rows", rows, count > most ? "..." : ""));
}

}  // namespace

GivenBounds::GivenBounds(std::size_t n, std::span<const double> lower, std::span<const double> upper)
    : lower_(lower), upper_(upper) {
  check("lower", lower, n);
  check("upper", upper, n);
  refuse_empty(*this, n);
}

template <int B>
Constraints<B> constraints(const GivenBounds& bounds, const std::vector<Flags>& held) {
  Constraints<B> out;
  out.slot.assign(held.size(), -1);
  for (Index p = 0; p < static_cast<Index>(held.size()); ++p) {
    Interval of[B];
    bool any = false;
    for (int k = 0; k < B; ++k) {
      of[k] = held[p] >> k & 1u ? Interval{-infinity, infinity} : bounds[static_cast<std::size_t>(Offset{p} * B + k)];
      any = any || !of[k].all();
    }
    if (!any) continue;
    out.slot[p] = out.size();
    out.vector.push_back(p);
    for (const Interval& interval : of) {
      out.lower.push_back(interval.lower);
      out.upper.push_back(interval.upper);
    }
  }
  return out;
}

template Constraints<1> constraints(const GivenBounds&, const std::vector<Flags>&);
template Constraints<2> constraints(const GivenBounds&, const std::vector<Flags>&);
template Constraints<3> constraints(const GivenBounds&, const std::vector<Flags>&);

}  // namespace signorini
