#include "apps/bench/accuracy/answer.hpp"

#include <algorithm>
#include <cmath>

#include "apps/bench/processor_time.hpp"
#include "core/base/error.hpp"

namespace signorini::bench {
namespace {

template <int D>
Position position(const Point<D>& x) {
  Position out{};
  std::copy(x.begin(), x.end(), out.begin());
  return out;
}

/// Between vertices as a finite element function of the elements' order.
template <int D>
std::vector<double> stresses_at(const BodyRun<D, D>& run, const std::vector<Position>& samples) {
  std::vector<double> values;
  for (const Stress& stress : run.stress()) values.insert(values.end(), stress.begin(), stress.end());
  const std::vector<double> coefficients = run.nodes().at_nodes(std::move(values), 6);
  std::vector<double> out;
  for (const Position& sample : samples) {
    Point<D> x;
    std::copy_n(sample.begin(), D, x.begin());
    out.push_back(von_mises(evaluate<6>(run.nodes(), locate<D>(run.mesh(), x, "sample"), coefficients)));
  }
  return out;
}

template <int D>
void read(const BodyRun<D, D>& run, const Question& question, Answer& out) {
  for (const ContactNode<D>& node : run.results().contact.nodes)
    out.pressure.push_back({question.along(position<D>(run.nodes().at(node.vertex))), node.area, node.recovered});
  std::ranges::sort(out.pressure, {}, &Answer::Pressure::at);
  out.stress = stresses_at(run, question.samples);
}

double of_vector(const std::vector<double>& force) {
  double squares = 0;
  for (const double f : force) squares += f * f;
  return std::sqrt(squares);
}

double relative(double found, double exact) { return found / exact - 1; }

double mean_square(const std::vector<double>& found, const std::vector<double>& exact) {
  if (exact.empty()) return not_there;
  double difference = 0, all = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    difference += std::pow(found[k] - exact[k], 2);
    all += std::pow(exact[k], 2);
  }
  return std::sqrt(difference / all);
}

double pressure_error(const Answer& found, const std::function<double(double)>& exact) {
  if (!exact) return not_there;
  double difference = 0, all = 0;
  for (const auto& [at, area, value] : found.pressure) {
    difference += area * std::pow(value - exact(at), 2);
    all += area * std::pow(exact(at), 2);
  }
  return std::sqrt(difference / all);
}

}  // namespace

Answer solve(const Question& question, const std::vector<std::string>& overrides,
             const std::function<void(Driver&)>& look) {
  Answer out;
  const ProcessorTime time;
  Driver driver(parse_scene(question.scene, "scene.toml", question.folder, overrides));
  const StepReport& step = driver.solve().last();
  out.seconds = time.elapsed();
  if (!step.summary.converged()) throw Error(Exit::not_converged, step.summary.reason);
  out.unknowns = static_cast<double>(step.summary.level_unknowns.back());
  out.cycles = step.summary.iterations;
  if (!step.probes.empty()) out.probe = step.probes[0].value.back();
  if (!step.contact.empty()) {
    const ContactReport& contact = step.contact[0];
    out.force = of_vector(contact.force);
    out.peak = contact.max_pressure;
    out.radius = question.round ? contact.radius : contact.area;
  }
  driver.visit(0, [&]<int D, int B>(const BodyRun<D, B>& run) {
    if constexpr (D == B) read<D>(run, question, out);
  });
  if (look) look(driver);
  return out;
}

std::function<double(double)> profile(std::vector<Answer::Pressure> nodes) {
  return [nodes = std::move(nodes)](double at) {
    const auto after = std::ranges::lower_bound(nodes, at, {}, &Answer::Pressure::at);
    if (after == nodes.begin() || after == nodes.end())
      return after == nodes.end() ? nodes.back().value : nodes.front().value;
    const auto before = after - 1;
    const double part = (at - before->at) / (after->at - before->at);
    return (1 - part) * before->value + part * after->value;
  };
}

Errors errors_of(const Answer& found, const Answer& exact, const std::function<double(double)>& pressure) {
  return {relative(found.force, exact.force),   relative(found.peak, exact.peak),
          relative(found.radius, exact.radius), relative(found.probe, exact.probe),
          pressure_error(found, pressure),      mean_square(found.stress, exact.stress)};
}

}  // namespace signorini::bench
