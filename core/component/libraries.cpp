#include "core/component/libraries.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/component/registry.hpp"

namespace signorini {
namespace {

/// Libraries stay loaded until the program ends, whoever asked for them.
struct Loaded {
  std::mutex mutex;
  std::vector<Library> libraries{{file_of(reinterpret_cast<const void*>(&loaded_libraries)), "BSD-3-Clause"}};
};

Loaded& loaded() {
  static Loaded all;
  return all;
}

}  // namespace

std::vector<Library> loaded_libraries() {
  const std::lock_guard lock(loaded().mutex);
  return loaded().libraries;
}

std::string licence_of(const std::string& file) {
  const auto all = loaded_libraries();
  const auto found = std::ranges::find(all, file, &Library::file);
  return found == all.end() ? "" : found->licence;
}

void remember_library(const std::filesystem::path& file, std::string licence) {
  const std::lock_guard lock(loaded().mutex);
  std::vector<Library>& all = loaded().libraries;
  if (std::ranges::find(all, file.string(), &Library::file) == all.end())
    all.push_back({file.string(), std::move(licence)});
}

}  // namespace signorini
