#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/geometry/load_engine.hpp"

namespace signorini {
namespace {

std::string plugin_error_of(const std::string& library) {
  try {
    geometry::load_engine(library);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(Engine, IsLoadedOnce) { EXPECT_EQ(&geometry::engine(), &geometry::engine()); }

TEST(Engine, NamesTheLibraryThatIsMissing) {
  EXPECT_THAT(plugin_error_of("/none/libsignorini_geometry.so"), testing::HasSubstr("/none/libsignorini_geometry.so"));
}

TEST(Engine, RejectsAnotherLibrary) {
  EXPECT_THAT(plugin_error_of(SIGNORINI_BINARY_DIR "/lib/libsignorini_core.so"),
              testing::HasSubstr("signorini_geometry_engine"));
}

}  // namespace
}  // namespace signorini
