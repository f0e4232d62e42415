#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace signorini {

/// Columns for text that people read: COLUMNS where that is exported, else those of the terminal that standard output
/// is, else 80, so that what goes into files and pipes is the same everywhere.
int text_width();

/// Of the terminal that a file descriptor is; 0 where it is none, or does not say.
int terminal_width(int descriptor);

/// The text with longer lines broken at spaces. What goes on stands below what the line says: behind its first gap of
/// two spaces, or else behind a first word that ends with a colon; without either below its beginning.
std::string fitted(std::string_view text, int width);

void print_fitted(std::string_view text);

/// Formats, and prints fitted.
template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  print_fitted(fmt::format(format, std::forward<T>(values)...));
}

}  // namespace signorini
