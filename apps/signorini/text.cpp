#include "apps/signorini/text.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace signorini {
namespace {

constexpr int usual_width = 80, narrowest = 40;

/// In columns: bytes that continue a character have none.
std::size_t columns(std::string_view text) {
  return std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; });
}

/// Where the following lines begin.
std::size_t hanging(std::string_view line) {
  const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
  if (const std::size_t gap = line.find("  ", start); gap != std::string_view::npos)
    return columns(line.substr(0, std::min(line.find_first_not_of(' ', gap), line.size())));
  const std::size_t word = line.find(' ', start);
  const bool label = word != std::string_view::npos && line[word - 1] == ':';
  return label ? columns(line.substr(0, word + 1)) : start;
}

/// The end of the piece of a line that fits: a space, or the end. What has no space is longer.
std::size_t end_of_piece(std::string_view line, std::size_t from, std::size_t width) {
  std::size_t end = std::string_view::npos;
  for (std::size_t space = line.find(' ', from);; space = line.find(' ', space + 1)) {
    const std::size_t here = std::min(space, line.size());
    const bool fits = columns(line.substr(0, here)) <= width;
    if (fits || end == std::string_view::npos) end = here;
    if (!fits || here == line.size()) return end;
  }
}

void add_line(std::string_view line, std::size_t width, std::string& out) {
  const std::size_t below = std::min(hanging(line), width / 2);
  std::size_t from = std::min(line.find_first_not_of(' '), line.size());
  std::string piece(line);
  while (columns(piece) > width) {
    const std::size_t end = end_of_piece(piece, std::max(from, std::min(below, piece.size())), width);
    if (end == piece.size()) break;
    out += piece.substr(0, piece.find_last_not_of(' ', end) + 1) + '\n';
    piece = std::string(below, ' ') + piece.substr(std::min(piece.find_first_not_of(' ', end), piece.size()));
    from = below;
  }
  out += piece;
}

}  // namespace

int terminal_width(int descriptor) {
  winsize size{};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

int text_width() {
  const char* const given = std::getenv("COLUMNS");
  int width = given ? std::atoi(given) : 0;
  if (width <= 0) width = terminal_width(STDOUT_FILENO);
  return width <= 0 ? usual_width : std::max(width, narrowest);
}

std::string fitted(std::string_view text, int width) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    add_line(text.substr(0, end), static_cast<std::size_t>(width), out);
    if (end == std::string_view::npos) break;
    out += '\n';
    text.remove_prefix(end + 1);
  }
  return out;
}

void print_fitted(std::string_view text) { fmt::print("{}", fitted(text, text_width())); }

}  // namespace signorini
