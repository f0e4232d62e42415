// Contact with a rigid shape that holds with a given traction along it: friction with the bound `traction`.
#include <iterator>

#include <signorini/sdk/given_friction.hpp>
#include <signorini/sdk/given_friction_solver.hpp>
#include <signorini/sdk/plugin.hpp>
#include <signorini/sdk/rigid_contact.hpp>

using namespace signorini;

namespace {

// What phi is, how it is minimised, and how it is linearised are the SDK's: phi(v) = data[0] |v_T - last_T|.
template <int B>
class MyObstacle final : public FunctionalObstacle<B, GivenFriction<B>, GivenFrictionSolver<B>, GivenFrictionModel<B>>,
                         public Scaling,
                         public Friction {
 public:
  explicit MyObstacle(const Settings& settings) : settings_(settings), contact_(settings, "my_obstacle") {}

  // A normal with a bound, what is tangential to it, and one number.
  ObstacleDescriptor descriptor() const noexcept override {
    return {2, {{"normal", B, 1}, {"tangential", B - 1, 1}}, 1};
  }

  // Several threads may be in here at a time.
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      contact_.assemble(v, constraints[k], status);    // the distance and the normal of the shape
      if (!status.ok() || !(v.measure > 0)) continue;  // asked for the distance alone
      constraints[k].data[0] = v.measure * settings_.value("traction", 0, v.position, v.normal, status);
    }
  }

  // At a node that stands for several: integrals grow.
  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override { data[0] *= ratio; }

  // The largest force along the shape: no part of the pressure, and that bound.
  const Friction* friction() const noexcept override { return this; }
  FrictionLaw law(const double* data) const noexcept override { return {0, data[0]}; }

 private:
  const Settings& settings_;  // outlives the obstacle
  RigidContact<B> contact_;
};

constexpr OptionSpec options[] = {
    RigidContact<2>::normal_option,
    {"traction", OptionType::field, "0.01", "[0, inf)", "what it holds with, per area"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"my_obstacle", "contact with a shape that holds with a given traction", options,
                      std::size(options), true, nullptr, sdk::create<MyObstacle<2>, 2>, sdk::create<MyObstacle<3>, 3>},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("my_obstacle", "0.1.0", "contact with a shape that holds with a given traction", register_all);
