// The destructors of the interfaces live here, so that each of them exists once, in the core library.
#include "core/sdk/obstacle.hpp"
#include "core/sdk/registrar.hpp"

namespace signorini {

DistanceFunction::~DistanceFunction() = default;
Settings::~Settings() = default;
Registrar::~Registrar() = default;

template <int B>
Obstacle<B>::~Obstacle() = default;

template <int B>
Nonlinearity<B>::~Nonlinearity() = default;

template <int B>
void Nonlinearity<B>::renew(const LevelView<B>&, Index, Index, const double*, double*) const noexcept {}

template <int B>
bool Nonlinearity<B>::follows_solution() const noexcept {
  return false;
}

template <int B>
bool Nonlinearity<B>::scale(double, double*) const noexcept {
  return false;
}

template <int B>
bool Nonlinearity<B>::friction(const double*, FrictionLaw&) const noexcept {
  return false;
}

void DistanceFunction::place(const double*, const double*, Placement&, Status&) const noexcept {}

template class Obstacle<1>;
template class Obstacle<2>;
template class Obstacle<3>;
template class Nonlinearity<1>;
template class Nonlinearity<2>;
template class Nonlinearity<3>;

}  // namespace signorini
