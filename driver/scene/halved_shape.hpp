#pragma once
#include "core/scene/scene.hpp"

namespace signorini {

/// The part of a body's shape that is meshed: of a shape that lies on both sides of a plane of symmetry the side of the
/// larger coordinates. Shapes that mesh files and surfaces give stay as they are. Error(Exit::input) at the planes
/// where the shape is not symmetric.
Scene::BodyShape halved_shape(const Scene& scene, const Scene::Body& body);

}  // namespace signorini
