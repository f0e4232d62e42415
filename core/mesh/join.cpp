#include "core/mesh/join.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <utility>

namespace signorini {
namespace {

template <class T>
void append(std::vector<T>& all, std::vector<T>& more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

template <int D>
void append_parts(const std::string& body, Mesh<D>& mesh, Mesh<D>& all) {
  const auto first = static_cast<Index>(all.boundary.size());
  if (std::ranges::find(mesh.parts, "boundary", &Part::name) == mesh.parts.end()) {
    Part& whole = mesh.parts.emplace_back(Part{"boundary", std::vector<Index>(mesh.boundary.size())});
    std::iota(whole.faces.begin(), whole.faces.end(), 0);
  }
  for (Part& part : mesh.parts) {
    for (Index& face : part.faces) face += first;
    part.name = part_of(body, part.name);
  }
  append(all.parts, mesh.parts);
}

template <int D>
void append_boundary(Mesh<D>& mesh, Mesh<D>& all) {
  for (Face<D>& face : mesh.boundary) {
    for (Index& v : face.vertices) v += all.vertices();
    face.element += static_cast<Index>(all.elements.size());
    if (face.curve >= 0) face.curve += static_cast<Index>(all.curves.size());
  }
  append(all.boundary, mesh.boundary);
  append(all.curves, mesh.curves);
}

/// Lists that are empty where all entries are trivial.
template <class T>
void append_sparse(std::vector<T>& all, std::size_t before, std::vector<T>& more, std::size_t count) {
  if (all.empty() && more.empty()) return;
  all.resize(before);
  more.resize(count);
  append(all, more);
}

}  // namespace

std::string part_of(const std::string& body, const std::string& part) { return body + "/" + part; }

std::string body_of(const std::string& part) {
  const std::size_t slash = part.find('/');
  return slash == std::string::npos ? "" : part.substr(0, slash);
}

template <int D>
Mesh<D> join(std::vector<Mesh<D>> meshes, const std::vector<std::string>& bodies, const std::vector<int>& materials) {
  Mesh<D> all;
  std::vector<CubicPatch<D>> patches;
  Index region = 0;
  if (!meshes.empty()) all.mirrors = meshes.front().mirrors;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    Mesh<D>& mesh = meshes[k];
    assert(mesh.refinements == 0 && mesh.families.empty() && mesh.mirrors.size() == all.mirrors.size());
    std::vector<CubicPatch<D>> own;
    if (mesh.patches) own = *mesh.patches;
    append_sparse(patches, all.boundary.size(), own, mesh.boundary.size());
    append_parts(bodies[k], mesh, all);
    append_boundary(mesh, all);
    append_sparse(all.bends, all.elements.size(), mesh.bends, mesh.elements.size());
    mesh.region.resize(mesh.elements.size(), -1);
    for (Index& r : mesh.region) r += region + 1;
    append(all.region, mesh.region);
    region += 1 + materials[k];
    for (auto& element : mesh.elements)
      for (Index& v : element) v += all.vertices();
    append(all.elements, mesh.elements);
    append(all.points, mesh.points);
    append(all.pieces, mesh.pieces);
  }
  if (!patches.empty()) all.patches = std::make_shared<const std::vector<CubicPatch<D>>>(std::move(patches));
  return all;
}

template Mesh<2> join(std::vector<Mesh<2>>, const std::vector<std::string>&, const std::vector<int>&);
template Mesh<3> join(std::vector<Mesh<3>>, const std::vector<std::string>&, const std::vector<int>&);

}  // namespace signorini
