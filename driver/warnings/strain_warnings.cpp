#include "driver/warnings/strain_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/fem/conditions/fixes.hpp"
#include "core/io/warning_kinds.hpp"
#include "core/mesh/connected.hpp"
#include "driver/warnings/contact_warnings.hpp"

namespace signorini {
namespace {

// Of a body's volume. At corners, and at the rims of punches, strains have no limit: there they are large in a few
// elements, however small the loads are.
constexpr double much = 0.05;

template <int D>
std::string where(const StrainSizes<D>& strains) {
  return fmt::format("{:.3g} at ({:.6g})", strains.largest, fmt::join(strains.place, ", "));
}

/// Whether some displacement is prescribed that is not zero.
template <int D>
bool moves_by_fixes(const Nodes<D>& nodes, const Model<D>& model) {
  const std::vector<FixedDirections<D>> fixes = collect_fixes<D, D>(nodes, model);
  return std::ranges::any_of(fixes, [](const auto& at) {
    return std::any_of(at.value, at.value + at.count, [](double v) { return v != 0; });
  });
}

}  // namespace

template <int D>
StrainSizes<D> strains(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u) {
  return strain_sizes(nodes, model.plane, is_paired(model) ? connected_parts(nodes.mesh()) : std::vector<Index>(), u);
}

template <int D>
void refuse_folded(const Nodes<D>& coarsest, const Model<D>& model, const StrainSizes<D>& strains) {
  if (strains.folded <= much || (model.obstacles.empty() && !moves_by_fixes(coarsest, model))) return;
  const Warnings reasons = start_warnings(coarsest, model);  // an obstacle may be on the wrong side
  input_error(model.origin,
              fmt::format("{:.3g} % of the body would be pressed through itself, with strains of up to {}: linear "
                          "elasticity, which is meant for small ones, says nothing of that; expected smaller "
                          "displacements and loads, in units that fit the body's, and obstacles that begin outside of "
                          "it{}{}",
                          100 * strains.folded, where(strains), reasons.empty() ? "" : "; ", fmt::join(reasons, "; ")));
}

template <int D>
Warnings strain_warnings(const Model<D>& model, const StrainSizes<D>& strains) {
  if (strains.large <= much) return {};
  return {warning<"large-strain">(
      model.origin, where(strains), large_strain, 100 * strains.large,
      strains.folded > 0 ? fmt::format("; {:.3g} % of it is pressed through itself", 100 * strains.folded) : "")};
}

template StrainSizes<2> strains(const Nodes<2>&, const Model<2>&, const std::vector<double>&);
template StrainSizes<3> strains(const Nodes<3>&, const Model<3>&, const std::vector<double>&);
template void refuse_folded(const Nodes<2>&, const Model<2>&, const StrainSizes<2>&);
template void refuse_folded(const Nodes<3>&, const Model<3>&, const StrainSizes<3>&);
template Warnings strain_warnings(const Model<2>&, const StrainSizes<2>&);
template Warnings strain_warnings(const Model<3>&, const StrainSizes<3>&);

}  // namespace signorini
