// Parts of symmetric bodies against the whole: exactly where the mesh of the part is a part of the whole mesh.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/fem/recovery/stress.hpp"
#include "core/mesh/build.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/structured.hpp"
#include "driver/driver.hpp"
#include "mesh_file.hpp"
#include "run.hpp"
#include "tests/support/nightly.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A mesh on one side of planes of symmetry with its mirror images.
template <int D>
Mesh<D> whole_of(Mesh<D> part, const std::vector<Mirror>& mirrors) {
  for (const Mirror& mirror : mirrors) {
    RawMesh<D> raw{part.points, part.elements, {}, {}, {}};
    std::vector<Index> image;
    for (const Point<D>& x : part.points) {
      image.push_back(lies_on<D>(mirror, x) ? static_cast<Index>(image.size()) : static_cast<Index>(raw.points.size()));
      if (!lies_on<D>(mirror, x)) raw.points.push_back(reflected<D>(mirror, x));
    }
    const auto of = [&](auto vertices) {
      for (Index& v : vertices) v = image[v];
      return vertices;
    };
    for (const auto& element : part.elements) raw.elements.push_back(of(element));
    for (const Part& named : part.parts) {
      FaceGroup<D>& group = raw.groups.emplace_back(FaceGroup<D>{named.name, {}});
      for (const Index f : named.faces)
        for (const bool other : {false, true})
          group.faces.push_back(other ? of(part.boundary[f].vertices) : part.boundary[f].vertices);
    }
    part = build_mesh(std::move(raw), "whole");
  }
  return part;
}

std::string planes(const std::vector<Mirror>& mirrors) {
  std::string out = "[symmetry]\n";
  for (const Mirror& mirror : mirrors) out += fmt::format("{} = {}\n", axis_name(mirror.axis), mirror.at);
  return out;
}

/// A body from a part's mesh or from the whole's, and the rest of the scene.
template <int D>
Report solved(const Mesh<D>& mesh, const std::string& body, const std::string& rest) {
  const TemporaryFolder folder;
  const std::string text = fmt::format("[[body]]\nname = \"b\"\nmesh = \"{}\"\ngeometry = \"facets\"\n{}\n{}",
                                       folder.write("mesh.msh", msh(mesh, Motion<D>())), body, rest);
  Driver driver(parse_scene(text, "test.toml", ".", std::vector<std::string>{"solver.tolerance=1e-13"}));
  driver.solve();
  EXPECT_TRUE(driver.report().converged()) << driver.report().reason();
  return driver.report();
}

void expect_near(const std::vector<double>& found, const std::vector<double>& wanted, double most, const char* what) {
  ASSERT_EQ(found.size(), wanted.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], most) << what << " " << i;
}

/// @param pressures how far those that are recovered may differ, relative
void expect_same(const Report& part, const Report& whole, int copies, double tolerance, double pressures) {
  const StepReport &a = part.last(), &b = whole.last();
  EXPECT_EQ(a.bodies[0].copies, copies);
  EXPECT_EQ(b.bodies[0].copies, 1);
  EXPECT_NEAR(a.summary.energy / b.summary.energy, 1, tolerance);
  double size = 0;
  for (const ContactReport& contact : b.contact)
    for (const double f : contact.force) size = std::max(size, std::abs(f));
  for (std::size_t k = 0; k < b.contact.size(); ++k) {
    const ContactReport &p = a.contact[k], &w = b.contact[k];
    expect_near(p.force, w.force, tolerance * size, "force");
    expect_near(p.normal_force, w.normal_force, tolerance * size, "normal force");
    expect_near(p.tangential_force, w.tangential_force, tolerance * size, "tangential force");
    expect_near(p.moment, w.moment, tolerance * size, "moment");
    expect_near(p.displacement, w.displacement, tolerance, "displacement");
    EXPECT_NEAR(p.dissipated, w.dissipated, tolerance * (std::abs(b.summary.energy) + w.dissipated));
    EXPECT_NEAR(p.undetermined_force, w.undetermined_force, tolerance * size);
    EXPECT_NEAR(p.area / w.area, 1, pressures);
    EXPECT_NEAR(p.radius / w.radius, 1, pressures);
    EXPECT_NEAR(p.max_pressure / w.max_pressure, 1, pressures);
  }
  for (std::size_t k = 0; k < a.applied.size(); ++k)
    expect_near(a.applied[k].force, b.applied[k].force, tolerance * std::max(size, 1.0), "applied");
  for (std::size_t k = 0; k < b.reactions.size(); ++k)
    expect_near(a.reactions[k].force, b.reactions[k].force, tolerance * std::max(size, 1.0), "reaction");
  expect_near(a.balance[0].contact, b.balance[0].contact, tolerance * size, "sum of contacts");
  expect_near(a.balance[0].reactions, b.balance[0].reactions, tolerance * std::max(size, 1.0), "sum of reactions");
  for (std::size_t k = 0; k < b.probes.size(); ++k)
    expect_near(a.probes[k].value, b.probes[k].value, tolerance, "probe");
}

