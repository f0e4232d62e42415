#pragma once
#include <span>
#include <string>

#include "core/sdk/plugin.hpp"

namespace signorini {

/// Everything that keeps a plugin from working with this build, in one message; empty when it fits.
std::string incompatibilities(const sdk::Plugin& plugin);

/// "NAME: 'x' in the plugin, 'y' here" for every field that differs or is missing on one side, separated by "; ".
std::string differences(std::span<const sdk::FingerprintField> plugin, std::span<const sdk::FingerprintField> here);

/// The licence that a plugin tells of, "" where it tells of none.
std::string licence_of(const sdk::Plugin& plugin);

/// Whether the plugin was compiled with optimisation, as far as it says.
bool is_optimised(const sdk::Plugin& plugin);

}  // namespace signorini
