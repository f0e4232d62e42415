#include "estimators/registration.hpp"

#include <fmt/format.h>

#include "core/component/companion.hpp"
#include "estimators/estimator.hpp"

namespace signorini {
namespace {

template <int D, int B>
std::unique_ptr<Estimator<D, B>> certificate() {
  const std::string function = fmt::format("signorini_certificate_{}_{}", D, B);
  using Create = Estimator<D, B>* (*)();
  static const auto create = reinterpret_cast<Create>(load_function(certificate_library, function.c_str()));
  return std::unique_ptr<Estimator<D, B>>(create());
}

}  // namespace

void register_estimators(Registry& registry) {
  registry.add<Estimator<2, 1>, Estimator<3, 1>, Estimator<2, 2>, Estimator<3, 3>>(
      {"estimator",
       "certificate",
       "guaranteed bounds of the energy error: by a stress in equilibrium with the loads from above, by what bubbles "
       "of "
       "edges win from below",
       {},
       file_of(reinterpret_cast<const void*>(&register_estimators)),
       {}},
      certificate<2, 1>, certificate<3, 1>, certificate<2, 2>, certificate<3, 3>);
}

}  // namespace signorini
