#include "conformance/kit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <type_traits>

#include "conformance/node_checks.hpp"
#include "conformance/options.hpp"
#include "conformance/solves.hpp"
#include "conformance/vertex_checks.hpp"

namespace signorini::conformance {
namespace {

constexpr int many_samples = 150, some_samples = 20, many_vertices = 130;
constexpr double patience_of_solves = 120;  // seconds

/// What a check in a copy has found, and with what: two texts of its own in one.
constexpr char between = '\1';

template <int B>
class Kit {
 public:
  Kit(const Subject& subject, const std::filesystem::path& folder, double patience, Outcomes& outcomes)
      : subject_(subject), folder_(folder), patience_(patience), outcomes_(outcomes) {}

  std::string run(bool solves) {
    if (!find_base()) return refused_;
    check_values();
    for (const char* needed : {"constructs", "asked"})
      if (outcomes_.has_failed(needed)) return {};
    make_all();
    check_descriptors();
    if (outcomes_.has_failed("descriptor")) return {};
    make_vertices();
    for (const auto& checks : {checks_of_vertices<B>(), checks_of_equivariance<B>()}) run_at_vertices(checks);
    check_questions();
    for (const char* needed : {"beyond", "directions", "bounds", "numbers", "linearisation"})
      if (outcomes_.has_failed(needed)) {
        outcomes_.note(
            fmt::format("'{}' failed, so what happens at a node with {} was not checked", needed, unknowns()));
        return {};
      }
    if (make_samples())
      for (const auto& checks :
           {checks_of_changes<B>(), checks_of_minimisers<B>(), checks_of_linearisations<B>(), checks_of_numbers<B>()})
        if (!hangs_) run_at_nodes(checks);
    if (hangs_) outcomes_.note("what hangs once was asked nothing more");
    if (solves && !hangs_) check_solves();
    return {};
  }

 private:
  std::string unknowns() const { return B == 1 ? "1 unknown" : fmt::format("{} unknowns", B); }

  std::string with(const Values& values) const {
    return fmt::format("{} per node, {}", unknowns(), describe(values, subject_.given()));
  }

  /// Whether work in a copy came to its end, or else why not.
  std::optional<std::string> ended_badly(const std::function<void()>& work, double patience) {
    const std::string end = copy_.run(work, patience);
    hangs_ = hangs_ || end.starts_with("no end");
    if (end.empty()) return {};
    return "it leads to " + end;
  }
  std::optional<std::string> ended_badly(const std::function<void()>& work) { return ended_badly(work, patience_); }

  bool find_base() {
    if (const auto end = ended_badly([&] { (void)base_of<B>(subject_); })) {
      outcomes_.fail("constructs", *end, with({}));
      return false;
    }
    const Base base = base_of<B>(subject_);
    base_ = base.values;
    refused_ = base.refused;
    if (!base.failed.empty()) outcomes_.fail(base.failed, base.found, with(base_));
    if (!base.failed.empty() || !refused_.empty()) return false;
    outcomes_.pass("constructs");
    if (!base_.empty()) outcomes_.pass("missing");
    variants_ = variants_of<B>(subject_, base_);
    return true;
  }

  /// The ends of ranges. What is wrong with the base as well is told by what is asked of that.
  void check_values() {
    const auto end = ended_badly([&] {
      copy_.note(-1);
      if (!wrong_with_values<B>(subject_, base_).empty()) return;
      for (std::size_t k = 0; k < variants_.size(); ++k) {
        copy_.note(static_cast<long>(k));
        if (const std::string wrong = wrong_with_values<B>(subject_, variants_[k]); !wrong.empty())
          return copy_.tell(wrong);
      }
      copy_.note(static_cast<long>(variants_.size()));
    });
    varied_ = copy_.noted() == static_cast<long>(variants_.size());
    if (varied_)
      outcomes_.pass("ranges");
    else if (copy_.noted() >= 0)
      outcomes_.fail("ranges", end ? *end : copy_.told(), with(variants_[static_cast<std::size_t>(copy_.noted())]));
  }

