#include "driver/levels/level_choice.hpp"

#include "core/mesh/slender.hpp"
#include "core/mesh/stretch.hpp"

namespace signorini {
namespace {

/// Vectors on the coarsest mesh above which the hierarchy goes on below it.
constexpr Index large_coarsest_mesh = 1000;

/// Stretching of cells (core/mesh/stretch.hpp) from which on algebraic levels from the finest mesh take about
/// half the cycles of nested meshes or less, in about the same time: their set-up costs more for elastic bodies.
constexpr double stretched_scalar = 1.45, stretched_elastic = 1.7;
constexpr double most_stretched = 0.1;  // part of the cells so stretched

/// Vertices across the coarsest mesh of an elastic body, and across all where cells are stretched, which then have no
/// good coarser level, up to which a factorisation costs no more than some cycles. Other meshes have one: they are
/// factorised up to two cells across (in space three), which bend badly as coarse levels.
constexpr double cheap_across = 20;
template <int D>
constexpr double most_across = D == 2 ? 4 : 16;
/// Layers of vertices over vertices across, from where on bending makes coarser levels poor ones.
constexpr double slender = 16;

}  // namespace

template <int D>
bool is_stretched(const Mesh<D>& mesh, int block) {
  return stretched_part(mesh, block == 1 ? stretched_scalar : stretched_elastic) > most_stretched;
}

std::optional<Coarsening> coarsening_below(const Scene::Solver& options, int block, Index vertices) {
  if (!options.algebraic || vertices <= large_coarsest_mesh) return {};
  const Coarsening wanted = algebraic_settings(options).coarsening;
  if (wanted != Coarsening::automatic) return wanted;
  return block > 1 ? Coarsening::aggregation : Coarsening::classical;
}

template <int D>
std::size_t factorised_meshes(std::span<const Mesh<D>* const> meshes, const Scene::Solver& options, int block) {
  if (block == 1 || options.hierarchy != "auto" || options.coarse != "newton") return 0;
  const bool stretched = is_stretched(*meshes.front(), block);
  std::size_t count = 0;
  for (const Mesh<D>* mesh : meshes) {
    const LayerShape shape = layer_shape(*mesh);
    const double most = stretched || count == 0 ? cheap_across : most_across<D>;
    const bool factorised = shape.across <= most && (stretched || shape.along >= slender * shape.across);
    if (!factorised) break;
    ++count;
  }
  return stretched && count < meshes.size() ? 0 : count;
}

template <int D>
std::size_t first_mesh(std::span<const Mesh<D>* const> meshes, const Scene::Solver& options, int block, int order) {
  const std::size_t finest = meshes.size() - static_cast<std::size_t>(order);
  if (options.hierarchy != "auto") return options.hierarchy == "matrix" ? finest : 0;
  if (!options.algebraic || factorised_meshes(meshes, options, block) > 0) return 0;
  return is_stretched(*meshes.front(), block) ? finest : 0;
}

template std::size_t factorised_meshes(std::span<const Mesh<2>* const>, const Scene::Solver&, int);
template std::size_t factorised_meshes(std::span<const Mesh<3>* const>, const Scene::Solver&, int);
template std::size_t first_mesh(std::span<const Mesh<2>* const>, const Scene::Solver&, int, int);
template std::size_t first_mesh(std::span<const Mesh<3>* const>, const Scene::Solver&, int, int);
template bool is_stretched(const Mesh<2>&, int);
template bool is_stretched(const Mesh<3>&, int);

}  // namespace signorini
