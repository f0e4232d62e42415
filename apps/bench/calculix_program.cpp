#include "apps/bench/calculix_program.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"

namespace signorini::bench {
namespace {

namespace fs = std::filesystem;

double seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto of = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

std::string text_of(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

}  // namespace

std::optional<CalculixRun> run_calculix(const fs::path& folder, const std::string& name, double limit) {
  fs::remove(folder / (name + ".dat"));
  CalculixRun out;
  const double before = seconds_of_children();
  const int status = std::system(
      fmt::format("cd '{}' && OMP_NUM_THREADS=1 timeout {} ccx -i {} > log 2>&1", folder.string(), limit, name)
          .c_str());
  out.seconds = seconds_of_children() - before;
  const std::string result = text_of(folder / (name + ".dat")), log = text_of(folder / "log");
  const std::size_t total = result.rfind("total force");
  if (status != 0 || total == std::string::npos) return {};
  std::istringstream(result.substr(result.find('\n', total))) >> out.force[0] >> out.force[1] >> out.force[2];
  for (std::size_t at = log.find("iteration "); at != std::string::npos; at = log.find("iteration ", at + 1))
    ++out.iterations;
  return out;
}

fs::path calculix_folder() {
  if (std::system("command -v ccx > /dev/null") != 0)
    throw Error(Exit::input,
                "there is no program 'ccx': install Debian's package calculix-ccx, as ./dev setup peers does");
  const fs::path folder = fs::temp_directory_path() / fmt::format("signorini_calculix_{}", getpid());
  fs::create_directories(folder);
  return folder;
}

}  // namespace signorini::bench
