#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/sdk/obstacle.hpp"
#include "core/sdk/stepping.hpp"

namespace signorini {

/// An obstacle of a registered type, for blocks of a matrix: `signorini list obstacles` shows types and options.
///
///   auto floor = std::make_shared<Floor>();  // derived from DistanceFunction
///   auto obstacle = signorini::obstacle_by_name<2>("coulomb", {{"friction=0.3"}}, floor);
///
/// @tparam B the block size of the matrix
/// @param options texts "KEY=VALUE"; a value may be an expression in x, y, z, nx, ny, nz where the type takes fields
/// @param shape of types that take one: the rigid obstacle; null: none
/// @param folders where plugins are looked for first, see PluginLoader
/// @param step of types that depend on it
/// @throws Error(Exit::input) for an option or a value that the type does not have, a shape that is missing or too
/// much,
///     and a type that knows no blocks of this size; Error(Exit::plugin) where no library has the type or it fails
template <int B>
std::shared_ptr<const Obstacle<B>> obstacle_by_name(const std::string& type, std::span<const std::string> options = {},
                                                    std::shared_ptr<const DistanceFunction> shape = nullptr,
                                                    std::vector<std::filesystem::path> folders = {},
                                                    const LoadStep& step = {});

template <int B>
std::shared_ptr<const Obstacle<B>> obstacle_by_name(const std::string& type, const std::vector<std::string>& options,
                                                    std::shared_ptr<const DistanceFunction> shape = nullptr) {
  return obstacle_by_name<B>(type, std::span(options), std::move(shape), {}, {});
}

}  // namespace signorini
