// A scalar functional with a kink, as a plugin that uses the SDK alone: see ConvexKink.
#include <cstdio>
#include <iterator>

#include "core/sdk/plugin.hpp"
#include "tests/obstacles/kink/convex_kink.hpp"

namespace signorini::test {
namespace {

class Kink final : public FunctionalObstacle<1, ConvexKink> {
 public:
  explicit Kink(const Settings& settings) : settings_(settings) {}

  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 2}}, 5}; }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<1>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      const auto value = [&](const char* name) { return settings_.value(name, 0, v.position, v.normal, status); };
      LocalConstraint<1>& c = constraints[k];
      c.directions = 1;
      c.direction[0][0] = 1;
      c.lower[0] = settings_.has("lower") ? value("lower") : -infinity;
      c.upper[0] = infinity;
      const double numbers[5] = {value("at"), v.measure * value("below"), v.measure * value("above"),
                                 v.measure * value("stiffness_below"), v.measure * value("stiffness_above")};
      std::copy(std::begin(numbers), std::end(numbers), c.data);
      if (status.ok() && c.data[1] + c.data[2] < 0) status.fail(2, "'below' and 'above' together are negative");
    }
  }

 private:
  const Settings& settings_;
};

constexpr OptionSpec options[] = {
    {"at", OptionType::field, "0", "", "the value at which the energy has a kink"},
    {"below", OptionType::field, "0", "", "slope of the energy per measure, downwards from there"},
    {"above", OptionType::field, "0", "", "upwards from there"},
    {"stiffness_below", OptionType::field, "0", "[0, inf)", "its second derivative below"},
    {"stiffness_above", OptionType::field, "0", "[0, inf)", "and above"},
    {"lower", OptionType::field, "", "", "a bound; none when missing"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"kink", "a convex, piecewise quadratic energy", options, std::size(options), false,
                      sdk::create<Kink, 1>, nullptr, nullptr},
                     status);
}

}  // namespace
}  // namespace signorini::test

SIGNORINI_PLUGIN("kink", "0.1.0", "a convex, piecewise quadratic energy", signorini::test::register_all);
