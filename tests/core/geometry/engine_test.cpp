#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/geometry/load_engine.hpp"

namespace signorini {
namespace {

template <int D>
std::string plugin_error_of(const std::string& library) {
  try {
    geometry::load_engine<D>(library);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(Engine, IsLoadedOnce) {
  EXPECT_EQ(&geometry::engine<2>(), &geometry::engine<2>());
  EXPECT_EQ(&geometry::engine<3>(), &geometry::engine<3>());
}

TEST(Engine, NamesTheLibraryThatIsMissing) {
  EXPECT_THAT(plugin_error_of<3>("/none/libsignorini_geometry.so"),
              testing::HasSubstr("/none/libsignorini_geometry.so"));
}

TEST(Engine, RejectsAnotherLibrary) {
  EXPECT_THAT(plugin_error_of<2>(SIGNORINI_BINARY_DIR "/lib/libsignorini_geometry.so"),
              testing::HasSubstr("signorini_plane_engine"));
  EXPECT_THAT(plugin_error_of<3>(SIGNORINI_BINARY_DIR "/lib/libsignorini_core.so"),
              testing::HasSubstr("signorini_geometry_engine"));
}

}  // namespace
}  // namespace signorini
