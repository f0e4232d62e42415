#pragma once
#include <string>

#include "core/scene/specs.hpp"
#include "core/sdk/settings.hpp"

namespace signorini {

/// In a word or two, as the other one for keys: "number or expression".
const char* type_name(OptionType type);

/// "number in (0, 1), default 1e-8": of an option of a component, or of a key of a scene.
template <class Spec>
std::string option_kind(const Spec& option) {
  std::string text = type_name(option.type);
  if (*option.range) text += std::string(" in ") + option.range;
  if (option.fallback && *option.fallback) text += std::string(", default ") + option.fallback;
  return text;
}

}  // namespace signorini
