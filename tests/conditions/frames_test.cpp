// Cylindrical frames, and loads in frames.
#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/fem/conditions/directions.hpp"
#include "core/mesh/build.hpp"
#include "support.hpp"
#include "tests/support/folder.hpp"
#include "tests/verification/mesh_file.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double young = 1, nu = 0.3, mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));

TEST(Directions, are_orthonormal_and_turn_around_the_axis) {
  LocalFrame<3> frame = Frame::cylindrical;
  frame.center = {1, 2, 3};
  frame.axis = {0, 0, -2};
  const auto [away, around, along] = directions<3, 3>(frame, {1, 5, 9}, {});
  EXPECT_EQ(away, (Point<3>{0, 1, 0}));
  EXPECT_EQ(along, (Point<3>{0, 0, -1}));
  EXPECT_EQ(around, (Point<3>{1, 0, 0}));  // counterclockwise as seen from -z
  EXPECT_TRUE((is_on_axis<3, 3>(frame, {1, 2, 7})));
  EXPECT_FALSE((is_on_axis<3, 3>(frame, {1, 2.001, 7})));
  LocalFrame<2> plane = Frame::cylindrical;
  plane.center = {1, 0};
  EXPECT_EQ((directions<2, 2>(plane, {1, 4}, {})[1]), (Point<2>{-1, 0}));
}

