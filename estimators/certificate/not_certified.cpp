#include <fmt/format.h>

#include "core/fem/model/material.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "estimators/certificate/certificate.hpp"

namespace signorini {

template <int D, int B>
std::vector<std::string> not_certified(const Nodes<D>& nodes, const Model<B>& model) {
  std::vector<std::string> reasons;
  for (const ObstacleTerm<B>& term : model.obstacles) {
    if (!term.other) continue;
    if (term.tied) reasons.emplace_back("bodies that are tied to each other are not covered");
    if constexpr (B == D)
      if (of_one_body(term)) reasons.emplace_back("a body that touches itself is not covered");
  }
  if (!model.orthotropic.empty()) reasons.emplace_back("orthotropic material is not covered");
  if (std::ranges::any_of(model.loads, [](const Load<B>& load) { return load.where_open.has_value(); }))
    reasons.emplace_back("pressures that act where contact is open are not covered");
  if (!model.rigid.empty()) reasons.emplace_back("rigid parts are not covered");
  if (model.plane == Plane::axisymmetric) reasons.emplace_back("bodies of revolution are not covered");
  const auto fix_on_faces = [](const Fix<B>& fix) { return fix.on.picks_faces(); };
  const auto load_on_faces = [](const Load<B>& load) { return !load.on || load.on->picks_faces(); };
  if (!std::ranges::all_of(model.fixes, fix_on_faces) || !std::ranges::all_of(model.loads, load_on_faces))
    reasons.emplace_back("fixes and loads at points and along edges are not covered");
  if (std::ranges::any_of(model.fixes, [](const Fix<B>& fix) { return fix.frame.kind == Frame::cylindrical; }))
    reasons.emplace_back("fixes in cylindrical frames are not covered");
  if (!model.springs.empty()) reasons.emplace_back("springs are not covered");
  for (const ObstacleTerm<B>& term : model.obstacles)
    if (!term.tied && term.obstacle->functional() && !term.obstacle->friction())
      reasons.push_back(fmt::format("the energy that an obstacle adds ({}) is not covered", term.origin));
  if (nodes.size() != nodes.mesh().vertices()) reasons.emplace_back("meshes that are glued together are not covered");
  return reasons;
}

template std::vector<std::string> not_certified(const Nodes<2>&, const Model<1>&);
template std::vector<std::string> not_certified(const Nodes<3>&, const Model<1>&);
template std::vector<std::string> not_certified(const Nodes<2>&, const Model<2>&);
template std::vector<std::string> not_certified(const Nodes<3>&, const Model<3>&);

}  // namespace signorini
