#include "methods/stages.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace signorini::automatic {

namespace {

// On which problems each constant was chosen: docs/measured/variants.md, "Constants".

// Vectors on a single level, and where so many are coupled to each on the coarsest one, above which a cycle's Newton
// steps, up to a dozen, are too dear to be tried first.
constexpr Index many_vectors = 1000, fewer_vectors = 400, many_couplings = 100;
constexpr int patience_with_matrix = 40, cycles_to_run_away = 40;
// What a direct solver does in about a minute and a few gigabytes, even for elasticity in space.
constexpr Offset most_for_direct = 150'000;
// Each of up to so many interior points needs a factorisation.
constexpr Offset most_for_interior_points = 50'000;
constexpr int interior_points = 60;
// Each step may need a dozen factorisations. (Slender bodies of 40 000 unknowns, of which rounding leaves no solution,
// took eight minutes.)
constexpr Offset most_for_newton = 12'000;
constexpr int newton_steps = 40, friction_steps = 20, plain_cycles = 120;
// With friction matrices have no symmetry, with pressures they are indefinite, and each step is a factorisation.
constexpr Offset most_for_friction = 100'000, most_for_friction_in_space = 20'000;

// Where the matrix could hardly be coarsened there is no multigrid for linear systems either.
bool coarsens(const Situation& s) { return !s.functional && s.block == 1 && 2 * s.coarsest <= s.unknowns; }
bool newton_suits(const Situation& s) {
  return s.friction && !s.spent && may_factorise_for_newton(s.block, s.unknowns);
}
bool factorisable(const Situation& s) { return !s.functional && s.unknowns <= most_for_direct; }

// The coarse solver is then a Newton method on about the finest level. Where sweeps do not do, active sets need fewer
// factorisations, and faster ones.
bool dear_below(const Situation& s) {
  const bool full = s.couplings > Offset{s.vectors} * many_couplings;
  return (s.coarsest_vectors == s.vectors && s.vectors > many_vectors) || (s.coarsest_vectors > fewer_vectors && full);
}

std::string patience(const Patience& p) {
  return fmt::format(
      "after {} cycles{}, or any {}later one, if the rate of the last ones predicts more than {} (or `max_iterations`) "
      "and another stage suits",
      p.first,
      p.first == patience_with_cycles.first
          ? fmt::format(" ({} of nearly incompressible material)", patience_with_loads.first)
          : "",
      p.every == 1 ? "" : fmt::format("{}th ", p.every), p.most);
}

// Thousands apart.
std::string number(Offset n) { return n < 1000 ? fmt::format("{}", n) : fmt::format("{} {:03}", n / 1000, n % 1000); }

}  // namespace

