#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/bench/accuracy/answer.hpp"

namespace signorini::bench {

/// A problem solved on finer and finer meshes, and its answer.
struct AccuracyProblem {
  std::string title;
  std::string about;  ///< what is solved, and what the answer is
  Question question;
  const char* width = "radius";  ///< what Answer::radius is called,
  const char* probe = nullptr;   ///< and Answer::probe; null: it is not compared
  struct Series {
    std::string name;
    std::vector<std::string> overrides;
    int finest;  ///< so many refinements at most
  };
  std::vector<Series> series;
  Answer exact{};
  std::function<double(double)> pressure = {};
};

/// Solves what the answer is taken from, if it is no formula.
struct NamedProblem {
  const char* name;  ///< of its picture
  /// @param less levels are left out
  /// @param scratch a folder for what it needs, which stays as long as the problem
  AccuracyProblem (*make)(int less, const std::filesystem::path& scratch);
};
const std::vector<NamedProblem>& accuracy_problems();

/// The ball of apps/scenes in space, with the answer of the axisymmetric one.
AccuracyProblem ball_in_space(int less, const std::filesystem::path& scratch);

}  // namespace signorini::bench
