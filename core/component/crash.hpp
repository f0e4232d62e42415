#pragma once
#include <filesystem>
#include <string>

namespace signorini {

/// From now on a fault, an exception that nothing catches or a call of exit while code of a plugin runs, or code that a
/// plugin called, ends the program with Exit::plugin and a message that names the plugin's file. It is told by the
/// stack, so that calls of plugins cost nothing more. Without a plugin on the stack the program ends as it would have.
void name_plugins_that_crash();

/// The file of a plugin in whose code some thread is, or in code that it called; "" where there is none. Every thread
/// looks at its stack.
std::string plugin_at_work();

/// The library of a plugin, as it was loaded.
/// @param address in it
void remember_plugin(const std::filesystem::path& file, const void* address);

}  // namespace signorini
