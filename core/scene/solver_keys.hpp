#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/scene/scene.hpp"
#include "core/scene/specs.hpp"

namespace signorini {

/// The keys of `[solver]`: the options of the solver, and those that only a scene has.
std::span<const KeySpec> solver_keys();

/// The names of the latter, which need meshes.
std::span<const char* const> solver_keys_of_scenes();

/// What docs/solver_options.md adds to one of them, in sentences; "" for nothing.
const char* more_about(std::string_view key);

/// The same as the table of docs/solver_options.md, in Markdown.
std::string solver_options_page();

Scene::Solver read_solver(const RawTable& table, const std::filesystem::path& folder);

}  // namespace signorini
