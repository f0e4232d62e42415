#include "core/solver/option_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "core/base/error.hpp"
#include "core/input/range.hpp"

namespace signorini {
namespace {

using S = SolverOptions;

constexpr bool of_levels = true, always = false;
constexpr const char* see_levels = "See docs/theory/amg.md.";

constexpr OptionRow<S> table[] = {
    {"tolerance", &S::tolerance, "(0, 1)", "for the relative algebraic error and for the natural residual"},
    {"max_iterations", &S::max_iterations, "[1, 1000000]",
     "limit on the steps of all methods together; a step is a cycle, or a linear solve of other methods", always,
     "With `pdas` and `newton`, and where `auto` goes on with other methods, each step solves a linear system."},
    {"method", &S::method, "auto | monotone | tnnmg | pgs | pdas | newton",
     "auto: multigrid, `monotone` and `tnnmg` in turns. Where this is slow, `pdas` goes on, for scalar unknowns or at "
     "most 150000 others. Where friction does not come to rest, `newton` goes on. So it does where the pressures of "
     "nearly incompressible material do not, for at most 100000 unknowns, in space 20000. "
     "monotone: monotone multigrid, whose coarse corrections keep to bounds. "
     "tnnmg: truncated nonsmooth Newton multigrid, with bounds on the finest level only. "
     "pgs: projected Gauss-Seidel alone, without coarser levels. "
     "pdas: primal-dual active sets, each step with a direct solver. "
     "newton: a semismooth Newton method for contact, also with friction and such pressures",
     always, "See docs/theory/auto.md."},
    {"cycle", &S::cycle, "V | W | F", "shape of the cycle", always,
     "With `start = \"nested\"`, the default, any of them is full multigrid."},
    {"pre", &S::pre, "[0, 100]", "smoothing steps before the coarse correction"},
    {"post", &S::post, "[0, 100]", "smoothing steps after the coarse correction"},
    {"smoother", &S::smoother, "", "a smoother of `signorini list smoothers`", always,
     "\"forward\", \"backward\", \"symmetric\", \"adjoint\" (forward down, backward up), \"surface_first\" or "
     "\"patch\". See docs/theory/smoothers.md."},
    {"relaxation", &S::relaxation, "(0, 2)",
     "over-relaxation of the smoother's sweeps at nodes that reach no bound; 1 is plain Gauss-Seidel", always,
     "Take more for badly shaped elements."},
    {"transfer", &S::transfer, "", "a monotone restriction of `signorini list transfers`", always,
     "\"min_merge\", \"mandel\" or \"kornhuber\". See docs/theory/transfer.md."},
    {"coarse", &S::coarse, "", "a coarse solver of `signorini list coarse`", always,
     "\"newton\": sweeps, and if these do not soon suffice, Newton steps with a factorisation; \"pgs\": projected "
     "Gauss–Seidel alone."},
    {"truncate", &S::truncate, "none | normal | tangential",
     "directions in contact taken out of the interpolation; tangential: all directions of a vector in contact", always,
     "With \"none\" the directions in contact make coarse corrections short."},
    {"cut", &S::cut, "[0, 100]",
     "also truncate where the distance to a bound is less than this part of the last cycle's largest change"},
    {"rotate", &S::rotate, "all | not_coarsest | meshes | none",
     "levels on which contact vectors use their local basis; meshes: not the algebraic ones", of_levels,
     "There coarse contact vectors take over the frame of their fine twin. See docs/theory/amg.md."},
    {"reassemble", &S::reassemble, "",
     "renew the matrices of algebraic levels where phases have changed; false: search along their corrections",
     of_levels, see_levels},
    {"reach", &S::reach, "all | twins",
     "what corrects constrained vectors from algebraic levels: all coarse vectors, which then have bounds, or the "
     "twins of constrained ones; other weights are truncated",
     of_levels, see_levels},
    {"interpolate", &S::interpolate, "global | local",
     "components that algebraic levels interpolate: global ones, then rotated, or those of the local bases", of_levels,
     see_levels},
    {"coarsening", &S::coarsening, "auto | classical | aggregation",
     "how these levels are chosen: interpolation from some of the vectors, or smoothed aggregation; auto: the latter "
     "for elastic bodies",
     of_levels, "See docs/theory/amg.md."},
    {"aggregates", &S::aggregates, "",
     "what makes the aggregates of smoothed aggregation, of `signorini list aggregates`", of_levels,
     "\"greedy\" or \"metis\". Refused where levels are asked for that have none."},
    {"krylov", &S::krylov, "", "accelerate the cycles while the phases rest", always,
     "Their corrections are made A-orthogonal to each other, and the energy is minimised along them. See "
     "docs/theory/monotone_multigrid.md."},
    {"threads", &S::threads, "[1, 4096]",
     "threads for the cycles of large problems, and for the packing of files; everything else uses one thread. Results "
     "do not depend on their number",
     always, "Levels of less than some megabytes use one thread."},
};

[[noreturn]] void refuse(const char* name, const std::string& found, const Range& range, const char* kind) {
  input_error(fmt::format("solver.{}", name), fmt::format("found '{}', expected {}{}", found, range.expected(kind),
                                                          did_you_mean(found, range.choices())));
}

void check(const char*, const Range&, bool) {}
void check(const char* name, const Range& range, int value) {
  if (!range.contains(static_cast<double>(value))) refuse(name, fmt::format("{}", value), range, "a whole number");
}
void check(const char* name, const Range& range, double value) {
  if (!range.contains(value)) refuse(name, fmt::format("{}", value), range, "a number");
}
void check(const char* name, const Range& range, const std::string& value) {
  if (!range.contains(std::string_view(value))) refuse(name, value, range, "a text");
}

}  // namespace

std::span<const OptionRow<SolverOptions>> option_table() { return table; }

void check_ranges(const SolverOptions& options) {
  for (const auto& row : table)
    std::visit([&](auto member) { check(row.name, Range(row.range), options.*member); }, row.member);
}

int position_among_choices(const SolverOptions& options, std::string SolverOptions::*member) {
  const auto* const row = std::ranges::find(table, decltype(OptionRow<S>::member)(member), &OptionRow<S>::member);
  assert(row != std::end(table));
  const Range range(row->range);
  check(row->name, range, options.*member);
  const auto& choices = range.choices();
  return static_cast<int>(std::ranges::find(choices, options.*member) - choices.begin());
}

}  // namespace signorini
