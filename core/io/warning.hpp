#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace signorini {

/// What the program warns of: a row of the table in warning_kinds.hpp.
struct WarningKind {
  enum class About { scene, mesh, result };
  About about;
  const char* id;     ///< that reports give
  const char* text;   ///< that is printed, for fmt
  const char* means;  ///< what the text does not say itself
  const char* advice;
};

/// A figure of the results that is doubtful, or a place of the scene that is odd. Nothing stops for it.
struct Warning {
  std::string_view id;  ///< of its kind
  std::string text;

  operator const std::string&() const { return text; }  // NOLINT: it is what it says
  bool operator==(const Warning&) const = default;
};

using Warnings = std::vector<Warning>;

/// The tables of docs/warnings.md.
std::string warnings_page();

}  // namespace signorini

template <>
struct fmt::formatter<signorini::Warning> : fmt::formatter<std::string> {
  auto format(const signorini::Warning& warning, auto& context) const {
    return fmt::formatter<std::string>::format(warning.text, context);
  }
};
