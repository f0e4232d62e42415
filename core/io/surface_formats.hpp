#pragma once
#include <fmt/format.h>

#include "core/io/surface_reader.hpp"
#include "core/io/text_lines.hpp"

namespace signorini {

// The readers of parse_surface().
PolygonSoup read_off(std::string_view content, std::string_view place);
PolygonSoup read_obj(std::string_view content, std::string_view place);
PolygonSoup read_stl(std::string_view content, std::string_view place);
PolygonSoup read_ply(std::string_view content, std::string_view place);

/// Three coordinates from the next three words, of this line alone or of those below as well. `of()` tells what they
/// are of, for messages.
enum class Words { of_line, of_text };
template <class Of>
Point<3> read_coordinates(TextLines& lines, Words words, const Of& of) {
  Point<3> p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = lines.real(words == Words::of_line ? lines.word() : lines.next(),
                      [&] { return fmt::format("{} of {}, a finite number", "xyz"[k], of()); });
  return p;
}

/// Complains about a face of fewer than three vertices.
inline void check_corners(const TextLines& lines, std::size_t face, std::size_t corners) {
  if (corners < 3) lines.fail(fmt::format("face {} has {} vertices; expected at least 3", face, corners));
}

}  // namespace signorini
