// Contact of two elastic bodies with a coating in between: they touch where the coating fills what is between them.
#include <iterator>

#include <signorini/sdk/box_obstacle.hpp>
#include <signorini/sdk/plugin.hpp>

using namespace signorini;

namespace {

// The unknowns at a node are by how much the first body moves more than the second one.
template <int B>
class MyObstacle final : public BoxObstacle<B> {
 public:
  explicit MyObstacle(const Settings& settings) : settings_(settings) {}

  // One direction, along the normal, with a bound.
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"normal", B, 1}}}; }

  // Several threads may be in here at a time.
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) {
      const SurfaceVertex& v = vertices[k];
      const double coating = settings_.value("coating", 0, v.position, v.normal, status);
      if (!status.ok()) return;
      LocalConstraint<B>& c = constraints[k];
      c.directions = 1;
      for (int i = 0; i < B; ++i) c.direction[0][i] = v.away[i];  // from the second body to the first
      c.lower[0] = -(v.gap - coating);
      c.upper[0] = infinity;
    }
  }

 private:
  const Settings& settings_;  // outlives the obstacle
};

constexpr OptionSpec options[] = {
    {"coating", OptionType::field, "0", "[0, inf)", "thickness of what is between the bodies"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"my_obstacle", "contact of two bodies with a coating in between", options, std::size(options),
                      false, nullptr, sdk::create<MyObstacle<2>, 2>, sdk::create<MyObstacle<3>, 3>, true},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("my_obstacle", "0.1.0", "contact of two bodies with a coating in between", register_all);
