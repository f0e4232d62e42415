#pragma once

namespace signorini {

/// Of an obstacle between two bodies that holds them together, whatever acts there: the jump of their displacements is
/// prescribed to be zero, in all directions. It bounds no direction, and so has none. It is an extension: an obstacle
/// that has it derives from it beside Obstacle<B>, and is asked for it by dynamic_cast.
class Tying {
 public:
  virtual ~Tying();

  /// How far apart, or into each other, the bodies may be at the start and are tied all the same, as they are; the
  /// user's unit of length. 0: as far as meshes of one surface are.
  virtual double adjust() const noexcept = 0;
};

}  // namespace signorini
