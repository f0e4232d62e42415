#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/input/raw.hpp"
#include "core/sdk/settings.hpp"

namespace signorini {

/// Validates the values a user gave to a component's options and fills in defaults. An unknown key, a value of another
/// type and one out of range are Error(Exit::input) that name the place, the component and what was expected.
/// @param component for messages: "obstacle 'contact'"
/// @param other_keys valid in the same table although not the component's own; for suggestions
/// @param shape what Settings::shape() returns, may be null
/// @param t the step parameter at which fields are evaluated
std::shared_ptr<const Settings> compile_settings(const std::string& component, std::span<const OptionSpec> specs,
                                                 const RawTable& given, std::span<const std::string> other_keys = {},
                                                 std::shared_ptr<const DistanceFunction> shape = nullptr, double t = 1);

/// Options given as texts "KEY=VALUE", a vector as "[a, b, c]": what compile_settings() takes. Error(Exit::input) for a
/// text without an equals sign.
RawTable table_of(const std::string& component, std::span<const OptionSpec> specs,
                  std::span<const std::string> assignments);

/// Throws Error(Exit::plugin) where a component asked these settings for an option that its table does not have, or for
/// one as of another type, naming it.
/// @param origin of the component, for the message
void check_asked(const Settings& settings, std::string_view origin = {});

}  // namespace signorini
