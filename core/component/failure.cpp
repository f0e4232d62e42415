#include "core/component/failure.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace signorini {

void throw_failure(const Status& status, std::string_view origin) {
  const auto code = static_cast<Exit>(status.code);
  const bool known = code == Exit::no_solution || code == Exit::plugin;
  throw Error(known ? code : Exit::input, fmt::format("{}: {}", origin, status.message));
}

}  // namespace signorini
