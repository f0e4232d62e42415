// my_obstacle_test LIBRARY: what every plugin has to do, by the checks of `signorini plugin check`.
// my_obstacle_test LIBRARY SCENE: the scene is solved to what Gauss-Seidel steps alone lead to.
#include <cstdio>
#include <exception>

#include <signorini/conformance/check.hpp>

using namespace signorini::conformance;

namespace {

bool conforms(const char* library) {
  const Verdict verdict = check_plugin(library);  // of other options: check_plugin(library, {{"gap=0.3"}})
  std::fputs(text_of(verdict).c_str(), stdout);
  return verdict.conforms();
}

bool agrees(const char* library, const char* scene) {
  const Comparison found = compare_with_gauss_seidel(scene, library);
  std::printf("%d iterations, %d of Gauss-Seidel; the solutions differ by %.1e\n", found.iterations, found.gauss_seidel,
              found.difference);
  return found.difference < 1e-5;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2 && argc != 3) return 1;
  return (argc == 2 ? conforms(argv[1]) : agrees(argv[1], argv[2])) ? 0 : 5;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
