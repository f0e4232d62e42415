#pragma once
#include <string>
#include <string_view>

namespace signorini {

/// What a file that is no mesh the program reads is, and what to do with it: "a Nastran file, ..."; "" where it is not
/// recognised.
/// @param place the name of the file
std::string foreign_format(std::string_view content, std::string_view place);

}  // namespace signorini