const std::string fix_top2 = "[[fix]]\nbody = \"b\"\non = \"top\"\nvalue = [\"0.002*x\", \"-0.02*t\"]\n",
                  load2 = "[[load]]\nbody = \"b\"\nvalue = [\"-0.01*x\", -0.01]\n",
                  probe2 = "[[probe]]\nname = \"p\"\nbody = \"b\"\nat = [-0.4, 0.3]\n";

std::string sphere2(const std::string& type) {
  return "[[obstacle]]\n" + type +
         "\nbody = \"b\"\non = \"bottom\"\nshape = \"sphere\"\ncenter = [0, -3]\nradius = 3\n";
}

TEST(Symmetry, HalvesInThePlane) {
  const std::vector<Mirror> mirrors{{0, 0.0}};
  const Mesh<2> half = rectangle({0, 0}, {1, 1}, {6, 6}), whole = whole_of(half, mirrors);
  for (const char* material : {"order = 1\nyoung = 1\npoisson = 0.3\n", "young = 1\npoisson = 0.3\n",
                               "order = 1\nyoung = 1\npoisson = 0.3\nplane = \"stress\"\n"})
    for (const char* type :
         {"type = \"contact\"", "type = \"tresca\"\nbound = 0.002", "type = \"coulomb\"\nfriction = 0.2"}) {
      const std::string rest =
          fix_top2 + load2 + probe2 + sphere2(type) + "[refine]\nuniform = 2\n[steps]\ncount = 2\n";
      SCOPED_TRACE(std::string(material) + type);
      expect_same(solved(half, material, rest + planes(mirrors)), solved(whole, material, rest), 2, 1e-9, 1e-6);
    }
}

/// Stresses on the plane of symmetry are those that the whole body has there.
template <int D>
void expect_stresses_of_the_whole(const Mesh<D>& part, const std::string& rest) {
  const std::vector<Mirror> mirrors{{.axis = 0, .at = 0}};
  const TemporaryFolder folder;
  for (const int order : {1, 2}) {
    const auto recovered = [&](const Mesh<D>& mesh, const char* name, const std::string& planes) {
      const std::string text = fmt::format(
          "[[body]]\nname = \"b\"\nmesh = \"{}\"\ngeometry = \"facets\"\norder = {}\nyoung = 1\npoisson = 0.3\n{}{}",
          folder.write(name, msh(mesh, Motion<D>())), order, planes, rest);
      const auto r = run<D, D>(text, {"solver.tolerance=1e-12"});
      const std::vector<Stress> stress = nodal_stress(r.nodes(), r.model, r.u());
      std::map<Point<D>, Stress> out;
      for (Index v = 0; v < r.mesh().vertices(); ++v)
        if (lies_on<D>(mirrors[0], r.mesh().points[v])) out[r.mesh().points[v]] = stress[v];
      return out;
    };
    const auto of_part = recovered(part, "part.msh", planes(mirrors));
    const auto of_whole = recovered(whole_of(part, mirrors), "whole.msh", "");
    ASSERT_EQ(of_part.size(), of_whole.size());
    for (const auto& [x, stress] : of_part)
      for (int k = 0; k < 6; ++k) EXPECT_NEAR(stress[k], of_whole.at(x)[k], 1e-8) << "order " << order << ", " << k;
  }
}

