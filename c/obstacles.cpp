#include "c/obstacles.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <string>

#include "amg/tabulated_obstacle.hpp"
#include "c/versioned.hpp"
#include "core/sdk/coulomb_law.hpp"
#include "core/sdk/functional_obstacle.hpp"

namespace signorini {
namespace {

template <int B>
signorini_slot for_caller(const Slot<B>& slot) {
  return {B, slot.lower, slot.upper, slot.data, slot.last, slot.before, slot.tangential};
}

/// What functions of the caller say at one block.
template <int B>
class CallerEnergy {
 public:
  CallerEnergy() = default;  // of what is not used
  explicit CallerEnergy(const signorini_energy& energy) : energy_(energy) {}

  double change(const Slot<B>& slot, const double* from, const double* to) const {
    const signorini_slot own = for_caller(slot);
    return energy_.change(&own, from, to, energy_.data);
  }
  double slope(const Slot<B>& slot, const double* at, const double* step) const {
    const signorini_slot own = for_caller(slot);
    return energy_.slope(&own, at, step, energy_.data);
  }
  void minimise(const Slot<B>& slot, const double* M, const double* r, const double* x, double* y) const {
    const signorini_slot own = for_caller(slot);
    energy_.minimise(&own, M, r, x, y, energy_.data);
  }
  void linearise(const Slot<B>& slot, const double* x, const QuadraticModel<B>& out) const {
    const signorini_slot own = for_caller(slot);
    unsigned critical = 0;
    energy_.linearise(&own, x, out.gradient, out.hessian, &critical, energy_.data);
    for (int k = 0; k < B; ++k)
      if (critical >> k & 1u) out.lower[k] = out.upper[k] = 0;
    *out.critical |= static_cast<Flags>(critical);
  }

 private:
  signorini_energy energy_{};
};

template <int B>
class CallerLaw : public FunctionalObstacle<B, CallerEnergy<B>>, public Renewal<B>, public Scaling {
 public:
  explicit CallerLaw(const signorini_energy& energy)
      : FunctionalObstacle<B, CallerEnergy<B>>(CallerEnergy<B>(energy), CallerEnergy<B>(energy),
                                               CallerEnergy<B>(energy)),
        energy_(energy) {}

  const Renewal<B>* renewal() const noexcept override { return energy_.renew ? this : nullptr; }
  void renew(const LevelView<B>& level, Index first, Index last, const double* r,
             double* data) const noexcept override {
    const auto [from, to] = slots_between(level, first, last);
    for (Index slot = from; slot < to; ++slot) {
      const Index p = level.constrained[slot];
      const signorini_slot own = for_caller<B>(this->slot_of(level, slot));
      const Offset at = Offset{slot} * level.width;
      std::copy_n(level.data + at, level.width, data + at);
      energy_.renew(&own, level.value + level.row[p] * B * B, r + Offset{p} * B, level.x + Offset{p} * B, data + at,
                    energy_.data);
    }
  }

  const Scaling* scaling() const noexcept override { return energy_.scale ? this : nullptr; }
  void scale(double ratio, double* data) const noexcept override { energy_.scale(ratio, data, energy_.data); }

