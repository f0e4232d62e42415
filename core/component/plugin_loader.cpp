#include "core/component/plugin_loader.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "core/base/error.hpp"
#include "core/component/crash.hpp"
#include "core/component/elf.hpp"
#include "core/component/handshake.hpp"
#include "core/component/libraries.hpp"
#include "core/component/staging.hpp"
#include "core/component/trial.hpp"

namespace signorini {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "libsignorini_", suffix = ".so";
constexpr std::string_view kinds[] = {"obstacle", "estimator"};  // of plugins

[[noreturn]] void reject(const fs::path& file, std::string_view reason) {
  throw Error(Exit::plugin, fmt::format("{}: {}", file.string(), reason));
}

/// What the name of a library says that it provides; "" for any other file.
struct Provided {
  std::string kind, id;
  auto operator<=>(const Provided&) const = default;
};

Provided provided_by(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.ends_with(suffix)) return {};
  for (const std::string_view kind : kinds)
    if (const std::string start = fmt::format("{}{}_", prefix, kind);
        name.starts_with(start) && name.size() > start.size() + suffix.size())
      return {std::string(kind), name.substr(start.size(), name.size() - start.size() - suffix.size())};
  return {};
}

std::vector<fs::path> folders_of_environment() {
  std::vector<fs::path> folders;
  const char* list = std::getenv("SIGNORINI_PLUGIN_PATH");
  for (std::string_view rest = list ? list : ""; !rest.empty();) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    const fs::path folder(rest.substr(0, colon));
    rest.remove_prefix(std::min(colon + 1, rest.size()));
    if (folder.empty()) continue;  // elsewhere an empty entry means the current folder; here it means nothing
    if (folder.is_relative())
      throw Error(Exit::plugin, fmt::format("SIGNORINI_PLUGIN_PATH: '{}' is no absolute path; the current folder is "
                                            "never searched",
                                            folder.string()));
    folders.push_back(folder);
  }
  return folders;
}

// An exception that passes through dlopen leaves it broken: one that leaves a static constructor ends the program. It
// is called through a pointer, for dlopen is declared not to throw and a compiler then may leave out what noexcept
// promises.
void* dlopen_or_die(const char* file) noexcept {
  void* (*volatile function)(const char*, int) = &dlopen;
  return function(file, RTLD_NOW | RTLD_LOCAL);
}

void* open(const fs::path& file) {
  if (void* library = dlopen_or_die(file.c_str())) return library;
  const char* reason = dlerror();
  std::string text = reason ? reason : "it cannot be loaded";
  if (text.starts_with(file.string() + ": ")) text.erase(0, file.string().size() + 2);
  // The name of a library has the version that the plugin was linked with: of the SDK its major one.
  if (text.starts_with("libsignorini_"))
    text = fmt::format("it is linked with another version of signorini ({}): rebuild against SDK {}.{}", text,
                       sdk::abi_major, sdk::abi_minor);
  reject(file, text);
}

const sdk::Plugin& handshake(void* library, const fs::path& file) {
  const auto* plugin = static_cast<const sdk::Plugin*>(dlsym(library, "signorini_plugin"));
  if (!plugin) reject(file, "it exports no symbol 'signorini_plugin', so it is no signorini plugin");
  if (const std::string reason = incompatibilities(*plugin); !reason.empty()) reject(file, reason);
  return *plugin;
}

void add_all_of(const fs::path& file, Registry& registry) {
  const sdk::Plugin& plugin = handshake(open(file), file);
  remember_plugin(file, &plugin);
  StagingRegistrar staging;
  Status status;
  plugin.register_all(staging, status);
  if (!status.ok()) reject(file, fmt::format("its registration failed: {}", status.message));
  try {
    staging.commit(registry, file.string(), plugin.version, is_optimised(plugin));
    remember_library(file, licence_of(plugin));
  } catch (const Error& error) {
    reject(file, fmt::format("its registration failed: {}", error.what()));
  }
}

