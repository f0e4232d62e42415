#pragma once
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/io/warning.hpp"
#include "core/mesh/refine.hpp"
#include "core/scene/scene.hpp"
#include "driver/scene/coarse_mesh.hpp"
#include "driver/scene/memory.hpp"

namespace signorini {

/// Calls function.operator()<D, B>() with the scene's dimension and a body's number of unknowns per vertex.
template <class Function>
decltype(auto) dispatch(const Scene& scene, Function&& function, std::size_t body = 0) {
  const bool scalar = scene.bodies[body].equation == Scene::Equation::diffusion;
  if (dimension_of(scene) == 2)
    return scalar ? function.template operator()<2, 1>() : function.template operator()<2, 2>();
  return scalar ? function.template operator()<3, 1>() : function.template operator()<3, 3>();
}

/// Calls work(); where there are several steps, or parts of one, its errors tell the one they belong to.
template <class Work>
decltype(auto) at_step(const Scene& scene, double t, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    const bool whole = scene.steps.count() == 1 && t == scene.steps.at.back();
    if (whole || error.status() == Exit::interrupted) throw;
    throw Error(error.status(), fmt::format("{}, at t = {}", error.what(), t));
  }
}

/// The meshes of a body, after making sure that a problem with B unknowns per vertex on them fits into memory. The
/// vertices of the finest one are the nodes of the body's elements, see nodes_of(): for quadratic elements it is one
/// refinement finer than `refine.uniform` says.
/// @param warnings where there are any, what is odd about the mesh of a file is added
/// @param promised memory of the bodies before it, to which its own is added; null: it is alone
template <int D>
MeshHierarchy<D> build_hierarchy(const Scene& scene, int block, Warnings* warnings = nullptr,
                                 const Progress& progress = Progress(), std::size_t body = 0,
                                 PromisedMemory* promised = nullptr);

/// The same of a coarsest mesh that is there.
/// @param uniform how often it is refined for linear elements
template <int D>
MeshHierarchy<D> hierarchy_of(Mesh<D> coarsest, int uniform, const Scene& scene, int block, Warnings* warnings,
                              std::size_t body, PromisedMemory* promised);

}  // namespace signorini
