#include "smoothers/registration.hpp"

#include "smoothers/gauss_seidel.hpp"

namespace signorini {

namespace {

void add(Registry& registry, const char* id, const char* help, SweepOrder order) {
  const Entry entry{"smoother", id, help, {}, file_of(reinterpret_cast<const void*>(&register_smoothers)), {}};
  registry.add<Smoother<1>, Smoother<2>, Smoother<3>>(
      entry, [order] { return std::make_unique<GaussSeidel<1>>(order); },
      [order] { return std::make_unique<GaussSeidel<2>>(order); },
      [order] { return std::make_unique<GaussSeidel<3>>(order); });
}

}  // namespace

void register_smoothers(Registry& registry) {
  add(registry, "forward", "projected block Gauss-Seidel in ascending order", SweepOrder::forward);
  add(registry, "backward", "projected block Gauss-Seidel in descending order", SweepOrder::backward);
  add(registry, "symmetric", "projected block Gauss-Seidel, forward and backward in every step", SweepOrder::symmetric);
  add(registry, "adjoint", "projected block Gauss-Seidel, forward on the way down and backward on the way up",
      SweepOrder::adjoint);
}

}  // namespace signorini