 private:
  signorini_energy energy_;
};

void require(const void* pointer, const std::string& name, const char* what) {
  if (!pointer) input_error(name, fmt::format("'{}' is null, expected an array", what));
}

std::vector<double> copied(const double* values, std::size_t count) {
  return values ? std::vector<double>(values, values + count) : std::vector<double>();
}

signorini_energy energy_of(const signorini_energy* given, const std::string& name) {
  constexpr std::size_t first_version = offsetof(signorini_energy, data) + sizeof given->data;
  const signorini_energy out = versioned(given, first_version, "energy", "signorini_energy", "SIGNORINI_ENERGY");
  if (!out.change || !out.slope || !out.minimise || !out.linearise)
    input_error(name, "its energy has a null among 'change', 'slope', 'minimise' and 'linearise', expected functions");
  return out;
}

template <int B>
ObstacleTable<B> table_of(const signorini_obstacle& given, const std::string& name) {
  if (given.blocks < 0) input_error(name, fmt::format("found {} blocks, expected 0 or more", given.blocks));
  if (given.directions < 1 || given.directions > B)
    input_error(name, fmt::format("found {} directions, expected 1 to {}, the block size", given.directions, B));
  if (given.blocks > 0) require(given.block, name, "block");
  const auto rows = static_cast<std::size_t>(given.blocks), bounds = rows * static_cast<std::size_t>(given.directions);
  return {{given.block, given.block + rows},
          given.directions,
          copied(given.direction, bounds * B),
          copied(given.lower, bounds),
          copied(given.upper, bounds),
          0,
          {}};
}

template <int B>
std::shared_ptr<const Obstacle<B>> with_friction(const signorini_obstacle& given, const std::string& name,
                                                 ObstacleTable<B> table) {
  if (given.energy) input_error(name, "found friction and an energy, expected one of them");
  if (B == 1 || given.directions != 1)
    input_error(name, fmt::format("found friction with blocks of {} and {} directions, expected blocks of 2 or 3 and "
                                  "one direction",
                                  B, given.directions));
  table.width = CoulombFriction<B>::data;
  for (std::int32_t i = 0; i < given.blocks; ++i) {
    if (!(given.friction[i] >= 0 && given.friction[i] < infinity))
      input_error(name, fmt::format("block {}: found the friction {}, expected a finite number, 0 or more",
                                    given.block[i], given.friction[i]));
    table.data.insert(table.data.end(), {0, given.friction[i]});
  }
  return std::make_shared<const TabulatedObstacle<B, CoulombLaw<B>>>(std::move(table));
}

template <int B>
std::shared_ptr<const Obstacle<B>> obstacle_of(const signorini_obstacle& given, const std::string& name) {
  ObstacleTable<B> table = table_of<B>(given, name);
  if constexpr (B > 1)
    if (given.friction) return with_friction<B>(given, name, std::move(table));
  if (given.friction) input_error(name, "found friction with blocks of 1, expected blocks of 2 or 3");
  if (!given.energy) return std::make_shared<const TabulatedObstacle<B, BoxObstacle<B>>>(std::move(table));
  if (given.numbers < 0 || given.numbers > most_data)
    input_error(name, fmt::format("found {} numbers per block, expected 0 to {}", given.numbers, most_data));
  if (given.numbers > 0 && given.blocks > 0) require(given.number, name, "number");
  table.width = given.numbers;
  table.data = copied(given.number, static_cast<std::size_t>(given.blocks) * static_cast<std::size_t>(given.numbers));
  return std::make_shared<const TabulatedObstacle<B, CallerLaw<B>>>(std::move(table), energy_of(given.energy, name));
}

}  // namespace

template <int B>
std::vector<BlockObstacle<B>> obstacles_from_c(std::int32_t count, const signorini_obstacle* const* given) {
  constexpr std::size_t first_version = offsetof(signorini_obstacle, number) + sizeof(const double*);
  std::vector<BlockObstacle<B>> out;
  for (std::int32_t k = 0; k < count; ++k) {
    require(given[k], fmt::format("obstacle {} of {}", k + 1, count), "obstacles");
    const signorini_obstacle one =
        versioned(given[k], first_version, "obstacle", "signorini_obstacle", "SIGNORINI_OBSTACLE");
    const std::string name = one.name ? one.name : "obstacle";
    BlockObstacle<B>& obstacle = out.emplace_back();
    obstacle.name = name;
    obstacle.obstacle = obstacle_of<B>(one, name);
    obstacle.blocks.assign(one.block, one.block + one.blocks);
    obstacle.places.assign(obstacle.blocks.size(), SurfaceVertex{{}, {}, 1});
  }
  return out;
}

template std::vector<BlockObstacle<1>> obstacles_from_c(std::int32_t, const signorini_obstacle* const*);
template std::vector<BlockObstacle<2>> obstacles_from_c(std::int32_t, const signorini_obstacle* const*);
template std::vector<BlockObstacle<3>> obstacles_from_c(std::int32_t, const signorini_obstacle* const*);

}  // namespace signorini
