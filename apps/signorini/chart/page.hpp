#pragma once
#include <string>
#include <vector>

#include "apps/signorini/chart/reference.hpp"
#include "core/io/picture.hpp"

namespace signorini::chart {

/// Error against cost, a line per setting, both axes logarithmic.
std::vector<Panel> panels(const ChartArguments& arguments, const std::vector<Setting>& settings,
                          const std::vector<Run>& all);

/// A row per run, with a heading.
std::string csv(const ChartArguments& arguments, const std::vector<Setting>& settings, const std::vector<Run>& all);

/// What a page shows.
struct Page {
  std::string title;
  std::string reference;  ///< where it comes from
  std::string svg;        ///< the picture
  Panel solution;         ///< without patches: is not shown
};

/// One HTML file that needs no other one and no network: the picture, all runs, what is left out, and the solution, to
/// be turned with the mouse.
std::string html(const Page& page, const ChartArguments& arguments, const std::vector<Setting>& settings,
                 const Runs& runs);

}  // namespace signorini::chart
