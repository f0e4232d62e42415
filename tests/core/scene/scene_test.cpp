#include "core/scene/scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/scene/specs.hpp"
#include "core/scene/toml.hpp"
#include "scenes.hpp"

namespace signorini {
namespace {

using test::ball;
using test::membrane;
using test::parse;
using test::with;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Scene, ReadsTheDocumentedExample) {
  const Scene scene = parse(ball);
  EXPECT_EQ(scene.title, "Ball pressed on a plane");
  EXPECT_EQ(scene.name, "scene");
  EXPECT_EQ(scene.dimension, 3);
  const Scene::Body& body = scene.body("ball");
  const auto& shape = std::get<geometry::Ball>(body.shape);
  EXPECT_EQ(shape.center, (Point<3>{0, 0, 0}));
  EXPECT_EQ(shape.radius, 1);
  EXPECT_FALSE(shape.lower_half);
  EXPECT_EQ(body.size->constant(), 0.25);
  EXPECT_EQ(body.young.constant(), 1);
  EXPECT_EQ(body.poisson.constant(), 0.3);
  const Scene::Fix& fix = scene.fixes.at(0);
  EXPECT_EQ(fix.value.at(2)->constant(), -0.02);
  EXPECT_EQ(fix.on.where->text(), "z > 0.5");
  EXPECT_EQ(fix.on.origin, "scene.toml:16: fix.0.where");
  EXPECT_EQ(fix.source.of("value"), "scene.toml:17: fix.0.value");
  EXPECT_EQ(fix.source.of("frame"), "scene.toml:14: fix.0");
  EXPECT_EQ(scene.loads.at(0).value.size(), 3);
  EXPECT_FALSE(scene.loads.at(0).on);
  const Scene::Obstacle& obstacle = scene.obstacles.at(0);
  EXPECT_EQ(obstacle.type, "contact");
  EXPECT_EQ(obstacle.on->part, "boundary");
  EXPECT_EQ(std::get<Scene::PlaneShape>(*obstacle.shape).point.at(2).constant(), -1);
  EXPECT_TRUE(obstacle.options.entries.empty());
  EXPECT_EQ(scene.refine.uniform, 2);
  EXPECT_THAT(scene.probes.at(0).at, ElementsAre(0, 0, -1));
}

TEST(Scene, ElementsAreQuadraticUnlessItSaysOtherwise) {
  const auto chosen = [](const std::string& poisson, const std::string& order) {
    const Scene scene = parse(with(with(ball, "0.3", poisson), "order    = 1", order));
    return std::tuple(scene.bodies[0].order, scene.bodies[0].order_chosen, *scene.bodies[0].pressure);
  };
  EXPECT_EQ(chosen("0.3", ""), std::tuple(2, true, Pressure::linear));
  EXPECT_EQ(chosen("0.3", "order = \"auto\""), std::tuple(2, true, Pressure::linear));
  EXPECT_EQ(chosen("0.3", "order = 2"), std::tuple(2, false, Pressure::linear));
  EXPECT_EQ(chosen("0.3", "order = \"2\""), std::tuple(2, false, Pressure::linear));
  EXPECT_EQ(chosen("0.4999", ""), std::tuple(2, true, Pressure::linear));
  EXPECT_EQ(chosen("0.4999", "order = 1"), std::tuple(1, false, Pressure::none));
  EXPECT_EQ(chosen("0.4999", "pressure = \"none\""), std::tuple(2, true, Pressure::none));
  EXPECT_EQ(chosen("0.4999", "order = 2\npressure = \"none\""), std::tuple(2, false, Pressure::none));
  EXPECT_EQ(chosen("0.4999", "order = \"auto\"\npressure = \"constant\""), std::tuple(2, false, Pressure::constant));
  EXPECT_EQ(chosen("\"0.49 + 0*x\"", ""), std::tuple(2, true, Pressure::linear));
  const Scene stressed = parse(with(membrane, "equation = \"diffusion\"", "young = 1\npoisson = 0\nplane = \"stress\""),
                               {"fix.0.value=[0, 0]", "obstacle.0.on=top"});
  EXPECT_EQ(stressed.bodies[0].order, 2);
  EXPECT_EQ(stressed.bodies[0].pressure, Pressure::none);
}

// What the scene says of one holds for all, whichever it is.
TEST(Scene, BodiesThatTouchHaveOneKindOfElements) {
  const auto orders = [](const std::string& a, const std::string& b, const std::string& c, const std::string& more) {
    std::string text;
    for (const auto& [name, keys] : {std::pair("a", a), std::pair("b", b), std::pair("c", c)})
      text += std::string("[[body]]\nname = \"") + name +
              "\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [1, 1]\nyoung = 1\npoisson = 0.3\n" +
              keys + "\n";
    for (const auto& [body, other] : {std::pair("a", "b"), std::pair("c", "b")})
      text += std::string("[[obstacle]]\ntype = \"elastic\"\non = \"top\"\nother_on = \"bottom\"\nbody = \"") + body +
              "\"\nother = \"" + other + "\"\n";
    std::vector<int> out;
    for (const Scene::Body& body : parse(text + more).bodies)
      out.push_back(10 * body.order + (body.pressure == Pressure::linear));
    return out;
  };
  EXPECT_THAT(orders("", "", "", ""), ElementsAre(21, 21, 21));
  EXPECT_THAT(orders("order = 1", "", "", ""), ElementsAre(10, 10, 10));
  EXPECT_THAT(orders("", "", "order = 1", ""), ElementsAre(10, 10, 10));
  EXPECT_THAT(orders("pressure = \"none\"", "", "", ""), ElementsAre(20, 20, 20));
  EXPECT_THAT(orders("", "", "", "[solver]\nbodies = \"dirichlet-neumann\"\n"), ElementsAre(10, 10, 10));
  EXPECT_THAT(test::outcome([&] { orders("order = 1", "", "order = 2", ""); }).message, HasSubstr("elements of order"));
}

TEST(Scene, DefaultsAreTheDocumentedOnes) {
  const Scene scene = parse(membrane);
  EXPECT_EQ(scene.title, "");
  EXPECT_EQ(scene.bodies[0].diffusion.constant(), 1);
  EXPECT_EQ(scene.bodies[0].order, 1);
  EXPECT_FALSE(scene.bodies[0].size);
  EXPECT_EQ(scene.fixes[0].frame, Frame::global);
  EXPECT_EQ(scene.solver.tolerance, 1e-8);
  EXPECT_EQ(scene.solver.max_iterations, 200);
  EXPECT_EQ(scene.solver.method, "auto");
  EXPECT_EQ(scene.solver.cycle, "V");
  EXPECT_EQ(scene.solver.start, "nested");
  EXPECT_EQ(scene.refine.uniform, 0);
  EXPECT_EQ(scene.steps.count(), 1);
  EXPECT_TRUE(scene.plugin_path.empty());
  EXPECT_TRUE(scene.output.vtu && scene.output.pictures && scene.output.convergence);
  const Scene strained = parse(with(membrane, "equation = \"diffusion\"", "young = 1\npoisson = 0\n"),
                               {"fix.0.value=[0, 0]", "obstacle.0.on=top"});
  EXPECT_EQ(strained.bodies[0].equation, Scene::Equation::elasticity);
  EXPECT_EQ(strained.bodies[0].plane, Plane::strain);
}

TEST(Scene, DefaultsOfTheSolverAreThoseOfItsOptions) {
  const Scene scene = parse(membrane);
  const SolverOptions options;
  EXPECT_EQ(scene.solver.tolerance, options.tolerance);
  EXPECT_EQ(scene.solver.max_iterations, options.max_iterations);
  EXPECT_EQ(scene.solver.method, options.method);
  EXPECT_EQ(scene.solver.cycle, options.cycle);
  EXPECT_EQ(scene.solver.pre, options.pre);
  EXPECT_EQ(scene.solver.post, options.post);
  EXPECT_EQ(scene.solver.smoother, options.smoother);
  EXPECT_EQ(scene.solver.relaxation, options.relaxation);
  EXPECT_EQ(scene.solver.transfer, options.transfer);
  EXPECT_EQ(scene.solver.coarse, options.coarse);
  EXPECT_EQ(scene.solver.aggregates, options.aggregates);
  EXPECT_EQ(scene.solver.truncate, options.truncate);
  EXPECT_EQ(scene.solver.rotate, options.rotate);
  EXPECT_EQ(scene.solver.krylov, options.krylov);
  EXPECT_EQ(scene.solver.threads, options.threads);
}

TEST(Scene, EverySettingIsRead) {
  const Scene scene = parse(membrane + R"(
[solver]
tolerance = "1/1000"
max_iterations = 7
cycle = "W"
pre = 2
post = 3
smoother = "forward"
relaxation = 1.5
transfer = "other"
coarse = "direct"
aggregates = "metis"
truncate = "none"
rotate = "not_coarsest"
start = "zero"
[steps]
count = 4
[plugins]
path = ["..", "/"]
[output]
vtu = false
pictures = false
convergence = false
)");
  EXPECT_EQ(scene.solver.tolerance, 0.001);
  EXPECT_EQ(scene.solver.max_iterations, 7);
  EXPECT_EQ(scene.solver.cycle, "W");
  EXPECT_EQ(scene.solver.pre, 2);
  EXPECT_EQ(scene.solver.post, 3);
  EXPECT_EQ(scene.solver.smoother, "forward");
  EXPECT_EQ(scene.solver.relaxation, 1.5);
  EXPECT_EQ(scene.solver.transfer, "other");
  EXPECT_EQ(scene.solver.coarse, "direct");
  EXPECT_EQ(scene.solver.aggregates, "metis");
  EXPECT_EQ(scene.solver.truncate, "none");
  EXPECT_EQ(scene.solver.rotate, "not_coarsest");
  EXPECT_EQ(scene.solver.start, "zero");
  EXPECT_EQ(scene.steps.count(), 4);
  EXPECT_THAT(scene.plugin_path, ElementsAre("./..", "/"));
  EXPECT_FALSE(scene.output.vtu || scene.output.pictures || scene.output.convergence);
}

TEST(SceneSteps, AreEvenOrAsListed) {
  const auto steps = [](const std::string& table) { return parse(std::string(membrane) + table).steps; };
  EXPECT_THAT(steps("").at, ElementsAre(1));
  EXPECT_THAT(steps("[steps]\ncount = 4\n").at, ElementsAre(0.25, 0.5, 0.75, 1));
  EXPECT_THAT(steps("[steps]\nat = [0.1, '1/2', 1]\nhalvings = 2\n").at, ElementsAre(0.1, 0.5, 1));
  EXPECT_EQ(steps("").halvings, 4);
  EXPECT_EQ(steps("[steps]\nhalvings = 2\n").halvings, 2);
}

std::string body(const std::string& keys) {
  return "[[body]]\nname = \"b\"\nequation = \"diffusion\"\n" + keys +
         "\n[[fix]]\nbody = \"b\"\non = \"boundary\"\nvalue = 0\n";
}

TEST(Scene, ReadsEveryShapeOfABody) {
  const auto rectangle =
      std::get<Scene::Block<2>>(parse(body("shape='rectangle'\nfrom=[0,1]\nto=[2,3]\ncells=[4,5]")).bodies[0].shape);
  EXPECT_EQ(rectangle.to, (Point<2>{2, 3}));
  EXPECT_EQ(rectangle.cells, (std::array<Index, 2>{4, 5}));
  const auto box = std::get<Scene::Block<3>>(
      parse(body("shape='box'\nfrom=[0,0,0]\nto=['2*pi',1,1]\ncells=[1,2,3]")).bodies[0].shape);
  EXPECT_DOUBLE_EQ(box.to[0], 6.283185307179586);
  EXPECT_EQ(box.cells[2], 3);
  for (const bool half : {false, true}) {
    const std::string prefix = half ? "half_" : "";
    const auto disk = std::get<geometry::Disk>(
        parse(body("shape='" + prefix + "disk'\ncenter=[1,2]\nradius=3\nsize=1")).bodies[0].shape);
    EXPECT_EQ(disk.center, (Point<2>{1, 2}));
    EXPECT_EQ(disk.lower_half, half);
    const auto sphere = std::get<geometry::Ball>(
        parse(body("shape='" + prefix + "ball'\ncenter=[1,2,3]\nradius=3\nsize='0.1+x^2'")).bodies[0].shape);
    EXPECT_EQ(sphere.lower_half, half);
  }
  const auto polygon =
      std::get<geometry::Polygon>(parse(body("shape='polygon'\npoints=[[0,0],[1,0],[0,1]]\nsize=1")).bodies[0].shape);
  EXPECT_EQ(polygon.points.at(2), (Point<2>{0, 1}));
  const auto cylinder = std::get<geometry::Cylinder>(
      parse(body("shape='cylinder'\ncenter=[0,0,0]\nradius=2\nheight=5\nsize=1")).bodies[0].shape);
  EXPECT_EQ(cylinder.height, 5);
}

TEST(Scene, ReadsEveryShapeOfAnObstacle) {
  const auto shape = [](const std::string& keys) {
    return *parse(with(ball, "shape = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]", keys)).obstacles[0].shape;
  };
  const auto sphere = std::get<Scene::SphereShape>(shape("shape='sphere'\ncenter=[0,0,'-t']\nradius=3\ninside=true"));
  Site site;
  site.t = 0.25;
  EXPECT_EQ(sphere.center[2](site), -0.25);
  EXPECT_EQ(sphere.radius.constant(), 3);
  EXPECT_TRUE(sphere.inside);
  const auto cylinder =
      std::get<Scene::CylinderShape>(shape("shape='cylinder'\ncenter=[0,0,0]\naxis=[1,0,0]\nradius='1+x'"));
  EXPECT_EQ(cylinder.axis[0].constant(), 1);
  const auto expression = std::get<Scene::ExpressionShape>(shape("shape='expression'\ndistance='z+1'"));
  EXPECT_TRUE(expression.normal.empty());
  EXPECT_EQ(std::get<Scene::ExpressionShape>(shape("shape='expression'\ndistance='z'\nnormal=[0,'x',1]")).normal.size(),
            3);
}

TEST(Scene, KeysOfAPluginStayAsWrittenWithTheirOrigin) {
  const Scene scene = parse(with(ball, "normal = [0, 0, 1]", "normal = [0, 0, 1]\nodd = [1, 'a', true, 2.5]"));
  const RawTable& options = scene.obstacles[0].options;
  ASSERT_EQ(options.entries.size(), 1);
  EXPECT_EQ(options.origin, "scene.toml:23: obstacle.0");
  const RawValue& odd = *options.find("odd");
  EXPECT_EQ(odd.origin, "scene.toml:30: obstacle.0.odd");
  const auto& list = std::get<RawValue::List>(odd.value);
  EXPECT_EQ(std::get<std::int64_t>(list.at(0).value), 1);
  EXPECT_EQ(std::get<std::string>(list.at(1).value), "a");
  EXPECT_EQ(std::get<bool>(list.at(2).value), true);
  EXPECT_EQ(std::get<double>(list.at(3).value), 2.5);
  EXPECT_EQ(list.at(1).origin, "scene.toml:30: obstacle.0.odd[1]");
}

// `normal` as a word is an option of plugins, as a list it belongs to the shape.
TEST(Scene, TheWordBodyAsNormalIsLeftToThePlugin) {
  const std::string rigid = "shape = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]";
  for (const char* keys : {"shape='sphere'\ncenter=[0,0,0]\nradius=3\nnormal='body'",
                           "shape='expression'\ndistance='z+1'\nnormal='body'"}) {
    const Scene scene = parse(with(ball, rigid, keys));
    ASSERT_TRUE(scene.obstacles[0].options.find("normal")) << keys;
    EXPECT_EQ(std::get<std::string>(scene.obstacles[0].options.find("normal")->value), "body");
  }
}

TEST(Scene, BesideTheNormalOfAShapeThatOfThePluginIsCalledAlong) {
  const std::string rigid = "shape = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]";
  for (const char* keys : {"shape='plane'\npoint=[0,0,-1]\nnormal=[0,0,1]\nalong='body'",
                           "shape='expression'\ndistance='z+1'\nnormal=[0,0,1]\nalong='body'"}) {
    const Scene scene = parse(with(ball, rigid, keys));
    ASSERT_TRUE(scene.obstacles[0].options.find("normal")) << keys;
    EXPECT_EQ(std::get<std::string>(scene.obstacles[0].options.find("normal")->value), "body");
    EXPECT_FALSE(scene.obstacles[0].options.find("along")) << keys;
  }
  const test::Outcome word =
      test::outcome([&] { parse(with(ball, rigid, "shape='plane'\npoint=[0,0,-1]\nnormal='body'")); });
  EXPECT_EQ(word.status, Exit::input);
  EXPECT_THAT(word.message, testing::AllOf(testing::HasSubstr("obstacle.0.normal"), testing::HasSubstr("along = ")));
}

TEST(Scene, SuggestionsForAnObstacleCoverTheKeysOfItsShape) {
  const std::vector<std::string> keys = parse(ball).obstacles[0].core_keys();
  for (const char* key : {"type", "where", "point", "normal"}) EXPECT_THAT(keys, testing::Contains(key));
  EXPECT_THAT(keys, testing::Not(testing::Contains("radius")));
}

TEST(Scene, FreeComponentsAreEmpty) {
  const Scene scene = parse(with(ball, "[0, 0, -0.02]", "[\"free\", 0, \"-0.02*t\"]"));
  EXPECT_FALSE(scene.fixes[0].value[0]);
  EXPECT_TRUE(scene.fixes[0].value[1]);
  EXPECT_FALSE(scene.fixes[0].value[2]->constant());
}

TEST(Scene, TheRangeOfAnExpressionIsCheckedWhereItIsEvaluated) {
  const Scene scene = parse(with(ball, "young    = 1.0", "young = \"1 - x\""));
  Site site;
  site.x[0] = 0.5;
  EXPECT_EQ(scene.bodies[0].young(site), 0.5);
  site.x[0] = 2;
  const test::Outcome result = test::outcome([&] { scene.bodies[0].young(site); });
  EXPECT_EQ(result.status, Exit::input);
  EXPECT_THAT(result.message, HasSubstr("scene.toml:10: body.0.young: expression '1 - x' is -1 at (2, 0, 0)"));
  EXPECT_THAT(result.message, HasSubstr("(0, inf)"));
}

class SceneFiles : public testing::Test {
 protected:
  SceneFiles() { std::filesystem::create_directories(folder_ / "meshes"); }
  ~SceneFiles() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::filesystem::path& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("signorini_scene_" + std::to_string(::getpid()));
};

TEST_F(SceneFiles, FileNamesAreRelativeToTheFolderOfTheScene) {
  write("meshes/part.msh", "");
  const Scene scene = read_scene(write("s.toml", body("mesh = \"meshes/part.msh\"")));
  EXPECT_EQ(std::get<Scene::MeshFile>(scene.bodies[0].shape).file, folder_ / "meshes/part.msh");
  EXPECT_EQ(scene.dimension, 0);
  EXPECT_EQ(scene.name, "s");
}

TEST_F(SceneFiles, AMissingFileIsNamedWithItsNearestNeighbour) {
  write("meshes/part.msh", "");
  const auto file = write("s.toml", body("mesh = \"meshes/prat.msh\""));
  const test::Outcome result = test::outcome([&] { read_scene(file); });
  EXPECT_EQ(result.status, Exit::input);
  EXPECT_THAT(result.message, HasSubstr("s.toml:4: body.0.mesh: there is no file"));
  EXPECT_THAT(result.message, HasSubstr("did you mean 'part.msh'?"));
  const test::Outcome missing = test::outcome([&] { read_scene(folder_ / "t.toml"); });
  EXPECT_EQ(missing.status, Exit::input);
  EXPECT_THAT(missing.message, HasSubstr("did you mean 's.toml'?"));
  const test::Outcome is_folder = test::outcome([&] { read_scene(folder_ / "meshes"); });
  EXPECT_EQ(is_folder.status, Exit::input);
  EXPECT_THAT(is_folder.message, testing::StartsWith("'"));  // the name comes once
  EXPECT_THAT(is_folder.message, testing::EndsWith("meshes' is a folder"));
}

TEST_F(SceneFiles, LengthsAreCheckedOnceAMeshFileHasToldTheDimension) {
  write("meshes/part.msh", "");
  const Scene scene = read_scene(write("s.toml", R"([[body]]
name = "b"
mesh = "meshes/part.msh"
young = 1
poisson = 0.3
[[fix]]
body = "b"
on = "a"
value = [0, 0]
)"));
  check_dimension(scene, 2);
  EXPECT_THAT(test::outcome([&] { check_dimension(scene, 3); }).message,
              HasSubstr("s.toml:9: fix.0.value: expected 3 components, found 2"));
}

}  // namespace
}  // namespace signorini
