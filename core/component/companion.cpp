#include "core/component/companion.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>

#include <new>

#include "core/base/error.hpp"
#include "core/component/libraries.hpp"

namespace signorini {
namespace {

constexpr bool with_gpl = SIGNORINI_GPL;

/// Whether there is no room for a library: the loader does not say why it cannot map one.
bool out_of_address_space() {
  constexpr std::size_t library = 64 << 20;  // with those that it needs
  void* room = mmap(nullptr, library, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) return true;
  munmap(room, library);
  return false;
}

/// Of this library.
std::filesystem::path core_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&why_missing), &info) == 0 || !info.dli_fname) return {};
  std::error_code ignored;
  return std::filesystem::absolute(info.dli_fname, ignored).parent_path();
}

}  // namespace

std::filesystem::path path_of(const Companion& companion) { return core_folder() / companion.file; }

std::string why_missing(const Companion& companion) {
  if (with_gpl || !companion.gpl) return {};
  return fmt::format("this build was configured with SIGNORINI_GPL=OFF, without what is linked with {} ({})",
                     companion.of, companion.licence);
}

void* load_function(const Companion& companion, const char* function, const std::filesystem::path& library) {
  const auto fail = [&](const char* reason) {
    if (out_of_address_space()) throw std::bad_alloc();
    const std::string missing = why_missing(companion);
    throw Error(Exit::plugin, fmt::format("{}: {} cannot be loaded: {}; {}", library.string(), companion.what, reason,
                                          missing.empty() ? "expected it beside the core library" : missing));
  };
  void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) fail(dlerror());
  void* entry = dlsym(handle, function);
  if (!entry) fail(dlerror());
  remember_library(library, companion.licence);
  return entry;
}

}  // namespace signorini
