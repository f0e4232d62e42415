#pragma once

namespace signorini::bench {

/// Prints cycles and processor time of steps with Coulomb friction, on nested meshes and on levels chosen by the matrix
/// alone, beside those of the same steps without friction, and what `friction = 0` costs beside plain contact.
/// @param quick without the largest sizes
void print_friction_costs(bool quick);

/// The same cycles and time on nested meshes for scenes of other kinds: a corner, large steps, quadratic elements,
/// nearly incompressible material, a ball.
void print_friction_scenes(bool quick);

/// Prints the time of method "newton", with its direct solver, over that of the default. It is stopped where it
/// takes far longer.
void print_friction_direct(bool quick);

}  // namespace signorini::bench
