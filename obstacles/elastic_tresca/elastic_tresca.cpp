/// Contact of two elastic bodies and friction with a given bound on the tangential traction, on the jumps of their
/// displacements: see TrescaContact and ElasticContact.
#include <iterator>

#include "core/sdk/elastic_contact.hpp"
#include "core/sdk/plugin.hpp"
#include "core/sdk/tresca_contact.hpp"

namespace signorini {
namespace {

template <int B>
Obstacle<B>* create(const Settings& settings, Status& status) noexcept {
  return sdk::guarded(
      status, [&]() -> Obstacle<B>* { return new TrescaContact<B, ElasticContact<B>>(settings, "elastic_tresca"); });
}

constexpr OptionSpec options[] = {ElasticContact<2>::gap_option, TrescaContact<2, ElasticContact<2>>::bound_option};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"elastic_tresca", "contact with another elastic body and friction with a given bound", options,
                      std::size(options), false, nullptr, create<2>, create<3>, true},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("elastic_tresca", "1.0.0", "contact with another elastic body and friction with a given bound",
                 signorini::register_all, "BSD-3-Clause");
