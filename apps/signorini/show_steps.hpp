#pragma once
#include <vector>

#include "core/io/picture.hpp"
#include "core/io/report.hpp"

namespace signorini {

/// The panels of steps.png: the forces of the obstacles over t, and over the displacement. Over t a force has its sign,
/// that of its largest one being positive, where it keeps to a line in all steps; else it is its size. The displacement
/// is of the first probe of the obstacle's body, without one the mean of the surface that it may reach, less the motion
/// of the obstacle's reference point since t = 0, where the line begins. Where there is friction, tangential forces are
/// shown over it, else normal ones. Empty where nothing touches.
std::vector<Panel> steps_panels(const Report& report);

}  // namespace signorini
