#include "methods/configuration.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/solver/option_table.hpp"

namespace signorini {

namespace {

void require(bool holds, const char* key, const std::string& found, const char* expected) {
  if (!holds) input_error(fmt::format("solver.{}", key), fmt::format("found '{}', expected {}", found, expected));
}

enum class Reach { all, twins };
enum class Interpolate { global, local };

Truncation truncation_of(const SolverOptions& o) { return choice<Truncation>(o, &SolverOptions::truncate); }

bool only_twins(const SolverOptions& o) { return choice<Reach>(o, &SolverOptions::reach) == Reach::twins; }

bool local_components(const SolverOptions& o) {
  return choice<Interpolate>(o, &SolverOptions::interpolate) == Interpolate::local;
}

}  // namespace

Coarsening coarsening_of(const SolverOptions& o) { return choice<Coarsening>(o, &SolverOptions::coarsening); }

Method check_options(const SolverOptions& o) {
  check_ranges(o);
  require(o.pre + o.post > 0, "pre", fmt::format("{}' and '{}", o.pre, o.post), "at least one smoothing step");
  require(o.cut == 0 || truncation_of(o) != Truncation::none, "cut", fmt::format("{}", o.cut),
          "0 with truncate 'none'");
  const auto method = choice<Method>(o, &SolverOptions::method);
  require(method != Method::tnnmg || truncation_of(o) != Truncation::none, "truncate", o.truncate,
          "'normal' or 'tangential' with method 'tnnmg', whose coarse corrections have no bounds");
  require(method == Method::tnnmg || o.transfer != "none", "transfer", o.transfer,
          "a monotone restriction, or method 'tnnmg', whose coarse corrections have no bounds");
  const bool restricted = only_twins(o), rotated = local_components(o);
  require(coarsening_of(o) != Coarsening::aggregation || !(restricted || rotated), "coarsening", o.coarsening,
          "'auto' or 'classical' with reach 'twins' or interpolate 'local'");
  require(o.aggregates == SolverOptions{}.aggregates || algebraic_settings(o).coarsening != Coarsening::classical,
          "aggregates", o.aggregates,
          "'greedy' with coarsening 'classical', reach 'twins' or interpolate 'local', which make no aggregates");
  return method;
}

void check_components(const SolverOptions& o, const Registry& registry) {
  const auto check = [&](const char* kind, const char* key, const std::string& id) {
    try {
      registry.entry(kind, id);
    } catch (const Error& error) {
      input_error(fmt::format("solver.{}", key), error.what());
    }
  };
  check("smoother", "smoother", o.smoother);
  check("transfer", "transfer", o.transfer);
  check("coarse", "coarse", o.coarse);
  check("aggregates", "aggregates", o.aggregates);
}

AlgebraicSettings algebraic_settings(const SolverOptions& o) {
  const bool restricted = only_twins(o), rotated = local_components(o);
  return {restricted, rotated, restricted || rotated ? Coarsening::classical : coarsening_of(o)};
}

template <int B>
typename MonotoneMultigrid<B>::Settings settings_of(const SolverOptions& o) {
  check_options(o);
  return {o.pre,
          o.post,
          choice<Cycle>(o, &SolverOptions::cycle),
          truncation_of(o),
          choice<Rotate>(o, &SolverOptions::rotate),
          o.reassemble,
          o.relaxation,
          o.threads};
}

template <int B>
Components<B> components_of(const SolverOptions& o, const Registry& registry) {
  const std::string& transfer = o.transfer;
  registry.create<Transfer<B>>("transfer", transfer);  // an unknown name shows here
  return {registry.create<Smoother<B>>("smoother", o.smoother),
          [&registry, transfer] { return registry.create<Transfer<B>>("transfer", transfer); },
          registry.create<CoarseSolver<B>>("coarse", o.coarse)};
}

template MonotoneMultigrid<1>::Settings settings_of<1>(const SolverOptions&);
template MonotoneMultigrid<2>::Settings settings_of<2>(const SolverOptions&);
template MonotoneMultigrid<3>::Settings settings_of<3>(const SolverOptions&);
template Components<1> components_of(const SolverOptions&, const Registry&);
template Components<2> components_of(const SolverOptions&, const Registry&);
template Components<3> components_of(const SolverOptions&, const Registry&);

}  // namespace signorini
