#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "core/mesh/simplex.hpp"
#include "tests/bodies/scenes.hpp"
#include "tests/verification/mesh_file.hpp"

// One body whose two parts touch each other: a clip that closes. Its upper half on a rigid plane is the same problem.

namespace signorini::test {
namespace {

/// The jaws of the clip reach along x from 1 to 4, `slit` above and below y = 0, and along z (D = 3) over 1.
template <int D>
class ClipMesh {
 public:
  static constexpr double slit = 0.05;

  explicit ClipMesh(bool whole) {
    for (int i = 0; i < 16; ++i)
      for (int j = 0; j < 5; ++j)
        for (int k = 0; k < (D == 3 ? 3 : 1); ++k)
          if (j > 0 || i < 4) add_cell({i, j, k});
    if (whole) add_image();
  }

  const Mesh<D>& mesh() const { return mesh_; }

 private:
  static Point<D> at(const std::array<int, 3>& place) {
    static constexpr std::array y{0.0, slit, 0.25, 0.5, 0.75, 1.0};
    Point<D> x;
    x[0] = 0.25 * place[0];
    x[1] = y[place[1]];
    if constexpr (D == 3) x[2] = place[2] / 3.0;
    return x;
  }

  Index vertex(const std::array<int, 3>& place) {
    const auto [entry, added] = number_.try_emplace(place, static_cast<Index>(mesh_.points.size()));
    if (added) mesh_.points.push_back(at(place));
    return entry->second;
  }

  // A simplex for each order in which a way goes along the axes from one corner to the opposite one.
  void add_cell(const std::array<int, 3>& corner) {
    std::array<int, D> axes;
    std::iota(axes.begin(), axes.end(), 0);
    do {
      std::array<int, 3> place = corner;
      std::array<Index, D + 1> element{vertex(place)};
      for (int k = 0; k < D; ++k) {
        ++place[axes[k]];
        element[k + 1] = vertex(place);
      }
      add(element);
    } while (std::ranges::next_permutation(axes).found);
  }

  void add(std::array<Index, D + 1> element) {
    std::array<Point<D>, D + 1> corner;
    for (int k = 0; k <= D; ++k) corner[k] = mesh_.points[element[k]];
    if (signed_volume<D>(corner) < 0) std::swap(element[D - 1], element[D]);
    mesh_.elements.push_back(element);
  }

  void add_image() {
    std::vector<Index> image;
    for (Index p = 0, n = static_cast<Index>(mesh_.points.size()); p < n; ++p) {
      Point<D> x = mesh_.points[p];
      image.push_back(x[1] == 0 ? p : static_cast<Index>(mesh_.points.size()));
      if (x[1] == 0) continue;
      x[1] = -x[1];
      mesh_.points.push_back(x);
    }
    for (std::size_t e = 0, n = mesh_.elements.size(); e < n; ++e) {
      std::array<Index, D + 1> element = mesh_.elements[e];
      for (Index& v : element) v = image[v];
      add(element);
    }
  }

