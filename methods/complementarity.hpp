#pragma once
#include "core/base/types.hpp"
#include "core/sdk/friction.hpp"

namespace signorini {

/// Contact and friction at one vector as equations C(v, f) = 0 for its value v and the force f = A v - b on it, all of
/// them augmented: what decides which case holds is the force plus the stiffness times the distance (Alart and Curnier,
/// Comput. Methods Appl. Mech. Eng. 92, 1991; Hueeber, Stadler and Wohlmuth, SIAM J. Sci. Comput. 30, 2008).
template <int B>
struct Complementarity {
  const double *lower, *upper;  ///< bounds; both the same: prescribed
  Flags off;                    ///< components whose force is not known: f is then v less its value
  Flags tangential;             ///< components with friction; none: bounds alone
  const double* last;           ///< friction opposes v - last
  FrictionLaw law;
  const double* stiffness;  ///< B: in which distances from bounds count as forces
  double slip_stiffness;    ///< the same for slip; small: what slips the wrong way then sticks, and does not turn round

  enum class Friction : signed char { none, sticks, slips };
  /// Which case held at the last evaluation, per component -1 at the lower bound, 1 at the upper one.
  struct State {
    signed char side[B] = {};
    Friction friction = Friction::none;
    bool operator==(const State&) const = default;
  };

  /// C and its derivatives by f and v, B * B each, row-major.
  State evaluate(const double* v, const double* f, double* C, double* by_force, double* by_value) const;

 private:
  bool is(Flags flags, int k) const { return flags >> k & 1u; }
  void bounds(int k, const double* v, const double* f, State& state, double* C, double* by_force,
              double* by_value) const;
  void stick(const double* v, double* C, double* by_value) const;
  void slip(const double* v, const double* f, double g, int normal, double dg_force, double dg_value, double* C,
            double* by_force, double* by_value) const;
};

}  // namespace signorini
