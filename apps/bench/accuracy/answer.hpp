#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "driver/driver.hpp"

namespace signorini::bench {

using Position = std::array<double, 3>;  ///< the last entry is zero in 2D

inline constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// A scene whose answer is known, and what is asked of it.
struct Question {
  std::string scene;  ///< as a file has it
  std::filesystem::path folder = ".";
  bool round = false;  ///< the contact is a disk, else a strip
  /// Where on a contact a point is, by one number.
  std::function<double(const Position&)> along = [](const Position& x) { return x[0]; };
  std::vector<Position> samples = {};  ///< where stresses are compared, besides or without a contact
};

/// What a solve says, or the exact answer. Numbers that it has not are `not_there`.
struct Answer {
  double unknowns = 0, seconds = 0;
  int cycles = 0;
  double force = not_there, peak = not_there;
  double radius = not_there;  ///< of a contact that is round; else its area, which is in proportion to its width
  double probe = not_there;   ///< the last component of the first one
  /// At the nodes that the obstacle may reach, ascending.
  struct Pressure {
    double at, area, value;
  };
  std::vector<Pressure> pressure;
  std::vector<double> stress;  ///< von Mises' at Question::samples
};

/// Solves it, and calls look(driver) afterwards. Error(Exit::not_converged) where that fails.
Answer solve(const Question& question, const std::vector<std::string>& overrides,
             const std::function<void(Driver&)>& look = {});

/// Pressures between the nodes of a finer solve.
std::function<double(double)> profile(std::vector<Answer::Pressure> nodes);

/// What is compared, in the order of the tables.
inline constexpr std::size_t quantities = 6;
using Errors = std::array<double, quantities>;

/// Relative, with their sign where they have one: of force, largest pressure, radius, probe, of the pressure and of the
/// stress in the mean square. `not_there` where the exact answer is.
/// @param pressure the exact one
Errors errors_of(const Answer& found, const Answer& exact, const std::function<double(double)>& pressure);

}  // namespace signorini::bench
