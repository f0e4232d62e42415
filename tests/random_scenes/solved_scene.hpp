#pragma once
#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "driver/driver.hpp"
#include "view.hpp"

namespace signorini::test {

/// What a scene ends with.
struct Outcome {
  Exit exit = Exit::solved;
  std::string message;  ///< of an error, or why it did not converge
  Report report;
  Scene scene;
  std::vector<double> u;  ///< of all bodies
};

/// @param read gives the scene
inline Outcome solve_scene(const auto& read) {
  Outcome out;
  try {
    out.scene = read();
    Driver driver(out.scene);
    out.report = driver.solve();
    for (std::size_t body = 0; body < driver.bodies(); ++body) {
      const std::vector<double> u = driver.solution(body);
      out.u.insert(out.u.end(), u.begin(), u.end());
    }
    if (!out.report.converged()) out.exit = Exit::not_converged, out.message = out.report.reason();
  } catch (const Error& error) {
    out.exit = error.status(), out.message = error.what();
  }
  return out;
}

inline Outcome solve_text(const std::string& text) {
  return solve_scene([&] { return parse_scene(text, "random.toml", ".", {}); });
}

/// The forces of a step in the scene's own system, by the bodies' names.
template <int D>
struct Forces {
  std::map<std::string, Point<D>> contact, all;  ///< on each body: of obstacles; together with loads and fixes
  double largest = 0;

  Forces(const StepReport& step, const Scene& scene, const View<D>& view) {
    for (const Scene::Body& body : scene.bodies) contact[body.name] = all[body.name] = {};
    const auto add = [&](std::map<std::string, Point<D>>& to, const std::string& body, const std::vector<double>& f) {
      Point<D> given{};
      std::copy_n(f.begin(), D, given.begin());
      given = view.own_force(given);
      for (int k = 0; k < D; ++k) to[body][k] += given[k], largest = std::max(largest, std::abs(given[k]));
    };
    for (const ContactReport& c : step.contact) {
      add(contact, c.body, c.force), add(all, c.body, c.force);
      if (c.pair) add(contact, other_of(c), c.pair->force), add(all, other_of(c), c.pair->force);
    }
    for (const ForceReport& f : step.reactions) add(all, scene.fixes[f.number].body, f.force);
    for (const ForceReport& f : step.applied) add(all, scene.loads[f.number].body, f.force);
  }

  static const std::string& other_of(const ContactReport& c) {
    return c.pair->slave == c.body ? c.pair->master : c.pair->slave;
  }
};

}  // namespace signorini::test
