#include "core/mesh/boundary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mesh/red_refinement.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/subsimplices.hpp"

namespace signorini {

template <int D>
std::vector<Face<D>> find_boundary(Index vertices, const std::vector<std::array<Index, D + 1>>& elements) {
  const Numbering faces = number_faces<D>(vertices, elements);
  std::vector<std::uint8_t> more(faces.distinct, 0), seen(faces.distinct, 0);
  for (const Index f : faces.number) {
    more[f] |= seen[f];
    seen[f] = 1;
  }
  std::vector<Face<D>> boundary;
  for (std::size_t i = 0; i < faces.number.size(); ++i)
    if (!more[faces.number[i]]) {
      const auto e = static_cast<Index>(i / (D + 1));
      boundary.push_back({outward_face<D>(elements[e], static_cast<int>(i % (D + 1))), e});
    }
  return boundary;
}

namespace {

void sort_unique(std::vector<Index>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

void add_part(std::vector<Part>& parts, const std::string& name, const std::vector<Index>& faces) {
  if (faces.empty()) return;
  auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.name == name; });
  if (part == parts.end()) part = parts.insert(parts.end(), Part{name, {}});
  part->faces.insert(part->faces.end(), faces.begin(), faces.end());
  sort_unique(part->faces);
}

}  // namespace

template <int D>
void attach_parts(Mesh<D>& mesh, const std::vector<FaceGroup<D>>& groups) {
  std::vector<std::array<Index, D>> tuples;
  for (const Face<D>& face : mesh.boundary) tuples.push_back(sorted(face.vertices));
  for (const FaceGroup<D>& group : groups)
    for (const auto& face : group.faces) tuples.push_back(sorted(face));
  const Numbering numbering =
      number_subsimplices<D>(mesh.vertices(), static_cast<Offset>(tuples.size()), [&](Offset i) { return tuples[i]; });

  std::vector<Index> boundary_face(numbering.distinct, -1);
  for (std::size_t f = 0; f < mesh.boundary.size(); ++f) boundary_face[numbering.number[f]] = static_cast<Index>(f);
  std::size_t next = mesh.boundary.size();
  for (const FaceGroup<D>& group : groups) {
    std::vector<Index> faces;
    for (std::size_t i = 0; i < group.faces.size(); ++i)
      if (const Index f = boundary_face[numbering.number[next++]]; f >= 0) faces.push_back(f);
    add_part(mesh.parts, group.name, faces);
  }
}

template <int D>
void keep_faces(Mesh<D>& mesh, const std::vector<bool>& kept) {
  std::vector<Index> number(kept.size(), -1);
  std::vector<Face<D>> faces;
  std::vector<CubicPatch<D>> patches;
  for (std::size_t f = 0; f < kept.size(); ++f) {
    if (!kept[f]) continue;
    number[f] = static_cast<Index>(faces.size());
    faces.push_back(mesh.boundary[f]);
    if (mesh.patches) patches.push_back((*mesh.patches)[f]);
  }
  mesh.boundary = std::move(faces);
  if (mesh.patches) mesh.patches = std::make_shared<const std::vector<CubicPatch<D>>>(std::move(patches));
  for (Part& part : mesh.parts) {
    for (Index& face : part.faces) face = number[face];
    std::erase(part.faces, -1);
  }
}

template <int D>
std::vector<Index> faces_of(const Mesh<D>& mesh, std::string_view name, std::string_view place) {
  for (const Part& part : mesh.parts)
    if (part.name == name) return part.faces;
  if (name == "boundary") {
    std::vector<Index> all(mesh.boundary.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  std::vector<std::string> names{"boundary"};
  for (const Part& part : mesh.parts) names.push_back(part.name);
  input_error(place, fmt::format("unknown part '{}'{} (the parts are: {})", name, did_you_mean(name, names),
                                 fmt::join(names, ", ")));
}

// Child k of a face keeps its corner k, see RedRefinement.
template <int D>
std::array<Index, D> coarsest_face(const Mesh<D>& mesh, Index coarsest) {
  std::array<Index, D> corners;
  for (int k = 0; k < D; ++k) {
    Index face = coarsest;
    for (int step = 0; step < mesh.refinements; ++step) face = face * (1 << (D - 1)) + k;
    corners[k] = mesh.boundary[face].vertices[k];
  }
  return corners;
}

template <int D>
std::array<std::array<double, D>, D> in_coarsest_face(Index face, int refinements) {
  constexpr auto edges = simplex_edges<D - 1>();
  std::array<std::array<double, D>, D> corner{};
  for (int i = 0; i < D; ++i) corner[i][i] = 1;
  for (int step = refinements - 1; step >= 0; --step) {
    const auto& child = RedRefinement<D - 1>::children[(face >> ((D - 1) * step)) & ((1 << (D - 1)) - 1)];
    auto next = corner;
    for (int i = 0; i < D; ++i)
      for (int k = 0; k < D; ++k)
        next[i][k] = child[i] < D ? corner[child[i]][k]
                                  : (corner[edges[child[i] - D][0]][k] + corner[edges[child[i] - D][1]][k]) / 2;
    corner = next;
  }
  return corner;
}

#define SIGNORINI_INSTANTIATE(D)                                                                       \
  template std::vector<Face<D>> find_boundary<D>(Index, const std::vector<std::array<Index, D + 1>>&); \
  template void attach_parts(Mesh<D>&, const std::vector<FaceGroup<D>>&);                              \
  template void keep_faces(Mesh<D>&, const std::vector<bool>&);                                        \
  template std::vector<Index> faces_of(const Mesh<D>&, std::string_view, std::string_view);            \
  template std::array<Index, D> coarsest_face<D>(const Mesh<D>&, Index);                               \
  template std::array<std::array<double, D>, D> in_coarsest_face<D>(Index, int);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
