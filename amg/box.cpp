#include "amg/box.hpp"

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

struct Interval {
  double lower, upper;

  bool empty() const { return lower > upper || lower == infinity || upper == -infinity; }
  bool all() const { return lower == -infinity && upper == infinity; }
};

class Box {
 public:
  Box(std::span<const double> lower, std::span<const double> upper) : lower_(lower), upper_(upper) {}

  Interval operator[](std::size_t i) const {
    return {lower_.empty() ? -infinity : lower_[i], upper_.empty() ? infinity : upper_[i]};
  }

  void refuse_empty(std::size_t n) const {
    constexpr std::size_t most = 5;  // rows in the message
    std::size_t count = 0;
    std::string rows;
    for (std::size_t i = 0; i < n; ++i)
      if (const Interval bounds = (*this)[i]; bounds.empty() && ++count <= most)
        rows += fmt::format("{}row {}: {} and {}", count == 1 ? "" : ", ", i + 1, bounds.lower, bounds.upper);
    if (count > 0)
      throw Error(Exit::no_solution, fmt::format("infeasible bounds: no number lies between the lower and the upper "
                                                 "bound in {} {}: {}{}",
                                                 count, count == 1 ? "row" : "rows", rows, count > most ? "..." : ""));
  }

 private:
  std::span<const double> lower_, upper_;
};

}  // namespace

template <int B>
Constraints<B> box(std::size_t n, std::span<const double> lower, std::span<const double> upper) {
  check("lower", lower, n);
  check("upper", upper, n);
  const Box bounds(lower, upper);
  bounds.refuse_empty(n);
  Constraints<B> out;
  out.slot.assign(n / B, -1);
  for (Index p = 0; p < static_cast<Index>(n / B); ++p) {
    bool any = false;
    for (int k = 0; k < B; ++k) any = any || !bounds[static_cast<std::size_t>(Offset{p} * B + k)].all();
    if (!any) continue;
    out.slot[p] = out.size();
    out.vector.push_back(p);
    for (int k = 0; k < B; ++k) {
      const Interval interval = bounds[static_cast<std::size_t>(Offset{p} * B + k)];
      out.lower.push_back(interval.lower);
      out.upper.push_back(interval.upper);
    }
  }
  return out;
}

template Constraints<1> box(std::size_t, std::span<const double>, std::span<const double>);
template Constraints<2> box(std::size_t, std::span<const double>, std::span<const double>);
template Constraints<3> box(std::size_t, std::span<const double>, std::span<const double>);

}  // namespace signorini
