// Fixes and loads at points and along edges.
#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/fem/elements/select_nodes.hpp"
#include "support.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string square =
    "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 2]\nyoung = 2\npoisson = 0.25\n"
    "plane = \"stress\"\n";
const std::string cube =
    "shape = \"box\"\nfrom = [0, 0, 0]\nto = [2, 1, 1]\ncells = [4, 2, 2]\nyoung = 2\npoisson = 0.25\n";

Report solved(const std::string& text) {
  Driver driver(parse_scene(text, "test.toml", ".", std::vector<std::string>{"solver.tolerance=1e-12"}));
  EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  return driver.report();
}

std::string order(int order) { return fmt::format("order = {}\n", order); }

std::vector<std::string> ids(const Report& report) {
  std::vector<std::string> out;
  for (const Warning& warning : report.warnings) out.emplace_back(warning.id);
  return out;
}

// Statically determinate: three points stop a plane body, six components a solid, and let it stretch as it likes. The
// stretched bar is exact, and points that bear nothing make nothing singular.
TEST(Supports, at_points_stop_rigid_motions_and_nothing_else) {
  for (const int p : {1, 2}) {
    const Report plane = solved(text_of(
        square + order(p),
        table("fix", "at = [0, 0]\nvalue = [0, 0]") + table("fix", "at = [0, 1]\nvalue = [0, \"free\"]") +
            table("load", "on = \"right\"\nforce = [0.02, 0]") + table("load", "on = \"left\"\nforce = [-0.02, 0]") +
            table("probe", "name = \"p\"\nat = [2, 1]") + "[refine]\nuniform = 1\n"));
    EXPECT_NEAR(plane.last().probes[0].value[0], 0.02 * 2 / 2, 1e-9);
    EXPECT_NEAR(plane.last().probes[0].value[1], -0.25 * 0.02 / 2, 1e-9);
    EXPECT_THAT(plane.last().undetermined, IsEmpty());
    EXPECT_NEAR(plane.last().reactions[0].force[0], 0, 1e-10);
    EXPECT_THAT(ids(plane), Contains("singular"));
    EXPECT_THAT(ids(plane), Not(Contains("off-vertex")));
    const Report solid = solved(text_of(
        cube + order(p),
        table("fix", "at = [0, 0, 0]\nvalue = [0, 0, 0]") + table("fix", "at = [0, 1, 0]\nvalue = [0, \"free\", 0]") +
            table("fix", "at = [0, 0, 1]\nvalue = [0, \"free\", \"free\"]") +
            table("load", "on = \"right\"\nforce = [0.02, 0, 0]") +
            table("load", "on = \"left\"\nforce = [-0.02, 0, 0]") + table("probe", "name = \"p\"\nat = [2, 1, 1]")));
    EXPECT_NEAR(solid.last().probes[0].value[0], 0.02 * 2 / 2, 1e-9);
    EXPECT_NEAR(solid.last().probes[0].value[1], -0.25 * 0.02 / 2, 1e-9);
    EXPECT_THAT(solid.last().undetermined, IsEmpty());
  }
}

// The whole force is at the vertex, or along the edge, and the reaction is that.
TEST(Supports, loads_at_points_and_along_edges_act_there) {
  for (const int p : {1, 2}) {
    SCOPED_TRACE(order(p));
    const std::string held = table("fix", "on = \"left\"\nvalue = [0, 0, 0]");
    const auto at_point =
        run<3, 3>(text_of(cube + order(p), held + table("load", "at = [2, 1, 1]\nforce = [0, 0, -0.01]")));
    EXPECT_NEAR(sum<3>(at_point.solution.discretization.load)[2], -0.01, 1e-16);
    EXPECT_LT((moment<3>(at_point.nodes(), at_point.solution.discretization.load, {2, 1, 1})).norm(), 1e-16);
    const std::string edge = "on = [\"right\", \"top\"]\n";
    const auto total = run<3, 3>(text_of(cube + order(p), held + table("load", edge + "force = [0, 0, -0.01]")));
    const auto value =
        run<3, 3>(text_of(cube + order(p), held + table("load", edge + "value = [0, 0, \"-0.02 * y\"]")));
    for (const auto* solved : {&total, &value}) {
      EXPECT_NEAR(sum<3>(solved->solution.discretization.load)[2], -0.01, 1e-15);
      EXPECT_NEAR(solved->results.forces.reactions[0][2], 0.01, 1e-8);
    }
    const double middle = 0.5, third = 2.0 / 3;
    EXPECT_LT(moment<3>(total.nodes(), total.solution.discretization.load, {2, middle, 1}).norm(), 1e-15);
    EXPECT_LT(moment<3>(value.nodes(), value.solution.discretization.load, {2, third, 1}).norm(), 1e-15);
  }
}

