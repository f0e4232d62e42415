#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "apps/signorini/commands.hpp"
#include "apps/signorini/text.hpp"
#include "core/base/error.hpp"

namespace signorini {
namespace {

namespace fs = std::filesystem;

// What stands in the templates for the name and what is made of it.
constexpr std::string_view name_there = "my_obstacle", class_there = "MyObstacle", prefix_there = "@PREFIX@";

/// Where the program and all that belongs to it is installed.
fs::path own_prefix() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path();
}

fs::path templates() {
  std::error_code ignored;
  const fs::path bin = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  return (bin / SIGNORINI_TEMPLATES).lexically_normal();
}

bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

void check_name(const std::string& name) {
  const bool right = !name.empty() && is_letter(name[0]) && std::ranges::all_of(name, [](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
  });
  if (!right)
    throw Error(Exit::usage,
                fmt::format("found the name '{}', expected lower-case letters, digits and '_', a letter first", name));
}

/// "moving_wall" as "MovingWall".
std::string class_name(const std::string& name) {
  std::string out;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') out += begins && is_letter(c) ? static_cast<char>(c - 'a' + 'A') : c;
    begins = c == '_';
  }
  return out;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

std::string of_template(std::string text, const std::string& name) {
  text = replaced(std::move(text), name_there, name);
  text = replaced(std::move(text), class_there, class_name(name));
  return replaced(std::move(text), prefix_there, own_prefix().string());
}

void write_new(const fs::path& from, const fs::path& to, const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(from, std::ios::binary).rdbuf();
  std::ofstream out(to, std::ios::binary);
  out << of_template(text.str(), name);
  if (!out.flush()) throw Error(Exit::input, fmt::format("{}: cannot be written", to.string()));
}

}  // namespace

const std::vector<std::string>& plugin_kinds() {
  static const std::vector<std::string> kinds{"box", "functional", "friction", "between-bodies"};
  return kinds;
}

void plugin_new_command(const PluginNewArguments& arguments) {
  check_name(arguments.name);
  const fs::path folder = arguments.folder.empty() ? fs::path(arguments.name) : arguments.folder, from = templates();
  std::error_code failed;
  if (!fs::is_directory(from / arguments.kind, failed))
    throw Error(Exit::input, fmt::format("{}: the templates are not there; expected them beside the program that is "
                                         "installed",
                                         from.string()));
  if (fs::exists(folder, failed) && !fs::is_empty(folder, failed))
    throw Error(Exit::input, fmt::format("{}: is there already, and not empty; nothing was written", folder.string()));
  fs::create_directories(folder, failed);
  if (failed) throw Error(Exit::input, fmt::format("{}: cannot be made: {}", folder.string(), failed.message()));
  std::vector<std::string> written;
  for (const fs::path& source : {from / "common", from / arguments.kind})
    for (const fs::directory_entry& entry : fs::directory_iterator(source)) {
      written.push_back(replaced(entry.path().filename().string(), name_there, arguments.name));
      write_new(entry.path(), folder / written.back(), arguments.name);
    }
  std::ranges::sort(written);
  say("{} has\n", folder.string());
  for (const std::string& file : written) say("  {}\n", file);
  say("build and check it:\n");
  fmt::print("  cd {}\n  cmake -S . -B build -DCMAKE_PREFIX_PATH={}\n  ctest --test-dir build --output-on-failure\n",
             folder.string(), own_prefix().string());
}

}  // namespace signorini
