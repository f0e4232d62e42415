#pragma once
#include "core/fem/model/model.hpp"

namespace signorini {

/// Whether models surely have the same coefficients at their steps, see Field::same().
template <int B>
bool same_stiffness(const Model<B>& a, const Model<B>& b);
/// Whether they surely have the same loads.
template <int B>
bool same_loads(const Model<B>& a, const Model<B>& b);

}  // namespace signorini