TEST(Symmetry, StressesOnPlanes) {
  expect_stresses_of_the_whole<2>(rectangle({0, 0}, {1, 1}, {5, 5}),
                                  "[[fix]]\nbody = \"b\"\non = \"bottom\"\nvalue = [0, 0]\n"
                                  "[[load]]\nbody = \"b\"\non = \"top\"\nvalue = [\"-x\", \"x^2-1\"]\n");
  expect_stresses_of_the_whole<3>(box({0, 0, 0}, {1, 1, 1}, {3, 3, 3}),
                                  "[[fix]]\nbody = \"b\"\non = \"bottom\"\nvalue = [0, 0, 0]\n"
                                  "[[load]]\nbody = \"b\"\non = \"top\"\nvalue = [\"-x\", \"y\", \"x^2-1\"]\n");
}

// Quadratic displacements, which linear elements have exactly at the nodes of uniform meshes: linear stresses, up to
// where the plane meets the boundary.
TEST(Symmetry, LinearStressesOfAHalfAreExact) {
  const double young = 3.7, nu = 0.3, mu = young / 2 / (1 + nu), lambda = young * nu / (1 + nu) / (1 - 2 * nu);
  const std::string text =
      "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [-1, -1]\nto = [1, 1]\ncells = [4, 4]\norder = 1\nyoung = "
      "3.7\n"
      "poisson = 0.3\n[symmetry]\nx = 0\n[[fix]]\nbody = \"b\"\non = \"boundary\"\nvalue = [\"0.6 * x * y + 0.2 * "
      "x\", \"-0.3 * x^2 + 0.45 * y^2\"]\n[[load]]\nbody = \"b\"\nvalue = [0, -5.763461538461538]\n[refine]\nuniform "
      "= 2\n";
  const auto r = run<2, 2>(text, {"solver.tolerance=1e-12"});
  const std::vector<Stress> stress = nodal_stress(r.nodes(), r.model, r.u());
  for (Index v = 0; v < r.mesh().vertices(); ++v) {
    const double y = r.mesh().points[v][1], xx = 0.6 * y + 0.2, yy = 0.9 * y;
    EXPECT_NEAR(stress[v][0], (lambda + 2 * mu) * xx + lambda * yy, 1e-8);
    EXPECT_NEAR(stress[v][1], (lambda + 2 * mu) * yy + lambda * xx, 1e-8);
  }
}

TEST(Symmetry, HalvesOfRubber) {
  const std::vector<Mirror> mirrors{{0, 0.0}};
  const Mesh<2> half = rectangle({0, 0}, {1, 1}, {4, 4}), whole = whole_of(half, mirrors);
  const std::string material = "young = 1\npoisson = 0.499\n",
                    rest = fix_top2 + sphere2("type = \"contact\"") + "[refine]\nuniform = 2\n";
  expect_same(solved(half, material, rest + planes(mirrors)), solved(whole, material, rest), 2, 1e-7, 1e-6);
}

TEST(Symmetry, QuartersInSpace) {
  const std::vector<Mirror> mirrors{{0, 0.5}, {1, 0.0}};
  const Mesh<3> quarter = box({0.5, 0, 0}, {1.5, 1, 1}, {3, 3, 3}), whole = whole_of(quarter, mirrors);
  // The load on the side that is meshed stands for one on the other side, too, which is another one of the whole.
  const std::string left = "[[load]]\nbody = \"b\"\nwhere = \"x == -0.5\"\nvalue = [-0.003, \"0.001*y\", 0.001]\n";
  for (const char* order : {"order = 1\n", ""})
    for (const char* type : {"type = \"contact\"", "type = \"coulomb\"\nfriction = 0.3"}) {
      const std::string material = std::string("young = 1\npoisson = 0.3\n") + order;
      const std::string rest = fmt::format(
          "[[fix]]\nbody = \"b\"\non = \"top\"\nvalue = [0, 0, -0.02]\n"
          "[[load]]\nbody = \"b\"\nwhere = \"x == 1.5\"\nvalue = [0.003, \"0.001*y\", 0.001]\n"
          "[[obstacle]]\n{}\nbody = \"b\"\non = \"bottom\"\nshape = \"sphere\"\ncenter = [0.5, 0, -3]\nradius = 3\n"
          "[[probe]]\nname = \"p\"\nbody = \"b\"\nat = [-0.2, -0.3, 0.3]\n[refine]\nuniform = {}\n",
          type, *order ? 1 : 0);
      SCOPED_TRACE(material + type);
      expect_same(solved(quarter, material, rest + planes(mirrors)), solved(whole, material, rest + left), 4, 1e-9,
                  1e-6);
    }
}