const std::vector<Attempt>& stages() {
  static const std::vector<Attempt> list{
      {.name = "cycles, sweeps below",
       .kind = Kind::cycles,
       .method = "auto",
       .solver = "pgs",
       .suits =
           [](const Situation& s) { return !s.begun && s.newton && dear_below(s) && (coarsens(s) || factorisable(s)); },
       .begins =
           fmt::format("at once, if the coarsest level has more than {} vectors and each vector of the finest one more "
                       "than {} couplings, or if a single level has more than {} vectors",
                       fewer_vectors, many_couplings, many_vectors),
       .ends = patience(patience_with_sweeps),
       .purpose = "matrices that hardly coarsen. The coarsest level is left to sweeps: a Newton step there is a large "
                  "part of the "
                  "whole solve, and a cycle may take a dozen",
       .patience = patience_with_sweeps},
      {.name = "cycles",
       .kind = Kind::cycles,
       .method = "auto",
       .solver = "",
       .suits = [](const Situation& s) { return !s.begun; },
       .begins = "at once, otherwise",
       .ends = patience(patience_with_cycles),
       .purpose = "most problems are solved here"},
      {.name = "cycles without acceleration",
       .kind = Kind::cycles_again,
       .method = "auto",
       .solver = "",
       .suits = [](const Situation& s) { return s.begun && s.following; },
       .begins = "with nearly incompressible material, from where the cycles before began",
       .ends = fmt::format("if friction does not come to rest, or after {} cycles", plain_cycles),
       .purpose = "rubber that the accelerated ones do not solve",
       .most_steps = plain_cycles,
       .patience = endless,
       .starts = {Start::first}},
      {.name = "cycles from zero",
       .kind = Kind::cycles_from_zero,
       .method = "auto",
       .solver = "",
       .suits = [](const Situation& s) { return s.functional && s.begun; },
       .begins = "with friction, if the start was another one",
       .ends = "if friction does not come to rest, or at `max_iterations`",
       .purpose = "a body that friction barely holds, and that slid off on a coarse mesh",
       .starts = {Start::zero}},
      {.name = "Newton's method with friction and pressures",
       .kind = Kind::newton,
       .method = "newton",
       .solver = "",
       .suits = [](const Situation& s) { return s.begun && newton_suits(s); },
       .begins = fmt::format("with friction or nearly incompressible material, for at most {} unknowns, in space {}; "
                             "not in parts of a load step that it did not solve as a whole",
                             number(most_for_friction), number(most_for_friction_in_space)),
       .ends =
           fmt::format("after {} steps each from the first start, from zero, and from where cycles ended, or if its "
                       "matrix is singular",
                       friction_steps),
       .purpose = "bodies that little but friction holds; rubber in narrow grooves or under far stiffer bodies",
       .most_steps = friction_steps,
       .starts = {Start::first, Start::zero, Start::last},  // cycles may have slid far away
       .keep = Keep::solved},
      {.name = "active sets, multigrid",
       .kind = Kind::active_sets,
       .method = "pdas",
       .solver = "amg_cg",
       .suits = coarsens,
       .begins = "for scalar problems that coarsen to half of the unknowns or less, at any size",
       .ends = "if sets cycle, or do not come to rest",
       .purpose = "graph Laplacians with weights over 8 decades. Solved by conjugate gradients with an algebraic "
                  "multigrid cycle",
       .keep = Keep::solved},
      {.name = "active sets, direct",
       .kind = Kind::active_sets,
       .method = "pdas",
       .solver = "cholmod",
       .suits = factorisable,
       .begins = fmt::format("for at most {} unknowns", number(most_for_direct)),
       .ends = "if sets cycle, or do not come to rest",
       .purpose = "cells stretched 25 times that bend. Solved by CHOLMOD",
       .keep = Keep::solved},
      {.name = "interior points",
       .kind = Kind::interior_points,
       .method = "interior_point",
       .solver = "cholmod",
       .suits = [](const Situation& s) { return !s.functional && s.unknowns <= most_for_interior_points; },
       .begins = fmt::format("for at most {} unknowns", number(most_for_interior_points)),
       .ends = fmt::format("after {} steps, or if they make no progress", interior_points),
       .purpose =
           "sets that cycle, as they may if couplings have both signs. Mehrotra's predictor and corrector: a few dozen "
           "linear systems for any matrix",
       .most_steps = interior_points,
       .keep = Keep::solved},
      {.name = "the coarse solver on the finest level",
       .kind = Kind::single_level,
       .method = "newton",
       .solver = "",
       .suits =
           [](const Situation& s) {
             return !s.functional && s.levels && Offset{s.vectors} * s.block <= most_for_newton;
           },
       .begins = fmt::format("for at most {} unknowns, if there are coarser levels", number(most_for_newton)),
       .ends = fmt::format("after {} steps", newton_steps),
       .purpose = "problems without a solution: it finds that out",
       .most_steps = newton_steps},
      {.name = "more cycles",
       .kind = Kind::cycles,
       .method = "monotone",
       .solver = "",
       .suits = [](const Situation& s) { return s.begun && (!s.functional || s.slow); },
       .begins = "if no other stage has solved the problem, except if friction did not come to rest",
       .ends = "at `max_iterations`",
       .purpose = "slow cycles are better than none"}};
  return list;
}

