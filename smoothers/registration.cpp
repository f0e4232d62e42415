#include "smoothers/registration.hpp"

#include "smoothers/gauss_seidel.hpp"
#include "smoothers/patch.hpp"
#include "smoothers/surface_first.hpp"

namespace signorini {

namespace {

template <template <int> class Type, class... Arguments>
void add(Registry& registry, const char* id, const char* help, Arguments... arguments) {
  registry.add<Smoother<1>, Smoother<2>, Smoother<3>>(
      {"smoother", id, help, {}, file_of(reinterpret_cast<const void*>(&register_smoothers)), {}},
      [=] { return std::make_unique<Type<1>>(arguments...); }, [=] { return std::make_unique<Type<2>>(arguments...); },
      [=] { return std::make_unique<Type<3>>(arguments...); });
}

}  // namespace

void register_smoothers(Registry& registry) {
  add<GaussSeidel>(registry, "forward", "projected block Gauss-Seidel in ascending order", SweepOrder::forward);
  add<GaussSeidel>(registry, "backward", "projected block Gauss-Seidel in descending order", SweepOrder::backward);
  add<GaussSeidel>(registry, "symmetric", "projected block Gauss-Seidel, forward and backward in every step",
                   SweepOrder::symmetric);
  add<GaussSeidel>(registry, "adjoint",
                   "projected block Gauss-Seidel, forward on the way down and backward on the way up",
                   SweepOrder::adjoint);
  add<SurfaceFirst>(registry, "surface_first",
                    "projected block Gauss-Seidel, the vectors at obstacles and their neighbours before the others");
  add<Patch>(registry, "patch",
             "projected block Gauss-Seidel and exact solves on patches of vectors without obstacle, for nearly "
             "incompressible material");
}

}  // namespace signorini
