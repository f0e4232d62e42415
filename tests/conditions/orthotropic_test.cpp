// Orthotropic material against closed forms: Jones, Mechanics of Composite Materials; Lekhnitskii, Theory of Elasticity
// of an Anisotropic Body.
#include <numbers>

#include "core/fem/recovery/stress.hpp"
#include "orthotropic.hpp"

namespace signorini::test {
namespace {

/// strain = S stress, both as matrices: the tensor of compliance, turned index by index.
class Compliance {
 public:
  /// @param axes its rows are the material's directions
  Compliance(const EngineeringConstants& c, Eigen::Matrix3d axes) : axes_(std::move(axes)) {
    normal_ << 1 / c[0], -c[3] / c[0], -c[4] / c[0],  //
        -c[3] / c[0], 1 / c[1], -c[5] / c[1],         //
        -c[4] / c[0], -c[5] / c[1], 1 / c[2];
    shear_ << 0, c[6], c[7], c[6], 0, c[8], c[7], c[8], 0;
  }
  Eigen::Matrix3d strain(const Eigen::Matrix3d& stress) const {
    const Eigen::Matrix3d own = axes_ * stress * axes_.transpose();
    Eigen::Matrix3d out;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        out(i, j) = i == j ? normal_.row(i).dot(own.diagonal()) : own(i, j) / (2 * shear_(i, j));
    return axes_.transpose() * out * axes_;
  }

