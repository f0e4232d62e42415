#include "core/mesh/refine.hpp"

#include <cmath>
#include <random>

#include "core/mesh/curve.hpp"
#include "core/mesh/families.hpp"
#include "core/mesh/red_refinement.hpp"
#include "core/mesh/structured.hpp"
#include "core/mesh/subsimplices.hpp"
#include "mesh_checks.hpp"

namespace signorini {
namespace {

using test::area;
using test::volume;

Mesh<2> plate() { return rectangle({0, 0}, {3, 2}, {3, 2}); }
Mesh<3> brick() { return box({0, 0, 0}, {1, 2, 3}, {1, 2, 3}); }

template <int D>
Mesh<D> one_simplex(std::vector<Point<D>> points) {
  Mesh<D> mesh;
  mesh.points = std::move(points);
  for (int i = 0; i <= D; ++i) mesh.elements.resize(1), mesh.elements[0][i] = i;
  mesh.boundary = find_boundary<D>(D + 1, mesh.elements);
  return mesh;
}

/// A disk as a fan around its centre.
Mesh<2> fan(int n) {
  Mesh<2> mesh;
  mesh.points = {{1, -2}};
  for (int i = 0; i < n; ++i) {
    mesh.points.push_back({1 + 3 * std::cos(2 * M_PI * i / n), -2 + 3 * std::sin(2 * M_PI * i / n)});
    mesh.elements.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  mesh.boundary = find_boundary<2>(mesh.vertices(), mesh.elements);
  mesh.curves = {{.center = {1, -2}, .radius = 3}};
  for (auto& face : mesh.boundary) face.curve = 0;
  mesh.parts = {{"rim", faces_of(mesh, "boundary", "test")}};
  return mesh;
}

/// An octahedron inscribed in a sphere, cut into tetrahedra around its centre; the lower half only if asked for.
Mesh<3> octahedron(bool lower_half) {
  Mesh<3> mesh;
  mesh.points = {{0, 0, 1}, {2, 0, 1}, {-2, 0, 1}, {0, 2, 1}, {0, -2, 1}, {0, 0, -1}, {0, 0, 3}};
  const Index ring[] = {1, 3, 2, 4};
  for (int i = 0; i < 4; ++i) {
    mesh.elements.push_back({0, ring[(i + 1) % 4], ring[i], 5});
    if (!lower_half) mesh.elements.push_back({0, ring[i], ring[(i + 1) % 4], 6});
  }
  if (lower_half) mesh.points.pop_back();
  mesh.boundary = find_boundary<3>(mesh.vertices(), mesh.elements);
  mesh.curves = {{.center = {0, 0, 1}, .radius = 2}};
  mesh.parts = {{"flat", {}}, {"curved", {}}};
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    const bool flat = std::ranges::count(mesh.boundary[f].vertices, 0) > 0;
    mesh.boundary[f].curve = flat ? -1 : 0;
    mesh.parts[flat ? 0 : 1].faces.push_back(static_cast<Index>(f));
  }
  return mesh;
}

/// A prism over a regular hexagon, inscribed in a cylinder: three tetrahedra over each triangle of the fan.
Mesh<3> hexagonal_prism() {
  Mesh<3> mesh;
  const int n = 6;
  for (const double z : {1.0, 2.0}) {
    mesh.points.push_back({0, 0, z});
    for (int i = 0; i < n; ++i)
      mesh.points.push_back({0.5 * std::cos(2 * M_PI * i / n), 0.5 * std::sin(2 * M_PI * i / n), z});
  }
  for (Index i = 0; i < n; ++i) {
    std::array<Index, 3> t = {0, 1 + i, 1 + (i + 1) % n};
    std::sort(t.begin(), t.end());  // the same order in neighbours: the sides are cut alike
    const Index up = n + 1;
    std::array<std::array<Index, 4>, 3> tets = {
        {{t[0], t[1], t[2], t[2] + up}, {t[0], t[1], t[2] + up, t[1] + up}, {t[0], t[1] + up, t[2] + up, t[0] + up}}};
    for (auto& tet : tets) {
      if (signed_volume<3>(corners<3>(mesh.points, tet)) < 0) std::swap(tet[2], tet[3]);
      mesh.elements.push_back(tet);
    }
  }
  mesh.boundary = find_boundary<3>(mesh.vertices(), mesh.elements);
  mesh.curves = {{.center = {0, 0, 0}, .radius = 0.5, .kind = Curve<3>::Kind::cylinder, .axis = {0, 0, 1}}};
  mesh.parts = {{"bottom", {}}, {"top", {}}, {"side", {}}};
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
    const auto at = [&](double z) {
      return std::ranges::all_of(mesh.boundary[f].vertices, [&](Index v) { return mesh.points[v][2] == z; });
    };
    const int part = at(1) ? 0 : at(2) ? 1 : 2;
    mesh.parts[part].faces.push_back(static_cast<Index>(f));
    mesh.boundary[f].curve = part == 2 ? 0 : -1;
  }
  return mesh;
}

template <int D>
void expect_children(const Mesh<D>& coarse, const Mesh<D>& fine, const Refinement& refinement) {
  constexpr std::size_t per_element = 1 << D, per_face = 1 << (D - 1);
  ASSERT_EQ(fine.elements.size(), per_element * coarse.elements.size());
  ASSERT_EQ(fine.boundary.size(), per_face * coarse.boundary.size());
  ASSERT_EQ(refinement.father.size(), fine.elements.size());
  std::vector<std::size_t> children(coarse.elements.size(), 0);
  for (std::size_t e = 0; e < fine.elements.size(); ++e) {
    ++children.at(refinement.father[e]);
    for (const Index v : fine.elements[e])
      for (const Index parent : refinement.parents.at(v))
        EXPECT_THAT(coarse.elements[refinement.father[e]], testing::Contains(parent));
  }
  EXPECT_THAT(children, testing::Each(per_element));
  for (std::size_t f = 0; f < fine.boundary.size(); ++f) {
    EXPECT_EQ(fine.boundary[f].curve, coarse.boundary[f / per_face].curve);
    for (const Index v : fine.boundary[f].vertices)
      for (const Index parent : refinement.parents[v])
        EXPECT_THAT(coarse.boundary[f / per_face].vertices, testing::Contains(parent));
  }
}

template <int D>
void expect_families(const Mesh<D>& coarse, const Mesh<D>& fine, const Refinement& refinement) {
  ASSERT_EQ(fine.families.size(), coarse.elements.size());
  std::multiset<Simplex<D>> children, elements;
  for (const Family<D>& family : fine.families) {
    for (const auto& child : RedRefinement<D>::children) {
      Simplex<D> vertices;
      for (int a = 0; a <= D; ++a) vertices[a] = family[child[a]];
      children.insert(sorted(vertices));
    }
    for (std::size_t k = 0; k < simplex_edges<D>().size(); ++k) {
      const auto [a, b] = simplex_edges<D>()[k];
      std::array<Index, 2> parents = refinement.parents[family[D + 1 + k]];
      EXPECT_EQ(sorted(parents),
                sorted(std::array<Index, 2>{refinement.parents[family[a]][0], refinement.parents[family[b]][0]}));
    }
  }
  for (const Simplex<D>& element : fine.elements) elements.insert(sorted(element));
  EXPECT_EQ(children, elements);
}

template <int D>
void expect_parents(const Mesh<D>& coarse, const Mesh<D>& fine, const Refinement& refinement) {
  ASSERT_EQ(refinement.parents.size(), fine.points.size());
  std::set<std::array<Index, 2>> seen;
  for (std::size_t v = 0; v < fine.points.size(); ++v) {
    const auto [a, b] = refinement.parents[v];
    EXPECT_TRUE(seen.insert({std::min(a, b), std::max(a, b)}).second) << "vertex " << v << " exists twice";
    for (int k = 0; k < D; ++k)
      EXPECT_NEAR(fine.points[v][k], (coarse.points[a][k] + coarse.points[b][k]) / 2, 1e-14) << "vertex " << v;
  }
}

/// Vertices appear in the order of their numbers when the elements are run through.
template <int D>
void expect_first_touch_numbering(const Mesh<D>& mesh) {
  Index next = 0;
  for (const auto& element : mesh.elements)
    for (const Index v : element) {
      ASSERT_LE(v, next);
      next += v == next;
    }
  EXPECT_EQ(next, mesh.vertices());
}

template <int D>
void refine_and_check_flat(const Mesh<D>& coarsest) {
  const MeshHierarchy<D> h = hierarchy(coarsest, 3);
  ASSERT_EQ(h.levels.size(), 4u);
  ASSERT_EQ(h.refinements.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    const Mesh<D>&coarse = h.levels[k], &fine = h.levels[k + 1];
    test::expect_consistent(fine);
    Mesh<D> again;
    const Refinement refinement = refine_uniformly(coarse, again);
    expect_children(coarse, again, refinement);
    EXPECT_EQ(h.refinements[k].father.capacity(), 0u) << "nobody asks for them any more";
    EXPECT_EQ(elements_of_families(fine), fine.elements);
    expect_families(coarse, fine, h.refinements[k]);
    expect_parents(coarse, fine, h.refinements[k]);
    expect_first_touch_numbering(fine);
    EXPECT_NEAR(volume(fine), volume(coarse), 1e-12 * volume(coarse));
    for (const Part& part : coarse.parts)
      EXPECT_NEAR(area(fine, part.name.c_str()), area(coarse, part.faces), 1e-12) << part.name;
  }
}

TEST(Refine, PlateStaysAConformingMeshWithItsParts) { refine_and_check_flat(plate()); }
TEST(Refine, BrickStaysAConformingMeshWithItsParts) { refine_and_check_flat(brick()); }

/// The elements as sets of points, whatever the numbering.
template <int D>
std::set<std::set<Point<D>>> shapes(const Mesh<D>& mesh) {
  std::set<std::set<Point<D>>> all;
  for (const auto& element : mesh.elements) {
    std::set<Point<D>> shape;
    for (const Index v : element) shape.insert(mesh.points[v]);
    all.insert(shape);
  }
  return all;
}

TEST(Refine, StructuredMeshesBecomeTheFinerStructuredMeshes) {
  EXPECT_EQ(shapes<2>(hierarchy(plate(), 2).finest()), shapes<2>(rectangle({0, 0}, {3, 2}, {12, 8})));
  EXPECT_EQ(shapes<3>(hierarchy(brick(), 2).finest()), shapes<3>(box({0, 0, 0}, {1, 2, 3}, {4, 8, 12})));
  const Mesh<3> flat = box({0, 0, 0}, {1, 4, 0.25}, {1, 1, 1});  // no ties among the diagonals but those of Kuhn
  EXPECT_EQ(shapes<3>(hierarchy(flat, 2).finest()), shapes<3>(box({0, 0, 0}, {1, 4, 0.25}, {4, 4, 4})));
}

TEST(Refine, ShapesOfTetrahedraDoNotDeteriorate) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int sample = 0; sample < 50; ++sample) {
    std::vector<Point<3>> points(4);
    for (auto& p : points)
      for (double& x : p) x = uniform(random);
    if (signed_volume<3>({points[0], points[1], points[2], points[3]}) < 0) std::swap(points[2], points[3]);
    const Mesh<3> coarse = one_simplex<3>(points);
    const double start = relative_volume<3>(corners<3>(coarse.points, coarse.elements[0]));
    const auto worst = [](const Mesh<3>& mesh) {
      double least = 1;
      for (const auto& e : mesh.elements) least = std::min(least, relative_volume<3>(corners<3>(mesh.points, e)));
      return least;
    };
    const MeshHierarchy<3> h = hierarchy(coarse, 4);
    EXPECT_GT(worst(h.levels[4]), 0.1 * start);
    EXPECT_GT(worst(h.levels[4]), 0.6 * worst(h.levels[2]));
  }
}

