#include "core/io/picture.hpp"

#include "core/component/companion.hpp"

namespace signorini {

const Painter& load_painter(const std::filesystem::path& library) {
  void* entry = load_function(picture_library, "signorini_painter", library);
  return *reinterpret_cast<const Painter* (*)()>(entry)();
}

const Painter& painter() {
  static const Painter& loaded = load_painter(path_of(picture_library));
  return loaded;
}

}  // namespace signorini