const std::vector<Attempt>& attempts_around() {
  static const std::vector<Attempt> list{
      {.name = "nested start",
       .kind = Kind::nested_start,
       .method = "nested start",
       .solver = "",
       .begins = "first, on each coarser level from the coarsest one up, if `start` is \"nested\"",
       .purpose = "a start near the solution. What fails on a coarse level may well hold on the finest one",
       .keep = Keep::solved},
      {.name = "levels of the matrix",
       .kind = Kind::levels_of_matrix,
       .method = "nested start",
       .solver = "",
       .begins = "with elastic bodies whose levels the matrix may choose (`hierarchy` \"auto\", stretched cells)",
       .purpose = fmt::format("stretched cells. Of at most {} cycles, {} with friction: they take twenty, or do not do",
                              patience_with_matrix, patience_with_friction),
       .most_steps = patience_with_matrix,
       .starts = {Start::first},
       .keep = Keep::better},
      {.name = "levels of the meshes",
       .kind = Kind::levels_of_meshes,
       .method = "nested start",
       .solver = "",
       .begins = "if those of the matrix did not reach the tolerance",
       .purpose = "columns that can sway. They do so with so little energy that rounding in the matrix hides it, and "
                  "its levels may carry them anywhere; meshes keep such motions out of the corrections",
       .starts = {Start::first},
       .keep = Keep::better},
      {.name = "Newton's method mesh by mesh",
       .kind = Kind::newton_by_meshes,
       .method = "nested start",
       .solver = "",
       .begins = fmt::format("with friction that all stages of `auto` leave unsolved before `max_iterations`, up to {} "
                             "steps on each mesh, with multigrid for the linear systems of large ones; the next load "
                             "step begins with the stages again",
                             newton_steps),
       .purpose = "stacks of soft and stiff blocks: what few cycles leave on a coarse mesh has slid far away",
       .most_steps = newton_steps,
       .starts = {Start::first},
       .keep = Keep::solved},
      {.name = "pairs anew",
       .kind = Kind::pairs_anew,
       .method = "auto",
       .solver = "",
       .begins = fmt::format("if bodies have moved past each other, or along or up to an obstacle, in a step that "
                             "follows another one; up to {} times",
                             most_slides),
       .purpose = "contact where bodies are now",
       .starts = {Start::first}},
      {.name = "pairs anew, in the first step",
       .kind = Kind::pairs_anew_first,
       .method = "auto",
       .solver = "",
       .begins = "if they have done so in the first step, and contact is noticeably off (`too-curved`, `slid-past`)",
       .purpose =
           "bodies that are drawn far from where they touch. It fails where contact is not less than half as far "
           "off then",
       .starts = {Start::first},
       .keep = Keep::solved},
      {.name = "cycles with sweeps below",
       .kind = Kind::sweeps_below,
       .method = "auto",
       .solver = "pgs",
       .begins = "with a matrix alone, if its energy seems to have no minimum but no motion is known to fall",
       .purpose = "matrices whose rounding on a coarse level is taken for such a motion"},
      {.name = "cycles that run away",
       .kind = Kind::cycles_away,
       .method = "monotone",
       .solver = "",
       .begins = "with a matrix alone, if another method than `auto` or `monotone` was asked for and ends unsolved",
       .purpose = fmt::format("energies without a minimum, which iterates that run away show in {} cycles",
                              cycles_to_run_away),
       .most_steps = cycles_to_run_away,
       .keep = Keep::never},
      {.name = "refinement",
       .kind = Kind::refinement,
       .method = "refinement",
       .solver = "extended",
       .begins = "with a matrix alone, last, if it is cheap beside the solve, or rounding is in question",
       .purpose = "matrices that double precision does not solve. Active sets with residuals in extended precision",
       .keep = Keep::better}};
  return list;
}

const Attempt& attempt(Kind kind) { return *std::ranges::find(attempts_around(), kind, &Attempt::kind); }

std::vector<std::string> solvers_for_active_sets(int block, Offset unknowns, Offset coarsest) {
  std::vector<std::string> out;
  for (const Attempt& rule : stages())
    if (rule.kind == Kind::active_sets && rule.suits({.block = block, .unknowns = unknowns, .coarsest = coarsest}))
      out.emplace_back(rule.solver);
  return out;
}

bool may_factorise_for_newton(int block, Offset unknowns) {
  return unknowns <= (block == 3 ? most_for_friction_in_space : most_for_friction);
}

bool newton_is_affordable(int block, Offset unknowns, bool levels, bool following) {
  return (levels && !following) || may_factorise_for_newton(block, unknowns);
}

bool others_suit(const Situation& s) { return s.functional || coarsens(s) || factorisable(s); }

std::string table_of_stages() {
  std::string out = "| stage | begins | ends unsolved | is for |\n| --- | --- | --- | --- |\n";
  for (const Attempt& rule : stages())
    out += fmt::format("| {} | {} | {} | {} |\n", rule.name, rule.begins, rule.ends, rule.purpose);
  return out;
}

std::string table_of_attempts_around() {
  const auto keeps = [](Keep keep) {
    return keep == Keep::always   ? "always"
           : keep == Keep::solved ? "if it is solved"
           : keep == Keep::better ? "if it reaches the tolerance, or what came before does not count as solved"
                                  : "never";
  };
  std::string out = "| attempt | begins | is kept | is for |\n| --- | --- | --- | --- |\n";
  for (const Attempt& attempt : attempts_around())
    out += fmt::format("| {} | {} | {} | {} |\n", attempt.name, attempt.begins, keeps(attempt.keep), attempt.purpose);
  return out;
}

}  // namespace signorini::automatic