TEST(Refine, InnerDiagonalIsTheShortest) {
  const Mesh<3> coarse = one_simplex<3>({{0, 0, 0}, {1, 0, 0}, {0.4, 1, 0}, {0.5, 0.2, 3}});
  Mesh<3> fine;
  const Refinement r = refine_uniformly(coarse, fine);
  const Numbering edges = number_edges<3>(fine.vertices(), fine.elements);
  EXPECT_EQ(edges.distinct, 2 * 6 + 3 * 4 + 1);
  const auto center = [&](int a, int b) { return midpoint<3>(coarse.points[a], coarse.points[b]); };
  double shortest = infinity;
  for (const auto [a, b, c, d] : {std::array{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}})
    shortest = std::min(shortest, length<3>(difference<3>(center(a, b), center(c, d))));
  int diagonals = 0;
  for (const auto& e : fine.elements)
    for (const auto [i, j] : simplex_edges<3>()) {
      std::set<Index> ends(r.parents[e[i]].begin(), r.parents[e[i]].end());
      ends.insert(r.parents[e[j]].begin(), r.parents[e[j]].end());
      if (ends.size() < 4) continue;
      ++diagonals;
      EXPECT_NEAR(length<3>(difference<3>(fine.points[e[i]], fine.points[e[j]])), shortest, 1e-14);
    }
  EXPECT_EQ(diagonals, 4);
}