TEST(Symmetry, QuarterOfAMembrane) {
  const std::vector<Mirror> mirrors{{0, 0.0}, {1, 0.0}};
  const Mesh<2> quarter = rectangle({0, 0}, {1, 1}, {6, 6}), whole = whole_of(quarter, mirrors);
  for (const char* order : {"", "order = 2\n"}) {
    const std::string material = std::string("equation = \"diffusion\"\n") + order;
    const std::string rest =
        "[[fix]]\nbody = \"b\"\nwhere = \"abs(x) == 1 || abs(y) == 1\"\nvalue = 0\n"
        "[[load]]\nbody = \"b\"\nvalue = \"-10*(1 + x^2)\"\n"
        "[[obstacle]]\ntype = \"scalar\"\nbody = \"b\"\nlower = \"-0.5 - 0.1*y^2\"\n"
        "[[probe]]\nname = \"p\"\nbody = \"b\"\nat = [-0.3, 0.4]\n[refine]\nuniform = 2\n";
    expect_same(solved(quarter, material, rest + planes(mirrors)), solved(whole, material, rest), 4, 1e-9, 1e-6);
  }
}

/// A cube squeezed between two spheres, of which one is in the scene of the eighth: its force is that of one, and not
/// of both. Three planes hold the eighth.
TEST(Symmetry, EighthOfASqueezedCube) {
  const std::vector<Mirror> mirrors{{0, 0.0}, {1, 0.0}, {2, 0.0}};
  const Mesh<3> eighth = box({0, 0, 0}, {1, 1, 1}, {3, 3, 3});
  const auto sphere = [](int side) {
    return fmt::format(
        "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\nwhere = \"z == {0}\"\nshape = \"sphere\"\n"
        "center = [0, 0, {1}]\nradius = 3\n",
        side, side * 3.98);
  };
  const std::string material = "order = 1\nyoung = 1\npoisson = 0.3\n", fine = "[refine]\nuniform = 1\n";
  const Report part = solved(eighth, material, sphere(1) + fine + planes(mirrors)),
               whole = solved(whole_of(eighth, mirrors), material, sphere(1) + sphere(-1) + fine);
  const StepReport &a = part.last(), &b = whole.last();
  EXPECT_EQ(a.bodies[0].copies, 8);
  EXPECT_NEAR(a.summary.energy / b.summary.energy, 1, 1e-8);
  EXPECT_NEAR(a.contact[0].force[2] / b.contact[0].force[2], 1, 1e-8);
  EXPECT_NEAR(a.contact[0].area / b.contact[0].area, 1, 0.02);
  EXPECT_NEAR(a.contact[0].max_pressure / b.contact[0].max_pressure, 1, 0.02);
  EXPECT_LT(b.contact[0].force[2], -1e-3);
}

/// Two bodies from meshes, "u" on "l", the gap between their flat sides one of curved ones.
template <int D>
Report solved_pair(const Mesh<D>& upper, const Mesh<D>& lower, const std::string& type, const std::string& rest) {
  const TemporaryFolder folder;
  std::string text;
  for (const auto& [name, mesh] : {std::pair{"u", &upper}, std::pair{"l", &lower}})
    text += fmt::format(
        "[[body]]\nname = \"{0}\"\nmesh = \"{1}\"\ngeometry = \"facets\"\norder = 1\nyoung = 1\npoisson = 0.3\n", name,
        folder.write(name + std::string(".msh"), msh(*mesh, Motion<D>())));
  text += fmt::format(
      "[[obstacle]]\n{}\nbody = \"u\"\non = \"bottom\"\nother = \"l\"\nother_on = \"top\"\n"
      "gap = \"0.02*(x^2 + {})\"\n[refine]\nuniform = {}\n[steps]\ncount = 2\n{}",
      type, D == 3 ? "y^2" : "0", D == 3 ? nightly(2, 1) : 1, rest);
  Driver driver(parse_scene(text, "test.toml", ".", std::vector<std::string>{"solver.tolerance=1e-13"}));
  driver.solve();
  EXPECT_TRUE(driver.report().converged()) << driver.report().reason();
  return driver.report();
}

