#include <cstdint>

#include "core/base/error.hpp"
#include "core/io/vtu_reader.hpp"

/// Any bytes are a mesh or an Error, nothing else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    signorini::read_vtu({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const signorini::Error&) {  // the answer to bad input
  }
  return 0;
}
