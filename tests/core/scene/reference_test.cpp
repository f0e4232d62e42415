#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/scene/scene.hpp"

namespace signorini {
namespace {

// To renew docs/scene.md after a change of the specifications, copy the file that this test names.
TEST(SceneReference, IsTheFileInTheDocumentation) {
  std::ifstream file(SIGNORINI_SOURCE_DIR "/docs/scene.md");
  std::ostringstream text;
  text << file.rdbuf();
  const std::string expected = scene_reference();
  if (text.str() == expected) return;
  const std::string renewed = testing::TempDir() + "scene.md";
  std::ofstream(renewed) << expected;
  ADD_FAILURE() << "docs/scene.md is not what the specifications say; the right text is in " << renewed;
}

}  // namespace
}  // namespace signorini
