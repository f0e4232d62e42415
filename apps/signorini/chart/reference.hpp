#pragma once
#include <string>
#include <vector>

#include "apps/signorini/chart/run.hpp"

namespace signorini::chart {

/// What runs are compared with.
struct Reference {
  std::vector<double> value;
  double uncertain = 0;  ///< how far it may be off itself, as an error
  std::string text;      ///< where it comes from
};

/// The relative difference of a quantity from what it is taken to be; of energies the square root of it, which is that
/// of the solutions in the energy norm.
double relative_error(const std::string& of, const std::vector<double>& value, const std::vector<double>& exact);

/// By the differences of the last three values on meshes that are refined alike, or of two of them: how far the last
/// one is off, as an error. Each difference to come is taken to be as much smaller than the one before as the last one
/// was, but at most 2.5 times: contact comes and goes in steps, and a small difference may be one by chance. With two
/// values it is half as large.
double error_left(const std::string& of, const std::vector<std::vector<double>>& values);

/// The exact value where it is given. Else the last run of the first setting, which is an answer as good as the
/// differences of the last three of its runs say, going on alike.
/// Error(Exit::input) where there are too few runs to compare with each other, or the exact value has another number of
/// components.
Reference reference(const ChartArguments& arguments, const std::vector<Setting>& settings, const std::vector<Run>& all);

/// Gives runs their errors; none to those that come as near to the reference as that is to the answer.
void compare(const std::string& of, const Reference& with, std::vector<Run>& all);

}  // namespace signorini::chart
