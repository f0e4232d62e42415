// load FOLDER: finds the plugin `slot` in a folder and compares one of its constraints with the numbers expected.
#include <cstdio>
#include <memory>

#include <signorini/component/plugin_loader.hpp>
#include <signorini/component/settings.hpp>

using namespace signorini;

int main(int argc, char** argv) try {
  if (argc != 2) return 1;
  Registry registry;
  PluginLoader loader(registry, {argv[1]});
  loader.require("slot");
  loader.require("contact");  // from the installed folder
  const RawValue gap{std::string("x / 4"), "gap"}, axis{RawValue::List{{0.0, "axis"}, {2.0, "axis"}}, "axis"};
  const auto settings = compile_settings("obstacle 'slot'", registry.entry("obstacle", "slot").options,
                                         {"slot", {{"gap", gap}, {"axis", axis}}});
  Status status;
  const std::unique_ptr<Obstacle<2>> slot(registry.obstacle("slot").create2(*settings, status));
  LocalConstraint<2> c;
  const SurfaceVertex vertex = {{2, 0, 0}, {0, 1, 0}};
  if (slot) slot->assemble(&vertex, 1, &c, status);
  std::printf("%s: %s%d direction (%g, %g), %g to %g\n", registry.entry("obstacle", "contact").file.c_str(),
              status.message, c.directions, c.direction[0][0], c.direction[0][1], c.lower[0], c.upper[0]);
  const bool right = c.direction[0][0] == 0 && c.direction[0][1] == 1 && c.lower[0] == -0.5 && c.upper[0] == 0.5;
  const bool optimised = registry.entry("obstacle", "slot").optimised;
  if (!optimised) std::printf("the documented commands build it without optimisation\n");
  return status.ok() && right && optimised ? 0 : 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 5;
}
