#include "apps/bench/peers/calculix_program.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "apps/bench/peers/child.hpp"
#include "core/base/error.hpp"

namespace signorini::bench {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

}  // namespace

std::optional<CalculixRun> run_calculix(const fs::path& folder, const std::string& name, double limit) {
  fs::remove(folder / (name + ".dat"));
  // in a shell of its own, whose limit holds for all of it
  const ChildRun child =
      run_child(fmt::format("sh -c \"cd '{}' && exec ccx -i {} > log 2>&1\"", folder.string(), name), limit);
  CalculixRun out;
  out.seconds = child.seconds;
  const std::string result = text_of(folder / (name + ".dat")), log = text_of(folder / "log");
  const std::size_t total = result.rfind("total force");
  if (!child.ended_well || total == std::string::npos) return {};
  std::istringstream(result.substr(result.find('\n', total))) >> out.force[0] >> out.force[1] >> out.force[2];
  for (std::size_t at = log.find("iteration "); at != std::string::npos; at = log.find("iteration ", at + 1))
    ++out.iterations;
  return out;
}

bool has_calculix() { return has_program("ccx"); }

void require_calculix() {
  if (!has_calculix())
    throw Error(Exit::input,
                "there is no program 'ccx': install Debian's package calculix-ccx, as ./dev setup peers does");
}

}  // namespace signorini::bench
