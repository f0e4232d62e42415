#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/input/field.hpp"
#include "core/sdk/settings.hpp"

/// Rigid obstacles with a closed form of their distance. Vectors have an entry per dimension; in 2D the third is zero.
/// Fields are evaluated at the point that asks, with its normal and the step parameter t. What is wrong with constants
/// is an Error(Exit::input) at `origin` ("scene.toml:12: obstacle.0") here, with expressions a failed status later.
namespace signorini::geometry {

/// A half space (2D: a half plane); `normal`, of any length, points out of it.
std::unique_ptr<DistanceFunction> plane(const std::vector<Field>& point, const std::vector<Field>& normal, double t,
                                        const std::string& origin);

/// A ball (2D: a disk), or with `inside` all but a ball: the body lies within.
std::unique_ptr<DistanceFunction> sphere(const std::vector<Field>& center, const Field& radius, bool inside, double t,
                                         const std::string& origin);

/// An infinitely long circular cylinder around the line through `center` along `axis`, of any length; or with `inside`
/// all but that.
std::unique_ptr<DistanceFunction> cylinder(const std::vector<Field>& center, const std::vector<Field>& axis,
                                           const Field& radius, bool inside, double t, const std::string& origin);

/// Where an expression is negative. It need be no distance: the nearest point where it is zero is found, see
/// distance_to_zeros(), and the normal points away from there. With `normal` it is the distance along that.
std::unique_ptr<DistanceFunction> expression(const Field& distance, const std::vector<Field>& normal, int dimension,
                                             double t, const std::string& origin);

}  // namespace signorini::geometry