// A plate on two edges under its weight is a beam of two supports: each bears half, and nothing else holds it upright.
TEST(Supports, along_edges_bear_a_beam) {
  for (const int p : {1, 2}) {
    const Report report =
        solved(text_of(cube + order(p), table("fix", "on = [\"left\", \"bottom\"]\nvalue = [0, 0, 0]") +
                                            table("fix", "on = [\"right\", \"bottom\"]\nvalue = [\"free\", 0, 0]") +
                                            table("load", "force = [0, 0, -0.02]")));
    for (const int k : {0, 1}) EXPECT_NEAR(report.last().reactions[k].force[2], 0.01, 1e-9);
    EXPECT_THAT(report.last().undetermined, IsEmpty());
    EXPECT_THAT(ids(report), Contains("singular"));
  }
}

// A. Flamant 1892: under a force P at the edge of a half plane all is radial pressure, 2 P cos / (pi r), and below the
// force u = const - 2 P / (pi E) log r. The half disk bears that pressure at its rim, so that its support bears
// nothing.
TEST(Supports, a_force_at_a_point_is_that_of_flamant) {
  const double P = 0.01;
  const std::string rim =
      fmt::format("[\"-2*{0}/pi * x * abs(y) / hypot(x, y)^3\", \"2*{0}/pi * y^2 / hypot(x, y)^3\"]", P);
  const Report report = solved(
      text_of("shape = \"half_disk\"\ncenter = [0, 0]\nradius = 8\nsize = \"0.15 + 0.25 * hypot(x, y)\"\nyoung = 1\n"
              "poisson = 0\nplane = \"stress\"\norder = 2\n",
              table("load", fmt::format("at = [0, 0]\nforce = [0, {}]", -P)) +
                  table("load", "on = \"curved\"\nvalue = " + rim) +
                  table("fix", "at = [0, -8]\nvalue = [\"free\", 0]") + table("probe", "name = \"a\"\nat = [0, -1]") +
                  table("probe", "name = \"b\"\nat = [0, -2]") + "[refine]\nuniform = 1\n[symmetry]\nx = 0\n"));
  const double found = report.last().probes[1].value[1] - report.last().probes[0].value[1];
  show("Flamant: {} of {}\n", found, 2 * P / pi * std::log(2.0));
  EXPECT_NEAR(found / (2 * P / pi * std::log(2.0)), 1, 0.02);
  EXPECT_NEAR(report.last().applied[0].force[1], -P, 1e-15);
}

// Half of the body gets half of a force on the plane of symmetry, and the report says the whole.
TEST(Supports, on_a_plane_of_symmetry_are_those_of_both_sides) {
  double sunk[2];
  for (const bool half : {false, true}) {
    const Report report = solved(text_of(
        "shape = \"rectangle\"\nfrom = [-2, 0]\nto = [2, 1]\ncells = [4, 1]\nyoung = 2\npoisson = 0\norder = 2\n",
        table("fix", "on = \"bottom\"\nvalue = [0, 0]") + table("load", "at = [0, 1]\nforce = [0, -0.01]") +
            table("probe", "name = \"p\"\nat = [0.5, 0.5]") + "[refine]\nuniform = 3\n" +
            (half ? "[symmetry]\nx = 0\n" : "")));
    EXPECT_NEAR(report.last().applied[0].force[1], -0.01, 1e-15);
    EXPECT_NEAR(report.last().reactions[0].force[1], 0.01, 1e-9);
    sunk[half] = report.last().probes[0].value[1];
  }
  EXPECT_NEAR(sunk[1] / sunk[0], 1, 5e-3);
}

