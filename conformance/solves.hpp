#pragma once
#include <filesystem>
#include <string>

#include "conformance/check.hpp"
#include "conformance/subject.hpp"

namespace signorini::conformance {

/// What solves of an obstacle lead to.
struct Solves {
  std::string agrees, cycles;  ///< what is wrong with them, by check; "" for nothing
  std::string example;         ///< the scene
  std::string note;            ///< why none were compared; "" where they were
};

/// Solves a square or a cube with the obstacle, at three sizes, by what method "auto" takes and by Gauss-Seidel steps.
/// @param folder of the library
template <int B>
Solves solve_scenes(const Subject& subject, const Values& values, const std::filesystem::path& folder, int space);

}  // namespace signorini::conformance
