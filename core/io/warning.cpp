#include "core/io/warning.hpp"

#include <iterator>

#include "core/io/warning_kinds.hpp"

namespace signorini {
namespace {

/// A text with … for what is put in, and without the place that it begins with.
std::string pattern(std::string_view text) {
  std::string out;
  if (text.starts_with("{}: ")) text.remove_prefix(4);
  for (bool inside = false; const char c : text) {
    if (c == '{' && out.ends_with("… ")) out.pop_back();
    if (c == '{' && !out.ends_with("…")) out += "…";
    inside = c == '{' || (inside && c != '}');
    if (!inside && c != '}') out += c;
  }
  return out;
}

}  // namespace

std::string warnings_page() {
  std::string out;
  const std::pair<WarningKind::About, const char*> chapters[] = {{WarningKind::About::scene, "the scene"},
                                                                 {WarningKind::About::mesh, "the mesh"},
                                                                 {WarningKind::About::result, "the result"}};
  for (const auto& [about, heading] : chapters) {
    out += fmt::format("## About {}\n\n| id | message | means | do |\n| --- | --- | --- | --- |\n", heading);
    for (const WarningKind& kind : warning_kinds)
      if (kind.about == about)
        fmt::format_to(std::back_inserter(out), "| `{}` | {} | {} | {} |\n", kind.id, pattern(kind.text), kind.means,
                       kind.advice);
    out += '\n';
  }
  return out;
}

}  // namespace signorini
