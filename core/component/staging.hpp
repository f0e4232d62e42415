#pragma once
#include <string>
#include <vector>

#include "core/component/registry.hpp"

namespace signorini {

/// Holds what a plugin registers until all of it succeeded.
class StagingRegistrar final : public Registrar {
 public:
  void obstacle(const ObstacleType& type, Status& status) noexcept override;

  /// Adds everything to the registry, or nothing and throws Error(Exit::plugin).
  void commit(Registry& registry, const std::string& file, const std::string& version, bool optimised = true) const;

 private:
  std::vector<ObstacleType> obstacles_;
  Status first_failure_;  // also when the plugin looks away from the status it got
};

}  // namespace signorini