// What anybody may change is nobody's code. A folder like /tmp, whose files others may not replace, still takes new
// ones from everybody; one below it that is the user's own is safe.
void reject_writable_by_all(const fs::path& file) {
  const auto open_to_all = [](const fs::path& path) {
    struct stat found {};
    return stat(path.c_str(), &found) == 0 && (found.st_mode & S_IWOTH) != 0;
  };
  const fs::path folder = file.parent_path();
  if (open_to_all(folder))
    reject(file, fmt::format("everybody may put files into its folder {0}, so it is not loaded; expected a folder that "
                             "others may not write into (chmod o-w {0})",
                             folder.string()));
  if (open_to_all(file))
    reject(file, "everybody may change it, so it is not loaded; expected a file that others may not write (chmod o-w)");
}

// Static constructors and damaged files can end the program in ways that nothing in it can hold.
void reject_fatal(const fs::path& file) {
  const std::string end = fatal_end([&] {
    Registry registry;
    add_all_of(file, registry);
  });
  if (!end.empty())
    reject(file, fmt::format("loading it leads to {}: the file is damaged, or its static constructors or its "
                             "registration have a fault; build or copy it again",
                             end));
}

}  // namespace

PluginLoader::PluginLoader(Registry& registry, std::vector<fs::path> scene_folders)
    : registry_(registry), folders_(std::move(scene_folders)) {
  for (fs::path& folder : folders_) folder = fs::absolute(folder);
  for (const fs::path& folder : folders_of_environment()) folders_.push_back(folder);
  folders_.push_back(fs::path(file_of(reinterpret_cast<const void*>(&file_of))).parent_path() / "signorini" /
                     "plugins");
}

void PluginLoader::load(const fs::path& name) {
  const fs::path file = fs::absolute(name);  // a bare name would send dlopen through its own search path
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) reject(file, "there is no such file");
  reject_writable_by_all(file);
  if (const std::string missing = missing_of_elf(file); !missing.empty()) reject(file, missing);
  reject_fatal(file);
  add_all_of(file, registry_);
}

void PluginLoader::require(const std::string& id, const std::string& kind) {
  if (registry_.has(kind, id)) return;
  for (const fs::path& file : found()) {
    if (provided_by(file) != Provided{kind, id}) continue;
    load(file);
    if (registry_.has(kind, id)) return;
    reject(file, fmt::format("it provides no {} '{}'", kind, id));
  }
  not_found(id, kind);
}

std::vector<PluginLoader::Rejected> PluginLoader::load_all() {
  std::set<std::string> loaded;
  for (const std::string_view kind : kinds)
    for (const Entry& entry : registry_.entries(kind)) loaded.insert(entry.file);
  std::vector<Rejected> rejected;
  for (const fs::path& file : found()) {
    try {
      if (loaded.count(file.string()) == 0) load(file);
    } catch (const Error& error) {
      if (error.status() == Exit::interrupted) throw;
      rejected.push_back({file.string(), std::string(error.what()).substr(file.string().size() + 2)});
    }
  }
  return rejected;
}

// The libraries in all folders, those of one name only where they come first; within a folder by name.
std::vector<fs::path> PluginLoader::found() const {
  std::vector<fs::path> files;
  std::set<Provided> seen;
  for (const fs::path& folder : folders_) {
    std::vector<fs::path> here;
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored))
      if (!provided_by(entry->path()).id.empty()) here.push_back(entry->path());
    std::sort(here.begin(), here.end());
    for (const fs::path& file : here)
      if (seen.insert(provided_by(file)).second) files.push_back(file);
  }
  return files;
}

void PluginLoader::not_found(const std::string& id, const std::string& kind) const {
  std::vector<std::string> ids, places;
  for (const Entry& entry : registry_.entries(kind)) ids.push_back(entry.id);
  for (const fs::path& file : found())
    if (const Provided provided = provided_by(file); provided.kind == kind) ids.push_back(provided.id);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::error_code ignored;
  for (const fs::path& folder : folders_)
    places.push_back(folder.string() + (fs::is_directory(folder, ignored) ? "" : " (no such folder)"));
  throw Error(Exit::plugin,
              fmt::format("there is no {} plugin '{}'{} (available: {}); looked for {}{}_{}{} in {}", kind, id,
                          did_you_mean(id, ids), ids.empty() ? "none" : fmt::format("{}", fmt::join(ids, ", ")), prefix,
                          kind, id, suffix, fmt::join(places, ", ")));
}

Catalogue catalogue(Registry& registry, PluginLoader& loader, std::string_view kind) {
  Catalogue result;
  result.rejected = loader.load_all();
  result.entries = registry.entries(kind);
  return result;
}

}  // namespace signorini