  /// What the copy could make; where that failed or crashed, nothing but the base.
  void make_all() {
    made_.push_back(subject_.make<B>(base_));
    if (!varied_) return;
    for (const Values& values : variants_) try {
        made_.push_back(subject_.make<B>(values));
      } catch (const Error&) {  // refused, or told already
      }
  }

  void check_descriptors() {
    for (const Made<B>& made : made_) {
      const ObstacleDescriptor d = made.obstacle->descriptor();
      std::string wrong;
      constexpr int most = std::extent_v<decltype(d.direction)>;
      if (d.directions < 0 || d.directions > most) wrong = fmt::format("it has {} directions", d.directions);
      if (d.data < 0 || d.data > most_data) wrong = fmt::format("it has {} numbers", d.data);
      for (int k = 0; k < std::clamp(d.directions, 0, most) && wrong.empty(); ++k) {
        const auto& [name, components, values] = d.direction[k];
        if (!name || !*name) wrong = fmt::format("direction {} has no name", k);
        if (components < 1 || components > B || values < 1)
          wrong = fmt::format("direction {} has {} components and {} values", k, components, values);
      }
      if (!wrong.empty()) outcomes_.fail("descriptor", wrong, with(made.values));
      if (!made.obstacle->functional()) continue;
      if (made.obstacle->linearisation())
        outcomes_.pass("linearisation");
      else
        outcomes_.fail("linearisation", "its functional has none", with(made.values));
    }
    outcomes_.pass("descriptor");
  }

  void make_vertices() {
    Random random(1);
    for (int k = 0; k < many_vertices; ++k) vertices_.push_back(random_vertex(dimension<B>, random));
  }

  /// Whether all of some checks, in one copy, find nothing: then each of them has passed, and needs none of its own.
  template <class Check, class Applies, class Finds>
  bool all_pass(const std::vector<Check>& checks, const Applies& applies, const Finds& finds) {
    const auto end = copy_.run(
        [&] {
          for (const Check& check : checks)
            if (finds(check)) return;
          copy_.tell("passed");
        },
        patience_);
    if (!end.empty() || copy_.told() != "passed") return false;
    for (const Check& check : checks)
      if (applies(check)) outcomes_.pass(check.id);
    return true;
  }

  void run_at_vertices(const std::vector<VertexCheck<B>>& checks) {
    const auto of_one = [&](const VertexCheck<B>& check, const Made<B>& made) {
      return check.applies(subject_, made) && !check.wrong(subject_, made, vertices_).empty();
    };
    const auto finds = [&](const VertexCheck<B>& check) {
      return std::ranges::any_of(made_, [&](const Made<B>& made) { return of_one(check, made); });
    };
    const auto applies = [&](const VertexCheck<B>& check) {
      return std::ranges::any_of(made_, [&](const Made<B>& made) { return check.applies(subject_, made); });
    };
    if (all_pass(checks, applies, finds)) return;
    for (const VertexCheck<B>& check : checks)
      if (!hangs_) run_at_vertices(check);
  }

  void run_at_nodes(const std::vector<NodeCheck<B>>& checks) {
    const auto applies = [&](const NodeCheck<B>& check) {
      for (std::size_t k = 0; k < made_.size(); ++k)
        if (check.applies(*made_[k].obstacle) && !samples_[k].empty()) return true;
      return false;
    };
    const auto finds = [&](const NodeCheck<B>& check) {
      for (std::size_t k = 0; k < made_.size(); ++k)
        if (check.applies(*made_[k].obstacle))
          for (const Sample<B>& sample : samples_[k]) {
            Node<B> node(*made_[k].obstacle, sample);
            if (!check.wrong(node).empty()) return true;
          }
      return false;
    };
    if (all_pass(checks, applies, finds)) return;
    for (const NodeCheck<B>& check : checks)
      if (!hangs_) run_at_nodes(check);
  }

