// Scenes at random: columns, whose force is known, round bodies, of which Hertz knows the pressure, and piles of any
// blocks, whose forces balance, obey the laws of contact and do not depend on units, on where the scene is, on what
// program its meshes are from or how it is solved.
#include <gtest/gtest.h>

#include <cstdlib>

#include "round.hpp"
#include "solved_scene.hpp"
#include "tests/support/folder.hpp"

namespace signorini::test {
namespace {

double length_of(const std::vector<double>& f) {
  double sum = 0;
  for (const double x : f) sum += x * x;
  return std::sqrt(sum);
}

std::string unbalanced(const auto& forces) {
  for (const auto& [body, sum] : forces.all)
    for (const double f : sum)
      if (!(std::abs(f) <= 1e-6 * forces.largest)) return fmt::format("what acts on {} sums to {}", body, sum);
  return "";
}

template <int D>
std::string wrong_column(const Stack<D>& stack, const View<D>& view, const Outcome& outcome) {
  if (outcome.exit != Exit::solved) return fmt::format("exit {}: {}", static_cast<int>(outcome.exit), outcome.message);
  const Block<D>& top = stack.blocks.back();
  double area = 1;
  for (int i = 0; i + 1 < D; ++i) area *= top.to[i] - top.from[i];
  if (stack.kind == Kind::axisymmetric) area *= 3.14159265358979323846 * (top.to[0] + top.from[0]);
  for (const StepReport& step : outcome.report.steps) {
    const double expected = expected_force(stack, step.t), all = std::max(expected_force(stack, 1), expected);
    for (const ContactReport& c : step.contact) {
      const double size = expected > 0 ? all : 0.01;
      const double found = length_of(c.force) /
                           (stack.kind == Kind::axisymmetric ? view.stress * view.length * view.length : view.force());
      const double tolerance = 1e-6;
      if (!(std::abs(found - expected) <= tolerance * size))
        return fmt::format("obstacle {}: force {}, expected {}", c.obstacle, found, expected);
      if (expected == 0) continue;
      const double per_area = std::pow(view.length, D == 2 && stack.kind != Kind::axisymmetric ? 1 : 2);
      if (!(std::abs(c.area / per_area - area) <= tolerance * area))
        return fmt::format("obstacle {}: area {}, expected {}", c.obstacle, c.area / per_area, area);
      if (!(std::abs(c.max_pressure / view.stress - expected / area) <= 10 * tolerance * expected / area))
        return fmt::format("obstacle {}: largest pressure {}, expected {}", c.obstacle, c.max_pressure / view.stress,
                           expected / area);
    }
  }
  return "";
}

/// What breaks the laws of contact and friction, or balance, whatever the solution is.
template <int D>
std::string unlawful(const Stack<D>& stack, const Outcome& outcome, const View<D>& view) {
  if (outcome.exit != Exit::solved) return fmt::format("exit {}: {}", static_cast<int>(outcome.exit), outcome.message);
  for (const StepReport& step : outcome.report.steps) {
    const Forces<D> forces(step, outcome.scene, view);
    if (std::string sums = unbalanced(forces); !sums.empty()) return sums;
    for (const ContactReport& c : step.contact) {
      const double across = length_of(c.tangential_force) / view.force(),
                   along = length_of(c.normal_force) / view.force();
      if (stack.friction > 0 && !(across <= stack.friction * along + 1e-6 * forces.largest))
        return fmt::format("obstacle {}: {} across, {} along the normal", c.obstacle, across, along);
      if (!(c.dissipated >= 0)) return fmt::format("obstacle {}: friction does the work {}", c.obstacle, c.dissipated);
    }
    // The highest body is pressed up, and what carries the lowest one presses it up as well.
    for (const bool highest : {true, false}) {
      if (highest ? stack.blocks.size() == 1 && !stack.on_plane : !stack.on_plane || stack.blocks.size() > 1) continue;
      const double up = forces.contact.at(highest ? fmt::format("b{}", stack.blocks.size() - 1) : "b0")[D - 1];
      if (!(up >= -1e-6 * forces.largest)) return fmt::format("what lies below pulls: {}", up);
    }
  }
  return "";
}

template <int D>
std::string different(const Outcome& one, const Outcome& other, const View<D>& view) {
  if (one.report.steps.size() != other.report.steps.size()) return "another number of steps";
  for (std::size_t s = 0; s < one.report.steps.size(); ++s) {
    const Forces<D> a(one.report.steps[s], one.scene, {}), b(other.report.steps[s], other.scene, view);
    for (const auto& [body, force] : a.contact) {
      const Point<D>& there = b.contact.at(body);
      for (int k = 0; k < D; ++k)
        if (!(std::abs(force[k] - there[k]) <= 1e-5 * a.largest))
          return fmt::format("step {}: {} on {}, and {} where it is seen or solved in another way", s + 1, force, body,
                             there);
    }
  }
  return "";
}

/// A pile as it is, and once more seen from elsewhere, in other units, and solved in another way.
template <int D>
std::string wrong_pile(Random& random, const Stack<D>& pile, const View<D>& view, auto solve) {
  const Outcome one = solve(pile, View<D>{}, Way::of(random, pile.kind));
  if (std::string complaint = unlawful(pile, one, View<D>{}); !complaint.empty()) return complaint;
  const Outcome other = solve(pile, view, Way::any(random, pile.kind, view.is_plain()));
  if (std::string complaint = unlawful(pile, other, view); !complaint.empty()) return "seen anew: " + complaint;
  return different(one, other, view);
}

/// Hertz's formulas are for half spaces; meshes add the rest.
constexpr double of_peak = 0.03;
/// The edge of the contact is known up to half a face; around a disk errors of both signs leave a third of that.
template <int D>
constexpr double of_area = D == 2 ? Round<D>::face_at_edge / 2 : 2 * Round<D>::face_at_edge / 2 / 3;

template <int D>
std::string wrong_round(const Round<D>& round, const View<D>& view, const Outcome& outcome) {
  if (outcome.exit != Exit::solved) return fmt::format("exit {}: {}", static_cast<int>(outcome.exit), outcome.message);
  const ContactReport& c = outcome.report.steps.back().contact.front();
  const double force = length_of(c.force) / view.force();
  const auto off = [](double found, double expected) { return std::abs(found / expected - 1); };
  const double load = length_of(outcome.report.steps.back().applied.front().force) / view.force();
  if (!(off(force, load) <= 1e-6 && off(load, round.force()) <= 1e-4))
    return fmt::format("force {}, loads {}, expected {}", force, load, round.force());
  const double area = c.area / std::pow(view.length, D - 1), peak = c.max_pressure / view.stress;
  if (!(off(area, round.area()) <= of_area<D>)) return fmt::format("area {}, Hertz has {}", area, round.area());
  if (!(off(peak, round.peak()) <= of_peak))
    return fmt::format("largest pressure {}, Hertz has {}", peak, round.peak());
  return "";
}

class RandomScenes : public Folder {
 protected:
  /// The scenes of a test: RANDOM_SCENES many, or from one to another as in 601-700; else the first few.
  template <class Judge>
  void judge_all(int few, Judge judge) {
    int first = 1, last = few;
    if (const char* wanted = std::getenv("RANDOM_SCENES")) {
      const std::string text = wanted;
      const std::size_t dash = text.find('-');
      if (dash != std::string::npos) first = std::stoi(text.substr(0, dash));
      last = std::stoi(text.substr(dash == std::string::npos ? 0 : dash + 1));
    }
    int wrong = 0;
    for (int seed = first; seed <= last; ++seed) {
      Random random(static_cast<std::uint64_t>(seed) * 0x9E3779B97F4A7C15u);
      texts_.clear();
      const std::string complaint = judge(random);
      wrong += !complaint.empty();
      if (!complaint.empty())
        ADD_FAILURE() << "seed " << seed << ": " << complaint << '\n' << (std::getenv("SHOW") ? texts_ : "");
    }
    if (std::getenv("SHOW")) fmt::print("{} of {} scenes wrong\n", wrong, last - first + 1);
  }

