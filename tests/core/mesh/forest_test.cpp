#include "core/mesh/forest.hpp"

#include <algorithm>
#include <map>

#include "core/mesh/curve.hpp"
#include "core/mesh/structured.hpp"
#include "tests/core/mesh/mesh_checks.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

template <int D>
Mesh<D> cells(Index n) {
  if constexpr (D == 2)
    return rectangle({0, 0}, {1, 1}, {n, n});
  else
    return box({0, 0, 0}, {1, 1, 1}, {n, n, n});
}

/// Vertices inside are moved: no two elements are alike, and no two edges are equally long.
template <int D>
Mesh<D> distorted(Index n, std::uint64_t seed) {
  Random random(seed);
  Mesh<D> mesh = cells<D>(n);
  std::vector<bool> outside(mesh.points.size(), false);
  for (const Face<D>& face : mesh.boundary)
    for (const Index v : face.vertices) outside[v] = true;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    for (double& x : mesh.points[v]) x += outside[v] ? 0 : random.between(-0.2, 0.2) / n;
  return mesh;
}

template <int D>
std::shared_ptr<const Mesh<D>> shared(Mesh<D> mesh) {
  return std::make_shared<const Mesh<D>>(std::move(mesh));
}

/// The leaves with a corner that `wanted` holds for.
template <int D, class Wanted>
std::vector<Index> leaves_at(const Mesh<D>& mesh, const Wanted& wanted) {
  std::vector<Index> out;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (std::ranges::any_of(mesh.elements[e], [&](Index v) { return wanted(mesh.points[v]); }))
      out.push_back(static_cast<Index>(e));
  return out;
}

template <int D>
double worst_shape(const Mesh<D>& mesh) {
  double worst = 1;
  for (const auto& element : mesh.elements)
    worst = std::min(worst, relative_volume<D>(corners<D>(mesh.points, element)));
  return worst;
}

template <int D>
void expect_equal(const Mesh<D>& a, const Mesh<D>& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.elements, b.elements);
  ASSERT_EQ(a.boundary.size(), b.boundary.size());
  for (std::size_t f = 0; f < a.boundary.size(); ++f) {
    EXPECT_EQ(a.boundary[f].vertices, b.boundary[f].vertices);
    EXPECT_EQ(a.boundary[f].element, b.boundary[f].element);
  }
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t p = 0; p < a.parts.size(); ++p) EXPECT_EQ(a.parts[p].faces, b.parts[p].faces);
}

template <int D>
void expect_to_conform() {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Random random(seed);
    const auto coarsest = shared(distorted<D>(2, seed));
    Forest<D> forest(coarsest);
    for (int round = 0; round < 6; ++round) {
      std::vector<Index> some;
      for (Index leaf = 0; leaf < forest.leaves(); ++leaf)
        if (random.chance(0.1)) some.push_back(leaf);
      forest.bisect(some);
    }
    const auto [mesh, id] = forest.mesh();
    EXPECT_EQ(static_cast<Index>(mesh.elements.size()), forest.leaves());
    expect_consistent(mesh);
    EXPECT_NEAR(volume(mesh), 1, 1e-13);
    for (const Part& part : coarsest->parts)
      EXPECT_NEAR(area(mesh, part.faces.empty() ? "" : part.name.c_str()), 1, 1e-13);
    // Every vertex is the middle of its parents.
    std::map<VertexId, Point<D>> at;
    for (std::size_t v = 0; v < id.size(); ++v) at[id[v]] = mesh.points[v];
    for (const auto& [name, x] : at) {
      const auto [a, b] = forest.parents(name);
      EXPECT_EQ(x, (midpoint<D>(at.at(a), at.at(b))));
    }
  }
}

TEST(Forest, MeshesConformWhateverIsMarked) {
  expect_to_conform<2>();
  expect_to_conform<3>();
}

template <int D>
void expect_the_same_in_any_order() {
  Forest<D> one(shared(distorted<D>(2, 5))), other(shared(distorted<D>(2, 5)));
  Random random(6);
  for (int round = 0; round < 5; ++round) {
    std::vector<Index> some;
    for (Index leaf = 0; leaf < one.leaves(); ++leaf)
      if (random.chance(0.1)) some.push_back(leaf);
    one.bisect(some);
    std::ranges::reverse(some);
    some.insert(some.end(), some.begin(), some.end());
    other.bisect(some);
  }
  expect_equal(one.mesh().mesh, other.mesh().mesh);
  EXPECT_EQ(one.mesh().id, other.mesh().id);
}

TEST(Forest, TheOrderOfMarksDoesNotMatter) {
  expect_the_same_in_any_order<2>();
  expect_the_same_in_any_order<3>();
}

