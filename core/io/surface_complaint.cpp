#include "core/io/surface_complaint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "core/io/read_file.hpp"

namespace signorini {
namespace {

/// The words of a text with their lines; what follows # is none.
class Words {
 public:
  explicit Words(const std::string& text) : text_(text) {}

  /// Empty at the end.
  std::string next() {
    std::string word;
    while (!(line_ >> word)) {
      std::string line;
      if (!std::getline(text_, line)) return {};
      ++number_;
      line_ = std::istringstream(line.substr(0, line.find('#')));
    }
    return word;
  }

  template <class T>
  T number(const std::string& expected) {
    const std::string word = next();
    T value{};
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = status == std::errc{} && end == word.data() + word.size();
    if (word.empty()) fail(fmt::format("the file ends where {} is expected; is it truncated?", expected));
    if (!whole || !std::isfinite(static_cast<double>(value)))
      fail(fmt::format("found '{}', expected {}", word.substr(0, 40), expected));
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const { input_error(fmt::format("line {}", number_), what); }

 private:
  std::istringstream text_, line_;
  Offset number_ = 0;
};

void check_off(const std::string& text) {
  Words words(text);
  words.next();  // OFF
  const auto vertices = words.number<std::uint64_t>("the number of vertices");
  const auto faces = words.number<std::uint64_t>("the number of faces");
  words.number<std::uint64_t>("the number of edges");
  if (vertices == 0) words.fail("found no vertices, expected a surface");
  for (std::uint64_t v = 0; v < vertices; ++v)
    for (const char axis : {'x', 'y', 'z'})
      words.number<double>(fmt::format("{} of vertex {} of {}, a finite number", axis, v, vertices));
  for (std::uint64_t f = 0; f < faces; ++f) {
    const auto corners = words.number<std::uint64_t>(fmt::format("the number of vertices of face {} of {}", f, faces));
    for (std::uint64_t k = 0; k < corners; ++k) {
      const std::string expected = fmt::format("a vertex of face {} of {}, from 0 to {}", f, faces, vertices - 1);
      if (const auto v = words.number<std::int64_t>(expected); v < 0 || static_cast<std::uint64_t>(v) >= vertices)
        words.fail(fmt::format("found '{}', expected {}", v, expected));
    }
  }
}

void check_stl(const std::string& bytes) {
  constexpr std::size_t head = 80, triangle = 50;
  if (bytes.starts_with("solid") && bytes.find("facet") != std::string::npos) {
    if (bytes.find("endsolid") == std::string::npos)
      throw Error(Exit::input, "the file ends without 'endsolid'; is it truncated?");
    return;
  }
  std::uint32_t count = 0;
  if (bytes.size() >= head + sizeof count) std::memcpy(&count, bytes.data() + head, sizeof count);
  if (const std::size_t needed = head + sizeof count + triangle * std::size_t{count}; bytes.size() < needed)
    throw Error(Exit::input, fmt::format("the file has {} bytes, its {} triangles take {}; is it truncated?",
                                         bytes.size(), count, needed));
}

}  // namespace

std::string surface_complaint(const std::filesystem::path& file) {
  try {
    const std::string content = read_file(file, "surface file");
    if (file.extension() == ".off" && content.starts_with("OFF")) check_off(content);
    if (file.extension() == ".stl") check_stl(content);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace signorini
