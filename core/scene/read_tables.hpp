#pragma once
#include <filesystem>

#include "core/input/raw.hpp"
#include "core/scene/scene.hpp"

/// One reader per table of a scene; each validates the table by itself. `folder` is what file names are relative to.
namespace signorini {

Scene::Body read_body(const RawTable& table, const std::filesystem::path& folder);
Scene::Obstacle read_obstacle(const RawTable& table, const std::filesystem::path& folder);
Scene::Contact read_contact(const RawTable& table, const std::filesystem::path& folder);
Scene::Material read_material(const RawTable& table, const std::filesystem::path& folder);
Scene::Fix read_fix(const RawTable& table, const std::filesystem::path& folder);
Scene::Rigid read_rigid(const RawTable& table, const std::filesystem::path& folder);
Scene::Load read_load(const RawTable& table, const std::filesystem::path& folder);
Scene::Spring read_spring(const RawTable& table, const std::filesystem::path& folder);
Scene::Probe read_probe(const RawTable& table, const std::filesystem::path& folder);

/// Dimension of a body by its shape; 0 when only the mesh file tells.
int dimension_of(const Scene::Body& body);

/// What bodies leave open: the order of their elements, and whether nearly incompressible material has a pressure of
/// its own.
void choose_elements(Scene& scene);

/// Everything that concerns more than one table: names, what holds the body.
void check_scene(const Scene& scene, const std::string& place);

}  // namespace signorini