  Mesh<D> mesh_;
  std::map<std::array<int, 3>, Index> number_;
};

const char* const upper_jaw = "abs(y - 0.05) < 1e-6 && x > 0.99";

std::string vector(const std::string& x, const std::string& y, int dimension) {
  return fmt::format("[{}, {}{}]", x, y, dimension == 3 ? ", 0" : "");
}

std::string where(const char* table, const std::string& condition, const std::string& value) {
  return fmt::format("[[{}]]\nbody = \"clip\"\nwhere = \"{}\"\nvalue = {}\n", table, condition, value);
}

/// Held at its back, and pressed together at the jaws.
template <int D>
std::string clip(const std::string& file, bool whole, const std::string& obstacle, int refinements) {
  std::string text = fmt::format("[[body]]\nname = \"clip\"\nmesh = \"{}\"\n{}", file, material(1)) +
                     where("fix", "x < 1e-6", vector("0", "0", D)) +
                     where("load", "y > 0.999 && x > 1.99", vector("0", "-0.003", D));
  if (whole) text += where("load", "y < -0.999 && x > 1.99", vector("0", "0.003", D));
  if (!whole) text += where("fix", "abs(y) < 1e-6", D == 3 ? "[\"free\", 0, \"free\"]" : "[\"free\", 0]");
  return text + fmt::format("[[obstacle]]\nbody = \"clip\"\nwhere = \"{}\"\n{}\n", upper_jaw, obstacle) +
         fmt::format("[refine]\nuniform = {}\n[solver]\ntolerance = 1e-10\n", refinements);
}

template <int D>
struct Closed {
  explicit Closed(const std::string& text) : driver(scene_of(text)) {
    EXPECT_TRUE(driver.solve().converged()) << driver.report().reason();
  }
  const ContactReport& contact() const { return driver.report().last().contact[0]; }
  Driver driver;
};

std::string with_itself(const char* type, const std::string& more) {
  return fmt::format("type = \"{}\"\nother = \"clip\"\nother_where = \"abs(y + 0.05) < 1e-6 && x > 0.99\"\n{}", type,
                     more);
}

const char* const on_plane = "type = \"contact\"\nshape = \"plane\"\npoint = {}\nnormal = {}";

constexpr double clip_slit = ClipMesh<2>::slit;

/// Displacements by the place of the vertex, in units of 1e-6.
template <int D>
std::map<std::array<long, D>, std::array<double, D>> by_place(const Driver& driver) {
  const std::vector<double> u = driver.solution(), points = driver.points();
  std::map<std::array<long, D>, std::array<double, D>> out;
  for (std::size_t v = 0; v < u.size() / D; ++v) {
    std::array<long, D> place;
    for (std::size_t i = 0; i < D; ++i) place[i] = std::lround(1e6 * points[v * D + i]);
    std::copy_n(u.begin() + static_cast<Offset>(v * D), D, out[place].begin());
  }
  return out;
}

/// Meshes of both halves are images of each other, so that nothing but rounding and the tolerance may differ.
template <int D>
void expect_as_half_on_plane(int refinements) {
  const TemporaryFolder folder;
  const ClipMesh<D> half(false), whole(true);
  const std::string half_file = folder.write("half.msh", msh(half.mesh())),
                    whole_file = folder.write("whole.msh", msh(whole.mesh()));
  const Closed<D> expected(clip<D>(
      half_file, false, fmt::format(fmt::runtime(on_plane), vector("0", "0", D), vector("0", "1", D)), refinements));
  ASSERT_GT(expected.contact().nodes, 5);
  const auto u = by_place<D>(expected.driver);
  const double size = clip_slit;  // about how far the jaws move
  for (const auto& [type, more] : {std::pair{"elastic", "slave = \"body\"\n"},
                                   {"elastic", "slave = \"other\"\n"},
                                   {"elastic_coulomb", "friction = 0.4\n"}}) {
    SCOPED_TRACE(fmt::format("{} {}", type, more));
    const Closed<D> found(clip<D>(whole_file, true, with_itself(type, more), refinements));
    const auto both = by_place<D>(found.driver);
    ASSERT_GT(both.size(), u.size());
    for (const auto& [place, moved] : u)
      for (int i = 0; i < D; ++i)
        ASSERT_NEAR(both.at(place)[i], moved[i], 1e-7 * size) << fmt::format("at {} {}", place[0], place[1]);
    EXPECT_EQ(found.contact().nodes, expected.contact().nodes);
    EXPECT_NEAR(found.contact().force[1], expected.contact().force[1], 1e-8 * expected.contact().force[1]);
    EXPECT_NEAR(found.contact().area, expected.contact().area, 1e-9 * expected.contact().area);
    EXPECT_NEAR(found.contact().max_pressure, expected.contact().max_pressure, 1e-7 * expected.contact().max_pressure);
    expect_opposite(found.contact());
    ASSERT_EQ(found.driver.report().last().balance.size(), 1u);
    expect_balance(found.driver.report().last(), 1e-10);
    show("{} and {} iterations\n", expected.driver.report().last().summary.iterations,
         found.driver.report().last().summary.iterations);
    EXPECT_LE(found.driver.report().last().summary.iterations, 2 * expected.driver.report().last().summary.iterations);
  }
}

TEST(SelfContact, IsThatOfHalfAClipOnAPlaneIn2D) { expect_as_half_on_plane<2>(2); }

// Refined meshes are no images of each other inside.
TEST(SelfContact, IsThatOfHalfAClipOnAPlaneIn3D) { expect_as_half_on_plane<3>(0); }

std::string polygon(const std::string& points, int refinements) {
  return fmt::format(
      "[[body]]\nname = \"clip\"\nshape = \"polygon\"\npoints = {}\nsize = \"y < 0 ? 0.17 : "
      "0.25\"\n{}[refine]\nuniform "
      "= {}\n",
      points, material(1), refinements);
}

// Meshes of the jaws do not match.
TEST(SelfContact, TendsToThatOfHalfAClipWhereMeshesDoNotMatch) {
  const std::string upper = "[1, 0.3], [3, 0.05], [4, 0.05], [4, 1], [0, 1]]";
  std::vector<double> difference;
  for (const int refinements : {0, 1, 2}) {
    const Closed<2> half(polygon("[[0, 0], [1, 0], " + upper, refinements) + tables::fix("clip", "edge6", "[0, 0]") +
                         tables::fix("clip", "edge0", "[\"free\", 0]") + tables::load("clip", "[0, -0.002]", "edge5") +
                         tables::plane("clip", "edge3", "[0, 0]", "[0, 1]"));
    const Closed<2> whole(polygon("[[0, -1], [4, -1], [4, -0.05], [3, -0.05], [1, -0.3], " + upper, refinements) +
                          tables::fix("clip", "edge9", "[0, 0]") + tables::load("clip", "[0, -0.002]", "edge8") +
                          tables::load("clip", "[0, 0.002]", "edge0") + pair("clip", "edge6", "clip", "edge2"));
    expect_opposite(whole.contact());
    difference.push_back(std::abs(whole.contact().force[1] / half.contact().force[1] - 1));
    show("force {:.6g} and {:.6g}: {:.2e}, {} iterations\n", half.contact().force[1], whole.contact().force[1],
         difference.back(), whole.driver.report().last().summary.iterations);
  }
  EXPECT_LT(difference.back(), 0.01);
  EXPECT_LT(difference.back(), 0.5 * difference.front());
}

TEST(SelfContact, NamesThePartsOfTheBody) {
  const Closed<2> shipped(
      polygon("[[0, -1], [4, -1], [4, -0.05], [1, -0.05], [1, 0.05], [4, 0.05], [4, 1], [0, 1]]", 1) +
      tables::fix("clip", "edge7", "[0, 0]") + pair("clip", "edge4", "clip", "edge2"));
  EXPECT_EQ(shipped.contact().pair->slave, "clip/edge4");
  EXPECT_EQ(shipped.contact().pair->master, "clip/edge2");
}

TEST(SelfContact, HasTwoParts) {
  const std::string text =
      polygon("[[0, -1], [4, -1], [4, -0.05], [1, -0.05], [1, 0.05], [4, 0.05], [4, 1], [0, 1]]", 0) +
      tables::fix("clip", "edge7", "[0, 0]");
  expect_error(text + pair("clip", "edge4", "clip", "edge4"), Exit::input, "is on both sides, of slave and master");
  expect_error(text + pair("clip", "edge4", "clip", "boundary"), Exit::input, "the face at (");
  expect_error(text + "[[obstacle]]\ntype = \"elastic\"\nbody = \"clip\"\non = \"edge4\"\nother = \"clip\"\n",
               Exit::input, "needs 'other_on' or 'other_where'");
  // Parts that meet have nodes in common, at which nothing can open or close.
  Driver meet(scene_of(text + pair("clip", "edge4", "clip", "edge3")));
  EXPECT_TRUE(meet.solve().converged());
}

}  // namespace
}  // namespace signorini::test
