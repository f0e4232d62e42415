#include "driver/warnings/balance_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/io/warning_kinds.hpp"
#include "core/sdk/block.hpp"
#include "driver/scene/part_nodes.hpp"

namespace signorini {
namespace {

/// The sum of their sizes, node by node: loads that balance each other count.
template <int B>
double size_of(const std::vector<double>& load, const std::vector<char>& inside) {
  double sum = 0;
  for (std::size_t p = 0; p < inside.size(); ++p)
    if (inside[p]) sum += block::norm<B>(load.data() + p * B);
  return sum;
}

double size(const std::vector<double>& f) { return std::sqrt(dot(f, f)); }

/// @param radial the first entry is no resultant: radial forces of an axisymmetric body need not balance
double left_over(const BalanceReport& balance, bool radial) {
  std::vector<double> sum = balance.sum();
  if (radial) sum.front() = 0;
  return size(sum);
}

/// The largest force that one obstacle exerts on a body: those from above and from below balance each other. Those of
/// one obstacle may do so, too: it is no less than what its largest pressure is on its area.
double largest_contact(const StepReport& report, const std::string& body) {
  double largest = 0;
  for (const ContactReport& contact : report.contact) {
    const bool on_other = contact.pair && (contact.pair->slave == body || contact.pair->master == body);
    if (contact.body != body && !on_other) continue;
    largest = std::max({largest, size(contact.body == body ? contact.force : contact.pair->force),
                        contact.max_pressure * contact.area});
  }
  return largest;
}

/// The largest of loads, reactions and contact.
double most_acting(const StepReport& report, const BalanceReport& balance) {
  return std::max({size(balance.applied), size(balance.reactions), largest_contact(report, balance.body)});
}

/// The same of single tables: what two of them do may cancel. Of one alone it is known by its work.
double most_acting(const Scene& scene, const StepReport& report, const BalanceReport& balance, double by_work) {
  double most = std::max(most_acting(report, balance), by_work);
  const auto add = [&](const auto& forces, const auto& tables) {
    for (const auto& of : forces)
      if (tables[of.number].body == balance.body) most = std::max(most, size(of.force));
  };
  add(report.applied, scene.loads);
  add(report.reactions, scene.fixes);
  add(report.springs, scene.springs);
  add(report.rigid, scene.rigids);
  return most;
}

/// A force that does the work of a solution along its largest displacement; 0 where nothing moves.
double force_by_work(const StepReport& report, const std::vector<double>& u) {
  double largest = 0;
  for (const double v : u) largest = std::max(largest, std::fabs(v));
  return largest > 0 ? std::fabs(report.summary.energy) / largest : 0;
}

}  // namespace

template <int D, int B>
Warnings balance_warnings(const Scene& scene, const Scene::Body& body, const Nodes<D>& nodes,
                          const std::vector<double>& load, const StepReport& report, const std::vector<double>& u,
                          double rounding) {
  constexpr double noticeable = 0.01, uneven = 1e-3;
  Warnings warnings;
  if (!report.summary.converged()) return warnings;
  const BodyReport& whole = report.bodies.front();
  for (std::size_t part = 0; part < report.balance.size(); ++part) {
    const double left = left_over(report.balance[part], whole.axisymmetric && B == D);
    const double loads = whole.copies * size_of<B>(load, nodes_of_part(scene, body, part, nodes));
    const double acting = most_acting(scene, report, report.balance[part], force_by_work(report, u));
    if (loads == 0 && left > rounding && left > uneven * acting)
      warnings.push_back(
          warning<"unbalanced">(report.balance[part].body, left,
                                fmt::format("forces of {:.2g} act: some of these are not known; {}", acting,
                                            report.summary.outcome == Outcome::rounding
                                                ? "that is what the machine's precision leaves with a mesh and a "
                                                  "material like these"
                                                : "a smaller tolerance may help")));
    if (!(loads > 0 && left > noticeable * loads)) continue;
    warnings.push_back(
        warning<"unbalanced">(report.balance[part].body, left,
                              fmt::format("the loads are {:.2g}: these are too small beside stiffness times "
                                          "displacement for the tolerance or the machine's precision, and what they do "
                                          "is not known",
                                          loads)));
  }
  return warnings;
}

double imbalance(const StepReport& report, const std::vector<double>& u) {
  double worst = 0;
  const double by_work = force_by_work(report, u);
  for (const BalanceReport& balance : report.balance) {
    const double acting = std::max(most_acting(report, balance), by_work);
    const double left = left_over(balance, report.bodies.front().axisymmetric && balance.applied.size() > 1);
    if (acting > 0) worst = std::max(worst, left / acting);
  }
  return worst;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                                   \
  template Warnings balance_warnings<D, B>(const Scene&, const Scene::Body&, const Nodes<D>&,                         \
                                           const std::vector<double>&, const StepReport&, const std::vector<double>&, \
                                           double);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
