#include "core/mesh/separate.hpp"

#include <algorithm>
#include <unordered_map>

namespace signorini {
namespace {

template <int D>
class Separator {
 public:
  explicit Separator(Mesh<D>& mesh) : mesh_(mesh), elements_of_(mesh.points.size()), faces_of_(mesh.elements.size()) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (const Index v : mesh.elements[e]) elements_of_[v].push_back(static_cast<Index>(e));
    for (std::size_t f = 0; f < mesh.boundary.size(); ++f) {
      faces_of_[mesh.boundary[f].element].push_back(static_cast<Index>(f));
      for (const Index v : mesh.boundary[f].vertices) boundary_of_[v].push_back(static_cast<Index>(f));
    }
  }

  void run() {
    const std::size_t given = mesh_.elements.size();
    for (std::size_t e = 0; e < given; ++e)
      while (divide(static_cast<Index>(e))) {
      }
  }

 private:
  bool holds(const auto& vertices, Index v) const {
    return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
  }

  // Two faces f, g of a simplex miss one vertex each; the edge between these is the only one in neither.
  bool divide(Index e) {
    const std::vector<Index>& faces = faces_of_[e];
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (std::size_t j = i + 1; j < faces.size(); ++j) {
        const Face<D>&f = mesh_.boundary[faces[i]], &g = mesh_.boundary[faces[j]];
        if (f.curve < 0 || f.curve != g.curve || mesh_.curves[f.curve].kind == Curve<D>::Kind::elements) continue;
        const Index c = missing(e, f), d = missing(e, g);
        if (!on_boundary(c, d)) {
          bisect(c, d);
          return true;
        }
      }
    return false;
  }

  Index missing(Index e, const Face<D>& face) const {
    for (const Index v : mesh_.elements[e])
      if (!holds(face.vertices, v)) return v;
    return -1;
  }

  bool on_boundary(Index c, Index d) const {
    const auto faces = boundary_of_.find(c);
    return faces != boundary_of_.end() && std::any_of(faces->second.begin(), faces->second.end(),
                                                      [&](Index f) { return holds(mesh_.boundary[f].vertices, d); });
  }

  void bisect(Index c, Index d) {
    const Index m = mesh_.vertices();
    Point<D> middle;
    for (int i = 0; i < D; ++i) middle[i] = 0.5 * (mesh_.points[c][i] + mesh_.points[d][i]);
    mesh_.points.push_back(middle);
    elements_of_.emplace_back();
    const std::vector<Index> around = elements_of_[c];
    for (const Index e : around)
      if (holds(mesh_.elements[e], d)) bisect_element(e, c, d, m);
  }

  // The old element keeps c, the new one d.
  void bisect_element(Index e, Index c, Index d, Index m) {
    const auto added = static_cast<Index>(mesh_.elements.size());
    mesh_.elements.push_back(mesh_.elements[e]);
    if (!mesh_.region.empty()) mesh_.region.push_back(mesh_.region[e]);
    std::replace(mesh_.elements[e].begin(), mesh_.elements[e].end(), d, m);
    std::replace(mesh_.elements[added].begin(), mesh_.elements[added].end(), c, m);
    for (const Index v : mesh_.elements[added])
      if (v != d) elements_of_[v].push_back(added);
    std::replace(elements_of_[d].begin(), elements_of_[d].end(), e, added);
    elements_of_[m].push_back(e);
    faces_of_.emplace_back();
    const std::vector<Index> faces = faces_of_[e];
    faces_of_[e].clear();
    for (const Index f : faces) {
      const Index owner = holds(mesh_.boundary[f].vertices, d) ? added : e;
      mesh_.boundary[f].element = owner;
      faces_of_[owner].push_back(f);
    }
  }

  Mesh<D>& mesh_;
  std::vector<std::vector<Index>> elements_of_;                // per vertex
  std::vector<std::vector<Index>> faces_of_;                   // per element, its boundary faces
  std::unordered_map<Index, std::vector<Index>> boundary_of_;  // per boundary vertex, its boundary faces
};

}  // namespace

template <int D>
void separate_curved_faces(Mesh<D>& mesh) {
  Separator<D>(mesh).run();
}

template void separate_curved_faces(Mesh<2>&);
template void separate_curved_faces(Mesh<3>&);

}  // namespace signorini
