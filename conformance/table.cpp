#include "conformance/table.hpp"

#include <algorithm>
#include <cstdlib>

namespace signorini::conformance {

const std::vector<Check>& all_checks() {
  static const std::vector<Check> checks{
#define PAGE "docs/plugin_check.md"
      {"loads", "the library is loaded, and was built as this program was",
       "docs/plugins.md#when-a-plugin-does-not-load"},
      {"exports", "the library exports signorini_plugin and nothing else", "docs/plugins.md#rules-of-the-boundary"},
      {"id", "libsignorini_obstacle_ID.so provides an obstacle ID", PAGE "#the-library-and-its-options"},
      {"help", "the obstacle and each of its options have a line of help", PAGE "#the-library-and-its-options"},
      {"constructs", "with its defaults, and what it asks for by name, it is constructed",
       PAGE "#the-library-and-its-options"},
      {"missing",
       "without an option that it needs it fails as bad input (Exit::input), and the message names the option",
       PAGE "#the-library-and-its-options"},
      {"ranges",
       "with each option at both ends of its range it is constructed and assembled, or refuses that as bad input",
       PAGE "#the-library-and-its-options"},
      {"asked", "it asks for options in its table alone, and as of their type", PAGE "#the-library-and-its-options"},
      {"descriptor", "at most 4 directions with names, 1 to B components and values, and at most 8 numbers",
       PAGE "#assemble"},
      {"beyond", "assemble() reads `count` vertices and writes to `count` constraints, and to no memory behind them",
       PAGE "#assemble"},
      {"directions", "0 to B directions at a node, unit vectors, independent of each other", PAGE "#assemble"},
      {"bounds", "both bounds of each direction are set, none is NaN, and lower <= upper", PAGE "#assemble"},
      {"numbers", "the numbers in `data` are finite, and as many as the descriptor says", PAGE "#assemble"},
      {"repeatable", "assemble() gives the same again, in any order and one by one", PAGE "#assemble"},
      {"threads", "assemble() gives the same to several threads at once", PAGE "#assemble"},
      {"far", "far away, at the centre of the shape and with a zero normal the answer is finite, or bad input",
       PAGE "#assemble"},
      {"equivariant", "what is turned and moved, with the shape or the other body, has constraints turned alike",
       PAGE "#assemble"},
      {"measure", "three times the surface has the numbers of scale(3): integrals grow, places and ratios stay",
       PAGE "#numbers"},
      {"distance", "distance() is from the iterate to the bounds, and flags the components that are at one",
       PAGE "#local-solver"},
      {"linearisation", "an obstacle with a functional has its linearisation", PAGE "#linearisation"},
      {"change_zero", "change(x, x) is 0, and changes are finite", PAGE "#change-and-slope"},
      {"change_antisymmetric", "change(z, x) is -change(x, z)", PAGE "#change-and-slope"},
      {"change_adds_up", "change(x, z) + change(z, w) is change(x, w)", PAGE "#change-and-slope"},
      {"change_digits", "change() over a step of 1e-9 of x keeps its digits: it is the mean slope times the step",
       PAGE "#change-and-slope"},
      {"slope_homogeneous", "slope(x, t d) is t slope(x, d) for t > 0", PAGE "#change-and-slope"},
      {"slope_derivative", "slope(x, d) is the derivative of change() from x along d, to that side, at kinks as well",
       PAGE "#change-and-slope"},
      {"convex", "slope(x, z - x) <= change(x, z), and half way the change is at most half of it",
       PAGE "#change-and-slope"},
      {"minimise_finite", "the local solver leads to numbers", PAGE "#local-solver"},
      {"minimise_bounds", "the local solver leads to within the bounds, not by a rounding error beyond",
       PAGE "#local-solver"},
      {"minimise_start", "the local solver leads to the same from everywhere", PAGE "#local-solver"},
      {"minimise_rests", "the local solver stays at its result, whose natural residual is 0", PAGE "#local-solver"},
      {"minimise_energy", "no other place within the bounds has less energy", PAGE "#local-solver"},
      {"minimise_slope", "at the local solver's result no slope, against the forces left, leads down",
       PAGE "#local-solver"},
      {"prescribed", "a component whose bounds are equal is left there, and the others are the best beside it",
       PAGE "#local-solver"},
      {"facet", "with one more bound, along any direction, the result is the best that it admits",
       PAGE "#local-solver"},
      {"linearise_bounds", "linearise() leaves lower <= 0 <= upper, and finite gradients and Hessians",
       PAGE "#linearisation"},
      {"linearise_gradient", "the gradient is the slope, to both sides, in all components that are not critical",
       PAGE "#linearisation"},
      {"linearise_hessian", "the Hessian is the derivative of the gradient", PAGE "#linearisation"},
      {"linearise_definite", "the Hessian is symmetric and has no negative eigenvalue", PAGE "#linearisation"},
      {"linearise_kinks",
       "components are critical at kinks alone, and then rest: bounds, gradient and Hessian are zero",
       PAGE "#linearisation"},
      {"scaling", "a functional with numbers has a Scaling: at three times the surface it is three times as large",
       PAGE "#numbers"},
      {"renew", "renew() gives the same again, finite numbers, and writes to no other slot's", PAGE "#numbers"},
      {"law", "law() is the slope: what sticks is held by bound + coefficient * (the force that presses)",
       PAGE "#numbers"},
      {"solve_agrees", "scenes are solved, and to what Gauss-Seidel steps alone (method = \"pgs\") lead to",
       PAGE "#solves"},
      {"solve_cycles", "cycles do not grow with the mesh", PAGE "#solves"},
#undef PAGE
  };
  return checks;
}

const Check& check_named(std::string_view id) {
  const auto found = std::ranges::find(all_checks(), id, &Check::id);
  if (found == all_checks().end()) std::abort();  // a slip of the kit's own
  return *found;
}

}  // namespace signorini::conformance
