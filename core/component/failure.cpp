#include "core/component/failure.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/base/error.hpp"

namespace signorini {
namespace {

// What fields and settings complain about names the file and the line of its own key already, or the command line.
bool names_place(std::string_view message, std::string_view origin) {
  const std::string_view line = origin.substr(0, origin.find(": "));
  const std::size_t colon = line.rfind(':');
  return message.starts_with("--set ") ||
         (colon != std::string_view::npos && message.starts_with(line.substr(0, colon + 1)));
}

}  // namespace

bool is_fault_of_plugin(const Status& status) {
  return status.code == 0 || status.code == static_cast<int>(Exit::plugin);
}

void throw_failure(const Status& status, std::string_view origin) {
  const Exit code = is_fault_of_plugin(status) ? Exit::plugin : static_cast<Exit>(status.code);
  const bool known = code == Exit::no_solution || code == Exit::plugin;
  throw Error(known ? code : Exit::input,
              names_place(status.message, origin) ? status.message : fmt::format("{}: {}", origin, status.message));
}

}  // namespace signorini