TEST(Symmetry, BodiesThatTouchEachOther) {
  const std::string held =
      "[[fix]]\nbody = \"u\"\non = \"top\"\nvalue = [{0}, \"-0.02*t\"]\n"
      "[[fix]]\nbody = \"l\"\non = \"bottom\"\nvalue = [{0}, 0]\n";
  const std::vector<Mirror> in_plane{{0, 0.0}}, in_space{{0, 0.0}, {1, 0.0}};
  Mesh<2> upper = rectangle({0, 1}, {1, 2}, {7, 6});
  for (Point<2>& x : upper.points) x[1] += 0.02 * x[0] * x[0];  // the normal at the plane is not that of its one face
  const Mesh<2> lower = rectangle({0, 0}, {1.5, 1}, {6, 4});
  const Mesh<3> cube = box({0, 0, 1}, {1, 1, 2}, {3, 3, 3}), slab = box({0, 0, 0}, {1.5, 1.5, 1}, {4, 4, 2});
  for (const char* type : {"type = \"elastic\"", "type = \"elastic_coulomb\"\nfriction = 0.2"}) {
    SCOPED_TRACE(type);
    const std::string flat = fmt::format(fmt::runtime(held), "\"0.002*x\""),
                      space = fmt::format(fmt::runtime(held), "\"0.002*x\", 0");
    const Report half = solved_pair(upper, lower, type, flat + planes(in_plane)),
                 two = solved_pair(whole_of(upper, in_plane), whole_of(lower, in_plane), type, flat);
    expect_same(half, two, 2, 1e-9, 1e-6);
    EXPECT_NEAR(half.last().balance[1].contact[1], two.last().balance[1].contact[1], 1e-9);
    expect_same(solved_pair(cube, slab, type, space + planes(in_space)),
                solved_pair(whole_of(cube, in_space), whole_of(slab, in_space), type, space), 4, 1e-9, 1e-6);
  }
}

