// Surface files: the first byte tells the format.
#include <string_view>

#include "core/base/error.hpp"
#include "core/io/surface_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size == 0) return 0;
  constexpr std::string_view formats[] = {"off", "obj", "stl", "ply"};
  const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    const auto soup = signorini::parse_surface(content, formats[data[0] % 4], "fuzz");
    for (const auto& face : soup.faces)
      for (const std::size_t v : face)
        if (v >= soup.points.size()) __builtin_trap();
  } catch (const signorini::Error&) {
  }
  return 0;
}
