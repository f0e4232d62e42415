// An estimator outside the program: stresses against their means around vertices.
#include <signorini/sdk/plugin.hpp>

#include <array>
#include <vector>

using namespace signorini;

namespace {

class Averaging final : public ErrorEstimator {
 public:
  void estimate(const SampledStress& stress, double* of_element, Status& status) const noexcept override {
    sdk::guarded(status, [&] {
      std::vector<std::array<double, 6>> mean(static_cast<std::size_t>(stress.vertices()));
      std::vector<double> weight(mean.size());
      each(stress, status, [&](Index, int corner, Index vertex, const SampledElement& element) {
        for (int q = 0; q < element.count; ++q) {
          const StressSample& point = element.sample[q];
          const double part = point.weight * point.barycentric[corner];
          weight[vertex] += part;
          for (int c = 0; c < stress.components(); ++c) mean[vertex][c] += part * point.stress[c];
        }
      });
      for (std::size_t v = 0; v < mean.size(); ++v)
        for (double& s : mean[v]) s /= weight[v] > 0 ? weight[v] : 1;
      each(stress, status, [&](Index e, int corner, Index, const SampledElement& element) {
        if (corner > 0) return;
        of_element[e] = 0;
        for (int q = 0; q < element.count; ++q) {
          const StressSample& point = element.sample[q];
          std::array<double, 6> off{};
          for (int c = 0; c < stress.components(); ++c) {
            off[c] = -point.stress[c];
            for (int a = 0; a <= stress.dimension(); ++a) off[c] += point.barycentric[a] * mean[element.corner[a]][c];
          }
          of_element[e] += point.weight * stress.energy(e, point, off.data());
        }
      });
    });
  }

 private:
  /// Calls use(number of the element, number of a corner of it, vertex, element).
  static void each(const SampledStress& stress, Status& status, const auto& use) {
    SampledElement element;
    for (Index e = 0; e < stress.elements() && status.ok(); ++e) {
      stress.read(e, StressRule::exact, element, status);
      for (int a = 0; a <= stress.dimension(); ++a) use(e, a, element.corner[a], element);
    }
  }
};

void register_all(Registrar& registrar, Status& status) {
  registrar.estimator({"averaging", "stresses against means", sdk::create_estimator<Averaging>}, status);
}

}  // namespace

SIGNORINI_PLUGIN("averaging", "0.1.0", "stresses against means", register_all);
