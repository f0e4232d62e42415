// Vertices that move in a slot: -gap <= u . axis <= gap.
#include <iterator>

#include <signorini/sdk/box_obstacle.hpp>
#include <signorini/sdk/plugin.hpp>

using namespace signorini;

namespace {

template <int B>
class MyObstacle final : public BoxObstacle<B> {
 public:
  explicit MyObstacle(const Settings& settings) : settings_(settings) {
    if (settings.length("axis") != B) throw Error(Exit::input, "'axis' needs an entry per dimension");
  }

  // One direction with B components and two bounds.
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"axis", B, 2}}}; }

  // Several threads may be in here at a time.
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) {
      const SurfaceVertex& v = vertices[k];
      const double gap = settings_.value("gap", 0, v.position, v.normal, status);
      double axis[B];
      for (int i = 0; i < B; ++i)
        axis[i] = settings_.value("axis", static_cast<std::size_t>(i), v.position, v.normal, status);
      const double length = block::norm<B>(axis);
      if (!status.ok()) return;
      if (!(length > 0)) return status.fail(static_cast<int>(Exit::input), "'axis' is zero");

      LocalConstraint<B>& c = constraints[k];
      c.directions = 1;
      for (int i = 0; i < B; ++i) c.direction[0][i] = axis[i] / length;
      c.lower[0] = -gap;
      c.upper[0] = gap;
    }
  }

 private:
  const Settings& settings_;  // outlives the obstacle
};

constexpr OptionSpec options[] = {
    {"gap", OptionType::field, "0.01", "[0, inf)", "how far a vertex may move along the axis"},
    {"axis", OptionType::vector, "", "", "direction across the slot"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"my_obstacle", "vertices move in a slot", options, std::size(options), false, nullptr,
                      sdk::create<MyObstacle<2>, 2>, sdk::create<MyObstacle<3>, 3>},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("my_obstacle", "0.1.0", "vertices move in a slot", register_all);
