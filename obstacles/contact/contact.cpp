/// Frictionless contact with a rigid obstacle: see RigidContact.
#include <iterator>

#include "core/sdk/plugin.hpp"
#include "core/sdk/rigid_contact.hpp"

namespace signorini {
namespace {

template <int B>
class Contact final : public FrictionlessContact<B> {
 public:
  explicit Contact(const Settings& settings) : FrictionlessContact<B>(settings, "contact") {}
};

constexpr OptionSpec options[] = {RigidContact<2>::normal_option};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"contact", "frictionless contact with a rigid obstacle", options, std::size(options), true,
                      nullptr, sdk::create<Contact<2>, 2>, sdk::create<Contact<3>, 3>},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("contact", "1.0.0", "frictionless contact with a rigid obstacle", signorini::register_all,
                 "BSD-3-Clause");
