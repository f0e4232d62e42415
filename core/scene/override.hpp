#pragma once
#include <string>

#include "core/input/raw.hpp"

namespace signorini {

/// Changes one value of a scene, as `--set` does: "obstacle.0.lower=-1", "fix.0.value.2=-0.05", "title=Two". The value
/// is TOML, or else a bare text. A table or key that the file does not have is added. An unknown path or an index out
/// of range is an Error(Exit::input) that names the nearest valid one.
void apply_override(RawDocument& document, const std::string& assignment);

}  // namespace signorini
