#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "core/scene/scene.hpp"

namespace signorini::test {

/// The scene of the documentation: an elastic ball on a plane.
inline const std::string ball = R"(title = "Ball pressed on a plane"

[[body]]
name     = "ball"
shape    = "ball"
center   = [0, 0, 0]
radius   = 1.0
size     = 0.25
equation = "elasticity"
young    = 1.0
poisson  = 0.3
order    = 1

[[fix]]
body  = "ball"
where = "z > 0.5"
value = [0, 0, -0.02]

[[load]]
body  = "ball"
value = [0, 0, 0]

[[obstacle]]
type  = "contact"
body  = "ball"
on    = "boundary"
shape = "plane"
point = [0, 0, -1]
normal = [0, 0, 1]

[solver]
tolerance = 1e-8

[refine]
uniform = 2

[[probe]]
name = "pole"
body = "ball"
at   = [0, 0, -1]
)";

/// A scalar problem in 2D with only what is required.
inline const std::string membrane = R"([[body]]
name = "membrane"
shape = "rectangle"
from = [0, 0]
to = [1, 1]
cells = [2, 2]
equation = "diffusion"

[[fix]]
body = "membrane"
on = "boundary"
value = 0

[[obstacle]]
type = "scalar"
body = "membrane"
lower = "-0.1 + x"
)";

inline Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "scene.toml", ".", overrides);
}

/// The text with its only occurrence of `from` replaced.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos)
    throw std::logic_error("not exactly once in the scene: " + std::string(from));
  return text.replace(at, from.size(), to);
}

/// What a call throws: exit status and message; status `solved` when it throws nothing.
struct Outcome {
  Exit status = Exit::solved;
  std::string message;
};

template <class Call>
Outcome outcome(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.status(), error.what()};
  }
  return {};
}

}  // namespace signorini::test