/// What planes of symmetry leave of the rigid motions: along the plane, and turns around what is across it.
TEST(Symmetry, BodiesThatNothingElseHolds) {
  const std::string lying = "[[load]]\nbody = \"b\"\nvalue = [0, {}-0.01]\n[refine]\nuniform = 1\n",
                    on_floor = "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\non = \"bottom\"\nshape = \"plane\"\n";
  const std::string material = "order = 1\nyoung = 1\npoisson = 0.3\n";
  const std::vector<Mirror> one{{0, 0.0}}, two{{0, 0.0}, {1, 0.0}};
  const Mesh<2> half = rectangle({0, 0}, {1, 1}, {4, 4});
  const std::string in_plane = fmt::format(fmt::runtime(lying), "") + on_floor + "point = [0, 0]\nnormal = [0, 1]\n";
  const Report flat = solved(half, material, in_plane + planes(one));
  EXPECT_NEAR(flat.last().contact[0].force[1], 0.02, 1e-10);
  expect_same(flat, solved(whole_of(half, one), material, in_plane), 2, 1e-8, 1e-6);
  const Mesh<3> quarter = box({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), beside = whole_of(quarter, {two[1]});
  const std::string in_space =
      fmt::format(fmt::runtime(lying), "0, ") + on_floor + "point = [0, 0, 0]\nnormal = [0, 0, 1]\n";
  const Report whole = solved(whole_of(beside, one), material, in_space);
  expect_same(solved(quarter, material, in_space + planes(two)), whole, 4, 1e-8, 1e-6);
  expect_same(solved(beside, material, in_space + planes(one)), whole, 2, 1e-8, 1e-6);
}

double volume(const Mesh<3>& mesh) {
  double sum = 0;
  for (const auto& e : mesh.elements) sum += signed_volume<3>(corners<3>(mesh.points, e));
  return sum;
}
double volume(const Mesh<2>& mesh) {
  double sum = 0;
  for (const auto& e : mesh.elements) sum += signed_volume<2>(corners<2>(mesh.points, e));
  return sum;
}

/// The finest mesh of a shape of which planes leave a part.
template <int D>
Mesh<D> part_of(const std::string& shape, const std::string& planes, int refinements = 1) {
  const Scene scene = parse_scene(
      fmt::format("[[body]]\nname = \"b\"\nequation = \"diffusion\"\n{}\n[[fix]]\nbody = \"b\"\non = \"boundary\"\n"
                  "value = 0\n[symmetry]\n{}\n[refine]\nuniform = {}\n",
                  shape, planes, refinements),
      "test.toml", ".");
  return build_hierarchy<D>(scene, 1).finest();
}

template <int D>
void expect_part(const std::string& shape, const std::string& planes, int copies, double measure,
                 const std::vector<std::string>& parts) {
  SCOPED_TRACE(shape + planes);
  const Mesh<D> mesh = part_of<D>(shape, planes);
  EXPECT_NEAR(copies * volume(mesh) / measure, 1, 0.02);
  std::vector<std::string> names;
  for (const Part& part : mesh.parts)
    if (!part.faces.empty()) names.push_back(part.name);
  EXPECT_EQ(names, parts);
  EXPECT_EQ(1 << mesh.mirrors.size(), copies);
  for (const Mirror& mirror : mesh.mirrors) {
    Index on = 0;
    for (const Point<D>& x : mesh.points) on += lies_on<D>(mirror, x);
    EXPECT_GT(on, 2);
    for (const Face<D>& face : mesh.boundary)
      EXPECT_FALSE(std::ranges::all_of(face.vertices, [&](Index v) { return lies_on<D>(mirror, mesh.points[v]); }));
  }
}

TEST(Symmetry, PartsOfShapes) {
  const std::string disk = "shape = \"disk\"\ncenter = [1, 2]\nradius = 2\nsize = 0.4",
                    half_disk = "shape = \"half_disk\"\ncenter = [1, 2]\nradius = 2\nsize = 0.4",
                    ball = "shape = \"ball\"\ncenter = [1, 2, 0]\nradius = 2\nsize = 0.5",
                    half_ball = "shape = \"half_ball\"\ncenter = [1, 2, 0]\nradius = 2\nsize = 0.5",
                    cylinder = "shape = \"cylinder\"\ncenter = [1, 2, 0]\nradius = 2\nheight = 3\nsize = 0.6",
                    house = "shape = \"polygon\"\npoints = [[0, 0], [2, 0], [2, 1], [1, 2], [0, 1]]\nsize = 0.3",
                    cross = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [4, 4]";
  for (const auto& [given, copies] : std::map<std::string, int>{{"x=1", 2}, {"y=2", 2}, {"x=1\ny=2", 4}})
    expect_part<2>(disk, given, copies, 4 * pi, {});
  expect_part<2>(half_disk, "x=1", 2, 2 * pi, {"curved", "flat"});
  expect_part<2>(half_disk, "y=2", 2, 4 * pi, {"curved"});
  expect_part<2>(house, "x=1", 2, 3, {"edge0", "edge1", "edge2"});
  expect_part<2>(cross, "x=1", 2, 2, {"right", "bottom", "top"});
  expect_part<2>("shape = \"rectangle\"\nfrom = [0, 0]\nto = [2, 1]\ncells = [5, 3]", "x=1", 2, 2,
                 {"right", "bottom", "top"});
  for (const auto& [given, copies] :
       std::map<std::string, int>{{"x=1", 2}, {"y=2", 2}, {"z=0", 2}, {"x=1\nz=0", 4}, {"x=1\ny=2\nz=0", 8}}) {
    expect_part<3>(ball, given, copies, 32 * pi / 3, {});
    expect_part<3>(cylinder, given, copies, 12 * pi,
                   given.find('z') == std::string::npos ? std::vector<std::string>{"bottom", "top", "side"}
                                                        : std::vector<std::string>{"top", "side"});
  }
  expect_part<3>(half_ball, "x=1\ny=2", 4, 16 * pi / 3, {"flat", "curved"});
  expect_part<3>(half_ball, "z=0\ny=2", 4, 32 * pi / 3, {"curved"});
}

/// On the coarsest mesh with one refinement: the quarter of the ball against Hertz and the whole ball.
TEST(Symmetry, QuarterOfHertzsBall) {
  const double modulus = 1 / (1 - 0.3 * 0.3);
  const auto solve = [](const std::vector<std::string>& more) {
    std::vector<std::string> overrides{"refine.uniform=1", "body.0.order=2"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    Driver driver(read_scene(shipped_scenes / "ball_on_plane.toml", overrides));
    driver.solve();
    return driver.report();
  };
  const Report quarter = solve({"symmetry.x=0", "symmetry.y=0"}), whole = solve({});
  const ContactReport &q = quarter.last().contact[0], &w = whole.last().contact[0];
  const double a = std::cbrt(3 * q.force[2] / (4 * modulus)), p0 = 3 * q.force[2] / (2 * pi * a * a);
  show("quarter: {} unknowns, force {:.6e}, radius {:+.4f}, pressure {:+.4f}; whole: {} unknowns, force {:.6e}\n",
       quarter.last().summary.level_unknowns.back(), q.force[2], q.radius / a - 1, q.max_pressure / p0 - 1,
       whole.last().summary.level_unknowns.back(), w.force[2]);
  EXPECT_NEAR(q.force[2] / w.force[2], 1, 2e-3);
  EXPECT_NEAR(q.radius / a, 1, 0.015);
  EXPECT_NEAR(q.max_pressure / p0, 1, 0.015);
  EXPECT_LT(2.5 * quarter.last().summary.level_unknowns.back(), whole.last().summary.level_unknowns.back());
  EXPECT_NEAR(q.displacement[2] / w.displacement[2], 1, 2e-3);
  EXPECT_EQ(q.force[0], 0);
}

// Quadratic elements of both.
TEST(Symmetry, QuarterOfABallAgreesWithTheAxisymmetricOne) {
  const auto space =
      run_shipped<3, 3>("ball_on_plane.toml", {uniform(1), "body.0.order=2", "symmetry.x=0", "symmetry.y=0"});
  const auto r = run_shipped<2, 2>("ball_axisymmetric.toml", {uniform(3), "body.0.order=2"});
  show("quadratic forces: in space {:.6e}, axisymmetric {:.6e}\n", 4 * space.contact().force[2], r.contact().force[1]);
  EXPECT_NEAR(4 * space.contact().force[2] / r.contact().force[1], 1, 2e-3);
}

/// What the driver says against a scene with a rectangle -1 < x < 1, 0 < y < 1, x = 0 a plane of symmetry.
std::string refusal(const std::string& rest, const std::string& given = "x = 0") {
  try {
    Driver driver(
        parse_scene("[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [-1, 0]\nto = [1, 1]\n"
                    "cells = [4, 2]\norder = 1\nyoung = 1\npoisson = 0.3\n[symmetry]\n" +
                        given + "\n" + rest,
                    "test.toml", "."));
    driver.solve();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string fix(const std::string& where, const std::string& value) {
  return fmt::format("[[fix]]\nbody = \"b\"\n{}\nvalue = {}\n", where, value);
}
std::string load(const std::string& where, const std::string& value) {
  return fmt::format("[[load]]\nbody = \"b\"\n{}\nvalue = {}\n", where, value);
}
std::string floor(const std::string& more) {
  return "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\non = \"bottom\"\n" + more;
}

TEST(Symmetry, RefusesWhatIsNotSymmetric) {
  const std::string held = fix("on = \"top\"", "[0, 0]");
  EXPECT_THAT(refusal(load("", "[0, -0.01]")), HasSubstr("translation along (0, -1)"));
  EXPECT_EQ(refusal(held), "");
  EXPECT_THAT(refusal(held, "r = 0"), HasSubstr("unknown key 'r'"));
  EXPECT_THAT(refusal(held, "x = \"middle\""), HasSubstr("symmetry.x"));
  EXPECT_THAT(refusal(held, "x = inf"), HasSubstr("symmetry.x"));
  EXPECT_THAT(refusal(held, "z = 0"), AllOf(HasSubstr("symmetry.z"), HasSubstr("2 dimensions")));
  EXPECT_THAT(refusal(held, "x = 0.5"), AllOf(HasSubstr("symmetry.x"), HasSubstr("not in its middle")));
  EXPECT_THAT(refusal(held, "x = 2"), AllOf(HasSubstr("symmetry.x"), HasSubstr("no face on the plane of symmetry")));
  EXPECT_THAT(refusal(held + fix("on = \"left\"", "[0, 0]")), HasSubstr("fix.1"));
  EXPECT_THAT(refusal(fix("on = \"top\"", "[0.1, 0]")),
              AllOf(HasSubstr("fix.0"), HasSubstr("not symmetric about x = 0")));
  EXPECT_THAT(refusal(fix("where = \"y == 1 && x > -0.6\"", "[0, 0]")), HasSubstr("their images"));
  EXPECT_THAT(refusal(held + load("", "[0.1, 0]")), AllOf(HasSubstr("load"), HasSubstr("not symmetric")));
  EXPECT_THAT(refusal(held + load("on = \"bottom\"", "[0, \"0.1*x\"]")), HasSubstr("load.0"));
  EXPECT_EQ(refusal(held + load("on = \"right\"", "[0.1, 0.2]")), "");
  EXPECT_EQ(refusal(held + load("", "[\"0.1*sin(pi)\", -0.1]")), "");  // rounding of zero
  EXPECT_EQ(refusal(held + load("on = \"bottom\"", "[\"-0.01*x\", \"0.01*x^2\"]")), "");
  EXPECT_THAT(refusal(held + floor("shape = \"plane\"\npoint = [0, 0]\nnormal = [0.1, 1]\n")),
              AllOf(HasSubstr("obstacle.0"), HasSubstr("not symmetric")));
  EXPECT_THAT(refusal(held + floor("shape = \"sphere\"\ncenter = [0.1, -3]\nradius = 3\n")), HasSubstr("obstacle.0"));
  EXPECT_EQ(refusal(held + floor("shape = \"sphere\"\ncenter = [0, -3]\nradius = 3\n")), "");
  const std::string dragged =
      "[[obstacle]]\ntype = \"coulomb\"\nfriction = {}\nbody = \"b\"\non = \"bottom\"\n"
      "shape = \"plane\"\npoint = [{}, 0]\nnormal = [0, 1]\n[steps]\ncount = 2\n";
  EXPECT_THAT(refusal(fix("on = \"top\"", "[0, -0.01]") + fmt::format(fmt::runtime(dragged), 0.3, "\"0.01*t\"")),
              AllOf(HasSubstr("obstacle.0"), HasSubstr("motion")));
  EXPECT_THAT(refusal(fix("on = \"top\"", "[0, -0.01]") + fmt::format(fmt::runtime(dragged), "\"0.3+0.1*x\"", 0)),
              AllOf(HasSubstr("obstacle.0"), HasSubstr("option")));
}

/// A tube between two planes, of which the upper half is meshed, without axial strain: Lame.
TEST(Symmetry, HalfOfAnAxisymmetricTube) {
  const std::string tube =
      "[[body]]\nname = \"b\"\nshape = \"rectangle\"\nfrom = [1, -1]\nto = [2, 1]\ncells = [8, 8]\n"
      "plane = \"axisymmetric\"\norder = 1\nyoung = 1\npoisson = 0.3\n" +
      fix("where = \"abs(y) == 1\"", "[\"free\", 0]") + load("on = \"left\"", "[0.01, 0]");
  const auto solve = [](const std::string& text) {
    Driver driver(parse_scene(text, "test.toml", "."));
    driver.solve();
    return driver.report();
  };
  const Report half = solve(tube + "[symmetry]\ny = 0\n"), whole = solve(tube);
  EXPECT_NEAR(half.last().applied[0].force[0], 0.01 * 2 * pi * 2, 1e-12);
  EXPECT_NEAR(half.last().summary.energy / whole.last().summary.energy, 1, 1e-3);
  EXPECT_THAT([&] { solve(tube + "[symmetry]\nx = 0\n"); },
              testing::ThrowsMessage<Error>(HasSubstr("radius of the axisymmetric body")));
}

}  // namespace
}  // namespace signorini::test
