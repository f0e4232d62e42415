#pragma once
#include <cstdlib>

namespace signorini::test {

/// Whether `./dev nightly` runs the tests: sweeps then take all their cases and meshes.
inline bool nightly() { return std::getenv("NIGHTLY") != nullptr; }

/// What a sweep takes at night, and what of it in every run of the tests.
template <class T>
T nightly(T all, T some) {
  return nightly() ? all : some;
}

}  // namespace signorini::test