TEST(Refine, DoesNotDependOnUnits) {
  const Mesh<3> coarse = octahedron(false);
  Mesh<3> scaled = coarse;
  for (auto& p : scaled.points)
    for (double& x : p) x *= 1024;
  for (auto& curve : scaled.curves) {
    curve.radius *= 1024;
    for (double& x : curve.center) x *= 1024;
  }
  const Mesh<3> a = hierarchy(coarse, 3).finest(), b = hierarchy(scaled, 3).finest();
  EXPECT_EQ(a.elements, b.elements);
  for (std::size_t v = 0; v < a.points.size(); ++v)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(1024 * a.points[v][k], b.points[v][k], 1e-11);
}

/// The errors of a measure on successive levels must fall by four, once the mesh is no longer coarse.
void expect_second_order(const std::vector<double>& measures, double exact) {
  for (std::size_t k = 3; k < measures.size(); ++k) {
    const double order = std::log2(std::abs(measures[k - 1] - exact) / std::abs(measures[k] - exact));
    EXPECT_NEAR(order, 2, 0.2) << "level " << k << ": " << measures[k] << ", exact " << exact;
  }
  EXPECT_NEAR(measures.back(), exact, 0.02 * exact);
}

TEST(Refine, DiskTendsToTheCircle) {
  const MeshHierarchy<2> h = hierarchy(fan(5), 5);
  std::vector<double> volumes, lengths;
  for (const Mesh<2>& mesh : h.levels) {
    test::expect_consistent(mesh);
    for (const auto& face : mesh.boundary)
      for (const Index v : face.vertices) EXPECT_NEAR(length<2>(difference<2>(mesh.points[v], {1, -2})), 3, 1e-14);
    volumes.push_back(volume(mesh));
    lengths.push_back(area(mesh, "rim"));
  }
  expect_second_order(volumes, M_PI * 9);
  expect_second_order(lengths, M_PI * 6);
}

