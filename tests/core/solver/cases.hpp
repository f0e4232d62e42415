#pragma once
#include "tests/support/problems.hpp"

namespace signorini::test {

/// The problems that every setting of the solver has to solve, small enough for a direct reference solver.
template <int B>
struct Case {
  std::string name;
  Nested<B> nested;
};

inline std::vector<Case<1>> scalar_cases() {
  const auto zero = [](const double*) { return 0.0; };
  const auto hill = [](const double* x) {
    return 0.1 - 1.5 * ((x[0] - 0.4) * (x[0] - 0.4) + (x[1] - 0.5) * (x[1] - 0.5));
  };
  const auto wave = [](const double* x) { return std::sin(9 * x[0]) * std::cos(5 * x[1]) * 0.03 - 0.01; };
  const auto ceiling = [=](const double* x) { return wave(x) + 0.05; };
  const auto level = [](double c) { return [c](const double*) { return c; }; };
  std::vector<Case<1>> out;
  out.push_back({"radial2", discretize_all<2, 1>(cube<2>(-2, 2, 4), 3, radial_model<2>())});
  out.push_back({"radial3", discretize_all<3, 1>(cube<3>(-2, 2, 3), 2, radial_model<3>())});
  out.push_back({"two_sided", discretize_all<2, 1>(cube<2>(0, 1, 2), 4, membrane(3, level(-0.05), ceiling))});
  out.push_back({"hill", discretize_all<2, 1>(cube<2>(0, 1, 3), 3, membrane(-1, hill, {}))});
  out.push_back({"full_contact", discretize_all<2, 1>(cube<2>(0, 1, 2), 3, membrane(-8, zero, {}))});
  out.push_back({"no_contact", discretize_all<2, 1>(cube<2>(0, 1, 2), 4, membrane(1, level(-1), level(1)))});
  // Equal bounds on a quarter of the square, none elsewhere.
  const auto pinned = [](double sign) {
    return [sign](const double* x) {
      return x[0] < 0.51 && x[1] < 0.51 ? 0.01 * std::sin(6 * x[0] * x[1]) * x[0] * x[1] : sign * infinity;
    };
  };
  Model<1> equal = membrane(1, pinned(-1), pinned(1));
  equal.fixes = {{on("right"), {Field(0)}}};
  out.push_back({"equal_bounds", discretize_all<2, 1>(cube<2>(0, 1, 2), 4, equal)});
  // u = x solves -Laplace u = 0 and touches the obstacle on half of the square without any force: biactive.
  const auto touching = [](const double* x) { return x[0] - std::max(0.0, x[0] - 0.5); };
  Model<1> weightless = membrane(0, touching, {});
  weightless.fixes = {{on("boundary"), {field([](const double* x) { return x[0]; })}}};
  out.push_back({"biactive", discretize_all<2, 1>(cube<2>(0, 1, 2), 4, weightless)});
  Model<1> half = weightless;
  half.loads = {{{}, {field([](const double* x) { return x[0] < 0.25 ? -1.0 : 0.0; })}}};
  out.push_back({"partly_biactive", discretize_all<2, 1>(cube<2>(0, 1, 2), 4, half)});
  return out;
}

inline std::vector<Case<2>> plane_cases() {
  std::vector<Case<2>> out;
  out.push_back({"block", discretize_all<2, 2>(cube<2>(0, 1, 2), 3, pressed_block<2>(plane<2>({0, 0}, {0, 1}), 0.05))});
  out.push_back({"incline",
                 discretize_all<2, 2>(cube<2>(0, 1, 2), 3, pressed_block<2>(plane<2>({0.2, 0}, {-0.28, 0.96}), 0.05))});
  out.push_back(
      {"circle", discretize_all<2, 2>(cube<2>(0, 1, 2), 3, pressed_block<2>(sphere<2>({0.4, -1}, 0.98), 0.08))});
  out.push_back({"held", discretize_all<2, 2>(cube<2>(0, 1, 2), 3, resting_block<2>({3, -1}, {"left"}))});
  return out;
}

inline std::vector<Case<3>> space_cases() {
  std::vector<Case<3>> out;
  out.push_back(
      {"block3", discretize_all<3, 3>(cube<3>(0, 1, 2), 1, pressed_block<3>(plane<3>({0, 0, 0}, {0, 0, 1}), 0.05))});
  out.push_back(
      {"sphere3", discretize_all<3, 3>(cube<3>(0, 1, 2), 2, pressed_block<3>(sphere<3>({0.4, 0.55, -1}, 0.98), 0.08))});
  out.push_back({"held3", discretize_all<3, 3>(cube<3>(0, 1, 2), 1, resting_block<3>({2, 1, -1}, {"left", "front"}))});
  return out;
}

}  // namespace signorini::test
