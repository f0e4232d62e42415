#pragma once
#include <optional>
#include <string>
#include <vector>

#include "conformance/subject.hpp"

namespace signorini::conformance {

/// Values that an obstacle can be constructed with, or why there are none.
struct Base {
  Values values;              ///< of options without default that it asks for
  std::string failed, found;  ///< the check that failed, and how; "" for none
  std::string refused;        ///< what it says of the user's values; "" where it takes them
};

/// Constructs it with its defaults, and gives it what its errors name until it is content.
/// @throws Error(Exit::input) where a value is needed that cannot be guessed
template <int B>
Base base_of(const Subject& subject);

/// All else that it is constructed with: values inside all ranges, at each end of each range, another shape.
template <int B>
std::vector<Values> variants_of(const Subject& subject, const Values& base);

/// What is wrong with what it says to these values, at some vertices; "" where it takes or refuses them well.
template <int B>
std::string wrong_with_values(const Subject& subject, const Values& values);

/// In words: "with friction=0, gap=0.3"; "with its defaults".
std::string describe(const Values& values, const Values& given);

}  // namespace signorini::conformance
