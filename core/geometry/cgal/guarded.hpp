#pragma once
#include <CGAL/exceptions.h>

#include <new>
#include <string>

#include "core/geometry/geometry.hpp"

namespace signorini::geometry {

/// The condition that failed, or the first line of what CGAL says instead of one.
inline std::string reason(const CGAL::Failure_exception& failure) {
  const std::string text = failure.expression().empty() ? failure.message() : failure.expression();
  return text.substr(0, text.find('\n'));
}

/// Calls `work`; what CGAL finds itself unable to do, and what does not fit memory, becomes the user's error.
template <class Work>
auto guarded(const char* what, const Work& work) {
  try {
    return work();
  } catch (const CGAL::Failure_exception& failure) {
    throw ShapeError(what, "",
                     fmt::format("failed for this geometry ({}); expected one without degenerate details, or another "
                                 "size",
                                 reason(failure)));
  } catch (const std::bad_alloc&) {
    throw ShapeError(what, "", "out of memory; expected a larger size");
  }
}

}  // namespace signorini::geometry
