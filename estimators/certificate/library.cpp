#include "estimators/certificate/certificate.hpp"
#include "estimators/certificate/hierarchical.hpp"

namespace signorini {
namespace {

template <int D, int B>
using Function = Estimate (*)(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                              const EstimateOptions<B>& options);

template <int D, int B, Function<D, B> function>
class ByFunction final : public Estimator<D, B> {
 public:
  Estimate estimate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                    const EstimateOptions<B>& options) const override {
    return function(nodes, model, u, options);
  }
};

}  // namespace
}  // namespace signorini

// What estimators/registration.cpp looks for, and all that the library exports.
#define SIGNORINI_EXPORT(name, D, B)                                                                          \
  __attribute__((visibility("default"))) void* signorini_##name##_##D##_##B() {                               \
    return static_cast<signorini::Estimator<D, B>*>(new signorini::ByFunction<D, B, &signorini::name<D, B>>); \
  }
extern "C" {
SIGNORINI_EXPORT(certificate, 2, 1)
SIGNORINI_EXPORT(certificate, 3, 1)
SIGNORINI_EXPORT(certificate, 2, 2)
SIGNORINI_EXPORT(certificate, 3, 3)
SIGNORINI_EXPORT(hierarchical, 2, 1)
SIGNORINI_EXPORT(hierarchical, 3, 1)
SIGNORINI_EXPORT(hierarchical, 2, 2)
SIGNORINI_EXPORT(hierarchical, 3, 3)
}
#undef SIGNORINI_EXPORT
