#pragma once
#include <functional>

#include "tests/random_scenes/round.hpp"
#include "tests/random_scenes/solved_scene.hpp"
#include "tests/verification/random_body.hpp"

namespace signorini::test {

struct Case {
  std::string name;
  bool quick;  ///< in every run of the tests
  std::function<Scene()> read;
};

/// The same with stiffnesses that differ by rounding.
inline Scene nudged(Scene scene, double by) {
  const auto nudge = [by](Scene::Body& body) {
    for (Field* field : {&body.young, &body.diffusion})
      if (const auto constant = field->constant()) *field = *constant * by;
  };
  for (Scene::Body& body : scene.bodies) {
    nudge(body);
    std::ranges::for_each(body.parts, nudge);
  }
  return scene;
}

/// Shipped scenes on their coarsest meshes (@0) and on the meshes they ask for.
inline void add_scenes(std::vector<Case>& cases) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SIGNORINI_SOURCE_DIR "/apps/scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& file : files) {
    const std::string name = "scene/" + file.stem().string();
    const bool slow = name == "scene/partial_slip_3d";  // its coarsest mesh is a fine one
    if (!slow)
      cases.push_back(
          {name + "@0", true, [=] { return read_scene(file, std::vector<std::string>{"refine.uniform=0"}); }});
    cases.push_back({name, false, [=] { return read_scene(file); }});
  }
}

/// @param text of the scene of a seed
inline void add_random(std::vector<Case>& cases, const std::string& kind, int quick, int all, const auto& text) {
  for (int seed = 1; seed <= all; ++seed)
    cases.push_back({fmt::format("{}/{}", kind, seed), seed <= quick,
                     [=] { return parse_scene(text(seed), "random.toml", ".", {}); }});
}

template <int D>
void add_bodies(std::vector<Case>& cases, int all) {
  const auto of = [](Bodies kind) {
    return [=](int seed) { return RandomBody<D>(static_cast<std::uint64_t>(seed), kind).text; };
  };
  add_random(cases, fmt::format("body{}", D), 20, all, of(Bodies::soft));
  add_random(cases, fmt::format("moved{}", D), 20, all, of(Bodies::stiff_and_moved));
}

template <int D>
void add_stacks(std::vector<Case>& cases, int quick, int all, const std::filesystem::path& folder) {
  const auto of = [folder](const char* salt, const auto& generate) {
    return [=](int seed) {
      Random random(static_cast<std::uint64_t>(seed) * 0x9E3779B97F4A7C15u + static_cast<unsigned char>(*salt));
      const Stack<D> stack = generate(random);
      const Way way = Way::any(random, stack.kind, true);
      return StackText<D>(stack, View<D>{}, way, folder).text();
    };
  };
  add_random(cases, fmt::format("column{}", D), quick, all, of("c", random_column<D>));
  add_random(cases, fmt::format("pile{}", D), quick, all, of("p", random_pile<D>));
  add_random(cases, fmt::format("round{}", D), 0, all / 10, [](int seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Round<D> round = random_round<D>(random);
    return text_of(round, View<D>{}, Way::any(random, Kind::shapes, true));
  });
}

/// @param folder for the files of meshes
inline std::vector<Case> cases(const std::filesystem::path& folder) {
  std::vector<Case> out;
  add_scenes(out);
  add_bodies<2>(out, 1300);
  add_bodies<3>(out, 1000);
  add_stacks<2>(out, 8, 150, folder);
  add_stacks<3>(out, 2, 50, folder);
  return out;
}

}  // namespace signorini::test
