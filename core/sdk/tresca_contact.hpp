#pragma once
#include <string>

#include "core/sdk/given_friction.hpp"
#include "core/sdk/given_friction_solver.hpp"
#include "core/sdk/rigid_contact.hpp"

namespace signorini {

/// Contact, and friction with a given bound on the tangential traction.
/// @tparam Contact RigidContact<B> or ElasticContact<B>: what may not be penetrated
template <int B, class Contact>
class TrescaContact final
    : public FunctionalObstacle<B, GivenFriction<B>, GivenFrictionSolver<B>, GivenFrictionModel<B>>,
      public Scaling,
      public Friction {
 public:
  /// The row of a table of options that goes with it, beside those of Contact.
  static constexpr OptionSpec bound_option = {"bound", OptionType::field, "", "[0, inf)",
                                              "largest tangential traction"};

  /// @throws Error(Exit::input) where the settings have no bound, or not what Contact needs
  TrescaContact(const Settings& settings, const char* type) : settings_(settings), contact_(settings, type) {
    if (!settings.has("bound")) throw Error(Exit::input, std::string("the obstacle type '") + type + "' needs 'bound'");
  }

  ObstacleDescriptor descriptor() const noexcept override {
    return {2, {{"normal", B, 1}, {"tangential", B - 1, 1}}, 1};
  }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      contact_.assemble(v, constraints[k], status);
      if (!(v.measure > 0)) continue;  // asked for the distance alone
      const double bound = status.ok() ? settings_.value("bound", 0, v.position, v.normal, status) : 0;
      if (status.ok() && !(bound >= 0)) RigidContact<B>::fail(v, "'bound' is negative", status);
      constraints[k].data[0] = bound * v.measure;
    }
  }

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }

  const Friction* friction() const noexcept override { return this; }
  FrictionLaw law(const double* data) const noexcept override { return {0, data[0]}; }

 private:
  const Settings& settings_;
  Contact contact_;
};

}  // namespace signorini