// A force is that of the whole body, whichever key it is given by: an edge that lies in a plane of symmetry or crosses
// it, and a point in two of them.
TEST(Supports, are_those_of_the_whole_where_planes_of_symmetry_cut_it) {
  const auto pressed = [](const std::string& body, const std::string& load, const std::string& more) {
    const Report report =
        solved(text_of(body, table("load", load) + table("probe", "name = \"p\"\nat = [1.5, 0.5, 0.5]") + more));
    return std::pair{report.last().applied[0].force.back(), report.last().probes[0].value.back()};
  };
  const std::string solid =
                        "shape = \"box\"\nfrom = [-2, -1, 0]\nto = [2, 1, 1]\ncells = [4, 4, 2]\nyoung = 2\n"
                        "poisson = 0.25\norder = 1\n",
                    held = table("fix", "on = \"bottom\"\nvalue = [0, 0, 0]");
  const std::string point = "at = [0, 0, 1]\n", edge = "on = [\"top\", \"front\"]\n";
  for (const auto& [where, length] : {std::pair{point, 1.0}, {edge, 4.0}}) {
    SCOPED_TRACE(where);
    const std::string planes = where == point ? "[symmetry]\nx = 0\ny = 0\n" : "[symmetry]\nx = 0\n";
    const std::string value = fmt::format("{}value = [0, 0, -0.01]", where),
                      force = fmt::format("{}force = [0, 0, {}]", where, -0.01 * length);
    const auto whole = pressed(solid, value, held), half = pressed(solid, value, held + planes),
               total = pressed(solid, force, held + planes);
    EXPECT_NEAR(whole.first, -0.01 * length, 1e-14);
    EXPECT_NEAR(half.first, -0.01 * length, 1e-14);
    EXPECT_NEAR(half.second / total.second, 1, 1e-9);
    EXPECT_NEAR(half.second / whole.second, 1, 0.2);  // the meshes are not each other's images
  }
  const std::string sheet =
      "shape = \"rectangle\"\nfrom = [-1, -1]\nto = [1, 1]\ncells = [8, 8]\n"
      "equation = \"diffusion\"\n" +
      table("fix", "on = \"boundary\"\nvalue = 0") + table("load", "at = [0, 0]\nvalue = 1") +
      table("probe", "name = \"p\"\nat = [0.5, 0.5]");
  const Report whole = solved(text_of(sheet, "")), quarter = solved(text_of(sheet, "[symmetry]\nx = 0\ny = 0\n"));
  EXPECT_NEAR(quarter.last().probes[0].value[0] / whole.last().probes[0].value[0], 1, 0.02);
  EXPECT_NEAR(quarter.last().applied[0].force[0], 1, 1e-14);
}

// Where half a body has an edge in the plane of symmetry, a force per length on it is that of both sides.
TEST(Supports, share_an_edge_in_a_plane_of_symmetry_with_the_other_side) {
  Mesh<3> mesh;
  const std::array<Point<3>, 2> in{{{0, 0, 0}, {0, 1, 0}}}, out{{{0, 0, 0}, {1, 0, 0}}};
  EXPECT_EQ(share_of_side<3>(mesh, in), 1);
  mesh.mirrors = {{0, 0.0}, {1, 0.0}};
  EXPECT_EQ(share_of_side<3>(mesh, in), 0.5);
  EXPECT_EQ(share_of_side<3>(mesh, out), 0.5);
  EXPECT_EQ(share_of_side<3>(mesh, {in.data(), 1}), 0.25);
  EXPECT_EQ(share_of_side<3>(mesh, {out.data() + 1, 1}), 0.5);
}

TEST(Supports, of_one_part_twice_have_no_edge) {
  EXPECT_THAT(refusal([&] {
                solved(text_of(square, table("load", "on = [\"right\", \"right\"]\nvalue = [1, 0]") +
                                           table("fix", "on = \"left\"\nvalue = [0, 0]")));
              }),
              AllOf(HasSubstr("load.0.on"), HasSubstr("'right' stands twice")));
}

