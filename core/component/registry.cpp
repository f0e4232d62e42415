#include "core/component/registry.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "core/base/error.hpp"
#include "core/sdk/error_estimator.hpp"

namespace signorini {

void Registry::require_free(std::string_view kind, std::string_view id, std::string_view file) const {
  if (has(kind, id))
    throw Error(Exit::plugin,
                fmt::format("{} '{}' is provided twice: by {} and by {}", kind, id, entry(kind, id).file, file));
}

void Registry::insert(Entry entry, Creators creators) {
  require_free(entry.kind, entry.id, entry.file);
  const auto key = std::pair(entry.kind, entry.id);
  items_.emplace(key, Item{std::move(entry), std::move(creators)});
}

void Registry::add_obstacle(const ObstacleType& type, Entry entry) {
  entry.kind = "obstacle";
  entry.id = type.id;
  entry.help = type.help;
  entry.options.assign(type.options, type.options + type.option_count);
  Creators offered;
  offered.emplace(typeid(ObstacleType), type);
  insert(std::move(entry), std::move(offered));
}

void Registry::add_estimator(const EstimatorType& type, Entry entry) {
  entry.kind = "estimator";
  entry.id = type.id;
  entry.help = type.help;
  Creators offered;
  offered.emplace(typeid(EstimatorType), type);
  insert(std::move(entry), std::move(offered));
}

const Registry::Item& Registry::item(std::string_view kind, std::string_view id) const {
  const auto found = items_.find({std::string(kind), std::string(id)});
  if (found != items_.end()) return found->second;
  std::vector<std::string> ids;
  for (const Entry& known : entries(kind)) ids.push_back(known.id);
  throw Error(Exit::input, fmt::format("there is no {} '{}'{} (available: {})", kind, id, did_you_mean(id, ids),
                                       ids.empty() ? "none" : fmt::format("{}", fmt::join(ids, ", "))));
}

const std::any* Registry::offered(std::string_view kind, std::string_view id, std::type_index interface) const {
  const Creators& creators = item(kind, id).creators;
  const auto found = creators.find(interface);
  return found == creators.end() ? nullptr : &found->second;
}

void Registry::wrong_interface(std::string_view kind, std::string_view id) {
  throw Error(Exit::input, fmt::format("{} '{}' cannot be used for this kind of problem", kind, id));
}

const ObstacleType& Registry::obstacle(std::string_view id) const {
  const std::any* type = offered("obstacle", id, typeid(ObstacleType));
  if (!type) wrong_interface("obstacle", id);
  return std::any_cast<const ObstacleType&>(*type);
}

const EstimatorType* Registry::estimator(std::string_view id) const {
  const std::any* type = offered("estimator", id, typeid(EstimatorType));
  return type ? &std::any_cast<const EstimatorType&>(*type) : nullptr;
}

bool Registry::has(std::string_view kind, std::string_view id) const {
  return items_.count({std::string(kind), std::string(id)}) != 0;
}

const Entry& Registry::entry(std::string_view kind, std::string_view id) const { return item(kind, id).entry; }

std::vector<Entry> Registry::entries(std::string_view kind) const {
  std::vector<Entry> result;
  for (const auto& [key, known] : items_)
    if (kind.empty() || key.first == kind) result.push_back(known.entry);
  return result;
}

std::string file_of(const void* address) {
  Dl_info info{};
  if (dladdr(address, &info) == 0 || !info.dli_fname) return {};
  std::error_code ignored;
  const auto path = std::filesystem::canonical(info.dli_fname, ignored);
  return ignored ? std::string(info.dli_fname) : path.string();
}

}  // namespace signorini
