#include "core/component/companion.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <new>

#include "core/base/error.hpp"

namespace signorini {
namespace {

/// Whether there is no room for a library: the loader does not say why it cannot map one.
bool out_of_address_space() {
  constexpr std::size_t library = 64 << 20;  // with those that it needs
  void* room = mmap(nullptr, library, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) return true;
  munmap(room, library);
  return false;
}

}  // namespace

std::filesystem::path core_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&core_folder), &info) == 0 || !info.dli_fname) return {};
  std::error_code ignored;
  return std::filesystem::absolute(info.dli_fname, ignored).parent_path();
}

void* load_function(const std::filesystem::path& library, const char* function, const char* what) {
  const auto fail = [&](const char* reason) {
    if (out_of_address_space()) throw std::bad_alloc();
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
