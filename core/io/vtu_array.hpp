#pragma once
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.hpp"

namespace signorini {

/// How a VTU file stores its arrays.
struct VtuFormat {
  bool swapped = false;          ///< numbers are in the other byte order
  std::size_t header_bytes = 4;  ///< of the integers in front of binary data
  bool compressed = false;
  std::string_view appended;  ///< what follows the underscore
  bool appended_base64 = false;
  std::string_view content;  ///< the file, to find lines
  std::string_view place;

  /// Error(Exit::input) with the line of an element.
  [[noreturn]] void fail(const pugi::xml_node& node, std::string_view message) const;
};

/// The numbers of a DataArray, `expected` of them. T is double, or Offset for arrays that must be of an integer type.
/// Memory is taken for no more than what the file holds.
template <class T>
std::vector<T> read_array(const pugi::xml_node& array, Offset expected, const VtuFormat& format);

/// An attribute that must be an integer >= 0; `fallback` where it is missing, which is an error if negative.
Offset integer_attribute(const pugi::xml_node& node, const char* name, Offset fallback, const VtuFormat& format);

}  // namespace signorini
