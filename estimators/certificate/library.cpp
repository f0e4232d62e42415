#include "estimators/certificate/certificate.hpp"

namespace signorini {
namespace {

template <int D, int B>
class CertificateEstimator final : public Estimator<D, B> {
 public:
  Estimate estimate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                    const EstimateOptions<B>& options) const override {
    return certificate<D, B>(nodes, model, u, options);
  }
};

}  // namespace
}  // namespace signorini

// What estimators/registration.cpp looks for, and all that the library exports.
extern "C" {
__attribute__((visibility("default"))) void* signorini_certificate_2_1() {
  return static_cast<signorini::Estimator<2, 1>*>(new signorini::CertificateEstimator<2, 1>);
}
__attribute__((visibility("default"))) void* signorini_certificate_3_1() {
  return static_cast<signorini::Estimator<3, 1>*>(new signorini::CertificateEstimator<3, 1>);
}
__attribute__((visibility("default"))) void* signorini_certificate_2_2() {
  return static_cast<signorini::Estimator<2, 2>*>(new signorini::CertificateEstimator<2, 2>);
}
__attribute__((visibility("default"))) void* signorini_certificate_3_3() {
  return static_cast<signorini::Estimator<3, 3>*>(new signorini::CertificateEstimator<3, 3>);
}
}
