#pragma once
#include <filesystem>
#include <string>

namespace signorini::bench {

/// The tables of docs/measured/accuracy.md: errors beside seconds and unknowns, linear and quadratic elements.
/// @param only problems whose name or title has this text; empty: all
/// @param pictures a folder that gets a picture of each table; empty: none
void print_accuracy(bool quick, const std::string& only, const std::filesystem::path& pictures);

}  // namespace signorini::bench
