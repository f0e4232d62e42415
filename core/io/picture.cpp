#include "core/io/picture.hpp"

#include "core/component/companion.hpp"

namespace signorini {

const Painter& load_painter(const std::filesystem::path& library) {
  void* entry = load_function(library, "signorini_painter", "the library for pictures");
  return *reinterpret_cast<const Painter* (*)()>(entry)();
}

const Painter& painter() {
  static const Painter& loaded = load_painter(core_folder() / "libsignorini_pictures.so");
  return loaded;
}

}  // namespace signorini
