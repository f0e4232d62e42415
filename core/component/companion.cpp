#include "core/component/companion.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/base/error.hpp"

namespace signorini {

std::filesystem::path core_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&core_folder), &info) == 0 || !info.dli_fname) return {};
  std::error_code ignored;
  return std::filesystem::absolute(info.dli_fname, ignored).parent_path();
}

void* load_function(const std::filesystem::path& library, const char* function, const char* what) {
  const auto fail = [&](const char* reason) {
    throw Error(Exit::plugin, fmt::format("{}: {} cannot be loaded: {}; expected it beside the core library",
                                          library.string(), what, reason));
  };
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) fail(dlerror());
  void* entry = dlsym(handle, function);
  if (!entry) fail(dlerror());
  return entry;
}

}  // namespace signorini
