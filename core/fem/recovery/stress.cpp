#include "core/fem/recovery/stress.hpp"

#include <cmath>

#include "core/fem/recovery/stress_reader.hpp"

namespace signorini {
template <int D>
std::vector<Stress> element_stress(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u,
                                   const OwnPressure<D>& pressure) {
  std::vector<Stress> out;
  with_order(nodes, [&](auto order) {
    const auto& elements = nodes.template elements<order>();
    const StressReader<D, order> reader(nodes, model, u, pressure);
    std::array<double, D + 1> centroid;
    centroid.fill(1.0 / (D + 1));
    out.reserve(elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e)
      out.push_back(reader.at(e, ElementMap<D, D, order>(nodes.mesh(), elements[e]), centroid).stress);
  });
  return out;
}

double von_mises(const Stress& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

template std::vector<Stress> element_stress(const Nodes<2>&, const Model<2>&, const std::vector<double>&,
                                            const OwnPressure<2>&);
template std::vector<Stress> element_stress(const Nodes<3>&, const Model<3>&, const std::vector<double>&,
                                            const OwnPressure<3>&);

}  // namespace signorini
