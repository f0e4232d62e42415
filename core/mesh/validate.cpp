#include "core/mesh/validate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/subsimplices.hpp"

namespace signorini {
namespace {

constexpr double degenerate = 1e-14;

template <int D>
class Validation {
 public:
  Validation(const Mesh<D>& mesh, std::string_view place, std::span<const Offset> label)
      : mesh_(mesh), place_(place), label_(label) {}

  void run() const {
    if (mesh_.elements.empty())
      input_error(place_, fmt::format("the mesh has no {}", D == 2 ? "triangles" : "tetrahedra"));
    check_points();
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) check_element(e);
    check_faces();
    check_connected();
  }

 private:
  Offset label(std::size_t e) const { return label_.empty() ? static_cast<Offset>(e) : label_[e]; }

  void check_points() const {
    for (std::size_t v = 0; v < mesh_.points.size(); ++v)
      if (!std::ranges::all_of(mesh_.points[v], [](double x) { return std::isfinite(x); }))
        input_error(place_, fmt::format("vertex {} is at {}, coordinates must be finite", v, mesh_.points[v]));
  }

  void check_element(std::size_t e) const {
    const Simplex<D>& element = mesh_.elements[e];
    for (const Index v : element)
      if (v < 0 || v >= mesh_.vertices())
        input_error(place_,
                    fmt::format("element {} has vertex {}, there are {} vertices", label(e), v, mesh_.vertices()));
    const Simplex<D> ordered = sorted(element);
    if (std::adjacent_find(ordered.begin(), ordered.end()) != ordered.end())
      input_error(place_, fmt::format("element {} has a vertex twice: {}", label(e), element));
    const auto corner = corners<D>(mesh_.points, element);
    const double volume = relative_volume<D>(corner);
    if (!(std::abs(volume) >= degenerate))
      input_error(place_, fmt::format("element {} is degenerate: its volume is {:.2g} of h^{}, h = {:.3g} its longest "
                                      "edge (at {})",
                                      label(e), volume, D, longest_edge<D>(corner), corner[0]));
    if (volume < 0)
      input_error(place_, fmt::format("element {} is inverted: its volume is {:.3g} while that of others is positive "
                                      "(at {})",
                                      label(e), signed_volume<D>(corner), corner[0]));
  }

  /// Whether the outward normal of a face belongs to an even or an odd order of its vertices: two elements on different
  /// sides of a face differ in this.
  static bool odd_face(const Simplex<D>& element, int opposite) {
    const std::array<Index, D> face = outward_face<D>(element, opposite);
    int inversions = 0;
    for (int k = 0; k < D; ++k)
      for (int l = 0; l < k; ++l) inversions += face[l] > face[k];
    return inversions % 2 == 1;
  }

  void check_faces() const {
    const Numbering faces = number_faces<D>(mesh_.vertices(), mesh_.elements);
    std::vector<Offset> first(faces.distinct, -1);
    std::vector<std::uint8_t> shared(faces.distinct, 0);
    for (std::size_t i = 0; i < faces.number.size(); ++i) {
      const Index f = faces.number[i];
      if (first[f] < 0) {
        first[f] = static_cast<Offset>(i);
        continue;
      }
      const std::size_t e = i / (D + 1), other = first[f] / (D + 1);
      if (shared[f]++ > 0)
        input_error(place_, fmt::format("the {} {} of element {} is shared by more than two elements, {} among them",
                                        D == 2 ? "edge" : "face", outward_face<D>(mesh_.elements[e], i % (D + 1)),
                                        label(e), label(other)));
      if (odd_face(mesh_.elements[e], i % (D + 1)) == odd_face(mesh_.elements[other], first[f] % (D + 1)))
        input_error(place_, fmt::format("elements {} and {} overlap: they lie on the same side of the {} they share",
                                        label(other), label(e), D == 2 ? "edge" : "face"));
    }
  }

  void check_connected() const {
    std::vector<Index> root(mesh_.points.size(), -1);  // a forest of vertices, -1: in no element
    const auto find = [&](Index v) {
      while (root[v] != v) v = root[v] = root[root[v]];
      return v;
    };
    for (const auto& element : mesh_.elements)
      for (const Index v : element) {
        if (root[v] < 0) root[v] = v;
        root[find(v)] = find(element[0]);
      }
    Index components = 0;
    for (Index v = 0; v < mesh_.vertices(); ++v) {
      if (root[v] < 0) input_error(place_, fmt::format("vertex {} belongs to no element", v));
      components += root[v] == v;
    }
    if (components > 1)
      input_error(place_, fmt::format("disconnected mesh: it has {} pieces that share no vertex; a body is one piece",
                                      components));
  }

  const Mesh<D>& mesh_;
  std::string_view place_;
  std::span<const Offset> label_;
};

}  // namespace

template <int D>
void validate(const Mesh<D>& mesh, std::string_view place, std::span<const Offset> label) {
  Validation<D>(mesh, place, label).run();
}

template void validate(const Mesh<2>&, std::string_view, std::span<const Offset>);
template void validate(const Mesh<3>&, std::string_view, std::span<const Offset>);

}  // namespace signorini
