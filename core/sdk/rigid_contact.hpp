#pragma once
#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/base/error.hpp"
#include "core/sdk/block.hpp"
#include "core/sdk/box_obstacle.hpp"

namespace signorini {

/// Linearised non-penetration of a rigid obstacle, -u.n <= d(x), with the distance d of the undeformed vertex to the
/// obstacle and the unit normal n, which points from the obstacle towards the body: what obstacles with and without
/// friction have in common.
template <int B>
class RigidContact {
 public:
  /// The row of a table of options that goes with it.
  static constexpr OptionSpec normal_option = {"normal", OptionType::text, "obstacle", "obstacle | body",
                                               "whose normal the condition -u.n <= distance takes"};

  /// @throws Error(Exit::input) where the settings have no shape
  RigidContact(const Settings& settings, const char* type)
      : shape_(settings.shape()), body_normal_(std::strcmp(settings.text("normal"), "body") == 0) {
    if (!shape_) throw Error(Exit::input, std::string("a ") + type + " obstacle needs a 'shape'");
  }

  /// One direction, n, with its bound; a status where the distance or the normal are not known.
  void assemble(const SurfaceVertex& vertex, LocalConstraint<B>& c, Status& status) const noexcept {
    const Distance distance = shape_->at(vertex.position, vertex.normal, status);
    if (!status.ok()) return;
    if (!std::isfinite(distance.value)) return fail(vertex, "the distance to the obstacle is not finite", status);
    c.directions = 1;
    if (!direction(vertex, distance, c.direction[0]))
      return fail(vertex, body_normal_ ? "the body has no outer normal" : "the obstacle has no normal", status);
    c.lower[0] = -distance.value;
    c.upper[0] = infinity;
  }

  static void fail(const SurfaceVertex& vertex, const char* what, Status& status) noexcept {
    char message[256];
    std::snprintf(message, sizeof message, "%s at (%g, %g, %g)", what, vertex.position[0], vertex.position[1],
                  vertex.position[2]);
    status.fail(static_cast<int>(Exit::input), message);
  }

 private:
  // The direction n as a unit vector; false where it is zero or not finite.
  bool direction(const SurfaceVertex& vertex, const Distance& distance, double* n) const noexcept {
    const double sign = body_normal_ ? -1 : 1;
    const double* normal = body_normal_ ? vertex.normal : distance.normal;
    const double length = block::norm<B>(normal);
    if (!(length > 0) || !std::isfinite(length)) return false;
    for (int i = 0; i < B; ++i) n[i] = sign * normal[i] / length;
    return true;
  }

  const DistanceFunction* shape_;
  bool body_normal_;
};

/// Contact and nothing else.
/// @tparam Contact what may not be penetrated
template <int B, class Contact = RigidContact<B>>
class FrictionlessContact : public BoxObstacle<B> {
 public:
  FrictionlessContact(const Settings& settings, const char* type) : contact_(settings, type) {}

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", B, 1}}}; }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) contact_.assemble(vertices[k], constraints[k], status);
  }

 private:
  Contact contact_;
};

}  // namespace signorini
