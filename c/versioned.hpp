#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

#include "core/base/error.hpp"

namespace signorini {

/// A struct as this version has it, of a program that may know fewer members, which it leaves at zero, or more, which
/// it may not use then.
/// @param first_version size of the first version of the struct
/// @param name of the variable, and of the macro that begins it
template <class Struct>
Struct versioned(const Struct* given, std::size_t first_version, const char* name, const char* type,
                 const char* macro) {
  constexpr std::size_t nonsense = 4096;
  const std::size_t size = given->size;
  if (size < first_version || size > nonsense)
    input_error(fmt::format("{}.size", name),
                fmt::format("found {}, expected sizeof({}), as {} sets it", size, type, macro));
  Struct out{};
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  if (std::any_of(bytes + std::min(size, sizeof out), bytes + size, [](unsigned char byte) { return byte != 0; }))
    input_error(name, "uses members that this library, which is older than its header, does not know");
  std::memcpy(&out, bytes, std::min(size, sizeof out));
  return out;
}

}  // namespace signorini
