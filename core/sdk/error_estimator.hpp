#pragma once
#include <cstddef>

#include "core/base/types.hpp"
#include "core/sdk/status.hpp"

namespace signorini {

/// A place in an element, and the stress of the solution there: xx, yy, zz, xy, yz, xz of an elastic body (of one of
/// revolution xx is radial, yy axial, zz the hoop stress); of a scalar one its flux, a number per dimension.
struct StressSample {
  double x[3];
  double barycentric[4];  ///< of the element's corners
  double weight;          ///< of the rule, with the element's measure; of a body of revolution that of the whole ring
  double stress[6];
};

/// Where stresses of finite elements are best; and points that integrate squares of polynomials of the element's
/// degree.
enum class StressRule { best, exact };

/// An element with samples of its stress.
struct SampledElement {
  Index corner[4];  ///< numbers of vertices; in the plane three
  double at[4][3];  ///< where these are
  Index region;     ///< of its material: from one to another stresses may jump
  int count;        ///< of samples
  StressSample sample[14];
};

/// A finite element solution as an estimator of its error sees it. Bodies that touch each other have no vertex in
/// common.
class SampledStress {
 public:
  virtual ~SampledStress();

  virtual int dimension() const noexcept = 0;
  virtual int order() const noexcept = 0;       ///< of elements, 1 or 2
  virtual int components() const noexcept = 0;  ///< of a stress
  virtual Index vertices() const noexcept = 0;  ///< corners are less than that
  virtual Index elements() const noexcept = 0;
  virtual void read(Index element, StressRule rule, SampledElement& out, Status& status) const noexcept = 0;
  /// The energy of a stress per volume, 1/2 stress . C^-1 stress, where `element` has this sample; of a scalar body
  /// 1/2 |flux|^2 / diffusion.
  virtual double energy(Index element, const StressSample& where, const double* stress) const noexcept = 0;
};

/// Estimates the energy error of a solution, with no promise.
class ErrorEstimator {
 public:
  virtual ~ErrorEstimator();

  /// @param of_element what each element's share is, not negative: they add up to about J(u_h) - J(u)
  virtual void estimate(const SampledStress& stress, double* of_element, Status& status) const noexcept = 0;
};

/// An estimator as its plugin registers it. Id and help have static storage duration.
struct EstimatorType {
  const char* id;                                      ///< what a scene writes as `estimate`
  const char* help;                                    ///< one line
  ErrorEstimator* (*create)(Status& status) noexcept;  ///< owned by the caller
  std::size_t element_size = sizeof(SampledElement);   ///< as the plugin was compiled
};

}  // namespace signorini
