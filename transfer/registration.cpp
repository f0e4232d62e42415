#include "transfer/registration.hpp"

#include "transfer/merge.hpp"
#include "transfer/unbounded.hpp"

namespace signorini {

namespace {

template <template <int> class Type>
void add(Registry& registry, const char* id, const char* help) {
  registry.add<Transfer<1>, Transfer<2>, Transfer<3>>(
      {"transfer", id, help, {}, file_of(reinterpret_cast<const void*>(&register_transfers)), {}},
      [] { return std::make_unique<Type<1>>(); }, [] { return std::make_unique<Type<2>>(); },
      [] { return std::make_unique<Type<3>>(); });
}

}  // namespace

void register_transfers(Registry& registry) {
  add<MinMerge>(registry, "min_merge", "monotone restriction by matrix and merge, in equal shares");
  add<Mandel>(registry, "mandel",
              "monotone restriction to the least distance in the support; rows with frames or negative weights as "
              "min_merge");
  add<Kornhuber>(registry, "kornhuber", "monotone restriction from row to row, nowhere tighter than min_merge");
  add<Unbounded>(registry, "none", "no bounds on coarse corrections: what method \"tnnmg\" uses");
}

}  // namespace signorini
