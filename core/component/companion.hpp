#pragma once
#include <array>
#include <filesystem>
#include <string>

namespace signorini {

/// A library of the project that lies beside the core library and is loaded when something needs it: it is linked with
/// what is under another licence, or few scenes need it.
struct Companion {
  const char* name;
  const char* file;
  const char* what;     ///< it is, for messages
  const char* of;       ///< what it is linked with that is no part of the project; "": nothing
  const char* licence;  ///< of both together, as SPDX names it
  bool gpl;             ///< a build with SIGNORINI_GPL=OFF leaves it out
};

inline constexpr Companion plane_library{"plane", "libsignorini_plane.so", "the geometry library for the plane",
                                         "CGAL",  "GPL-3.0-or-later",      true};
inline constexpr Companion geometry_library{"geometry", "libsignorini_geometry.so", "the geometry library",
                                            "CGAL",     "GPL-3.0-or-later",         true};
inline constexpr Companion direct_solvers{
    "cholmod", "libsignorini_cholmod.so", "the direct solver", "CHOLMOD and UMFPACK", "GPL-2.0-or-later", true};
inline constexpr Companion picture_library{"pictures",
                                           "libsignorini_pictures.so",
                                           "the library for pictures",
                                           "Cairo",
                                           "BSD-3-Clause AND (LGPL-2.1-only OR MPL-1.1)",
                                           false};
inline constexpr Companion certificate_library{
    "certificate", "libsignorini_certificate.so", "the error estimator", "", "BSD-3-Clause", false};
inline constexpr std::array companions{plane_library, geometry_library, direct_solvers, picture_library,
                                       certificate_library};

/// Beside the core library.
std::filesystem::path path_of(const Companion& companion);

/// Why it is missing, where this build does without: "this build was configured with SIGNORINI_GPL=OFF..."; else "".
std::string why_missing(const Companion& companion);

/// A function of it; the library is loaded for good.
/// @throws Error(Exit::plugin) naming the path where there is none, or another library
void* load_function(const Companion& companion, const char* function, const std::filesystem::path& library);
inline void* load_function(const Companion& companion, const char* function) {
  return load_function(companion, function, path_of(companion));
}

}  // namespace signorini