// Of a pressure, too: nobody has given a 'value'.
TEST(Supports, loads_that_are_not_symmetric_are_named_by_their_key) {
  const std::string tilted = "on = \"top\"\npressure = \"1 + x\"";
  EXPECT_THAT(refusal([&] {
                solved(text_of(
                    "shape = \"rectangle\"\nfrom = [-1, 0]\nto = [1, 1]\ncells = [2, 2]\nyoung = 2\npoisson = 0\n",
                    table("load", tilted) + table("fix", "on = \"bottom\"\nvalue = [0, 0]") + "[symmetry]\nx = 0\n"));
              }),
              AllOf(HasSubstr("load.0.pressure"), HasSubstr("the load is not symmetric"), Not(HasSubstr("'value'"))));
}

TEST(Supports, of_bodies_that_touch_are_those_of_the_one_they_are_given_for) {
  const std::string material = "young = 2\npoisson = 0\n";
  const Report report = solved(
      "[[body]]\nname = \"low\"\nshape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\n" + material +
      "[[body]]\nname = \"high\"\nshape = \"rectangle\"\nfrom = [0, 1]\nto = [1, 2]\ncells = [2, 2]\n" + material +
      "[[fix]]\nbody = \"low\"\non = \"bottom\"\nvalue = [0, 0]\n"
      "[[fix]]\nbody = \"high\"\nat = [0, 1]\nvalue = [0, \"free\"]\n"
      "[[fix]]\nbody = \"high\"\non = [\"left\", \"top\"]\nvalue = [0, \"free\"]\n"
      "[[load]]\nbody = \"high\"\non = \"top\"\nforce = [0, -0.03]\n"
      "[[obstacle]]\ntype = \"elastic\"\nbody = \"high\"\non = \"bottom\"\nother = \"low\"\nother_on = \"top\"\n");
  EXPECT_NEAR(report.last().contact[0].force[1], 0.03, 1e-8);
  EXPECT_NEAR(report.last().reactions[1].force[0], 0, 1e-8);
}

TEST(Supports, near_no_vertex_are_refused_and_off_one_warned_of) {
  const auto at = [](const std::string& point) {
    return text_of(
        square, table("fix", "on = \"left\"\nvalue = [0, 0]") + table("load", "at = " + point + "\nforce = [0, 1e-3]"));
  };
  EXPECT_THAT(refusal([&] { solved(at("[3, 1]")); }),
              AllOf(HasSubstr("load.0.at"), HasSubstr("no vertex of the mesh is near (3, 1)"), HasSubstr("(2, 1)")));
  const Report near = solved(at("[1.9, 1]"));
  EXPECT_THAT(ids(near), Contains("off-vertex"));
  EXPECT_THAT(refusal([&] { run<2, 2>(text_of(square, table("fix", "on = [\"left\", \"right\"]\nvalue = [0, 0]"))); }),
              HasSubstr("the parts 'left' and 'right' have no point in common"));
}

TEST(Supports, errors_say_what_they_may_be) {
  const auto refused = [&](const std::string& name, const std::string& keys) {
    return refusal([&] {
      parse_scene(text_of(square, table("fix", "on = \"left\"\nvalue = [0, 0]") + table(name, keys)), "s.toml", ".");
    });
  };
  EXPECT_THAT(refused("fix", "on = [\"left\", \"top\", \"right\"]\nvalue = [0, 0]"), HasSubstr("found 3"));
  EXPECT_THAT(refused("fix", "on = \"left\"\nat = [0, 0]\nvalue = [0, 0]"), HasSubstr("both 'on' and 'at'"));
  EXPECT_THAT(refused("fix", "at = [0, 0, 0]\nvalue = [0, 0]"), HasSubstr("expected 2 coordinates, found 3"));
  EXPECT_THAT(refused("fix", "at = [0, 0]\nframe = \"normal\"\nvalue = [0, 0]"),
              HasSubstr("frame 'normal' needs faces"));
  EXPECT_THAT(refused("load", "at = [0, 0]\npressure = 1"), HasSubstr("a pressure needs faces"));
  EXPECT_THAT(refused("load", "at = [0, 0]\ntorque = 1"), HasSubstr("a moment needs faces"));
}

}  // namespace
}  // namespace signorini::test
