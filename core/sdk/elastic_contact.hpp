#pragma once
#include <cmath>

#include "core/sdk/rigid_contact.hpp"

namespace signorini {

/// Linearised non-penetration of two bodies at a node of the slave's side, n . [u] >= -(g + gap): with the jump [u], by
/// which the slave moves more than the master near the node, the unit normal n from the master to the slave, their mean
/// distance g, and an offset `gap` of the user's. What obstacles with and without friction have in common.
template <int B>
class ElasticContact {
 public:
  /// The row of a table of options that goes with it.
  static constexpr OptionSpec gap_option = {"gap", OptionType::field, "0", "",
                                            "is added to the distance of the bodies; negative: they are pressed"};

  ElasticContact(const Settings& settings, const char*) : settings_(settings) {}

  /// One direction, n, with its bound; a status where the gap is not known.
  void assemble(const SurfaceVertex& vertex, LocalConstraint<B>& c, Status& status) const noexcept {
    const double offset = settings_.value("gap", 0, vertex.position, vertex.normal, status);
    if (!status.ok()) return;
    if (!std::isfinite(vertex.gap + offset))
      return RigidContact<B>::fail(vertex, "the distance to the other body is not finite", status);
    c.directions = 1;
    for (int i = 0; i < B; ++i) c.direction[0][i] = vertex.away[i];
    c.lower[0] = -(vertex.gap + offset);
    c.upper[0] = infinity;
  }

 private:
  const Settings& settings_;
};

}  // namespace signorini
