#pragma once
#include <string>
#include <vector>

#include "core/component/registry.hpp"
#include "core/sdk/error_estimator.hpp"

namespace signorini {

/// Holds what a plugin registers until all of it succeeded.
class StagingRegistrar final : public Registrar {
 public:
  void obstacle(const ObstacleType& type, Status& status) noexcept override;
  void estimator(const EstimatorType& type, Status& status) noexcept override;

  /// Adds everything to the registry, or nothing and throws Error(Exit::plugin).
  void commit(Registry& registry, const std::string& file, const std::string& version, bool optimised = true) const;

 private:
  template <class Type>
  void add(const Type& type, std::vector<Type>& to, Status& status) noexcept;

  std::vector<ObstacleType> obstacles_;
  std::vector<EstimatorType> estimators_;
  Status first_failure_;  // also when the plugin looks away from the status it got
};

}  // namespace signorini
