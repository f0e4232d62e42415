#pragma once
#include <algorithm>
#include <string>
#include <vector>

namespace signorini {

/// Of the largest value: what is no more counts as equal where fields are compared with polynomials.
inline constexpr double same_value = 1e-10;

/// Why a number is not a guaranteed bound, in sentences, each once.
struct Reasons {
  std::vector<std::string> all;
  bool refused = false;           ///< there is no number either
  bool geometry_unknown = false;  ///< of the true boundary and obstacle

  void add(std::string reason) {
    if (std::ranges::find(all, reason) == all.end()) all.push_back(std::move(reason));
  }
  void refuse(std::string reason) {
    refused = true;
    add(std::move(reason));
  }
  void add_geometry(std::string reason) {
    geometry_unknown = true;
    add(std::move(reason));
  }
  bool none() const { return all.empty(); }
};

}  // namespace signorini
