#pragma once
#include <string>
#include <vector>

/// Scenes of tests, which differ in few keys.
namespace signorini::test {

/// One body and one obstacle: the keys of their tables as TOML, but for `name` and `body`.
struct SceneText {
  std::string body;
  std::vector<std::string> fixes{}, loads{};
  std::string obstacle{};
  int refinements = 0;

  operator std::string() const {  // NOLINT: it is the text of a scene
    std::string text = "[[body]]\nname = \"b\"\n" + body + '\n';
    for (const std::string& fix : fixes) text += "[[fix]]\nbody = \"b\"\n" + fix + '\n';
    for (const std::string& load : loads) text += "[[load]]\nbody = \"b\"\n" + load + '\n';
    return text + "[[obstacle]]\nbody = \"b\"\n" + obstacle + "\n[refine]\nuniform = " + std::to_string(refinements) +
           '\n';
  }
};

}  // namespace signorini::test
