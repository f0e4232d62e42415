// Bodies of several materials, told apart by the volumes of their mesh files.
#include "core/base/error.hpp"
#include "core/mesh/structured.hpp"
#include "mesh_file.hpp"
#include "run.hpp"

namespace signorini::test {
namespace {

/// A bar over [0, 3] of unit height: MSH 2.2 with the volumes "left third", "middle" and "rest".
std::string bar_with_volumes(const Mesh<2>& mesh) {
  std::string out =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"left\"\n1 2 \"right\"\n2 11 \"left third\"\n"
      "2 12 \"middle\"\n2 13 \"rest\"\n$EndPhysicalNames\n";
  out += fmt::format("$Nodes\n{}\n", mesh.points.size());
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    out += fmt::format("{} {:.17g} {:.17g} 0\n", p + 1, mesh.points[p][0], mesh.points[p][1]);
  std::string elements;
  int count = 0;
  for (const Part& part : mesh.parts)
    if (part.name == "left" || part.name == "right")
      for (const Index f : part.faces)
        elements += fmt::format("{} 1 2 {} 1 {} {}\n", ++count, part.name == "left" ? 1 : 2,
                                mesh.boundary[f].vertices[0] + 1, mesh.boundary[f].vertices[1] + 1);
  for (const auto& e : mesh.elements) {
    const double x = (mesh.points[e[0]][0] + mesh.points[e[1]][0] + mesh.points[e[2]][0]) / 3;
    elements += fmt::format("{} 2 2 {} 1 {} {} {}\n", ++count,
                            x < 1   ? 11
                            : x < 2 ? 12
                                    : 13,
                            e[0] + 1, e[1] + 1, e[2] + 1);
  }
  return out + fmt::format("$EndNodes\n$Elements\n{}\n{}$EndElements\n", count, elements);
}

class Materials : public testing::Test {
 protected:
  Materials() : file_(folder_.write("bar.msh", bar_with_volumes(rectangle({0, 0}, {3, 1}, {6, 2})))) {}

  std::string scene(const std::string& body, const std::string& more, const std::string& value = "0") const {
    return fmt::format(
        "[[body]]\nname = \"b\"\nmesh = \"{}\"\n{}\n[[fix]]\nbody = \"b\"\non = \"left\"\nvalue = [{}]\n{}\n"
        "[[obstacle]]\nbody = \"b\"\n{}",
        file_, body, value, more, obstacle);
  }
  std::string obstacle;

  TemporaryFolder folder_;
  std::string file_;
};

// Springs in series: the flux through all of them is one, the value rises by flux times length over coefficient.
TEST_F(Materials, OfADiffusionEquationAreSpringsInSeries) {
  obstacle = "type = \"scalar\"\nlower = -100";
  const std::string text = scene("equation = \"diffusion\"\ndiffusion = 2",
                                 "[[material]]\nbody = \"b\"\nvolume = \"left third\"\ndiffusion = 0.5\n"
                                 "[[material]]\nbody = \"b\"\nvolume = \"middle\"\ndiffusion = \"4 + 0*x\"\n"
                                 "[[load]]\nbody = \"b\"\non = \"right\"\nvalue = [3]\n");
  for (const int refinements : {0, 2}) {
    const auto r = run<2, 1>(text, {uniform(refinements)});
    for (Index p = 0; p < r.mesh().vertices(); ++p) {
      const double x = r.mesh().points[p][0];
      const double expected = 3 * (std::min(x, 1.0) / 0.5 + std::clamp(x - 1, 0.0, 1.0) / 4 + std::max(x - 2, 0.0) / 2);
      EXPECT_NEAR(r.u()[p], expected, 1e-6) << "at x = " << x;
    }
  }
}

// The same body as by expressions, to the last bit but for the order of sums.
TEST_F(Materials, OfAnElasticBodyAreThoseOfAnExpression) {
  obstacle = "type = \"contact\"\non = \"right\"\nshape = \"plane\"\npoint = [3.1, 0]\nnormal = [-1, 0]";
  const std::string load = "[[load]]\nbody = \"b\"\nvalue = [1, 0.1]\n";
  const std::string by_volume =
      scene("young = 10\npoisson = 0.3",
            "[[material]]\nbody = \"b\"\nvolume = \"middle\"\nyoung = 1\npoisson = 0.4\n" + load, "0, 0");
  const std::string by_expression =
      scene("young = \"x > 1 && x < 2 ? 1 : 10\"\npoisson = \"x > 1 && x < 2 ? 0.4 : 0.3\"", load, "0, 0");
  for (const int refinements : {0, 2}) {
    const auto a = run<2, 2>(by_volume, {uniform(refinements)}), b = run<2, 2>(by_expression, {uniform(refinements)});
    ASSERT_EQ(a.u().size(), b.u().size());
    for (std::size_t i = 0; i < a.u().size(); ++i) EXPECT_NEAR(a.u()[i], b.u()[i], 1e-12);
    EXPECT_GT(a.contact().nodes, 0);
  }
}

std::string refusal(const std::string& scene) {
  try {
    run<2, 2>(scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "solved";
}

TEST_F(Materials, ThatAreWrongAreNamed) {
  obstacle = "type = \"contact\"\non = \"right\"\nshape = \"plane\"\npoint = [3.1, 0]\nnormal = [-1, 0]";
  const auto with = [&](const std::string& keys) {
    return refusal(scene("order = 1\nyoung = 10\npoisson = 0.3", "[[material]]\nbody = \"b\"\n" + keys, "0, 0"));
  };
  const auto expect = [](const std::string& message, const char* place, const char* what) {
    EXPECT_NE(message.find(place), std::string::npos) << message;
    EXPECT_NE(message.find(what), std::string::npos) << message;
  };
  expect(with("volume = \"midle\"\nyoung = 1\npoisson = 0.4"), "material.0.volume",
         "there is no volume 'midle'; the physical groups of triangles are: left third, middle, rest");
  expect(with("volume = \"middle\"\nyoung = 1"), "material.0", "missing key 'poisson'");
  expect(with("volume = \"middle\"\nyoung = 1\npoisson = 0.4\ndiffusion = 1"), "material.0.diffusion", "no meaning");
  expect(with("volume = \"middle\"\nyoung = -1\npoisson = 0.4"), "material.0.young", "-1");
  expect(with("volume = \"middle\"\nyoung = 1\npoisson = 0.4\n[[material]]\nbody = \"b\"\nvolume = \"middle\"\n"
              "young = 2\npoisson = 0.4"),
         "material.1.volume", "shares triangles with 'middle'");
}

}  // namespace
}  // namespace signorini::test
