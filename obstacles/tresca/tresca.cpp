/// Contact with a rigid obstacle and friction with a given bound on the tangential traction.
#include <iterator>

#include "core/sdk/given_friction.hpp"
#include "core/sdk/given_friction_solver.hpp"
#include "core/sdk/plugin.hpp"
#include "core/sdk/rigid_contact.hpp"

namespace signorini {
namespace {

template <int B>
class Tresca final : public FunctionalObstacle<B, GivenFriction<B>, GivenFrictionSolver<B>, GivenFrictionModel<B>>,
                     public Scaling,
                     public Friction {
 public:
  explicit Tresca(const Settings& settings) : settings_(settings), contact_(settings, "tresca") {
    if (!settings.has("bound")) throw Error(Exit::input, "a tresca obstacle needs 'bound'");
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
  RigidContact<B> contact_;
};

constexpr OptionSpec options[] = {
    RigidContact<2>::normal_option,
    {"bound", OptionType::field, "", "[0, inf)", "largest tangential traction"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"tresca", "contact with a rigid obstacle and friction with a given bound", options,
                      std::size(options), true, nullptr, sdk::create<Tresca<2>, 2>, sdk::create<Tresca<3>, 3>},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("tresca", "1.0.0", "contact with a rigid obstacle and friction with a given bound",
                 signorini::register_all, "BSD-3-Clause");