TEST(Refine, OctahedronTendsToTheBall) {
  const MeshHierarchy<3> h = hierarchy(octahedron(false), 5);
  std::vector<double> volumes;
  for (const Mesh<3>& mesh : h.levels) {
    validate(mesh, "test");
    for (const auto& face : mesh.boundary)
      for (const Index v : face.vertices) EXPECT_NEAR(length<3>(difference<3>(mesh.points[v], {0, 0, 1})), 2, 1e-14);
    volumes.push_back(volume(mesh));
  }
  expect_second_order(volumes, 4.0 / 3 * M_PI * 8);
}

TEST(Refine, HalfBallKeepsAFlatDiskWithARoundRim) {
  const MeshHierarchy<3> h = hierarchy(octahedron(true), 4);
  std::vector<double> volumes, disks;
  for (const Mesh<3>& mesh : h.levels) {
    test::expect_consistent(mesh);
    for (const Index f : faces_of(mesh, "flat", "test"))
      for (const Index v : mesh.boundary[f].vertices) EXPECT_EQ(mesh.points[v][2], 1);
    for (const Index f : faces_of(mesh, "curved", "test"))
      for (const Index v : mesh.boundary[f].vertices)
        EXPECT_NEAR(length<3>(difference<3>(mesh.points[v], {0, 0, 1})), 2, 1e-14);
    volumes.push_back(volume(mesh));
    disks.push_back(area(mesh, "flat"));
  }
  expect_second_order(volumes, 2.0 / 3 * M_PI * 8);
  expect_second_order(disks, M_PI * 4);
}