  void run_at_vertices(const VertexCheck<B>& check) {
    bool asked = false;
    const auto end = ended_badly([&] {
      for (std::size_t k = 0; k < made_.size(); ++k) {
        copy_.note(static_cast<long>(k));
        if (!check.applies(subject_, made_[k])) continue;
        if (std::string found = check.wrong(subject_, made_[k], vertices_); !found.empty()) {
          const std::vector<SurfaceVertex> few = fewest(check, made_[k], found);
          return copy_.tell(found + between + describe(std::span(few)));
        }
      }
    });
    for (const Made<B>& made : made_) asked = asked || check.applies(subject_, made);
    const auto at = static_cast<std::size_t>(std::max(0L, copy_.noted()));
    settle(check.id, asked, end, with(made_[std::min(at, made_.size() - 1)].values),
           end ? fmt::format("{} vertices", many_vertices) : "");
  }

  /// As few vertices as a check needs to fail, at places as simple as possible.
  std::vector<SurfaceVertex> fewest(const VertexCheck<B>& check, const Made<B>& made, std::string& found) const {
    std::vector<SurfaceVertex> few = vertices_;
    const auto attempt = [&](std::vector<SurfaceVertex> other) {
      if (other.empty()) return false;
      std::string wrong = check.wrong(subject_, made, other);
      if (wrong.empty()) return false;
      few = std::move(other);
      found = std::move(wrong);
      return true;
    };
    for (std::size_t part = few.size() / 2; part > 0; part /= 2)
      for (std::size_t first = 0; first < few.size();) {
        std::vector<SurfaceVertex> other = few;
        other.erase(other.begin() + static_cast<std::ptrdiff_t>(first),
                    other.begin() + static_cast<std::ptrdiff_t>(std::min(first + part, few.size())));
        if (!attempt(std::move(other))) first += part;
      }
    for (const int digits : {2, 1}) {
      std::vector<SurfaceVertex> other = few;
      for (SurfaceVertex& v : other) {
        for (double& x : v.position) x = rounded_to(x, digits);
        v.measure = rounded_to(v.measure, digits);
      }
      attempt(std::move(other));
    }
    return few;
  }

  /// Which only its settings know, once it has been asked for constraints.
  void check_questions() {
    const auto end = ended_badly([&] {
      for (const Made<B>& made : made_) try {
          copy_.note(static_cast<long>(&made - made_.data()));
          (void)assemble_at<B>(*made.obstacle, std::span(vertices_).first(1));
          expect_good_questions(*made.settings, fmt::format("obstacle '{}'", subject_.id()));
        } catch (const WrongQuestion& error) {
          return copy_.tell(error.what());
        }
    });
    if (end) return;  // which is told elsewhere
    const auto at = static_cast<std::size_t>(std::max(0L, copy_.noted()));
    copy_.told().empty() ? outcomes_.pass("asked") : outcomes_.fail("asked", copy_.told(), with(made_[at].values));
  }

  /// Whether it answers well enough for it.
  bool make_samples() {
    const auto all = [&] {
      Random random(2);
      std::vector<std::vector<Sample<B>>> out;
      for (std::size_t k = 0; k < made_.size(); ++k)
        out.push_back(samples_of<B>(*made_[k].obstacle, k < 2 ? many_samples : some_samples, random));
      return out;
    };
    if (const auto end = ended_badly([&] { (void)all(); })) {
      const bool renewed = std::ranges::any_of(made_, [](const Made<B>& made) { return made.obstacle->renewal(); });
      outcomes_.fail(renewed ? "renew" : "slope_derivative", *end, with(base_));
      return false;
    }
    samples_ = all();
    return true;
  }

