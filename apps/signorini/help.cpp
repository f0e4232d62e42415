#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "amg/registration.hpp"
#include "apps/signorini/command_line.hpp"
#include "apps/signorini/option_text.hpp"
#include "apps/signorini/text.hpp"
#include "core/base/error.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/scene/key_page.hpp"

namespace signorini {
namespace {

/// The first words of what may be called.
std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> shown_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// An option of a plugin, as a key of [[obstacle]].
struct PluginKey {
  std::string plugin;
  OptionSpec option;

  std::string path() const { return fmt::format("obstacle.{}.{}", plugin, option.name); }
};

std::vector<Entry> obstacle_types() {
  Registry registry = solver_components();
  PluginLoader loader(registry);
  return catalogue(registry, loader, "obstacle").entries;
}

std::vector<PluginKey> plugin_keys(const std::vector<Entry>& types) {
  std::vector<PluginKey> all;
  for (const Entry& entry : types)
    for (const OptionSpec& option : entry.options) all.push_back({entry.id, option});
  return all;
}

/// As --set and messages count tables and entries, and pages do not: obstacle.0.friction.
std::string without_numbers(const std::string& name) {
  std::string out;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('.', begin), name.size());
    const std::string part = name.substr(begin, end - begin);
    const bool number = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (!number || begin == 0) out += (out.empty() ? "" : ".") + part;
    begin = end + 1;
  }
  return out;
}

std::vector<PluginKey> plugin_keys_named(const std::vector<PluginKey>& all, const std::string& name) {
  std::vector<PluginKey> found;
  for (const PluginKey& key : all)
    if (name == key.option.name || name == key.path() || name == std::string("obstacle.") + key.option.name)
      found.push_back(key);
  return found;
}

/// Another value than the default, where that says nothing.
std::string sample(const OptionSpec& option) {
  const std::string_view fallback = option.fallback;
  if (option.type == OptionType::text) return fmt::format("\"{}\"", fallback);
  if (std::string_view(option.name) == "gap") return "-0.01   # the bodies overlap by that much: an interference fit";
  if (!fallback.empty() && fallback != "0") return std::string(fallback);
  return option.type == OptionType::vector ? "[0, 0, 1]" : "0.3";
}

std::string page(const PluginKey& key) {
  const OptionSpec& option = key.option;
  const std::string example = table_example(
      *find_table("obstacle"), fmt::format("type = \"{}\"\n{} = {}", key.plugin, option.name, sample(option)));
  return fmt::format("{}: a key of [[obstacle]] where type = \"{}\"\n\n  {}\n\n  {}\n\nExample:\n{}", key.path(),
                     key.plugin, option.help, option_kind(option), indented(example));
}

/// Of a type of obstacles, with its own keys.
std::string page(const Entry& type) {
  std::string text = fmt::format("{}: a type of [[obstacle]]\n\n  {}\n", type.id, type.help), lines;
  for (const OptionSpec& option : type.options) {
    text += fmt::format("\n  {:<14}  {} ({})", option.name, option.help, option_kind(option));
    if (!*option.fallback) lines += fmt::format("\n{} = {}", option.name, sample(option));
  }
  const std::string example = table_example(*find_table("obstacle"), fmt::format("type = \"{}\"{}", type.id, lines));
  return fmt::format("{}\n\nExample, beside the keys of every obstacle ('signorini help obstacle'):\n{}", text,
                     indented(example));
}

/// The page of the first key that is meant, and where else a key of the name is.
std::string pages(const std::string& name, const std::vector<PluginKey>& of_plugins) {
  const std::vector<KeyPlace> keys = keys_named(name);
  const std::vector<PluginKey> more = plugin_keys_named(of_plugins, name);
  if (keys.empty() && more.empty()) return {};
  std::string text = keys.empty() ? page(more.front()) : key_page(keys.front());
  std::string others;
  for (const KeyPlace& place : keys)
    if (&place != &keys.front()) others += fmt::format("  {:<32}  {}\n", place.path(), place.key->help);
  for (const PluginKey& key : more)
    if (!keys.empty() || &key != &more.front()) others += fmt::format("  {:<32}  {}\n", key.path(), key.option.help);
  return others.empty() ? text : text + "\nKeys of the same name:\n" + others;
}

[[noreturn]] void refuse(const CLI::App& program, const std::string& name, const std::vector<Entry>& types,
                         const std::vector<PluginKey>& of_plugins) {
  std::vector<std::string> known;
  for (const Entry& type : types) known.push_back(type.id);
  for (const std::string& command : command_names(program)) known.push_back(command);
  for (const TableSpec& table : table_specs()) known.emplace_back(table.name);
  for (const KeyPlace& place : key_places()) known.emplace_back(place.key->name), known.push_back(place.path());
  for (const PluginKey& key : of_plugins) known.emplace_back(key.option.name), known.push_back(key.path());
  throw Error(Exit::usage, fmt::format("there is no command, table or key '{}'{}; see 'signorini help', and "
                                       "docs/scene.md for the keys of scenes",
                                       name, did_you_mean(name, known)));
}

void print(const std::vector<std::string>& words) {
  for (const std::string& word : words) fmt::print("{}\n", word);
}

}  // namespace

void help_command(const CLI::App& program, const HelpArguments& arguments) {
  const std::string name = without_numbers(arguments.name);
  if (arguments.manual) return fmt::print("{}", manual_page(program));
  if (name.empty()) return print_fitted(help_of(program));
  if (const CLI::App* command = find_command(program, name)) return print_fitted(help_of(*command));
  if (const TableSpec* table = find_table(name)) return print_fitted(table_page(*table));
  const std::vector<Entry> types = obstacle_types();
  const std::vector<PluginKey> of_plugins = plugin_keys(types);
  if (const auto type = std::ranges::find(types, name, &Entry::id); type != types.end())
    return print_fitted(page(*type));
  const std::string text = pages(name, of_plugins);
  if (text.empty()) refuse(program, name, types, of_plugins);
  print_fitted(text);
}

void words_command(const CLI::App& program, const std::string& after) {
  const auto keys = [](bool to_set) {
    std::vector<std::string> all;
    for (const KeyPlace& place : key_places()) {
      const bool listed = place.table && place.table->listed;
      all.push_back(!to_set        ? place.path()
                    : !place.table ? fmt::format("{}=", place.key->name)
                                   : fmt::format("{}{}.{}=", place.table->name, listed ? ".0" : "", place.key->name));
    }
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  };
  if (after == "set") return print(keys(true));
  if (after.empty() || after == "help") print(command_names(program));
  if (after == "help") {
    for (const TableSpec& table : table_specs()) fmt::print("{}\n", table.name);
    print(keys(false));
  }
  if (after == "list") print(listable_kinds());
  if (after == "plugin new --kind") print(plugin_kinds());
  const CLI::App* command = after.empty() ? &program : find_command(program, after);
  if (command && command != &program) print(command_names(*command));
  if (command) print(shown_options(*command));
}

}  // namespace signorini
