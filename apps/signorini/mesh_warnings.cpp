#include "apps/signorini/mesh_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/mesh/joints.hpp"

namespace signorini {
namespace {

template <int D, std::size_t N>
std::string points(const Mesh<D>& mesh, const std::array<Index, N>& vertices) {
  std::string all;
  for (const Index v : vertices)
    all += fmt::format("{}({})", all.empty() ? "" : " - ", fmt::join(mesh.points[v], ", "));
  return all;
}

std::string and_others(std::size_t count) { return count > 1 ? fmt::format(", and at {} more", count - 1) : ""; }

}  // namespace

template <int D>
std::vector<std::string> joint_warnings(const Mesh<D>& mesh, const std::string& place) {
  std::vector<std::string> warnings;
  const Hinges hinges = find_hinges(mesh);
  if (const auto& all = hinges.vertices; !all.empty())
    warnings.push_back(fmt::format("{}: elements hang together only by the vertex at {}{}: the body has a hinge there",
                                   place, points(mesh, std::array{all[0]}), and_others(all.size())));
  if (const auto& all = hinges.edges; !all.empty())
    warnings.push_back(fmt::format("{}: elements hang together only by the edge {}{}: the body has a hinge there",
                                   place, points(mesh, all[0]), and_others(all.size())));
  if (const auto all = find_hanging_vertices(mesh); !all.empty())
    warnings.push_back(
        fmt::format("{}: the vertex at {} lies inside the {} {} of an element that it is no vertex of{}: "
                    "the body is torn there",
                    place, points(mesh, std::array{all[0].vertex}), D == 2 ? "edge" : "face",
                    points(mesh, mesh.boundary[all[0].face].vertices), and_others(all.size())));
  return warnings;
}

template std::vector<std::string> joint_warnings(const Mesh<2>&, const std::string&);
template std::vector<std::string> joint_warnings(const Mesh<3>&, const std::string&);

}  // namespace signorini
