#pragma once
#include <array>
#include <memory>
#include <string>

#include "core/sdk/obstacle.hpp"

namespace signorini {

/// What one obstacle demands at one vector along one unit direction: lower <= direction . v <= upper.
template <int B>
struct Bound {
  Index vertex;    ///< the vector, of finite elements a node
  Index obstacle;  ///< its number among ObstaclePlaces
  std::array<double, B> direction;
  double lower, upper;
  Index data = -1;  ///< place of its FunctionalNumbers, where the obstacle has a functional here
  double gap =
      0;  ///< between bodies: what both bounds contain of PairedNode::gap; of rigid ones: of ObstacleTerm::moved
  double part = 1;  ///< of what the obstacle says, see PairedNode::part
};

/// What an obstacle with a functional says at a vector beside its bound.
template <int B>
struct FunctionalNumbers {
  std::array<double, most_data> data;  ///< LocalConstraint::data
  std::array<double, B> motion;        ///< of the obstacle since the last load step
};

/// The obstacles of a problem, and what bounds, frames and messages need to know of where they act: a model on a mesh,
/// or blocks of a matrix.
template <int B>
class ObstaclePlaces {
 public:
  virtual ~ObstaclePlaces() = default;

  virtual Index count() const = 0;
  virtual const std::shared_ptr<const Obstacle<B>>& obstacle(Index k) const = 0;
  /// For messages: "scene.toml:12: obstacle.0".
  virtual std::string origin(Index k) const = 0;
  /// The same where what failed is told with no place.
  virtual std::string origin_at(Index k, Index vector) const = 0;
  /// For messages: "(0.5, 1)".
  virtual std::string place(Index vector) const = 0;
  /// The largest coordinate of a vector's place, where bounds are computed from these; rounding is measured by it.
  virtual double size() const = 0;

  /// How far an obstacle has moved since the last load step at a vertex.
  virtual std::array<double, B> motion(Index, const SurfaceVertex&, Status&) const { return {}; }
  /// Whether nothing can slide there along directions that are oblique to what is prescribed.
  virtual bool on_axis(Index) const { return false; }
  /// After an obstacle was asked: refuses what it wrongly asked for itself.
  virtual void check_asked(Index) const {}
};

}  // namespace signorini
