#include "core/mortar/dual_basis.hpp"

namespace signorini::mortar {
namespace {

// What is covered of a face has no moments in a direction in which it is less than this part as wide as the face.
constexpr double thin = 1e-6;

template <int D>
Moments<D - 1> sum_moments(const std::vector<Segment<D>>& segments, const Axes<D - 1>& axes) {
  Moments<D - 1> sum;
  for (const Segment<D>& s : segments) sum.add(moments(s.piece, axes));
  return sum;
}

}  // namespace

template <int D>
DualBasis<D>::DualBasis(const FaceFrame<D>& frame, const std::vector<Segment<D>>& segments) {
  // Three passes: the centroid, the principal directions, and what is exact in those even of a thin strip.
  Moments<K> m = sum_moments(segments, axes_);
  for (int k = 0; k < K; ++k) axes_.origin[k] = m.first[k] / m.measure;
  m = sum_moments(segments, axes_);
  if constexpr (K > 1) {
    turn(m);
    m = sum_moments(segments, axes_);
  }
  measure_ = m.measure;
  for (int k = 0; k < K; ++k) off_[k] = m.first[k] / m.measure;
  for (int p = 0; p < D; ++p) share_[p] = measure_ * std::max(0.0, frame.shape[p](axes_.origin));
  invert(frame, m);
}

// Axes along the principal directions.
template <int D>
void DualBasis<D>::turn(const Moments<K>& m) {
  if constexpr (K == 2) {
    const double angle = 0.5 * std::atan2(2 * m.second[0][1], m.second[0][0] - m.second[1][1]);
    const double c = std::cos(angle), s = std::sin(angle);
    axes_.axis = {{{c, s}, {-s, c}}};
  }
}

template <int D>
void DualBasis<D>::invert(const FaceFrame<D>& frame, const Moments<K>& m) {
  std::array<Point<K>, D> corner;
  for (int p = 0; p < D; ++p) corner[p] = axes_.of(frame.corner[p]);
  std::array<bool, K> wide;
  for (int k = 0; k < K; ++k) {
    double low = corner[0][k], high = low;
    for (const Point<K>& y : corner) low = std::min(low, y[k]), high = std::max(high, y[k]);
    wide[k] = m.second[k][k] > thin * thin * (high - low) * (high - low) * m.measure;
    lumped_ = lumped_ || !wide[k];
  }
  for (int p = 0; p < D; ++p) {
    const Point<K> y = difference<K>(corner[p], off_);
    if constexpr (K == 2) {
      if (wide[0] && wide[1]) {
        const double a = m.second[0][0], b = m.second[0][1], c = m.second[1][1];
        // 1 - b²/(ac) is near one: the axes are the principal ones.
        const double s = 1 / (1 - (b / a) * (b / c));
        slope_[p] = {s * (y[0] - b / c * y[1]) / a, s * (y[1] - b / a * y[0]) / c};
        continue;
      }
    }
    for (int k = 0; k < K; ++k) slope_[p][k] = wide[k] ? y[k] / m.second[k][k] : 0;
  }
}

template class DualBasis<2>;
template class DualBasis<3>;

}  // namespace signorini::mortar
