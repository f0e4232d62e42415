// Bodies of a scene: their tables, materials, those that touch each other, and who waits for their solution.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "core/mesh/structured.hpp"
#include "driver/scene/materials.hpp"
#include "driver/scene/numbers.hpp"
#include "driver/scene/part_nodes.hpp"
#include "driver/scene/progress.hpp"
#include "driver/scene/touching_bodies.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml", "."); }

std::string square(const std::string& name) { return tables::block(name, "[0, 0]", "[1, 1]", "[1, 1]"); }

std::string touching(const std::string& body, const std::string& other) {
  return fmt::format(
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"{}\"\non = \"bottom\"\nother = \"{}\"\nother_on = "
      "\"top\"\n",
      body, other);
}

std::vector<std::string> names(const std::vector<Scene::Body>& bodies) {
  std::vector<std::string> out;
  for (const Scene::Body& body : bodies) out.push_back(body.name);
  return out;
}

TEST(Numbers, AreThoseOfABodyOrOfItsParts) {
  const Scene scene = scene_of(square("a") + square("b") + tables::fix("b", "top", "[0, 0]") +
                               tables::fix("a", "top", "[0, 0]") + tables::fix("b", "left", "[0, 0]"));
  EXPECT_THAT(numbers_of(scene.fixes, scene.bodies[0]), ElementsAre(1));
  EXPECT_THAT(numbers_of(scene.fixes, scene.bodies[1]), ElementsAre(0, 2));
  Scene::Body both;
  both.name = "a+b";
  both.parts = scene.bodies;
  EXPECT_THAT(numbers_of(scene.fixes, both), ElementsAre(0, 1, 2));
  EXPECT_TRUE(numbers_of(scene.probes, both).empty());
}

// a touches b, b touches d: these are one body; c is alone, e touches itself.
TEST(TouchingBodies, AreOneWithAllThatTouchEachOther) {
  const std::string self =
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"e\"\non = \"left\"\nother = \"e\"\nother_on = \"right\"\n";
  const Scene scene = scene_of(square("a") + square("b") + square("c") + square("d") + square("e") +
                               touching("d", "b") + touching("b", "a") + self + tables::fix("c", "top", "[0, 0]"));
  const Scene joined = with_touching_bodies(scene);
  EXPECT_THAT(names(joined.bodies), ElementsAre("a+b+d", "c", "e"));
  EXPECT_THAT(names(joined.bodies[0].parts), ElementsAre("a", "b", "d"));
  EXPECT_TRUE(joined.bodies[1].parts.empty());
  EXPECT_THAT(names(joined.bodies[2].parts), ElementsAre("e"));
  EXPECT_EQ(joined.fixes.size(), scene.fixes.size());
  EXPECT_TRUE(joined.bodies[0].answers_to("d"));
  EXPECT_EQ(names(with_touching_bodies(scene_of(square("a") + square("b") + tables::fix("a", "top", "[0, 0]") +
                                                tables::fix("b", "top", "[0, 0]")))
                      .bodies),
            (std::vector<std::string>{"a", "b"}));
}

TEST(TouchingBodies, AreTooManyAbove16) {
  const auto chain = [](int count) {
    std::string text;
    for (int k = 0; k < count; ++k) text += square(fmt::format("b{}", k));
    for (int k = 1; k < count; ++k) text += touching(fmt::format("b{}", k), fmt::format("b{}", k - 1));
    return scene_of(text);
  };
  EXPECT_EQ(with_touching_bodies(chain(16)).bodies.size(), 1u);
  EXPECT_THROW(with_touching_bodies(chain(17)), Error);
}

TEST(TouchingBodies, HaveLevelsByMeshesAndPartsByTheirNames) {
  const Scene scene = with_touching_bodies(
      scene_of(square("a") + square("b") + square("c") + touching("b", "a") + tables::fix("c", "top", "[0, 0]")));
  EXPECT_EQ(solver_options(scene, scene.bodies[0]).hierarchy, "meshes");
  EXPECT_EQ(solver_options(scene, scene.bodies[1]).hierarchy, "auto");
  Scene asked = scene;
  asked.solver.hierarchy = "matrix";
  EXPECT_EQ(solver_options(asked, asked.bodies[0]).hierarchy, "matrix");
  EXPECT_EQ(*on_mesh_of(scene.bodies[0], "b", {"top", {}, ""}).part, "b/top");
  EXPECT_EQ(*on_mesh_of(scene.bodies[0], "b", {}).part, "b/boundary");
  EXPECT_EQ(*on_mesh_of(scene.bodies[1], "c", {"top", {}, ""}).part, "top");
  EXPECT_EQ(side_of(scene.obstacles[0], false), "b");
  EXPECT_EQ(side_of(scene.obstacles[0], true), "a");
  Scene::Obstacle self = scene.obstacles[0];
  self.other = self.body;
  EXPECT_EQ(side_of(self, false), "b/bottom");
  EXPECT_EQ(side_of(self, true), "b/top");
  self.other_on->part.reset();
  EXPECT_THAT(side_of(self, true), AllOf(HasSubstr("b"), HasSubstr("other_where")));
}

