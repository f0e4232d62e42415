#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.hpp"
#include "core/sdk/error_estimator.hpp"
#include "estimators/estimator.hpp"
#include "estimators/stress_at_points.hpp"

namespace signorini {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// That of a plugin.
template <int D, int B>
class ByStress final : public Estimator<D, B> {
 public:
  ByStress(const EstimatorType& type, std::string file) : id_(type.id), file_(std::move(file)) {
    Status status;
    own_.reset(type.create(status));
    require(status);
    if (!own_) status.fail(static_cast<int>(Exit::plugin), "its constructor returns nothing");
    require(status);
  }

  Estimate estimate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                    const EstimateOptions<B>& options) const override {
    const auto stress = stress_at_points<D, B>(nodes, model, u, options.pressure);
    Estimate out;
    out.lower = out.upper = out.total = out.lifted = not_known;
    out.parts = {not_known, not_known, not_known, not_known, not_known, not_known};
    out.reasons = {"an estimate, no bound"};
    out.of_element.resize(static_cast<std::size_t>(stress->elements()));
    Status status;
    own_->estimate(*stress, out.of_element.data(), status);
    require(status);
    for (const double share : out.of_element)
      if (!(share >= 0 && std::isfinite(share)))
        status.fail(static_cast<int>(Exit::plugin), "a share of an element is negative, or not finite");
    require(status);
    out.estimated = std::accumulate(out.of_element.begin(), out.of_element.end(), 0.0);
    out.energy = energy(*stress);
    return out;
  }

 private:
  void require(const Status& status) const {
    if (status.ok()) return;
    const auto exit = static_cast<Exit>(status.code);
    throw Error(exit, exit == Exit::plugin ? "estimator '" + id_ + "': " + status.message + " (" + file_ + ")"
                                           : std::string(status.message));
  }

  double energy(const SampledStress& stress) const {
    double sum = 0;
    Status status;
    SampledElement element;
    for (Index e = 0; e < stress.elements(); ++e) {
      stress.read(e, StressRule::best, element, status);  // that of the stiffness
      for (const StressSample& point : std::span(element.sample, static_cast<std::size_t>(element.count)))
        sum += point.weight * stress.energy(e, point, point.stress);
    }
    require(status);
    return sum;
  }

  const std::string id_, file_;
  std::unique_ptr<ErrorEstimator> own_;
};

}  // namespace

template <int D, int B>
std::unique_ptr<Estimator<D, B>> create_estimator(const Registry& registry, const std::string& id) {
  if (const EstimatorType* type = registry.estimator(id))
    return std::make_unique<ByStress<D, B>>(*type, registry.entry("estimator", id).file);
  return registry.create<Estimator<D, B>>("estimator", id);
}

template std::unique_ptr<Estimator<2, 1>> create_estimator(const Registry&, const std::string&);
template std::unique_ptr<Estimator<3, 1>> create_estimator(const Registry&, const std::string&);
template std::unique_ptr<Estimator<2, 2>> create_estimator(const Registry&, const std::string&);
template std::unique_ptr<Estimator<3, 3>> create_estimator(const Registry&, const std::string&);

}  // namespace signorini
