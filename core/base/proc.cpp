#include "core/base/proc.hpp"

#include <fstream>
#include <limits>
#include <string>

namespace signorini {

std::optional<double> proc_bytes(const char* file, std::string_view key) {
  std::ifstream lines(file);
  for (std::string name; lines >> name; lines.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (double kilobytes; name.size() == key.size() + 1 && name.starts_with(key) && lines >> kilobytes)
      return 1024 * kilobytes;
  return std::nullopt;
}

}  // namespace signorini