TEST(Refine, PrismTendsToTheCylinder) {
  const MeshHierarchy<3> h = hierarchy(hexagonal_prism(), 4);
  std::vector<double> volumes, tops, sides;
  for (const Mesh<3>& mesh : h.levels) {
    test::expect_consistent(mesh);
    for (const Index f : faces_of(mesh, "side", "test"))
      for (const Index v : mesh.boundary[f].vertices)
        EXPECT_NEAR(std::hypot(mesh.points[v][0], mesh.points[v][1]), 0.5, 1e-14);
    for (const Index f : faces_of(mesh, "top", "test"))
      for (const Index v : mesh.boundary[f].vertices) EXPECT_EQ(mesh.points[v][2], 2);
    volumes.push_back(volume(mesh));
    tops.push_back(area(mesh, "top"));
    sides.push_back(area(mesh, "side"));
  }
  expect_second_order(volumes, M_PI * 0.25);
  expect_second_order(tops, M_PI * 0.25);
  expect_second_order(sides, M_PI);
}

TEST(Refine, MovesThatWouldInvertAnElementAreCutBack) {
  // The midpoint of the edge belongs far beyond the opposite vertex.
  Mesh<2> mesh = one_simplex<2>({{0, 0}, {1, 0}, {0.5, 0.1}});
  mesh.curves = {{.center = {0.5, -0.05}, .radius = 0.6}};
  for (auto& face : mesh.boundary)
    if (std::ranges::count(face.vertices, 2) == 0) face.curve = 0;
  const MeshHierarchy<2> h = hierarchy(mesh, 3);
  for (const Mesh<2>& level : h.levels) test::expect_consistent(level);
}

TEST(Curve, ProjectionIsTheNearestPoint) {
  const Curve<3> sphere{.center = {1, 2, 3}, .radius = 2},
      cylinder{.center = {1, 2, 3}, .radius = 2, .kind = Curve<3>::Kind::cylinder, .axis = {0, 0, 1}};
  const Point<3> on_sphere = project<3>(sphere, {1, 5, 7}), on_cylinder = project<3>(cylinder, {4, 6, 9});
  EXPECT_NEAR(on_sphere[1], 2 + 2 * 0.6, 1e-15);
  EXPECT_NEAR(on_sphere[2], 3 + 2 * 0.8, 1e-15);
  EXPECT_NEAR(on_cylinder[0], 1 + 2 * 0.6, 1e-15);
  EXPECT_NEAR(on_cylinder[1], 2 + 2 * 0.8, 1e-15);
  EXPECT_EQ(on_cylinder[2], 9);
  EXPECT_EQ(project<3>(sphere, {1, 2, 3}), (Point<3>{1, 2, 3}));
  EXPECT_EQ(project<3>(cylinder, {1, 2, 8}), (Point<3>{1, 2, 8}));
}

