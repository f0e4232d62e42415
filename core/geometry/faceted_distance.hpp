#pragma once
#include "core/mesh/chords.hpp"
#include "core/sdk/settings.hpp"

namespace signorini::geometry {

/// The distance to a shape of flat faces, which may stand for a curved one.
class FacetedDistance : public DistanceFunction {
 public:
  ~FacetedDistance() override;
  /// How far the face nearest to a point [3] is from the curve that it may stand for, see sagitta(); NaN where it
  /// fails.
  virtual double sagitta_at(const double* point) const noexcept = 0;
  /// Of a smooth surface through its vertices, at the triangle nearest to a point [3].
  virtual SmoothedOver smoothed_at(const double* point) const noexcept = 0;
};

}  // namespace signorini::geometry
