/// Contact with a rigid obstacle and friction with a given bound on the tangential traction.
#include <iterator>

#include "core/sdk/plugin.hpp"
#include "core/sdk/tresca_contact.hpp"

namespace signorini {
namespace {

template <int B>
Obstacle<B>* create(const Settings& settings, Status& status) noexcept {
  return sdk::guarded(status,
                      [&]() -> Obstacle<B>* { return new TrescaContact<B, RigidContact<B>>(settings, "tresca"); });
}

constexpr OptionSpec options[] = {RigidContact<2>::normal_option, TrescaContact<2, RigidContact<2>>::bound_option};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"tresca", "contact with a rigid obstacle and friction with a given bound", options,
                      std::size(options), true, nullptr, create<2>, create<3>},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("tresca", "1.0.0", "contact with a rigid obstacle and friction with a given bound",
                 signorini::register_all, "BSD-3-Clause");