  void run_at_nodes(const NodeCheck<B>& check) {
    bool asked = false;
    const auto end = ended_badly([&] {
      long number = 0;
      for (std::size_t k = 0; k < made_.size(); ++k) {
        const Obstacle<B>& obstacle = *made_[k].obstacle;
        if (!check.applies(obstacle)) continue;
        for (const Sample<B>& sample : samples_[k]) {
          copy_.note(static_cast<long>(k) * many_samples + number++ % many_samples);
          Node<B> node(obstacle, sample);
          if (check.wrong(node).empty()) continue;
          const Sample<B> simple = simplest<B>(sample, [&](const Sample<B>& other) {
            Node<B> at(obstacle, other);
            return !check.wrong(at).empty();
          });
          Node<B> at(obstacle, simple);
          copy_.note(static_cast<long>(k) * many_samples);
          return copy_.tell(check.wrong(at) + between + describe(simple, check.parts));
        }
        number = 0;
      }
    });
    for (std::size_t k = 0; k < made_.size(); ++k)
      asked = asked || (check.applies(*made_[k].obstacle) && !samples_[k].empty());
    const auto at = static_cast<std::size_t>(std::max(0L, copy_.noted()));
    const std::size_t which = std::min(at / many_samples, made_.size() - 1);
    const auto& samples = samples_[which];
    const bool known = end && !samples.empty();
    settle(check.id, asked, end, with(made_[which].values),
           known ? describe(samples[std::min(at % many_samples, samples.size() - 1)], check.parts) : "");
  }

  /// @param where what it was about, if it came to no end
  void settle(std::string_view id, bool asked, const std::optional<std::string>& end, const std::string& values,
              const std::string& where) {
    if (end) return outcomes_.fail(id, *end, fmt::format("{}: {}", values, where));
    const std::string told = copy_.told();
    if (told.empty() && asked) outcomes_.pass(id);
    if (told.empty()) return;
    const std::size_t middle = told.find(between);
    outcomes_.fail(id, told.substr(0, middle),
                   fmt::format("{}: {}", values, middle == std::string::npos ? "" : told.substr(middle + 1)));
  }

  void check_solves() {
    for (const int space : {2, 3})
      if (B == 1 || B == space) solve_in(space);
  }

  void solve_in(int space) {
    const auto end = ended_badly(
        [&] {
          const Solves found = solve_scenes<B>(subject_, base_, folder_, space);
          copy_.tell(found.agrees + between + found.cycles + between + found.note + between + found.example);
        },
        patience_of_solves);
    std::vector<std::string> told;
    std::string rest = copy_.told();
    for (std::size_t at; (at = rest.find(between)) != std::string::npos; rest.erase(0, at + 1))
      told.push_back(rest.substr(0, at));
    told.push_back(rest);
    told.resize(4);
    if (end) told[0] = *end;
    if (!told[2].empty())
      return outcomes_.note(fmt::format("no scene in {}D was solved {}: {}; --set gives other values", space,
                                        describe(base_, subject_.given()), told[2]));
    const std::string example = fmt::format("{}, {}", told[3], describe(base_, subject_.given()));
    told[0].empty() ? outcomes_.pass("solve_agrees") : outcomes_.fail("solve_agrees", told[0], example);
    if (!told[0].empty()) return;
    told[1].empty() ? outcomes_.pass("solve_cycles") : outcomes_.fail("solve_cycles", told[1], example);
  }

  const Subject& subject_;
  const std::filesystem::path& folder_;
  double patience_;
  Outcomes& outcomes_;
  bool hangs_ = false;  // and further questions would take their time, too
  Copy copy_;
  Values base_;
  std::string refused_;
  std::vector<Values> variants_;
  bool varied_ = false;        // and all of them are answered well
  std::vector<Made<B>> made_;  // the first one with the base
  std::vector<SurfaceVertex> vertices_;
  std::vector<std::vector<Sample<B>>> samples_;  // for each
};

}  // namespace

template <int B>
std::string run_checks(const Subject& subject, const std::filesystem::path& folder, const Options& options,
                       Outcomes& outcomes) {
  return Kit<B>(subject, folder, options.patience, outcomes).run(options.solves);
}

template std::string run_checks<1>(const Subject&, const std::filesystem::path&, const Options&, Outcomes&);
template std::string run_checks<2>(const Subject&, const std::filesystem::path&, const Options&, Outcomes&);
template std::string run_checks<3>(const Subject&, const std::filesystem::path&, const Options&, Outcomes&);

}  // namespace signorini::conformance