/// A ring a < r < b around c, cut into rectangles in polar coordinates.
Mesh<2> ring(double a, double b, const Point<2>& c, int layers, int around) {
  RawMesh<2> raw;
  for (int j = 0; j < around; ++j)
    for (int i = 0; i <= layers; ++i) {
      const double r = a + (b - a) * i / layers, phi = 2 * pi * j / around;
      raw.points.push_back({c[0] + r * std::cos(phi), c[1] + r * std::sin(phi)});
    }
  FaceGroup<2> inner{"inner", {}}, outer{"outer", {}};
  const auto at = [&](int i, int j) { return static_cast<Index>((j % around) * (layers + 1) + i); };
  for (int j = 0; j < around; ++j) {
    for (int i = 0; i < layers; ++i) {
      raw.elements.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      raw.elements.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    inner.faces.push_back({at(0, j), at(0, j + 1)});
    outer.faces.push_back({at(layers, j), at(layers, j + 1)});
  }
  raw.groups = {inner, outer};
  return build_mesh(std::move(raw), "ring");
}

/// A ring in plane strain, with what stands in `rest`; the largest error against u = A r + B / r away from the axis and
/// w(r) around it.
template <class Exact>
double error_of(const std::string& rest, int order, int refinements, const Exact& exact) {
  const TemporaryFolder folder;
  const Point<2> c{1, -2};
  const auto solved = run<2, 2>(
      fmt::format(
          "[[body]]\nname = \"b\"\nmesh = \"{}\"\ngeometry = \"smooth\"\nyoung = 1\npoisson = 0.3\norder = {}\n{}"
          "[refine]\nuniform = {}\n",
          folder.write("ring.msh", msh(ring(1, 2, c, 2, 12), Motion<2>())), order, rest, refinements),
      {"solver.tolerance=1e-11"});
  EXPECT_THAT(solved.solution.undetermined, IsEmpty());
  const std::vector<double> u = solved.nodes().at_vertices(solved.u(), 2);
  double off = 0, size = 0;
  for (Index v = 0; v < solved.mesh().vertices(); ++v) {
    const Vector<2> x = point<2>(solved.mesh().points[v]) - Vector<2>(c[0], c[1]), e = x.normalized(), f(-e[1], e[0]);
    const auto [away, around] = exact(x.norm());
    off = std::max(off, (displacement<2>(u, v) - away * e - around * f).norm());
    size = std::max(size, std::hypot(away, around));
  }
  return off / size;
}

const std::string cylindrical = "frame = \"cylindrical\"\ncenter = [1, -2]\n";

// G. Lame 1852: the inner wall is pressed out by d, the outer one is free: u = A r + B / r.
TEST(Frames, a_ring_that_is_widened_is_that_of_lame) {
  const double d = 0.01, a = 1, b = 2, k = mu / (lambda + mu);  // sigma_r(b) = 0: A (lambda + mu) = mu B / b^2
  const double B = d / (a * k / (b * b) + 1 / a), A = k * B / (b * b);
  const auto lame = [&](double r) { return std::pair(A * r + B / r, 0.0); };
  const std::string fix = table("fix", "on = \"inner\"\n" + cylindrical + "value = [0.01, 0]");
  const double quadratic = error_of(fix, 2, 1, lame), coarse = error_of(fix, 1, 1, lame),
               fine = error_of(fix, 1, 2, lame);
  show("Lame: {} quadratic, {} and {} linear\n", quadratic, coarse, fine);
  EXPECT_LT(quadratic, 2e-3);
  EXPECT_LT(fine, 0.3 * coarse);
  // The same by a load away from the axis: p = 2 (lambda + mu) A - 2 mu B / a^2 at the inner wall. What stops the
  // ring from drifting is a spring around the axis and in all directions, which a widening does not feel.
  const double p = -(2 * (lambda + mu) * A - 2 * mu * B / (a * a));
  const std::string load = table("load", fmt::format("on = \"inner\"\n{}value = [{}, 0]", cylindrical, p)) +
                           table("spring", "on = \"outer\"\n" + cylindrical + "stiffness = [0, 1]");
  const double loaded = error_of(load, 2, 2, lame);
  show("Lame: {} under the load\n", loaded);
  EXPECT_LT(loaded, 5e-4);
}

// Torsion of a ring: nothing moves away from the axis, and around it w = A r + B / r.
TEST(Frames, a_ring_that_is_turned_is_sheared) {
  const auto exact = [](double r) { return std::pair(0.0, 0.01 * (r - 1 / r)); };
  const double outer = exact(2).second;
  const std::string fixes = table("fix", "on = \"inner\"\n" + cylindrical + "value = [0, 0]") +
                            table("fix", fmt::format("on = \"outer\"\n{}value = [\"free\", {}]", cylindrical, outer));
  EXPECT_LT(error_of(fixes, 2, 1, exact), 2e-3);
  EXPECT_LT(error_of(fixes, 1, 2, exact), 2e-2);
}

// Saint-Venant: u = theta z around the axis, whatever the section's radius; the torque is mu theta pi R^4 / 2. The
// ends are turned about an axis that goes through nodes.
TEST(Frames, a_shaft_is_twisted_as_by_saint_venant) {
  const double theta = 0.01, length = 2, torque = mu * theta * pi / 2;
  const std::string body =
      "shape = \"cylinder\"\ncenter = [0, 0, 1]\nradius = 1\nheight = 2\nsize = 0.6\nyoung = 1\n"
      "poisson = 0.3\norder = 2\n";
  const std::string frame = "frame = \"cylindrical\"\ncenter = [0, 0, 5]\naxis = [0, 0, 3]\n";
  const auto turned =
      run<3, 3>(text_of(body, table("fix", "on = \"bottom\"\nvalue = [0, 0, 0]") +
                                  table("fix", fmt::format("on = \"top\"\n{}value = [0, \"{} * sqrt(x^2 + y^2)\", 0]",
                                                           frame, theta * length))),
                {"solver.tolerance=1e-10"});
  const auto twisted =
      run<3, 3>(text_of(body, table("fix", "on = \"bottom\"\nvalue = [0, 0, 0]") +
                                  table("load", fmt::format("on = \"top\"\n{}value = [0, \"{} * sqrt(x^2 + "
                                                            "y^2)\", 0]",
                                                            frame, mu * theta))),
                {"solver.tolerance=1e-10"});
  const auto total =
      run<3, 3>(text_of(body, table("fix", "on = \"bottom\"\nvalue = [0, 0, 0]") +
                                  table("load", fmt::format("on = \"top\"\ntorque = [0, 0, {}]", torque))),
                {"solver.tolerance=1e-10"});
  for (const auto* solved : {&turned, &twisted, &total}) {
    const std::vector<double> u = solved->nodes().at_vertices(solved->u(), 3);
    double off = 0;
    for (Index v = 0; v < solved->mesh().vertices(); ++v) {
      const auto [x, y, z] = solved->mesh().points[v];
      off = std::max(off, (displacement<3>(u, v) - theta * z * Vector<3>(-y, x, 0)).norm());
    }
    show("shaft: {}\n", off / (theta * length));
    EXPECT_LT(off, 0.01 * theta * length);
  }
  std::vector<double> reaction = internal_forces(turned);
  for (std::size_t k = 0; k < reaction.size(); ++k)
    if (turned.nodes().at(static_cast<Index>(k / 3))[2] < 1.9) reaction[k] = 0;
  EXPECT_NEAR(moment<3>(turned.nodes(), reaction, Vector<3>::Zero())[2] / torque, 1, 0.01);
}

TEST(Frames, on_the_axis_only_zero_is_a_displacement_away_from_it) {
  const std::string body =
      "shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [2, 2, 2]\nyoung = 1\npoisson = 0.3\n";
  const auto with = [&](const std::string& value) {
    return refusal([&] {
      const auto solved = run<3, 3>(text_of(
          body, table("fix", "on = \"left\"\nframe = \"cylindrical\"\ncenter = [0, 0, 9]\naxis = [0, 0, 1]\nvalue = " +
                                 value)));
      const std::vector<double> u = solved.nodes().at_vertices(solved.u(), 3);
      for (Index v = 0; v < solved.mesh().vertices(); ++v)
        if (const auto& x = solved.mesh().points[v]; x[0] == 0 && x[1] == 0) {
          EXPECT_LT(displacement<3>(u, v).head<2>().norm(), 1e-12);
        }
    });
  };
  EXPECT_THAT(with("[0.1, \"free\", 0]"), AllOf(HasSubstr("fix.0.on"), HasSubstr("0.1 away from the axis at (0, 0, "),
                                                HasSubstr("which is on it")));
  EXPECT_EQ(with("[\"free\", \"0.1 * y\", 0]"), "not refused");
}

TEST(Frames, that_are_not_symmetric_are_refused) {
  const std::string body =
      "shape = \"rectangle\"\nfrom = [-1, 0]\nto = [1, 1]\ncells = [4, 2]\nyoung = 1\npoisson = 0\n";
  const auto with = [&](const std::string& center) {
    return refusal([&] {
      Driver(parse_scene(text_of(body, table("fix", "on = \"bottom\"\nframe = \"cylindrical\"\ncenter = " + center +
                                                        "\nvalue = [0, 0]") +
                                           "[symmetry]\nx = 0\n"),
                         "s.toml", "."))
          .solve();
    });
  };
  EXPECT_EQ(with("[0, 3]"), "not refused");
  EXPECT_THAT(with("[0.5, 3]"), HasSubstr("the frame is not symmetric"));
}

TEST(Frames, errors_say_what_a_frame_needs) {
  const std::string square =
      "shape = \"rectangle\"\nfrom = [1, 0]\nto = [2, 1]\ncells = [2, 2]\nyoung = 1\npoisson = 0\n";
  const std::string cube =
      "shape = \"box\"\nfrom = [1, 0, 0]\nto = [2, 1, 1]\ncells = [2, 2, 2]\nyoung = 1\npoisson = 0\n";
  const auto refused = [&](const std::string& body, const std::string& keys) {
    return refusal([&] { parse_scene(text_of(body, table("fix", "on = \"left\"\n" + keys)), "s.toml", "."); });
  };
  const std::string zero = "value = [0, 0]\n", zeros = "value = [0, 0, 0]\n", frame = "frame = \"cylindrical\"\n";
  EXPECT_THAT(refused(square, zero + frame), AllOf(HasSubstr("fix.0.frame"), HasSubstr("needs 'center'")));
  EXPECT_THAT(refused(square, zero + frame + "center = [0, 0]\naxis = [0, 1]"), HasSubstr("expected no 'axis'"));
  EXPECT_THAT(refused(square, zero + "center = [0, 0]"), HasSubstr("'center' has no meaning"));
  EXPECT_THAT(refused(cube, zeros + frame + "center = [0, 0, 0]"), HasSubstr("needs 'axis'"));
  EXPECT_THAT(refused(cube, zeros + frame + "center = [0, 0, 0]\naxis = [0, 0, 0]"), HasSubstr("this vector is zero"));
  EXPECT_THAT(refused(cube, zeros + frame + "center = [0, 0]\naxis = [0, 0, 1]"), HasSubstr("expected 3 coordinates"));
  EXPECT_THAT(refused(square + "plane = \"axisymmetric\"\n", zero + frame + "center = [0, 0]"),
              HasSubstr("expected frame = 'global'"));
}

}  // namespace
}  // namespace signorini::test
