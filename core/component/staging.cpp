#include "core/component/staging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/component/settings.hpp"
#include "core/input/range.hpp"

namespace signorini {
namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw Error(Exit::plugin, message);
}

bool is_id(std::string_view id) {
  return !id.empty() && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

const std::set<std::string_view> reserved = {"type", "body", "on", "where", "shape"};

void check_range(const ObstacleType& type, const OptionSpec& spec) {
  try {
    (void)Range(spec.range);
  } catch (const std::invalid_argument& error) {
    require(false, fmt::format("obstacle '{}': the range '{}' of option '{}' {}", type.id, spec.range, spec.name,
                               error.what()));
  }
}

// Ranges and defaults: what is wrong with them would else show in the scene that meets it.
void check_options(const ObstacleType& type) {
  std::set<std::string_view> names;
  for (std::size_t k = 0; k < type.option_count; ++k) {
    const OptionSpec& spec = type.options[k];
    require(spec.name && spec.fallback && spec.range && spec.help,
            fmt::format("obstacle '{}': option {} has a null text", type.id, k));
    require(reserved.count(spec.name) == 0,
            fmt::format("obstacle '{}': the option '{}' has the name of a key of every obstacle", type.id, spec.name));
    require(names.insert(spec.name).second, fmt::format("obstacle '{}': option '{}' stands twice", type.id, spec.name));
    check_range(type, spec);
  }
  (void)compile_settings(fmt::format("obstacle '{}'", type.id), {type.options, type.option_count}, {});
}

void check(const ObstacleType& type, const std::vector<ObstacleType>& others) {
  require(type.id && is_id(type.id),
          fmt::format("'{}' is no obstacle id: lower-case letters, digits and '_' were expected",
                      type.id ? type.id : "(null)"));
  require(type.help, fmt::format("obstacle '{}': no help", type.id));
  require(type.options || type.option_count == 0, fmt::format("obstacle '{}': no table of options", type.id));
  require(type.create1 || type.create2 || type.create3, fmt::format("obstacle '{}': no constructor", type.id));
  for (const ObstacleType& other : others)
    require(std::string_view(other.id) != type.id, fmt::format("obstacle '{}' is registered twice", type.id));
  check_options(type);
}

void check(const EstimatorType& type, const std::vector<EstimatorType>& others) {
  require(type.id && is_id(type.id),
          fmt::format("'{}' is no estimator id: lower-case letters, digits and '_' were expected",
                      type.id ? type.id : "(null)"));
  require(type.help, fmt::format("estimator '{}': no help", type.id));
  require(type.create, fmt::format("estimator '{}': no constructor", type.id));
  require(type.element_size == sizeof(SampledElement),
          fmt::format("estimator '{}': SampledElement has {} bytes in the plugin, {} here: it has to be rebuilt",
                      type.id, type.element_size, sizeof(SampledElement)));
  for (const EstimatorType& other : others)
    require(std::string_view(other.id) != type.id, fmt::format("estimator '{}' is registered twice", type.id));
}

}  // namespace

template <class Type>
void StagingRegistrar::add(const Type& type, std::vector<Type>& to, Status& status) noexcept {
  try {
    check(type, to);
    to.push_back(type);
  } catch (const std::exception& error) {
    status.fail(static_cast<int>(Exit::plugin), error.what());
    if (first_failure_.ok()) first_failure_ = status;
  }
}

void StagingRegistrar::obstacle(const ObstacleType& type, Status& status) noexcept { add(type, obstacles_, status); }
void StagingRegistrar::estimator(const EstimatorType& type, Status& status) noexcept { add(type, estimators_, status); }

void StagingRegistrar::commit(Registry& registry, const std::string& file, const std::string& version,
                              bool optimised) const {
  require(first_failure_.ok(), first_failure_.message);
  require(!obstacles_.empty() || !estimators_.empty(), "it registers nothing");
  for (const ObstacleType& type : obstacles_) registry.require_free("obstacle", type.id, file);
  for (const EstimatorType& type : estimators_) registry.require_free("estimator", type.id, file);
  const Entry entry{
      .kind = {}, .id = {}, .help = {}, .options = {}, .file = file, .version = version, .optimised = optimised};
  for (const ObstacleType& type : obstacles_) registry.add_obstacle(type, entry);
  for (const EstimatorType& type : estimators_) registry.add_estimator(type, entry);
}

}  // namespace signorini