/// A scene whose bodies a and b touch, with materials by hand: a has two more, b one.
Scene with_materials() {
  Scene scene = with_touching_bodies(scene_of(square("a") + square("b") + touching("b", "a")));
  const auto add = [&](const char* body, const char* volume, std::optional<Field> young) {
    Scene::Material& m = scene.materials.emplace_back();
    m.body = body, m.volume = volume, m.young = std::move(young);
    m.source.table = std::string("material of ") + volume;
  };
  add("a", "core", 10);
  add("b", "skin", 20);
  add("a", "tip", std::nullopt);
  scene.bodies[0].parts[0].young = 1;
  scene.bodies[0].parts[1].young = 2;
  return scene;
}

TEST(Materials, AreCountedFromPartToPart) {
  const Scene scene = with_materials();
  const Scene::Body& both = scene.bodies[0];
  EXPECT_EQ(regions_of_part(scene, both, 0), std::pair(0, 3));
  EXPECT_EQ(regions_of_part(scene, both, 1), std::pair(3, 2));
  const Field young = coefficient(scene, both, &Scene::Body::young, &Scene::Material::young);
  const double wanted[] = {1, 10, 1, 2, 20};  // what a material leaves out is the body's own
  for (int region = 0; region < 5; ++region) {
    Site site;
    site.region = region;
    EXPECT_EQ(young(site), wanted[region]) << region;
  }
}

// Of two triangles the first is of a, whose materials are the first three, the other one of b.
TEST(PartNodes, AreThoseOfItsElements) {
  const Scene scene = with_materials();
  Mesh<2> mesh;
  mesh.points = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {3, 0}, {2, 1}};
  mesh.elements = {{0, 1, 2}, {3, 4, 5}};
  mesh.region = {2, 3};
  const Nodes<2> nodes(mesh);
  EXPECT_THAT(nodes_of_part(scene, scene.bodies[0], 0, nodes), ElementsAre(1, 1, 1, 0, 0, 0));
  EXPECT_THAT(nodes_of_part(scene, scene.bodies[0], 1, nodes), ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_THAT(nodes_of_part(scene, scene.bodies[0].parts[0], 0, nodes), ElementsAre(1, 1, 1, 1, 1, 1));
}

TEST(Materials, OfABodyAloneCountFromItsOwn) {
  Scene scene = with_materials();
  Scene::Body alone = scene.bodies[0].parts[0];
  const Field young = coefficient(scene, alone, &Scene::Body::young, &Scene::Material::young);
  Site site;  // of region -1
  EXPECT_EQ(young(site), 1);
  site.region = 0;
  EXPECT_EQ(young(site), 10);
  EXPECT_FALSE(young.uses_t());
  scene.materials[0].young = Field([](const Site& s) { return s.t; }, "t", "test");
  EXPECT_TRUE(coefficient(scene, alone, &Scene::Body::young, &Scene::Material::young).uses_t());
  scene.materials.clear();
  EXPECT_EQ(coefficient(scene, alone, &Scene::Body::young, &Scene::Material::young).constant(), 1);
}

std::string refused(const Scene& scene, const Scene::Body& body, const FileGroups& groups) {
  try {
    regions(scene, body, rectangle({0, 0}, {1, 1}, {2, 1}), groups);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

TEST(Materials, AreThoseOfGroupsOfElements) {
  const Scene scene = with_materials();
  const Scene::Body& a = scene.bodies[0].parts[0];
  const Mesh<2> mesh = rectangle({0, 0}, {1, 1}, {2, 1});
  FileGroups groups;
  groups.of_elements = {{"core", {2}}, {"tip", {0, 3}}, {"other", {1, 2, 3}}};
  EXPECT_EQ(regions(scene, a, mesh, groups), (std::vector<Index>{1, -1, 0, 1}));
  EXPECT_TRUE(regions(Scene(), Scene::Body(), mesh, groups).empty());
  groups.of_elements["tip"] = {2};
  EXPECT_THAT(refused(scene, a, groups), AllOf(HasSubstr("material of tip"), HasSubstr("'core'")));
  groups.of_elements.erase("core");
  EXPECT_THAT(refused(scene, a, groups), AllOf(HasSubstr("material of core"), HasSubstr("other, tip")));
  EXPECT_THAT(refused(scene, a, {}), HasSubstr("no physical group of triangles"));
}

/// Somebody who wants to stop at the third question, and forgets about it.
class Impatient final : public Progress {
 public:
  bool interrupted() const override { return ++asked_ == 3; }

 private:
  mutable int asked_ = 0;
};

TEST(Progress, ThatIsEndedStaysSo) {
  const Progress patient;
  EXPECT_NO_THROW(patient.stop_if_interrupted());
  EXPECT_FALSE(patient.is_ended());
  const Impatient progress;
  EXPECT_FALSE(progress.is_ended());
  EXPECT_NO_THROW(progress.stop_if_interrupted());
  EXPECT_TRUE(progress.is_ended());
  EXPECT_TRUE(progress.is_ended());  // what it said once holds
  try {
    progress.stop_if_interrupted();
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::interrupted);
  }
  progress.listen();
  EXPECT_NO_THROW(progress.stop_if_interrupted());
}

}  // namespace
}  // namespace signorini::test
