// Apart from what registers components: the keys of scenes are of no use to a solver for matrices.
#include "amg/registration.hpp"
#include "core/scene/solver_keys.hpp"
#include "core/solver/option_table.hpp"

namespace signorini {
namespace {

/// Those of the solver that concern levels chosen by the matrix.
std::vector<OptionSpec> options_of_levels() {
  std::vector<OptionSpec> out;
  for (const auto& row : option_table())
    if (row.of_levels) {
      const KeySpec& key = *find_key(solver_keys(), row.name);
      const OptionType type = key.type == KeyType::boolean ? OptionType::boolean : OptionType::text;
      out.push_back({key.name, type, key.fallback, key.range, key.help});
    }
  return out;
}

}  // namespace

std::vector<Entry> coarsenings() {
  const std::string file = file_of(reinterpret_cast<const void*>(&coarsenings));
  return {{"amg",
           "aggregation",
           "smoothed aggregation, which represents a near null space such as rigid body modes",
           options_of_levels(),
           file,
           {}},
          {"amg",
           "classical",
           "strength of connection and extended interpolation from some of the vectors",
           options_of_levels(),
           file,
           {}}};
}

}  // namespace signorini
