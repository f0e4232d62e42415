#include "apps/signorini/chart/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/signorini/chart/child.hpp"
#include "core/base/error.hpp"

namespace signorini::chart {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double for_reference = 4;  // budgets that the run may take with which others are compared
constexpr double with_bounds = 8;    // times a solve, with bounds of its error, at most

std::vector<std::string> texts(const json& list) { return list.get<std::vector<std::string>>(); }

/// Removed in the end.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "signorini-chart-XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error(Exit::input, fmt::format("{}: no folder can be made there", name));
    path_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::vector<double> numbers(const json& value) {
  return value.is_number() ? std::vector{value.get<double>()} : value.get<std::vector<double>>();
}

/// One after the other; null is no number.
std::optional<std::vector<double>> joined(const json& list, const char* key) {
  std::vector<double> out;
  for (const json& entry : list) {
    if (entry[key].is_null()) return {};
    const std::vector<double> some = numbers(entry[key]);
    out.insert(out.end(), some.begin(), some.end());
  }
  if (out.empty()) return {};
  return out;
}

/// What of a report a run is.
std::optional<Run> read_run(const fs::path& file, std::size_t setting, std::vector<std::string> keys,
                            const std::string& of) {
  std::ifstream in(file);
  const json report = json::parse(in);
  auto value = quantity(report, of);
  if (!value) return {};
  const json& time = report["time"];
  return Run{.setting = setting,
             .keys = std::move(keys),
             .value = std::move(*value),
             .seconds = time["total"].get<double>() - time["output"].get<double>(),
             .unknowns = report["unknowns"].get<double>(),
             .memory = report["peak_memory_mb"].get<double>(),
             .iterations = report["iterations"].get<double>()};
}

std::vector<std::string> command(const ChartArguments& arguments, const std::vector<std::string>& keys,
                                 const fs::path& out) {
  std::vector<std::string> words{"solve", arguments.scene.string(), "--quiet", "--out", out.string()};
  const auto set = [&](const std::string& key) {
    words.emplace_back("--set");
    words.push_back(key);
  };
  for (const std::string& key : arguments.overrides) set(key);
  for (const std::string& key : keys) set(key);
  for (const char* file : {"vtu", "pictures", "convergence"}) set(fmt::format("output.{}=false", file));
  return words;
}

/// Seconds that the next run takes about, by the last two of its setting.
double next_seconds(const std::vector<Run>& all, std::size_t setting) {
  std::vector<double> took;
  for (const Run& run : all)
    if (run.setting == setting) took.push_back(run.seconds);
  if (took.empty()) return 0;
  if (took.size() == 1) return took.back();
  return took.back() * std::max(1.0, took.back() / took[took.size() - 2]);
}

/// The bounds of the energy error of the last run whose bounds are had in time; empty where there is none.
std::string certificate(const ChartArguments& arguments, const std::vector<Setting>& settings,
                        const std::vector<Run>& all, const fs::path& scratch) {
  const auto affordable = [&](const Run& run) {
    return settings[run.setting].has_bounds && with_bounds * run.seconds <= arguments.budget;
  };
  const auto found = std::find_if(all.rbegin(), all.rend(), affordable);
  if (arguments.of != "energy" || found == all.rend()) return {};
  std::vector<std::string> keys = found->keys;
  keys.emplace_back("solver.estimate=true");
  const fs::path folder = scratch / "bounds";
  if (!run_self(command(arguments, keys, folder), arguments.budget, scratch / "log").well) return {};
  std::ifstream in(folder / "report.json");
  const json estimate = json::parse(in)["estimate"];
  const std::string name = fmt::format("{}, {}", settings[found->setting].name, found->keys.back());
  if (estimate.is_null() || estimate["relative_upper"].is_null())
    return fmt::format("{}: no bounds of the energy error: {}", name,
                       estimate.is_null() ? "" : fmt::format("{}", fmt::join(texts(estimate["reasons"]), "; ")));
  return fmt::format(
      "{}: energy error between {:.2g} % and {:.2g} %, {}", name, 100 * estimate["relative_lower"].get<double>(),
      100 * estimate["relative_upper"].get<double>(),
      estimate["guaranteed"].get<bool>()
          ? "guaranteed"
          : "but for what is not covered: " + fmt::format("{}", fmt::join(texts(estimate["reasons"]), "; ")));
}

}  // namespace

std::optional<std::vector<double>> quantity(const json& report, const std::string& of) {
  if (of == "energy") {
    double sum = 0;
    for (const json& body : report["bodies"]) sum += body["energy"].get<double>();
    return std::vector{sum};
  }
  if (of == "force") return joined(report["contact"], "force");
  if (of == "pressure") return joined(report["contact"], "max_pressure");
  if (of == "area") return joined(report["contact"], "area");
  for (const json& probe : report["probes"])
    if ("probe " + probe["name"].get<std::string>() == of)
      return numbers(probe[probe.contains("displacement") ? "displacement" : "value"]);
  return {};
}

double Run::cost(const std::string& against) const {
  return against == "seconds" ? seconds : against == "unknowns" ? unknowns : against == "memory" ? memory : iterations;
}

Runs run_all(const ChartArguments& arguments, const std::vector<Setting>& settings,
             const std::function<void(const std::string&)>& begin, const std::function<void(const Run&)>& end) {
  Runs out;
  const Scratch scratch;
  for (std::size_t s = 0; s < settings.size(); ++s)
    for (std::size_t k = 0; k < settings[s].values.size(); ++k) {
      const std::vector<std::string> keys = settings[s].keys_of(k);
      const std::string name = fmt::format("{}, {}", settings[s].name, keys.back());
      const auto omit = [&](std::string why) { out.omitted.push_back({name, std::move(why)}); };
      // What others are compared with may take longer, once.
      const double limit = s == 0 ? for_reference * arguments.budget : arguments.budget;
      if (const double expected = next_seconds(out.all, s); expected > limit) {
        omit(fmt::format("would take about {:.3g} s of {:g}", expected, limit));
        break;
      }
      begin(name);
      const fs::path folder = scratch.path() / fmt::format("{}_{}", s, k);
      const Ended ended = run_self(command(arguments, keys, folder), limit, scratch.path() / "log");
      if (!ended.well) {
        omit(ended.reason);
        break;
      }
      const auto run = read_run(folder / "report.json", s, keys, arguments.of);
      if (!run) {
        omit(fmt::format("its report has no {}", arguments.of));
        break;
      }
      out.all.push_back(*run);
      end(*run);
      if (run->seconds > arguments.budget) break;
    }
  out.certificate = certificate(arguments, settings, out.all, scratch.path());
  return out;
}

}  // namespace signorini::chart
