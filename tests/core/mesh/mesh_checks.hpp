#pragma once
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/validate.hpp"

namespace signorini::test {

template <int D>
double volume(const Mesh<D>& mesh) {
  double sum = 0;
  for (const auto& element : mesh.elements) sum += signed_volume<D>(corners<D>(mesh.points, element));
  return sum;
}

/// Normal of a face, its length the area of the face.
template <int D>
Point<D> area_vector(const Mesh<D>& mesh, const Face<D>& face) {
  const auto& p = mesh.points[face.vertices[0]];
  const auto a = difference<D>(mesh.points[face.vertices[1]], p);
  if constexpr (D == 2) {
    return {a[1], -a[0]};
  } else {
    const auto b = difference<D>(mesh.points[face.vertices[2]], p);
    return {0.5 * (a[1] * b[2] - a[2] * b[1]), 0.5 * (a[2] * b[0] - a[0] * b[2]), 0.5 * (a[0] * b[1] - a[1] * b[0])};
  }
}

template <int D>
double area(const Mesh<D>& mesh, const std::vector<Index>& faces) {
  double sum = 0;
  for (const Index f : faces) sum += length<D>(area_vector(mesh, mesh.boundary[f]));
  return sum;
}

template <int D>
double area(const Mesh<D>& mesh, const char* part) {
  return area(mesh, faces_of(mesh, part, "test"));
}

/// The volume by the divergence theorem: right only if the boundary is closed and every face is oriented outwards.
template <int D>
double volume_within_boundary(const Mesh<D>& mesh) {
  double sum = 0;
  for (const Face<D>& face : mesh.boundary) {
    const Point<D> n = area_vector(mesh, face);
    for (const Index v : face.vertices)
      for (int k = 0; k < D; ++k) sum += mesh.points[v][k] * n[k] / (D * D);
  }
  return sum;
}

/// What every mesh must satisfy. The boundary is checked against a search of its own.
template <int D>
void expect_consistent(const Mesh<D>& mesh) {
  validate(mesh, "mesh");
  std::map<std::array<Index, D>, int> count;
  for (const auto& element : mesh.elements)
    for (int i = 0; i <= D; ++i) {
      std::array<Index, D> face;
      for (int j = 0, k = 0; j <= D; ++j)
        if (j != i) face[k++] = element[j];
      ++count[sorted(face)];
    }
  std::set<std::array<Index, D>> seen;
  for (const Face<D>& face : mesh.boundary) {
    EXPECT_EQ(count[sorted(face.vertices)], 1);
    EXPECT_TRUE(seen.insert(sorted(face.vertices)).second);
    for (const Index v : face.vertices) EXPECT_THAT(mesh.elements.at(face.element), testing::Contains(v));
  }
  EXPECT_EQ(std::ranges::count_if(count, [](const auto& c) { return c.second == 1; }),
            static_cast<Offset>(mesh.boundary.size()));
  // One face turned around would change this by the share of a face, rounding by far less.
  EXPECT_NEAR(volume_within_boundary(mesh), volume(mesh), 1e-10 * volume(mesh));
}

/// The message of the error that `action` must end with.
template <class Action>
std::string input_error_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

}  // namespace signorini::test
