/// Two elastic bodies that are glued together, on meshes that need not match: see Tying.
#include <iterator>

#include "core/sdk/box_obstacle.hpp"
#include "core/sdk/plugin.hpp"
#include "core/sdk/tying.hpp"

namespace signorini {
namespace {

template <int B>
class Tied : public BoxObstacle<B>, public Tying {
 public:
  explicit Tied(const Settings& settings) : adjust_(settings.number("adjust")) {}

  ObstacleDescriptor descriptor() const noexcept override { return {}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<B>*, Status&) const noexcept override {}
  double adjust() const noexcept override { return adjust_; }

 private:
  double adjust_;
};

template <int B>
Obstacle<B>* create(const Settings& settings, Status& status) noexcept {
  return sdk::guarded(status, [&]() -> Obstacle<B>* { return new Tied<B>(settings); });
}

constexpr OptionSpec options[] = {
    {"adjust", OptionType::number, "0", "[0, inf)",
     "the bodies may be so far apart, or into each other, at the start, and are tied all the same, as they are"}};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"tied", "glued to another elastic body, whose mesh need not match", options, std::size(options),
                      false, nullptr, create<2>, create<3>, true},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("tied", "1.0.0", "two elastic bodies glued together", signorini::register_all, "BSD-3-Clause");
