#include "driver/scene/materials.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>

#include "core/base/error.hpp"
#include "driver/scene/numbers.hpp"

namespace signorini {
namespace {

std::string known(const FileGroups& groups, const char* elements) {
  if (groups.of_elements.empty()) return fmt::format("the mesh file has no physical group of {}", elements);
  std::vector<std::string> names;
  for (const auto& [name, numbers] : groups.of_elements) names.push_back(name);
  return fmt::format("the physical groups of {} are: {}", elements, fmt::join(names, ", "));
}

}  // namespace

template <int D>
std::vector<Index> regions(const Scene& scene, const Scene::Body& body, const Mesh<D>& mesh, const FileGroups& groups) {
  const char* elements = D == 2 ? "triangles" : "tetrahedra";
  const std::vector<int> numbers = numbers_of(scene.materials, body);
  if (numbers.empty()) return {};
  std::vector<Index> out(mesh.elements.size(), -1);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Scene::Material& material = scene.materials[numbers[k]];
    const auto group = groups.of_elements.find(material.volume);
    if (group == groups.of_elements.end())
      input_error(material.source.of("volume"),
                  fmt::format("there is no volume '{}'; {}", material.volume, known(groups, elements)));
    for (const Index e : group->second) {
      if (out[e] >= 0 && out[e] != static_cast<Index>(k))
        input_error(material.source.of("volume"),
                    fmt::format("'{}' shares {} with '{}', which has a material, too; expected one material each",
                                material.volume, elements, scene.materials[numbers[out[e]]].volume));
      out[e] = static_cast<Index>(k);
    }
  }
  return out;
}

Field coefficient(const Scene& scene, const Scene::Body& body, Field Scene::Body::*own,
                  std::optional<Field> Scene::Material::*others) {
  std::vector<Field> of_region;
  std::string text;
  bool uses_t = false;
  const auto add = [&](const Field& field, const std::string& of) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", of, field.text());
    uses_t = uses_t || field.uses_t();
    of_region.push_back(field);
  };
  const std::span<const Scene::Body> bodies = body.parts.empty() ? std::span(&body, 1) : std::span(body.parts);
  for (const Scene::Body& part : bodies) {
    add(part.*own, part.name);
    for (const int k : numbers_of(scene.materials, part))
      add(others ? (scene.materials[k].*others).value_or(part.*own) : part.*own, scene.materials[k].volume);
  }
  if (of_region.size() == 1) return of_region.front();
  const int first = body.parts.empty() ? -1 : 0;  // the region of a body's own material
  const auto value = [of_region, first](const Site& site) {
    return of_region[static_cast<std::size_t>(site.region - first)](site);
  };
  return {value, text, body.source.table, false, uses_t};
}

template std::vector<Index> regions(const Scene&, const Scene::Body&, const Mesh<2>&, const FileGroups&);
template std::vector<Index> regions(const Scene&, const Scene::Body&, const Mesh<3>&, const FileGroups&);

}  // namespace signorini
