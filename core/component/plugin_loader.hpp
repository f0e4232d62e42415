#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/component/registry.hpp"

namespace signorini {

/// Finds the shared libraries libsignorini_KIND_ID.so, where the kind is obstacle or estimator, and registers what they
/// provide. Searched in this order: the
/// scene's folders, SIGNORINI_PLUGIN_PATH (separated by colons), the folder signorini/plugins beside the core library;
/// never the current folder, never folders below. A library once loaded stays loaded until the program ends, so that
/// objects cannot outlive their code.
class PluginLoader {
 public:
  struct Rejected {
    std::string file;
    std::string reason;
  };

  /// @param scene_folders searched first, in this order
  explicit PluginLoader(Registry& registry, std::vector<std::filesystem::path> scene_folders = {});

  /// Loads the library of an obstacle, or of an estimator, unless it is registered already. Errors are
  /// Error(Exit::plugin): where it was looked for and the nearest id there is, or why the library found was rejected.
  void require(const std::string& id, const std::string& kind = "obstacle");

  /// Loads a library by its file name and registers all it provides, or nothing and throws Error(Exit::plugin).
  void load(const std::filesystem::path& file);

  /// Loads all that can be found; of libraries of the same name the first.
  std::vector<Rejected> load_all();

  const std::vector<std::filesystem::path>& folders() const { return folders_; }

 private:
  std::vector<std::filesystem::path> found() const;
  [[noreturn]] void not_found(const std::string& id, const std::string& kind) const;

  Registry& registry_;
  std::vector<std::filesystem::path> folders_;
};

/// All a program can use, as `signorini list` shows it.
struct Catalogue {
  std::vector<Entry> entries;
  std::vector<PluginLoader::Rejected> rejected;
};

/// Loads every plugin that can be found.
/// @param kind lists entries of this kind only; empty for all
Catalogue catalogue(Registry& registry, PluginLoader& loader, std::string_view kind = {});

}  // namespace signorini
