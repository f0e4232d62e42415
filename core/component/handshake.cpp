#include "core/component/handshake.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <string_view>
#include <vector>

namespace signorini {
namespace {

using sdk::FingerprintField;

std::string value_of(const FingerprintField* field) {
  if (!field) return "nothing";
  return field->text ? fmt::format("'{}'", field->text) : fmt::format("{}", field->number);
}

const FingerprintField* find(std::span<const FingerprintField> fields, std::string_view name) {
  for (const FingerprintField& field : fields)
    if (field.name && name == field.name) return &field;
  return nullptr;
}

// What is wrong with the versions; a plugin for a newer minor relies on what this program does not have.
std::string version_mismatch(const sdk::Plugin& plugin) {
  const bool major = plugin.abi_major != sdk::abi_major;
  if (!major && plugin.abi_minor <= sdk::abi_minor) return {};
  const bool newer = major ? plugin.abi_major > sdk::abi_major : true;
  return fmt::format(
      "plugin interface: {}.{} in the plugin, {}.{} here{}", plugin.abi_major, plugin.abi_minor, sdk::abi_major,
      sdk::abi_minor,
      newer ? fmt::format(", it needs a newer signorini with SDK {}.{}", plugin.abi_major, plugin.abi_minor) : "");
}

}  // namespace

std::string differences(std::span<const FingerprintField> plugin, std::span<const FingerprintField> here) {
  std::vector<std::string> found;
  const auto compare = [&](std::string_view name, const FingerprintField* theirs, const FingerprintField* ours) {
    if (name == sdk::optimised) return;  // slow, but no danger
    if (value_of(theirs) != value_of(ours))
      found.push_back(fmt::format("{}: {} in the plugin, {} here", name, value_of(theirs), value_of(ours)));
  };
  for (const FingerprintField& ours : here) compare(ours.name, find(plugin, ours.name), &ours);
  for (const FingerprintField& theirs : plugin)
    if (theirs.name && !find(here, theirs.name)) compare(theirs.name, &theirs, nullptr);
  return fmt::format("{}", fmt::join(found, "; "));
}

std::string incompatibilities(const sdk::Plugin& plugin) {
  if (std::memcmp(plugin.magic, sdk::magic, sizeof sdk::magic) != 0)
    return "its 'signorini_plugin' does not begin with the magic word of signorini plugins";
  if (plugin.size < sdk::least_size)
    return fmt::format("its 'signorini_plugin' has {} bytes, at least {} were expected", plugin.size, sdk::least_size);
  if (!plugin.fingerprint || !plugin.id || !plugin.version || !plugin.description || !plugin.register_all)
    return "its 'signorini_plugin' has null members";
  std::vector<std::string> found;
  for (const std::string& mismatch :
       {version_mismatch(plugin), differences({plugin.fingerprint, plugin.fingerprint_fields}, sdk::fingerprint)})
    if (!mismatch.empty()) found.push_back(mismatch);
  if (found.empty()) return {};
  return fmt::format("{}: rebuild against SDK {}.{}", fmt::join(found, "; "), sdk::abi_major, sdk::abi_minor);
}

std::string licence_of(const sdk::Plugin& plugin) {
  const bool has_member = plugin.size >= offsetof(sdk::Plugin, licence) + sizeof plugin.licence;
  return has_member && plugin.licence ? plugin.licence : "";
}

bool is_optimised(const sdk::Plugin& plugin) {
  const FingerprintField* field = find({plugin.fingerprint, plugin.fingerprint_fields}, sdk::optimised);
  return field && field->number != 0;
}

}  // namespace signorini
