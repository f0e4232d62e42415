#include "core/input/raw.hpp"

#include <algorithm>

namespace signorini {

const RawValue* RawTable::find(std::string_view key) const {
  const auto entry = std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.first == key; });
  return entry == entries.end() ? nullptr : &entry->second;
}

RawValue* RawTable::find(std::string_view key) {
  return const_cast<RawValue*>(static_cast<const RawTable*>(this)->find(key));
}

const std::vector<RawTable>& RawDocument::of(std::string_view name) const {
  static const std::vector<RawTable> none;
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const RawTables& t) { return t.name == name; });
  return found == tables.end() ? none : found->tables;
}

}  // namespace signorini