template <int D>
void expect_undone() {
  Forest<D> forest(shared(distorted<D>(2, 7)));
  const auto towards = [](double part) { return [part](const Point<D>& x) { return length<D>(x) <= part; }; };
  for (int k = 0; k < 4; ++k) forest.bisect(leaves_at(forest.mesh().mesh, towards(0.3)));
  const MadeMesh<D> before = forest.mesh();
  std::set<VertexId> old(before.id.begin(), before.id.end());
  for (int k = 0; k < 4; ++k) forest.bisect(leaves_at(forest.mesh().mesh, towards(0.2)));
  EXPECT_GT(forest.leaves(), static_cast<Index>(before.mesh.elements.size()));
  // Who may go are those whose newest vertex is new.
  for (Index gone = 1; gone > 0;) {
    const MadeMesh<D> now = forest.mesh();
    std::vector<bool> may_go;
    for (const auto& element : now.mesh.elements)
      may_go.push_back(std::ranges::any_of(element, [&](Index v) { return !old.contains(now.id[v]); }));
    gone = forest.coarsen(may_go);
  }
  expect_equal(forest.mesh().mesh, before.mesh);
  EXPECT_EQ(forest.mesh().id, before.id);
  // What was taken out comes back under its names.
  for (int k = 0; k < 4; ++k) forest.bisect(leaves_at(forest.mesh().mesh, towards(0.2)));
  expect_consistent(forest.mesh().mesh);
  // And all of it can go.
  while (forest.coarsen(std::vector<bool>(static_cast<std::size_t>(forest.leaves()), true)) > 0)
    expect_consistent(forest.mesh().mesh);
  EXPECT_EQ(forest.leaves(), static_cast<Index>(distorted<D>(2, 7).elements.size()));
}

TEST(Forest, CoarseningGivesBackTheMeshBefore) {
  expect_undone<2>();
  expect_undone<3>();
}

/// The worst shape after so many generations, over that before.
template <int D, class Wanted>
double shapes_towards(const Mesh<D>& coarsest, const Wanted& wanted, int generations) {
  Forest<D> forest(shared(coarsest));
  for (int k = 0; k < generations; ++k) forest.bisect(leaves_at(forest.mesh().mesh, wanted));
  const Mesh<D> mesh = forest.mesh().mesh;
  EXPECT_NEAR(volume(mesh), volume(coarsest), 1e-12 * volume(coarsest));
  const double part = worst_shape(mesh) / worst_shape(coarsest);
  if (nightly())
    std::printf("%d generations, %zu elements: worst shape %.3f of the first\n", generations, mesh.elements.size(),
                part);
  return part;
}

TEST(Forest, ShapesStayBoundedOver25Generations) {
  const auto point = [](const auto& x) { return std::ranges::all_of(x, [](double c) { return c == 0; }); };
  const auto side = [](const auto& x) { return x[0] == 0; };
  const auto line = [](const Point<3>& x) { return x[0] == 0 && x[1] == 0; };
  for (const std::uint64_t seed : {1, 2}) {
    EXPECT_GT(shapes_towards(distorted<2>(3, seed), point, 25), 0.5);
    EXPECT_GT(shapes_towards(distorted<2>(3, seed), side, 16), 0.5);
    EXPECT_GT(shapes_towards(distorted<3>(2, seed), point, 25), 0.5);
    EXPECT_GT(shapes_towards(distorted<3>(2, seed), line, 18), 0.5);
    EXPECT_GT(shapes_towards(distorted<3>(2, seed), side, 9), 0.5);
  }
}

/// A square with its corners on the unit circle, on which new vertices are put.
Mesh<2> disk() {
  Mesh<2> mesh = rectangle({-1, -1}, {1, 1}, {2, 2});
  for (auto& x : mesh.points)
    if (const double r = length<2>(x); r > 1) x = {x[0] / r, x[1] / r};
  mesh.curves = {{.center = {0, 0}, .radius = 1}};
  for (auto& face : mesh.boundary) face.curve = 0;
  return mesh;
}

TEST(Forest, NewVerticesLieOnShapes) {
  Forest<2> forest(shared(disk()));
  for (int k = 0; k < 8; ++k) forest.bisect(leaves_at(forest.mesh().mesh, [](const auto& x) { return x[1] < -0.5; }));
  const Mesh<2> mesh = forest.mesh().mesh;
  expect_consistent(mesh);
  for (const auto& face : mesh.boundary)
    for (const Index v : face.vertices) EXPECT_NEAR(length<2>(mesh.points[v]), 1, 1e-15);
  EXPECT_EQ(forest.straightened(), 0);
}

