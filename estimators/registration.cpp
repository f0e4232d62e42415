#include "estimators/registration.hpp"

#include <fmt/format.h>

#include "core/component/companion.hpp"
#include "estimators/estimator.hpp"

namespace signorini {
namespace {

/// One of the library of the certificate.
template <int D, int B>
std::function<std::unique_ptr<Estimator<D, B>>()> creator(const char* id) {
  return [id] {
    const std::string function = fmt::format("signorini_{}_{}_{}", id, D, B);
    using Create = Estimator<D, B>* (*)();
    const auto create = reinterpret_cast<Create>(load_function(certificate_library, function.c_str()));
    return std::unique_ptr<Estimator<D, B>>(create());
  };
}

void add(Registry& registry, const char* id, const char* help) {
  const std::string file = file_of(reinterpret_cast<const void*>(&register_estimators));
  registry.add<Estimator<2, 1>, Estimator<3, 1>, Estimator<2, 2>, Estimator<3, 3>>(
      {"estimator", id, help, {}, file, {}}, creator<2, 1>(id), creator<3, 1>(id), creator<2, 2>(id),
      creator<3, 3>(id));
}

}  // namespace

void register_estimators(Registry& registry) {
  add(registry, "certificate",
      "guaranteed bounds of the energy error: by a stress in equilibrium with the loads from above, by what bubbles of "
      "edges win from below");
  add(registry, "hierarchical", "no bounds, but about how large the energy error is: what bubbles of edges win");
}

}  // namespace signorini
