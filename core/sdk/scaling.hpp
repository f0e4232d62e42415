#pragma once

namespace signorini {

/// Of a functional: what it is on coarser levels of a matrix, where a vector stands for several of the finer one.
class Scaling {
 public:
  virtual ~Scaling();

  /// Makes the numbers of one slot those of phi at a vertex that stands for `ratio` times as much of the surface.
  virtual void scale(double ratio, double* data) const noexcept = 0;
};

}  // namespace signorini
