#include <dlfcn.h>
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/load_engine.hpp"

namespace signorini::geometry {

namespace {

// The folder of the library that this code is in.
std::filesystem::path core_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&engine), &info) == 0 || !info.dli_fname) return {};
  std::error_code ignored;
  return std::filesystem::absolute(info.dli_fname, ignored).parent_path();
}

}  // namespace

const Engine& load_engine(const std::filesystem::path& library) {
  const auto fail = [&](const char* reason) {
    throw Error(Exit::plugin, fmt::format("{}: the geometry library cannot be loaded: {}; expected it beside the core "
                                          "library",
                                          library.string(), reason));
  };
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) fail(dlerror());
  void* entry = dlsym(handle, "signorini_geometry_engine");
  if (!entry) fail(dlerror());
  return *reinterpret_cast<const Engine* (*)()>(entry)();
}

const Engine& engine() {
  static const Engine& loaded = load_engine(core_folder() / "libsignorini_geometry.so");
  return loaded;
}

}  // namespace signorini::geometry
