#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/signorini/chart/setting.hpp"
#include "apps/signorini/commands.hpp"

namespace signorini::chart {

/// What a chart shows the error of: `energy`, `force`, `pressure`, `area` or `probe NAME`.
/// @return nothing where the report has no such quantity
std::optional<std::vector<double>> quantity(const nlohmann::json& report, const std::string& of);

/// One solve.
struct Run {
  std::size_t setting;  ///< its number
  std::vector<std::string> keys;
  std::vector<double> value;  ///< of the quantity
  double seconds = 0;         ///< without the writing of files
  double unknowns = 0, memory = 0, iterations = 0;
  std::optional<double> error{};  ///< relative; nothing: closer to the reference than that is to the answer

  double cost(const std::string& against) const;
};

/// What was not run, or is not shown, and why.
struct Omission {
  std::string what, why;
};

struct Runs {
  std::vector<Run> all;
  std::vector<Omission> omitted;
  std::string certificate;  ///< what is guaranteed of the energy error of one of them; empty: not asked
};

/// Solves a scene with each setting on finer and finer meshes, until a run is not ready in time, or the next one would
/// not be. The last run of the first setting may take four times as long. Where bounds of the energy error are to be
/// had, one of the runs is repeated with them.
/// @param begin, end are told of each run
Runs run_all(const ChartArguments& arguments, const std::vector<Setting>& settings,
             const std::function<void(const std::string&)>& begin, const std::function<void(const Run&)>& end);

}  // namespace signorini::chart
