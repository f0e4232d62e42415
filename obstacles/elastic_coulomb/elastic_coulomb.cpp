/// Contact of two elastic bodies with friction by Coulomb's law, on the jumps of their displacements: see
/// CoulombContact and ElasticContact.
#include <iterator>

#include "core/sdk/coulomb_contact.hpp"
#include "core/sdk/elastic_contact.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

template <int B>
Obstacle<B>* create(const Settings& settings, Status& status) noexcept {
  return sdk::guarded(status, [&] { return coulomb_contact<B, ElasticContact<B>>(settings, "elastic_coulomb"); });
}

constexpr OptionSpec options[] = {ElasticContact<2>::gap_option, CoulombContact<2, ElasticContact<2>>::friction_option};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"elastic_coulomb", "contact with another elastic body and friction by Coulomb's law", options,
                      std::size(options), false, nullptr, create<2>, create<3>, true},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("elastic_coulomb", "1.0.0", "contact with another elastic body and friction by Coulomb's law",
                 signorini::register_all, "BSD-3-Clause");
