#include "methods/configuration.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace signorini {

namespace {

void require(bool holds, const char* key, const std::string& found, const char* expected) {
  if (!holds) input_error(fmt::format("solver.{}", key), fmt::format("found '{}', expected {}", found, expected));
}

// The value that a name stands for.
template <class T>
T choice(const char* key, const std::string& found, std::initializer_list<std::pair<const char*, T>> known) {
  std::string names;
  for (const auto& [name, value] : known) {
    if (found == name) return value;
    names += fmt::format("{}'{}'", names.empty() ? "" : " or ", name);
  }
  require(false, key, found, names.c_str());
  return {};
}

Truncation truncation_of(const SolverOptions& o) {
  return choice<Truncation>(
      "truncate", o.truncate,
      {{"none", Truncation::none}, {"normal", Truncation::normal}, {"tangential", Truncation::tangential}});
}

bool only_twins(const SolverOptions& o) { return choice<bool>("reach", o.reach, {{"all", false}, {"twins", true}}); }

bool local_components(const SolverOptions& o) {
  return choice<bool>("interpolate", o.interpolate, {{"global", false}, {"local", true}});
}

}  // namespace

Coarsening coarsening_of(const SolverOptions& o) {
  return choice<Coarsening>("coarsening", o.coarsening,
                            {{"auto", Coarsening::automatic},
                             {"classical", Coarsening::classical},
                             {"aggregation", Coarsening::aggregation}});
}

Method check_options(const SolverOptions& o) {
  require(o.pre >= 0 && o.post >= 0 && o.pre + o.post > 0, "pre", fmt::format("{}' and '{}", o.pre, o.post),
          "pre, post >= 0 and at least one smoothing step");
  require(o.tolerance > 0 && o.tolerance < 1, "tolerance", fmt::format("{}", o.tolerance), "a number in (0, 1)");
  require(o.max_iterations >= 1, "max_iterations", fmt::format("{}", o.max_iterations), "at least 1");
  require(o.cut >= 0 && o.cut <= 100, "cut", fmt::format("{}", o.cut), "a number in [0, 100]");
  require(o.cut == 0 || truncation_of(o) != Truncation::none, "cut", fmt::format("{}", o.cut),
          "0 with truncate 'none'");
  require(o.relaxation > 0 && o.relaxation < 2, "relaxation", fmt::format("{}", o.relaxation), "a number in (0, 2)");
  require(o.threads >= 1 && o.threads <= 4096, "threads", fmt::format("{}", o.threads), "a number from 1 to 4096");
  const auto method = choice<Method>("method", o.method,
                                     {{"auto", Method::automatic},
                                      {"monotone", Method::monotone},
                                      {"tnnmg", Method::tnnmg},
                                      {"pgs", Method::pgs},
                                      {"pdas", Method::pdas}});
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

AlgebraicSettings algebraic_settings(const SolverOptions& o) {
  const bool restricted = only_twins(o), rotated = local_components(o);
  return {restricted, rotated, restricted || rotated ? Coarsening::classical : coarsening_of(o)};
}

template <int B>
typename MonotoneMultigrid<B>::Settings settings_of(const SolverOptions& o) {
  check_options(o);
  return {o.pre,
          o.post,
          choice<Cycle>("cycle", o.cycle, {{"V", Cycle::V}, {"W", Cycle::W}, {"F", Cycle::F}}),
          truncation_of(o),
          choice<Rotate>("rotate", o.rotate,
                         {{"all", Rotate::all},
                          {"not_coarsest", Rotate::not_coarsest},
                          {"meshes", Rotate::meshes},
                          {"none", Rotate::none}}),
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