/// One element whose edges are bent, and a face of it that lies on a patch.
template <int D>
void expect_parts_of_the_same_map() {
  Mesh<D> mesh = cells<D>(1);
  Random random(9);
  Bends<D> bends;
  for (auto& p : bends)
    for (double& x : p) x = random.between(-0.05, 0.05);
  mesh.bends.assign(mesh.elements.size(), Bends<D>{});
  mesh.bends[0] = bends;
  Mesh<D> alone;
  for (const Index v : mesh.elements[0]) alone.points.push_back(mesh.points[v]);
  Simplex<D> element;
  for (int i = 0; i <= D; ++i) element[i] = i;
  alone.elements = {element};
  alone.boundary = find_boundary<D>(D + 1, alone.elements);
  alone.bends = {bends};
  const auto image = [&](const std::array<double, D + 1>& x) {
    constexpr auto edges = simplex_edges<D>();
    Point<D> out{};
    for (int d = 0; d < D; ++d) {
      for (int i = 0; i <= D; ++i) out[d] += x[i] * alone.points[i][d];
      for (std::size_t k = 0; k < edges.size(); ++k) out[d] += 4 * x[edges[k][0]] * x[edges[k][1]] * bends[k][d];
    }
    return out;
  };
  Forest<D> forest(shared(alone));
  for (int k = 0; k < 6; ++k)
    forest.bisect(leaves_at(forest.mesh().mesh, [&](const auto& x) { return x == alone.points[0]; }));
  EXPECT_EQ(forest.straightened(), 0);
  const MadeMesh<D> made = forest.mesh();
  // In barycentric coordinates of the whole one by the parents.
  std::map<VertexId, std::array<double, D + 1>> at;
  const std::function<std::array<double, D + 1>(VertexId)> of = [&](VertexId id) {
    std::array<double, D + 1> x{};
    const auto [a, b] = forest.parents(id);
    if (a == b) {
      x[id] = 1;
    } else {
      const auto from = of(a), to = of(b);
      for (int i = 0; i <= D; ++i) x[i] = (from[i] + to[i]) / 2;
    }
    return x;
  };
  for (std::size_t v = 0; v < made.id.size(); ++v)
    for (int d = 0; d < D; ++d) EXPECT_NEAR(made.mesh.points[v][d], image(of(made.id[v]))[d], 1e-15);
  // What is bent of the leaves is the same map, too: at the middles of their edges.
  constexpr auto edges = simplex_edges<D>();
  for (std::size_t e = 0; e < made.mesh.elements.size(); ++e)
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const auto from = of(made.id[made.mesh.elements[e][edges[k][0]]]),
                 to = of(made.id[made.mesh.elements[e][edges[k][1]]]);
      std::array<double, D + 1> middle;
      for (int i = 0; i <= D; ++i) middle[i] = (from[i] + to[i]) / 2;
      for (int d = 0; d < D; ++d)
        EXPECT_NEAR((image(from)[d] + image(to)[d]) / 2 + made.mesh.bends[e][k][d], image(middle)[d], 1e-15);
    }
}

TEST(Forest, CurvedElementsStayPartsOfTheSameMap) {
  expect_parts_of_the_same_map<2>();
  expect_parts_of_the_same_map<3>();
}

TEST(Forest, PatchesStayPartsOfTheSameSurface) {
  Mesh<3> mesh = cells<3>(1);
  mesh.curves = {{.kind = CurveKind::patches}};
  std::vector<CubicPatch<3>> patches(mesh.boundary.size());
  Random random(10);
  for (const Index f : faces_of(mesh, "top", "test")) {
    mesh.boundary[f].curve = 0;
    std::array<Point<3>, 3> corner;
    for (int i = 0; i < 3; ++i) corner[i] = mesh.points[mesh.boundary[f].vertices[i]];
    patches[f] = flat_patch<3>(corner);
    for (std::size_t k = 3; k < CubicPatch<3>::size; ++k) patches[f].control[k][2] += 0.04;  // the same along each edge
  }
  mesh.patches = std::make_shared<const std::vector<CubicPatch<3>>>(patches);
  Forest<3> forest(shared(mesh));
  for (int k = 0; k < 9; ++k)
    forest.bisect(leaves_at(forest.mesh().mesh, [](const auto& x) { return x[0] == 0 && x[1] == 0; }));
  const Mesh<3> fine = forest.mesh().mesh;
  int seen = 0;
  for (std::size_t f = 0; f < fine.boundary.size(); ++f) {
    if (fine.boundary[f].curve < 0) continue;
    for (int i = 0; i < 3; ++i) {
      std::array<double, 3> x{};
      x[i] = 1;
      const Point<3> there = (*fine.patches)[f].at(x), vertex = fine.points[fine.boundary[f].vertices[i]];
      for (int d = 0; d < 3; ++d) EXPECT_NEAR(there[d], vertex[d], 1e-14);
    }
    // Inside, the part is the whole: both are the surface over the same point of the plane.
    const Point<3> inside = (*fine.patches)[f].at({0.5, 0.3, 0.2});
    double nearest = infinity;
    for (const Index whole : faces_of(mesh, "top", "test")) {
      std::array<double, 3> y;
      const auto& v = mesh.boundary[whole].vertices;
      const auto a = mesh.points[v[0]], b = mesh.points[v[1]], c = mesh.points[v[2]];
      const double det = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
      y[1] = ((inside[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (inside[1] - a[1])) / det;
      y[2] = ((b[0] - a[0]) * (inside[1] - a[1]) - (inside[0] - a[0]) * (b[1] - a[1])) / det;
      y[0] = 1 - y[1] - y[2];
      if (std::ranges::min(y) > -1e-12) nearest = std::min(nearest, std::abs(patches[whole].at(y)[2] - inside[2]));
    }
    EXPECT_LT(nearest, 1e-14);
    ++seen;
  }
  EXPECT_GT(seen, 10);
}

}  // namespace
}  // namespace signorini::test
