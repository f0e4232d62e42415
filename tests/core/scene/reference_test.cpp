#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/scene/examples.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/specs.hpp"

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

TEST(SceneReference, ItsExamplesAreAScene) {
  std::istringstream page(scene_reference());
  std::string scene;
  bool within = false;
  for (std::string line; std::getline(page, line);) {
    if (within && line == "```") within = false;
    if (within) scene += line + '\n';
    if (line == "```toml") within = true;
  }
  const std::string file = testing::TempDir() + "examples_of_the_reference.toml";
  std::ofstream(file) << scene;
  const Scene read = read_scene(file);
  EXPECT_EQ(read.bodies.size(), 1u);
  EXPECT_EQ(read.obstacles.size(), 1u);
  EXPECT_EQ(read.steps.count(), 4);
  for (const TableSpec& table : table_specs()) {
    if (!*table_text(table.name).example) continue;  // needs a file
    EXPECT_NE(scene.find(fmt::format(fmt::runtime(table.listed ? "[[{}]]" : "[{}]"), table.name)), std::string::npos);
  }
}

}  // namespace
}  // namespace signorini