  template <int D>
  View<D> any_view(Random& random, const Stack<D>& stack) const {
    const bool turned = stack.kind == Kind::files && random.chance(0.5);
    return units(random, turned ? View<D>::turned(random) : View<D>{});
  }

  template <int D>
  static View<D> units(Random& random, View<D> view) {
    if (random.chance(0.5)) view.length = decades(random, 4), view.stress = decades(random, 6);
    return view;
  }

  template <int D>
  Outcome solve(const Stack<D>& stack, const View<D>& view, const Way& way) {
    return solve(StackText<D>(stack, view, way, folder_).text());
  }
  Outcome solve(const std::string& text) {
    texts_ += text + '\n';
    return solve_text(text);
  }

  template <int D>
  void judge_columns(int few) {
    judge_all(few, [&](Random& random) {
      const Stack<D> stack = random_column<D>(random);
      const View<D> view = any_view(random, stack);
      return wrong_column(stack, view, solve(stack, view, Way::any(random, stack.kind, view.is_plain())));
    });
  }

  template <int D>
  void judge_rounds(int few) {
    judge_all(few, [&](Random& random) {
      const Round<D> round = random_round<D>(random);
      const View<D> view = units(random, View<D>{});
      const Way way = Way::any(random, Kind::shapes, true);
      return wrong_round(round, view, solve(text_of(round, view, way)));
    });
  }

  template <int D>
  void judge_piles(int few) {
    judge_all(few, [&](Random& random) {
      const Stack<D> pile = random_pile<D>(random);
      const View<D> view = any_view(random, pile);
      return wrong_pile(random, pile, view, [&](const auto&... how) { return solve(how...); });
    });
  }

  std::string texts_;  ///< of the last scene, in each way it was solved
};

TEST_F(RandomScenes, Columns2D) { judge_columns<2>(150); }
TEST_F(RandomScenes, Columns3D) { judge_columns<3>(40); }
TEST_F(RandomScenes, Rounds2D) { judge_rounds<2>(20); }
TEST_F(RandomScenes, Rounds3D) { judge_rounds<3>(3); }
TEST_F(RandomScenes, Piles2D) { judge_piles<2>(77); }
TEST_F(RandomScenes, Piles3D) { judge_piles<3>(10); }

}  // namespace
}  // namespace signorini::test
