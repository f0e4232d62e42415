#pragma once
#include <string>

#include "core/sdk/coulomb_law.hpp"
#include "core/sdk/rigid_contact.hpp"

namespace signorini {

/// Contact and friction by Coulomb's law: |tau| <= mu times the force that presses, at each vertex.
/// @tparam Contact RigidContact<B> or ElasticContact<B>: what may not be penetrated
template <int B, class Contact>
class CoulombContact final : public CoulombLaw<B> {
 public:
  /// The row of a table of options that goes with it, beside those of Contact.
  static constexpr OptionSpec friction_option = {"friction", OptionType::field, "", "[0, inf)",
                                                 "coefficient of friction"};

  /// @throws Error(Exit::input) where the settings have no friction, or not what Contact needs
  CoulombContact(const Settings& settings, const char* type) : settings_(settings), contact_(settings, type) {
    if (!settings.has("friction"))
      throw Error(Exit::input, std::string("the obstacle type '") + type + "' needs 'friction'");
  }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      contact_.assemble(v, constraints[k], status);
      if (!(v.measure > 0)) continue;  // asked for the distance alone
      const double friction = status.ok() ? settings_.value("friction", 0, v.position, v.normal, status) : 0;
      if (status.ok() && !(friction >= 0)) RigidContact<B>::fail(v, "'friction' is negative", status);
      constraints[k].data[1] = friction;
    }
  }

 private:
  const Settings& settings_;
  Contact contact_;
};

/// The same, or contact and nothing else where friction is zero.
template <int B, class Contact>
Obstacle<B>* coulomb_contact(const Settings& settings, const char* type) {
  double friction = 0;
  if (settings.constant("friction", friction) && friction == 0)
    return new FrictionlessContact<B, Contact>(settings, type);
  return new CoulombContact<B, Contact>(settings, type);
}

}  // namespace signorini
