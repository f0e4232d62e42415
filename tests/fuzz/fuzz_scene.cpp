#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/scene/scene.hpp"

using namespace signorini;

namespace {

// Evaluates what was accepted: a field gives a finite number, or an Error.
void evaluate(const Field& field) {
  try {
    field(Site{{0.5, -1, 2}, {0, 0, 1}, 0.5});
  } catch (const Error&) {
  }
}

void evaluate(const Scene& scene) {
  for (const Scene::Body& body : scene.bodies) {
    for (const Field* field : {&body.young, &body.poisson, &body.diffusion}) evaluate(*field);
    if (body.size) evaluate(*body.size);
  }
  for (const Scene::Fix& fix : scene.fixes) {
    if (fix.on.where) evaluate(*fix.on.where);
    for (const auto& component : fix.value)
      if (component) evaluate(*component);
  }
  for (const Scene::Load& load : scene.loads)
    for (const Field& component : load.value) evaluate(component);
}

}  // namespace

// A scene, and after each zero byte an assignment as `--set` takes it. Whatever the bytes: a scene or an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  const std::string_view text = rest.substr(0, rest.find('\0'));
  std::vector<std::string> overrides;
  while (rest.find('\0') != std::string_view::npos) {
    rest.remove_prefix(rest.find('\0') + 1);
    overrides.emplace_back(rest.substr(0, rest.find('\0')));
  }
  try {
    evaluate(parse_scene(text, "scene.toml", ".", overrides));
  } catch (const Error&) {
  }
  return 0;
}
