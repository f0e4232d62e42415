// The destructors of the interfaces live here, so that each of them exists once, in the core library.
#include "core/sdk/error_estimator.hpp"
#include "core/sdk/obstacle.hpp"
#include "core/sdk/registrar.hpp"
#include "core/sdk/stepping.hpp"
#include "core/sdk/tying.hpp"

namespace signorini {

DistanceFunction::~DistanceFunction() = default;
Settings::~Settings() = default;
Registrar::~Registrar() = default;
SampledStress::~SampledStress() = default;
ErrorEstimator::~ErrorEstimator() = default;
Scaling::~Scaling() = default;
Friction::~Friction() = default;
Stepping::~Stepping() = default;
Tying::~Tying() = default;

template <int B>
Obstacle<B>::~Obstacle() = default;

template <int B>
Functional<B>::~Functional() = default;

template <int B>
Linearisation<B>::~Linearisation() = default;

template <int B>
Renewal<B>::~Renewal() = default;

void DistanceFunction::place(const double*, const double*, Placement&, Status&) const noexcept {}

template class Obstacle<1>;
template class Obstacle<2>;
template class Obstacle<3>;
template class Functional<1>;
template class Functional<2>;
template class Functional<3>;
template class Linearisation<1>;
template class Linearisation<2>;
template class Linearisation<3>;
template class Renewal<1>;
template class Renewal<2>;
template class Renewal<3>;

}  // namespace signorini
