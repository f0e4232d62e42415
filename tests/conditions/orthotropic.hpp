#pragma once
#include "core/fem/model/orthotropy.hpp"
#include "support.hpp"

/// Bodies of orthotropic material.
namespace signorini::test {

inline const std::vector<std::string> exact = {"solver.tolerance=1e-12"};
inline const std::string plate = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [3, 1]\ncells = [6, 2]\n";
inline const std::string brick = "shape = \"box\"\nfrom = [0, 0, 0]\nto = [3, 1, 1]\ncells = [6, 2, 2]\n";

inline std::string orthotropic(const EngineeringConstants& c) {
  return fmt::format("orthotropic = [{}]\n", fmt::join(c, ", "));
}
inline std::string order(int p) { return fmt::format("order = {}\n", p); }
inline std::string fix(const std::string& on, const std::string& value) {
  return table("fix", on + "\nvalue = " + value);
}

inline constexpr EngineeringConstants wood = {10, 1, 2, 0.35, 0.3, 0.25, 0.7, 0.9, 0.4};

}  // namespace signorini::test
