/// Frictionless contact of two elastic bodies, on the jumps of their displacements: see ElasticContact.
#include <iterator>

#include "core/sdk/elastic_contact.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

template <int B>
Obstacle<B>* create(const Settings& settings, Status& status) noexcept {
  return sdk::guarded(
      status, [&]() -> Obstacle<B>* { return new FrictionlessContact<B, ElasticContact<B>>(settings, "elastic"); });
}

constexpr OptionSpec options[] = {ElasticContact<2>::gap_option};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"elastic", "frictionless contact with another elastic body", options, std::size(options), false,
                      nullptr, create<2>, create<3>, true},
                     status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("elastic", "1.0.0", "frictionless contact with another elastic body", signorini::register_all,
                 "BSD-3-Clause");