template <int D>
void expect_size_foretold(const Mesh<D>& coarsest) {
  for (int k = 0; k <= 3; ++k) {
    const MeshHierarchy<D> h = hierarchy(coarsest, k);
    const HierarchySize size = hierarchy_size(coarsest, k);
    EXPECT_EQ(size.vertices, h.finest().points.size());
    EXPECT_EQ(size.elements, h.finest().elements.size());
    double bytes = 0;
    for (const Mesh<D>& mesh : h.levels)
      bytes += mesh.points.size() * sizeof(mesh.points[0]) + mesh.elements.size() * sizeof(mesh.elements[0]);
    EXPECT_GE(size.bytes, bytes);
    EXPECT_LE(size.bytes, 3 * bytes);
  }
}

TEST(Refine, SizeIsForetoldExactly) {
  expect_size_foretold(plate());
  expect_size_foretold(fan(7));
  expect_size_foretold(brick());
  expect_size_foretold(octahedron(true));
  const HierarchySize huge = hierarchy_size(brick(), 40);
  EXPECT_TRUE(huge.bytes > 1e30 && std::isfinite(huge.bytes));
}

// Where the shortest diagonals of curved meshes change direction, elements get to span more than two layers.
TEST(Refine, NoChildIsLostWhereElementsSpanManyLayers) {
  Mesh<3> coarse = brick();
  for (std::size_t v = 0; v < coarse.points.size(); ++v) coarse.layer.push_back(static_cast<Index>(7 * v % 11));
  Mesh<3> fine;
  const Refinement refinement = refine_uniformly(coarse, fine);
  expect_children(coarse, fine, refinement);
  expect_families(coarse, fine, refinement);
  EXPECT_EQ(elements_of_families(fine), fine.elements);
}

TEST(Refine, RefinedMeshesGetElementsBackThatWereSetAside) {
  MeshHierarchy<3> meshes = hierarchy(octahedron(true), 2);
  const std::vector<Mesh<3>> before = meshes.levels;
  {
    const ElementsAside<3> aside(meshes);
    EXPECT_EQ(meshes.levels[0].elements, before[0].elements) << "which nothing else knows";
    for (int k : {1, 2}) EXPECT_EQ(meshes.levels[k].elements.capacity(), 0u);
  }
  for (int k : {0, 2}) EXPECT_EQ(meshes.levels[k].elements, before[k].elements);
  EXPECT_EQ(meshes.levels[1].elements.capacity(), 0u) << "which nobody needs yet";
  restore_elements(meshes);
  for (int k : {0, 1, 2}) EXPECT_EQ(meshes.levels[k].elements, before[k].elements);
  for (int k : {0, 1, 2}) EXPECT_EQ(meshes.levels[k].points, before[k].points);
}

TEST(Refine, PointsThatHalveEdgesAreSetAsideWithTheElements) {
  MeshHierarchy<3> meshes = hierarchy(box({0, 0.1, 0}, {1, 1.3, 1}, {2, 3, 2}), 2);
  double& moved = meshes.levels[2].points[100][1];
  moved = std::nextafter(moved, 2);  // as on a curved surface
  const std::vector<Mesh<3>> before = meshes.levels;
  {
    const ElementsAside<3> aside(meshes);
    EXPECT_EQ(meshes.levels[0].points, before[0].points);
    EXPECT_EQ(meshes.levels[1].points.capacity(), 0u);
    EXPECT_EQ(meshes.levels[2].points, before[2].points) << "which nothing else knows";
  }
  for (int k : {0, 1, 2}) EXPECT_EQ(meshes.levels[k].points, before[k].points);
}

TEST(Refine, StarsOfManyElementsTakeLinearTime) {
  const Mesh<2> mesh = fan(200000);
  Mesh<2> fine;
  refine_uniformly(mesh, fine);
  EXPECT_EQ(fine.elements.size(), 800000u);
}

}  // namespace
}  // namespace signorini
