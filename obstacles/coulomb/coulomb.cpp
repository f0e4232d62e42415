/// Contact with a rigid obstacle and friction by Coulomb's law.
#include <iterator>

#include "core/sdk/coulomb_contact.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

template <int B>
Obstacle<B>* create(const Settings& settings, Status& status) noexcept {
  return sdk::guarded(status, [&] { return coulomb_contact<B, RigidContact<B>>(settings, "coulomb"); });
}

constexpr OptionSpec options[] = {
    RigidContact<2>::normal_option,
    CoulombContact<2, RigidContact<2>>::friction_option,
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"coulomb", "contact with a rigid obstacle and friction by Coulomb's law", options,
                      std::size(options), true, nullptr, create<2>, create<3>},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("coulomb", "1.0.0", "contact with a rigid obstacle and friction by Coulomb's law",
                 signorini::register_all, "BSD-3-Clause");
