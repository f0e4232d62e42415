#include "core/mesh/slender.hpp"

#include "core/mesh/layers.hpp"

namespace signorini {

template <int D>
LayerShape layer_shape(const Mesh<D>& mesh) {
  std::vector<double> size;
  for (const Index l : mesh.layer.empty() ? layers(mesh) : mesh.layer) {
    if (static_cast<std::size_t>(l) >= size.size()) size.resize(static_cast<std::size_t>(l) + 1, 0);
    ++size[l];
  }
  double sum = 0;
  for (const double s : size) sum += s * s;
  const double vertices = mesh.vertices();
  return vertices > 0 ? LayerShape{sum / vertices, vertices * vertices / sum} : LayerShape{};
}

template LayerShape layer_shape(const Mesh<2>&);
template LayerShape layer_shape(const Mesh<3>&);

}  // namespace signorini
