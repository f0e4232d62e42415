#include "conformance/subject.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/component/failure.hpp"
#include "core/component/settings.hpp"
#include "core/scene/rigid_shape.hpp"
#include "core/scene/scene.hpp"
#include "core/sdk/stepping.hpp"

namespace signorini::conformance {
namespace {

template <int B>
auto constructor_of(const ObstacleType& type) {
  if constexpr (B == 1) return type.create1;
  if constexpr (B == 2) return type.create2;
  if constexpr (B == 3) return type.create3;
}

std::string name_in(const std::string& setting) { return setting.substr(0, setting.find('=')); }

/// A scene of which nothing but its obstacle is read.
template <int B>
std::string scene_around(const Subject& subject, const Values& values) {
  const bool plane = dimension<B> == 2;
  std::string text = fmt::format("[[body]]\nname = \"body\"\nshape = \"{}\"\nfrom = {}\nto = {}\ncells = {}\n",
                                 plane ? "rectangle" : "box", plane ? "[0, 0]" : "[0, 0, 0]",
                                 plane ? "[1, 1]" : "[1, 1, 1]", plane ? "[1, 1]" : "[1, 1, 1]");
  text += B == 1 ? "equation = \"diffusion\"\n" : "young = 1\npoisson = 0.3\n";
  text += fmt::format("[[obstacle]]\ntype = \"{}\"\nbody = \"body\"\non = \"bottom\"\n", subject.id());
  const bool shaped = std::ranges::any_of(values, [](const std::string& v) { return name_in(v) == "shape"; });
  if (subject.type().takes_shape && !shaped && !subject.is_given("shape"))
    text += plane ? "shape = \"plane\"\npoint = [0, -0.3]\nnormal = [0.2, 1]\n"
                  : "shape = \"plane\"\npoint = [0, 0, -0.3]\nnormal = [0.2, -0.1, 1]\n";
  return text;
}

template <int B>
Scene::Obstacle read_obstacle(const Subject& subject, const Values& values) {
  std::vector<std::string> overrides;
  for (const Values* all : {&values, &subject.given()})
    for (const std::string& value : *all) overrides.push_back("obstacle.0." + value);
  const std::string name = fmt::format("obstacle '{}'", subject.id());
  Scene::Obstacle obstacle = parse_scene(scene_around<B>(subject, values), name, ".", overrides).obstacles.at(0);
  if (obstacle.shape && !subject.type().takes_shape)
    throw Error(Exit::input, fmt::format("{}: it takes no shape", name));
  return obstacle;
}

}  // namespace

void expect_good_questions(const Settings& settings, const std::string& name) {
  try {
    check_asked(settings, name);
  } catch (const Error& error) {
    throw WrongQuestion(error.status(), error.what());
  }
}

bool Subject::is_given(std::string_view option) const {
  return std::ranges::any_of(given_, [&](const std::string& setting) { return name_in(setting) == option; });
}

template <int B>
bool Subject::has() const {
  return constructor_of<B>(type_) != nullptr;
}

template <int B>
std::shared_ptr<const DistanceFunction> Subject::shape(const Values& values) const {
  const Scene::Obstacle scene = read_obstacle<B>(*this, values);
  return scene.shape ? rigid_shape(*scene.shape, dimension<B>, 1, scene.source.table) : nullptr;
}

template <int B>
Made<B> Subject::make(const Values& values, std::shared_ptr<const DistanceFunction> shape) const {
  const Scene::Obstacle scene = read_obstacle<B>(*this, values);
  if (!shape && scene.shape) shape = rigid_shape(*scene.shape, dimension<B>, 1, scene.source.table);
  const std::string name = fmt::format("obstacle '{}'", id_);
  Made<B> made{compile_settings(name, {type_.options, type_.option_count}, scene.options, scene.core_keys(), shape, 1),
               {},
               values};
  Status status;
  made.obstacle.reset(constructor_of<B>(type_)(*made.settings, status));
  expect_good_questions(*made.settings, name);
  if (!status.ok()) throw_failure(status, name);
  if (!made.obstacle) throw Error(Exit::plugin, name + ": the constructor makes no obstacle, and gives no reason");
  if (auto* stepping = dynamic_cast<Stepping*>(made.obstacle.get())) stepping->begin({1, 0, 1, 0}, status);
  if (!status.ok()) throw_failure(status, name);
  return made;
}

#define SIGNORINI_INSTANTIATE(B)                                                           \
  template bool Subject::has<B>() const;                                                   \
  template std::shared_ptr<const DistanceFunction> Subject::shape<B>(const Values&) const; \
  template Made<B> Subject::make<B>(const Values&, std::shared_ptr<const DistanceFunction>) const;
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini::conformance
