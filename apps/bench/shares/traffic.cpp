#include "apps/bench/shares/traffic.hpp"

#include <algorithm>

#include "core/base/stopwatch.hpp"

namespace signorini::bench {

double stream_bandwidth() {
  const std::size_t n = std::size_t{1} << 25;
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  double best = 1e300;
  for (int run = 0; run < 5; ++run) {
    Stopwatch watch;
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 0.5 * c[i];
    best = std::min(best, watch.elapsed());
    std::swap(a, c);
  }
  return 3.0 * static_cast<double>(n * sizeof(double)) / best;
}

template <int B>
double cycle_bytes(const std::vector<Level<B>>& levels, std::span<const Prolongation> prolongations) {
  double bytes = 0;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const Level<B>& level = levels[k];
    const double vectors = level.vectors, doubles = sizeof(double);
    const double matrix = static_cast<double>(level.A->value.size()) * doubles +
                          static_cast<double>(level.A->column.size()) * sizeof(Index) + vectors * sizeof(Offset);
    const double inverse = vectors * B * B * doubles, vector = vectors * B * doubles;
    const double bounds = static_cast<double>(level.constraints.size()) * (2 * B * doubles + sizeof(Index));
    const double sweep = matrix + inverse + bounds + 3 * vector;  // b, x read and written
    const double residual = matrix + 3 * vector;
    const Prolongation& P = prolongations[k - 1];
    const double weights = static_cast<double>(P.weight.size() + P.block.size()) * doubles +
                           static_cast<double>(P.column.size()) * sizeof(Index) + vectors * sizeof(Offset);
    const double coarse = static_cast<double>(P.coarse) * B * doubles;
    bytes += 2 * sweep + residual + 2 * weights + vector + 2 * vector + 4 * coarse;
  }
  return bytes;
}

template double cycle_bytes(const std::vector<Level<1>>&, std::span<const Prolongation>);
template double cycle_bytes(const std::vector<Level<2>>&, std::span<const Prolongation>);
template double cycle_bytes(const std::vector<Level<3>>&, std::span<const Prolongation>);

}  // namespace signorini::bench