 private:
  Eigen::Matrix3d axes_, normal_, shear_;
};

constexpr std::array<std::array<int, 2>, 6> index_of_stress{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// Of one component alone.
Eigen::Matrix3d unit_stress(int k) {
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  const auto [i, j] = index_of_stress[static_cast<std::size_t>(k)];
  out(i, j) = out(j, i) = 0.01;
  return out;
}

/// Turned about z, then the result about its first direction.
Eigen::Matrix3d turned(double about_z, double about_first) {
  return (Eigen::AngleAxisd(-about_first * pi / 180, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(-about_z * pi / 180, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// A body whose boundary moves as uniform strain has it, and its uniform stress.
template <int D>
void expect_stress(const std::string& body, const Eigen::Matrix3d& axes, const Eigen::Matrix3d& strain,
                   const Eigen::Matrix3d& stress) {
  std::vector<std::string> directions, values;
  for (int i = 0; i < D; ++i) {
    values.push_back("\"0");
    for (int j = 0; j < D; ++j) values.back() += fmt::format(" + {:.17g} * {}", strain(i, j), "xyz"[j]);
    values.back() += '"';
  }
  for (int i = 0; i < D - 1; ++i) {
    std::vector<double> row;
    for (int j = 0; j < D; ++j) row.push_back(3 * axes(i, j));
    directions.push_back(fmt::format("[{:.17g}]", fmt::join(row, ", ")));
  }
  const auto found =
      run<D, D>(text_of(body + orthotropic(wood) + fmt::format("material_axes = [{}]\n", fmt::join(directions, ", ")),
                        fix("on = \"boundary\"", fmt::format("[{}]", fmt::join(values, ", ")))),
                exact);
  for (const auto& all : {element_stress<D>(found.nodes(), found.model, found.u()),
                          nodal_stress<D>(found.nodes(), found.model, found.u())})
    for (const Stress& s : all)
      for (std::size_t k = 0; k < 6; ++k)
        ASSERT_NEAR(s[k], stress(index_of_stress[k][0], index_of_stress[k][1]), 1e-9) << body << k << "\n" << stress;
}

TEST(Orthotropic, uniform_stress_in_space_has_the_strain_of_the_turned_compliance) {
  for (const Eigen::Matrix3d& axes : {turned(0, 0), turned(30, 0), turned(30, 50)}) {
    const Compliance compliance(wood, axes);
    for (int k = 0; k < 6; ++k)
      for (const int p : {1, 2})
        expect_stress<3>(brick + order(p), axes, compliance.strain(unit_stress(k)), unit_stress(k));
  }
}

TEST(Orthotropic, uniform_stress_in_the_plane_has_the_strain_of_the_turned_compliance) {
  for (const double angle : {0.0, 30.0}) {
    const Compliance compliance(wood, turned(angle, 0));
    for (const int k : {0, 1, 3})
      for (const int p : {1, 2}) {
        Eigen::Matrix3d stress = unit_stress(k);
        expect_stress<2>(plate + order(p) + "plane = \"stress\"\n", turned(angle, 0), compliance.strain(stress),
                         stress);
        stress(2, 2) = -compliance.strain(stress)(2, 2) / compliance.strain(unit_stress(2))(2, 2) * 0.01;
        expect_stress<2>(plate + order(p), turned(angle, 0), compliance.strain(stress), stress);
      }
  }
}

template <int D>
void expect_isotropic(const std::string& body, const std::string& conditions) {
  constexpr double E = 2, nu = 0.3, G = E / 2.6;
  for (const int p : {1, 2}) {
    SCOPED_TRACE(body + order(p));
    const auto isotropic = run<D, D>(text_of(body + order(p) + "young = 2\npoisson = 0.3\n", conditions), exact);
    const auto found =
        run<D, D>(text_of(body + order(p) + orthotropic({E, E, E, nu, nu, nu, G, G, G}) +
                              (D == 2 ? "material_axes = [[3, 1]]\n" : "material_axes = [[3, 1, 0.5], [0, 1, 2]]\n"),
                          conditions),
                  exact);
    const double size = max_norm(isotropic.u());
    for (std::size_t k = 0; k < found.u().size(); ++k) ASSERT_NEAR(found.u()[k], isotropic.u()[k], 1e-9 * size);
    const auto a = nodal_stress<D>(found.nodes(), found.model, found.u()),
               b = nodal_stress<D>(isotropic.nodes(), isotropic.model, isotropic.u());
    for (std::size_t v = 0; v < a.size(); ++v)
      for (int k = 0; k < 6; ++k) ASSERT_NEAR(a[v][k], b[v][k], 1e-8);
  }
}

TEST(Orthotropic, of_isotropic_constants_is_isotropic) {
  const std::string held = fix("on = \"left\"", "[0, 0]") + table("load", "on = \"right\"\nvalue = [0.1, 0.02]");
  for (const char* plane : {"strain", "stress"})
    expect_isotropic<2>(plate + fmt::format("plane = \"{}\"\n", plane), held);
  expect_isotropic<2>(plate + "plane = \"axisymmetric\"\n",
                      fix("on = \"bottom\"", "[\"free\", 0]") + table("load", "on = \"right\"\nvalue = [0.1, 0.02]"));
  expect_isotropic<3>(brick,
                      fix("on = \"left\"", "[0, 0, 0]") + table("load", "on = \"right\"\nvalue = [0.1, 0.02, -0.03]"));
}

/// Of a pull at this angle to the fibres.
double stretch(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return std::pow(c, 4) / wood[0] + std::pow(s, 4) / wood[1] + (1 / wood[6] - 2 * wood[3] / wood[0]) * c * c * s * s;
}

TEST(Orthotropic, stretches_by_the_off_axis_modulus) {
  constexpr double pull = 0.01;
  for (const double degrees : {0.0, 30.0, 75.0, 90.0}) {
    const double angle = degrees * pi / 180;
    for (const int p : {1, 2}) {
      const std::string plane =
          fmt::format("material_axes = [[{:.17g}, {:.17g}]]\nplane = \"stress\"\n", std::cos(angle), std::sin(angle));
      const auto flat = run<2, 2>(text_of(plate + order(p) + orthotropic(wood) + plane,
                                          table("load", fmt::format("on = \"right\"\nvalue = [{}, 0]", pull)) +
                                              table("load", fmt::format("on = \"left\"\nvalue = [{}, 0]", -pull)) +
                                              fix("at = [0, 0]", "[0, 0]") + fix("at = [3, 0]", "[\"free\", 0]")),
                                  exact);
      const auto u = flat.nodes().at_vertices(flat.u(), 2);
      for (Index v = 0; v < flat.mesh().vertices(); ++v)
        if (flat.mesh().points[v][1] == 0) {
          ASSERT_NEAR(u[v * 2], pull * stretch(angle) * flat.mesh().points[v][0], 1e-9) << degrees;
        }
      for (const Stress& s : element_stress<2>(flat.nodes(), flat.model, flat.u()))
        for (int k = 0; k < 6; ++k) ASSERT_NEAR(s[k], k == 0 ? pull : 0, 1e-9);
      const std::string space = fmt::format("material_axes = [[{0:.17g}, {1:.17g}, 0], [{2:.17g}, {0:.17g}, 0]]\n",
                                            std::cos(angle), std::sin(angle), -std::sin(angle));
      const auto solid =
          run<3, 3>(text_of(brick + order(p) + orthotropic(wood) + space,
                            table("load", fmt::format("on = \"right\"\nvalue = [{}, 0, 0]", pull)) +
                                table("load", fmt::format("on = \"left\"\nvalue = [{}, 0, 0]", -pull)) +
                                fix("at = [0, 0, 0]", "[0, 0, 0]") + fix("at = [3, 0, 0]", "[\"free\", 0, 0]") +
                                fix("at = [0, 1, 0]", "[\"free\", \"free\", 0]")),
                    exact);
      for (const Stress& s : element_stress<3>(solid.nodes(), solid.model, solid.u()))
        for (int k = 0; k < 6; ++k) ASSERT_NEAR(s[k], k == 0 ? pull : 0, 1e-9);
    }
  }
}

/// Radial and hoop stress of a thick tube, 1 < r < 2, of pressure 1 inside and without strain along its axis
/// (Lekhnitskii, section 23).
std::array<double, 2> tube_stress(double r, double k) {
  const double ratio = 0.5, out = std::pow(ratio, k + 1) / (1 - std::pow(ratio, 2 * k)), grow = std::pow(r / 2, k - 1),
               fall = std::pow(2 / r, k + 1);
  return {out * (grow - fall), out * k * (grow + fall)};
}

/// Its exponent: the root of the stiffness around over that along the radius.
double tube_exponent(int along_r, int around) {
  const auto C = stiffness_of(wood);
  return std::sqrt(C[static_cast<std::size_t>(around * 7)] / C[static_cast<std::size_t>(along_r * 7)]);
}

const std::string pressed_inside = table("load", "on = \"left\"\npressure = 1") +
                                   fix("on = \"bottom\"", "[\"free\", 0]") + fix("on = \"top\"", "[\"free\", 0]");

TEST(Orthotropic, tube_of_revolution_under_pressure_has_the_stress_of_lekhnitskii) {
  for (const bool fibres_along_axis : {false, true})
    for (const int p : {1, 2}) {
      const auto found =
          run<2, 2>(text_of("shape = \"rectangle\"\nfrom = [1, 0]\nto = [2, 0.25]\ncells = [64, "
                            "16]\nplane = \"axisymmetric\"\n" +
                                order(p) + orthotropic(wood) + (fibres_along_axis ? "material_axes = [[0, 1]]\n" : ""),
                            pressed_inside),
                    exact);
      const double k = tube_exponent(fibres_along_axis ? 1 : 0, 2);
      const auto stress = nodal_stress<2>(found.nodes(), found.model, found.u());
      for (Index v = 0; v < found.mesh().vertices(); ++v) {
        const auto [radial, hoop] = tube_stress(found.mesh().points[v][0], k);
        ASSERT_NEAR(stress[v][0], radial, p == 1 ? 0.02 : 3e-4) << k;
        ASSERT_NEAR(stress[v][2], hoop, p == 1 ? 0.02 : 3e-4) << k;
      }
    }
}

/// What turns within the half plane: shear by G12 alone, as log r.
TEST(Orthotropic, tube_of_revolution_is_sheared_along_its_axis) {
  const auto found = run<2, 2>(text_of("shape = \"rectangle\"\nfrom = [1, 0]\nto = [2, 0.5]\ncells = [32, 16]\nplane "
                                       "= \"axisymmetric\"\norder = 2\n" +
                                           orthotropic(wood),
                                       fix("on = \"boundary\"", "[0, \"log(x) / 100\"]")),
                               exact);
  const auto stress = nodal_stress<2>(found.nodes(), found.model, found.u());
  for (Index v = 0; v < found.mesh().vertices(); ++v) {
    ASSERT_NEAR(stress[v][3], wood[6] / 100 / found.mesh().points[v][0], 1e-5);
  }
}

TEST(Orthotropic, directions_around_an_axis) {
  const double k = tube_exponent(0, 1);
  const std::string value = fmt::format("[\"hypot(x,y)^{0} * x / 100\", \"hypot(x,y)^{0} * y / 100\"", k - 1);
  const auto flat =
      run<2, 2>(text_of("shape = \"rectangle\"\nfrom = [1, -0.5]\nto = [2, 0.5]\ncells = [8, 8]\norder = 2\n"
                        "material_center = [0, 0]\n" +
                            orthotropic(wood),
                        fix("on = \"boundary\"", value + "]")),
                exact);
  const auto u = flat.nodes().at_vertices(flat.u(), 2);
  for (Index v = 0; v < flat.mesh().vertices(); ++v) {
    const Point<2>& x = flat.mesh().points[v];
    for (int i = 0; i < 2; ++i) ASSERT_NEAR(u[v * 2 + i], std::pow(std::hypot(x[0], x[1]), k - 1) * x[i] / 100, 3e-6);
  }
  const auto solid =
      run<3, 3>(text_of("shape = \"box\"\nfrom = [1, -0.5, 0]\nto = [2, 0.5, 0.5]\ncells = [4, 4, 2]\norder = 2\n"
                        "material_center = [0, 0, 3]\nmaterial_axis = [0, 0, 2]\n" +
                            orthotropic(wood),
                        fix("on = \"boundary\"", value + ", 0]")),
                exact);
  const auto w = solid.nodes().at_vertices(solid.u(), 3);
  for (Index v = 0; v < solid.mesh().vertices(); ++v) {
    const Point<3>& x = solid.mesh().points[v];
    for (int i = 0; i < 2; ++i) ASSERT_NEAR(w[v * 3 + i], std::pow(std::hypot(x[0], x[1]), k - 1) * x[i] / 100, 5e-5);
  }
}

TEST(Orthotropic, grows_freely_when_it_is_heated) {
  for (const int p : {1, 2})
    for (const char* plane : {"strain", "stress", "axisymmetric"}) {
      SCOPED_TRACE(plane);
      const bool across = std::string(plane) == "strain";
      const auto found =
          run<2, 2>(text_of(plate + order(p) + fmt::format("plane = \"{}\"\n", plane) + orthotropic(wood) +
                                "expansion = 1e-3\ntemperature = 40\n",
                            (std::string(plane) == "axisymmetric" ? "" : fix("on = \"left\"", "[0, \"free\"]")) +
                                fix("on = \"bottom\"", "[\"free\", 0]")),
                    exact);
      const auto stress = element_stress<2>(found.nodes(), found.model, found.u());
      const double zz = across ? -wood[2] * 0.04 : 0;  // held across the plane, free within
      for (const Stress& s : stress)
        for (int k = 0; k < 6; ++k) ASSERT_NEAR(s[k], k == 2 ? zz : 0, 1e-9);
    }
}

TEST(Orthotropic, heated_brick_between_walls_has_the_stress_of_all_that_cannot_grow) {
  const Eigen::Matrix3d axes = turned(30, 50);
  std::string held;
  for (const char* wall : {"left", "right"}) held += fix(fmt::format("on = \"{}\"", wall), "[0, 0, 0]");
  for (const char* wall : {"front", "back", "bottom", "top"})
    held += fix(fmt::format("on = \"{}\"", wall), "[0, 0, 0]");
  for (const int p : {1, 2}) {
    const auto found = run<3, 3>(
        text_of(brick + order(p) + orthotropic(wood) +
                    fmt::format("material_axes = [[{:.17g}, {:.17g}, {:.17g}], [{:.17g}, {:.17g}, {:.17g}]]\n",
                                axes(0, 0), axes(0, 1), axes(0, 2), axes(1, 0), axes(1, 1), axes(1, 2)) +
                    "expansion = 1e-3\ntemperature = 40\n",
                held),
        exact);
    for (const Stress& s : element_stress<3>(found.nodes(), found.model, found.u())) {
      Eigen::Matrix3d stress;
      for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = index_of_stress[k];
        stress(i, j) = stress(j, i) = s[k];
      }
      const Eigen::Matrix3d off = Compliance(wood, axes).strain(stress) + 0.04 * Eigen::Matrix3d::Identity();
      ASSERT_LT(off.cwiseAbs().maxCoeff(), 1e-9);
    }
  }
}

TEST(Orthotropic, mean_constants_of_an_isotropic_material_are_its_own) {
  const IsotropicConstants mean = mean_constants({2, 2, 2, 0.3, 0.3, 0.3, 2 / 2.6, 2 / 2.6, 2 / 2.6});
  EXPECT_NEAR(mean.young, 2, 1e-14);
  EXPECT_NEAR(mean.poisson, 0.3, 1e-14);
}

}  // namespace
}  // namespace signorini::test
