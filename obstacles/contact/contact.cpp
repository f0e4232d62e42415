/// Frictionless contact with a rigid obstacle: linearised non-penetration -u.n <= d(x), with the distance d of the
/// undeformed vertex to the obstacle and the unit normal n, which points from the obstacle towards the body.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "core/sdk/box_obstacle.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

template <int B>
class Contact final : public BoxObstacle<B> {
 public:
  explicit Contact(const Settings& settings)
      : shape_(settings.shape()), body_normal_(std::strcmp(settings.text("normal"), "body") == 0) {
    if (!shape_) throw Error(Exit::input, "a contact obstacle needs a 'shape'");
  }

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", B, 1}}}; }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const Distance distance = shape_->at(vertices[k].position, vertices[k].normal, status);
      if (!status.ok()) return;
      if (!std::isfinite(distance.value))
        return fail(vertices[k], "the distance to the obstacle is not finite", status);
      LocalConstraint<B>& c = constraints[k];
      c.directions = 1;
      if (!direction(vertices[k], distance, c.direction[0]))
        return fail(vertices[k], body_normal_ ? "the body has no outer normal" : "the obstacle has no normal", status);
      c.lower[0] = -distance.value;
      c.upper[0] = infinity;
    }
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

  static void fail(const SurfaceVertex& vertex, const char* what, Status& status) noexcept {
    char message[256];
    std::snprintf(message, sizeof message, "%s at (%g, %g, %g)", what, vertex.position[0], vertex.position[1],
                  vertex.position[2]);
    status.fail(static_cast<int>(Exit::input), message);
  }

  const DistanceFunction* shape_;
  bool body_normal_;
};

constexpr OptionSpec options[] = {
    {"normal", OptionType::text, "obstacle", "obstacle | body", "whose normal the condition -u.n <= distance takes"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"contact", "frictionless contact with a rigid obstacle", options, std::size(options), true,
                      nullptr, sdk::create<Contact<2>, 2>, sdk::create<Contact<3>, 3>},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("contact", "1.0.0", "frictionless contact with a rigid obstacle", signorini::register_all);
