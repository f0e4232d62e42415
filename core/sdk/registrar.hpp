#pragma once
#include <cstddef>

#include "core/sdk/obstacle.hpp"

namespace signorini {

/// An obstacle type as its plugin registers it. Id, help and the table of options have static storage duration.
struct ObstacleType {
  const char* id;    ///< what a scene writes as `type`
  const char* help;  ///< one line
  const OptionSpec* options;
  std::size_t option_count;
  bool takes_shape;  ///< the keys `shape`, `point`, `normal`... describe a rigid obstacle, see Settings::shape()
  /// The constructors for 1, 2 and 3 unknowns per vector, null where there is none. The result is owned by the
  /// caller; null and a status if it failed.
  Obstacle<1>* (*create1)(const Settings& settings, Status& status) noexcept;
  Obstacle<2>* (*create2)(const Settings& settings, Status& status) noexcept;
  Obstacle<3>* (*create3)(const Settings& settings, Status& status) noexcept;
  /// The keys `other`, `other_on`... name a second elastic body, and the obstacle acts between the two: assemble() is
  /// given SurfaceVertex::gap and away.
  bool takes_body = false;
};

struct EstimatorType;

/// Where a plugin registers what it provides. Nothing becomes visible before all of it succeeded.
class Registrar {
 public:
  virtual ~Registrar();
  virtual void obstacle(const ObstacleType& type, Status& status) noexcept = 0;
  virtual void estimator(const EstimatorType& type, Status& status) noexcept = 0;
};

}  // namespace signorini
