#include "transfer/registration.hpp"

#include "transfer/min_merge.hpp"
#include "transfer/unbounded.hpp"

namespace signorini {

void register_transfers(Registry& registry) {
  const std::string file = file_of(reinterpret_cast<const void*>(&register_transfers));
  registry.add<Transfer<1>, Transfer<2>, Transfer<3>>(
      {"transfer",
       "min_merge",
       "monotone restriction by matrix and merge, for weights of any sign and coupling",
       {},
       file,
       {}},
      [] { return std::make_unique<MinMerge<1>>(); }, [] { return std::make_unique<MinMerge<2>>(); },
      [] { return std::make_unique<MinMerge<3>>(); });
  registry.add<Transfer<1>, Transfer<2>, Transfer<3>>(
      {"transfer", "none", "no bounds on coarse corrections: what method \"tnnmg\" uses", {}, file, {}},
      [] { return std::make_unique<Unbounded<1>>(); }, [] { return std::make_unique<Unbounded<2>>(); },
      [] { return std::make_unique<Unbounded<3>>(); });
}

}  // namespace signorini
