#include "core/scene/solver_options.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/scene/override.hpp"
#include "core/scene/solver_keys.hpp"

namespace signorini {

namespace {

void refuse(const RawValue& value, const std::string& expected) {
  input_error(value.origin, fmt::format("expected {}", expected));
}

}  // namespace

SolverOptions solver_options(std::span<const std::string> assignments) {
  RawDocument document;
  for (const std::string& given : assignments) apply_override(document, given);
  for (const auto& [key, value] : document.top.entries) refuse(value, "solver.KEY=VALUE");
  RawTable solver{"solver", {}};
  for (const RawTables& found : document.tables)
    for (const RawTable& table : found.tables)
      if (found.name == "solver")
        solver = table;
      else
        for (const auto& [key, value] : table.entries) refuse(value, "solver.KEY=VALUE");
  for (const char* key : solver_keys_of_scenes())
    if (const RawValue* value = solver.find(key)) refuse(*value, "another key: this one needs meshes");
  return read_solver(solver, {});
}

}  // namespace signorini
