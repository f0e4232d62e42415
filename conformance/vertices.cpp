// What assemble() gives.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "conformance/guarded.hpp"
#include "conformance/vertex_checks.hpp"
#include "core/base/error.hpp"
#include "core/sdk/block.hpp"

namespace signorini::conformance {
namespace {

constexpr double unknown_number = std::numeric_limits<double>::quiet_NaN();

template <int B>
bool for_all(const Subject&, const Made<B>&) {
  return true;
}

/// A product of directions that is 1 where they are orthogonal and 0 where they are dependent.
template <int B>
double volume_of(const LocalConstraint<B>& c) {
  double rest[B][B], volume = 1;
  for (int k = 0; k < c.directions; ++k) {
    std::copy_n(c.direction[k], B, rest[k]);
    for (int j = 0; j < k; ++j) {
      const double along = block::dot<B>(rest[k], rest[j]);
      for (int i = 0; i < B; ++i) rest[k][i] -= along * rest[j][i];
    }
    const double length = block::norm<B>(rest[k]);
    volume *= length;
    for (int i = 0; i < B; ++i) rest[k][i] /= length > 0 ? length : 1;
  }
  return volume;
}

template <int B>
std::string differs(const LocalConstraint<B>& a, const LocalConstraint<B>& b) {
  if (a.directions != b.directions) return fmt::format("{} directions, and {}", a.directions, b.directions);
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  for (int k = 0; k < std::clamp(a.directions, 0, B); ++k) {
    if (!same(a.lower[k], b.lower[k]))
      return fmt::format("the lower bound {:.17g}, and {:.17g}", a.lower[k], b.lower[k]);
    if (!same(a.upper[k], b.upper[k]))
      return fmt::format("the upper bound {:.17g}, and {:.17g}", a.upper[k], b.upper[k]);
    for (int i = 0; i < B; ++i)
      if (!same(a.direction[k][i], b.direction[k][i]))
        return fmt::format("the direction ({:.17g}), and ({:.17g})", fmt::join(a.direction[k], ", "),
                           fmt::join(b.direction[k], ", "));
  }
  for (int k = 0; k < most_data; ++k)
    if (!same(a.data[k], b.data[k])) return fmt::format("number {} as {:.17g}, and {:.17g}", k, a.data[k], b.data[k]);
  return {};
}

/// The first thing that a function finds wrong at one of the vertices.
template <int B, class Wrong>
std::string first_of_all(const Made<B>& made, std::span<const SurfaceVertex> vertices, const Wrong& wrong) {
  const Assembled<B> all = assemble_at<B>(*made.obstacle, vertices);
  if (!is_answer(all.status)) return fmt::format("it fails with status {}: {}", all.status.code, all.status.message);
  if (!all.status.ok()) return {};
  for (const LocalConstraint<B>& c : all.constraints)
    if (std::string found = wrong(c); !found.empty()) return found;
  return {};
}

/// Of a constraint that is to be written: what is not set shows.
template <int B>
void spoil(LocalConstraint<B>& c) {
  c = {};
  std::fill_n(c.lower, B, unknown_number);
  std::fill_n(c.upper, B, unknown_number);
}

/// Where memory ends behind the vertices, and behind the constraints.
template <int B>
std::string goes_beyond(const Subject&, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  for (const std::size_t most : {std::size_t{1}, std::size_t{2}, std::size_t{7}, vertices.size()}) {
    const std::size_t count = std::min(most, vertices.size());
    Guarded<SurfaceVertex> in(count);
    Guarded<LocalConstraint<B>> out(count);
    std::copy_n(vertices.begin(), count, in.data());
    for (LocalConstraint<B>& c : out.all()) spoil(c);
    Status status;
    made.obstacle->assemble(in.data(), count, out.data(), status);
  }
  return {};
}

template <int B>
std::string has_wrong_directions(const Subject&, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  return first_of_all<B>(made, vertices, [&](const auto& c) { return wrong_directions<B>(made, c); });
}
template <int B>
std::string has_wrong_bounds(const Subject&, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  return first_of_all<B>(made, vertices, [&](const auto& c) { return wrong_bounds<B>(c); });
}
template <int B>
std::string has_wrong_numbers(const Subject&, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  return first_of_all<B>(made, vertices, [&](const auto& c) { return wrong_numbers<B>(made, c); });
}

template <int B>
std::string is_not_repeatable(const Subject&, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  const Assembled<B> first = assemble_at<B>(*made.obstacle, vertices);
  if (!first.status.ok()) return {};
  const auto compare = [&](std::string_view how, std::size_t at, const LocalConstraint<B>& other) {
    const std::string wrong = differs<B>(first.constraints[at], other);
    return wrong.empty() ? wrong : fmt::format("it gives {} {}, at a vertex of {}", wrong, how, vertices.size());
  };
  const Assembled<B> again = assemble_at<B>(*made.obstacle, vertices);
  std::vector<SurfaceVertex> back(vertices.rbegin(), vertices.rend());
  const Assembled<B> reversed = assemble_at<B>(*made.obstacle, back);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const Assembled<B> alone = assemble_at<B>(*made.obstacle, vertices.subspan(k, 1));
    for (std::string wrong : {compare("the second time", k, again.constraints[k]),
                              compare("in the other order", k, reversed.constraints[vertices.size() - 1 - k]),
                              compare("alone", k, alone.constraints[0])})
      if (!wrong.empty()) return wrong;
  }
  return {};
}

template <int B>
std::string minds_threads(const Subject&, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  const Assembled<B> expected = assemble_at<B>(*made.obstacle, vertices);
  if (!expected.status.ok()) return {};
  std::string found[2];
  std::atomic<int> ready = 0;
  const auto ask = [&](int thread) {
    ++ready;
    while (ready < 2) std::this_thread::yield();
    for (int time = 0; time < 40 && found[thread].empty(); ++time) {
      std::vector<LocalConstraint<B>> own(vertices.size());
      Status status;
      made.obstacle->assemble(vertices.data(), vertices.size(), own.data(), status);
      if (!status.ok()) found[thread] = fmt::format("beside another thread it fails: {}", status.message);
      for (std::size_t k = 0; k < own.size() && found[thread].empty(); ++k)
        if (const std::string wrong = differs<B>(expected.constraints[k], own[k]); !wrong.empty())
          found[thread] = fmt::format("it gives {} beside another thread", wrong);
    }
  };
  std::thread other(ask, 1);
  ask(0);
  other.join();
  return found[0].empty() ? found[1] : found[0];
}

template <int B>
std::string gets_lost_far_away(const Subject&, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  for (const double size : {0.0, 1e8, 1e15})
    for (const bool normal : {true, false}) {
      std::vector<SurfaceVertex> there(vertices.begin(), vertices.end());
      for (SurfaceVertex& v : there)
        for (int i = 0; i < 3; ++i) {
          v.position[i] *= size;
          if (!normal) v.normal[i] = 0;
        }
      for (const SurfaceVertex& v : there) {
        const std::span one(&v, 1);
        std::string wrong = first_of_all<B>(made, one, [&](const auto& c) {
          std::string found = wrong_directions<B>(made, c);
          if (found.empty()) found = wrong_bounds<B>(c);
          return found.empty() ? wrong_numbers<B>(made, c) : found;
        });
        if (!wrong.empty())
          return fmt::format("at ({:.6g}){} {}", fmt::join(v.position, ", "), normal ? "" : ", with a zero normal,",
                             wrong);
      }
    }
  return {};
}

}  // namespace

bool is_answer(const Status& status) {
  const auto is = [&](Exit code) { return status.code == static_cast<int>(code); };
  return status.ok() || is(Exit::input) || is(Exit::no_solution);
}

template <int B>
Assembled<B> assemble_at(const Obstacle<B>& obstacle, std::span<const SurfaceVertex> vertices) {
  Assembled<B> result;
  result.constraints.resize(vertices.size());
  for (LocalConstraint<B>& c : result.constraints) spoil(c);
  obstacle.assemble(vertices.data(), vertices.size(), result.constraints.data(), result.status);
  return result;
}

template <int B>
std::string wrong_directions(const Made<B>& made, const LocalConstraint<B>& c) {
  if (c.directions < 0 || c.directions > B) return fmt::format("it gives {} directions", c.directions);
  if (c.directions > 0 && made.obstacle->descriptor().directions < 1)
    return "it gives directions, and its descriptor has none";
  for (int k = 0; k < c.directions; ++k)
    if (const double length = block::norm<B>(c.direction[k]); !(std::fabs(length - 1) <= 1e-6))
      return fmt::format("direction {} is ({:.6g}), of length {:.6g}", k, fmt::join(c.direction[k], ", "), length);
  if (c.directions > 1 && !(volume_of<B>(c) > 1e-6)) {
    std::string all;
    for (int k = 0; k < c.directions; ++k) all += fmt::format(" ({:.6g})", fmt::join(c.direction[k], ", "));
    return "its directions depend on each other:" + all;
  }
  return {};
}

template <int B>
std::string wrong_bounds(const LocalConstraint<B>& c) {
  for (int k = 0; k < std::clamp(c.directions, 0, B); ++k) {
    const bool ordered = c.lower[k] <= c.upper[k] && c.lower[k] < infinity && c.upper[k] > -infinity;
    if (ordered) continue;
    const bool missing = std::isnan(c.lower[k]) || std::isnan(c.upper[k]);
    return fmt::format("the bounds of direction {} are {:.6g} and {:.6g}{}", k, c.lower[k], c.upper[k],
                       missing ? " (nan also is what was there before)" : "");
  }
  return {};
}

template <int B>
std::string wrong_numbers(const Made<B>& made, const LocalConstraint<B>& c) {
  const int width = made.obstacle->descriptor().data;
  for (int k = 0; k < most_data; ++k) {
    if (!std::isfinite(c.data[k])) return fmt::format("number {} is {:.6g}", k, c.data[k]);
    if (k >= width && c.data[k] != 0)
      return fmt::format("number {} is {:.6g}, and the descriptor has {} numbers", k, c.data[k], width);
  }
  return {};
}

std::string describe(std::span<const SurfaceVertex> vertices) {
  std::string text;
  for (std::size_t k = 0; k < std::min<std::size_t>(vertices.size(), 2); ++k) {
    const SurfaceVertex& v = vertices[k];
    text += fmt::format("{}the vertex at ({:.6g}) with normal ({:.6g}) and measure {:.6g}", k ? ", " : "",
                        fmt::join(v.position, ", "), fmt::join(v.normal, ", "), v.measure);
  }
  return vertices.size() > 2 ? fmt::format("{} vertices, from {}", vertices.size(), text) : text;
}

template <int B>
std::vector<VertexCheck<B>> checks_of_vertices() {
  return {{"beyond", for_all<B>, goes_beyond<B>},           {"directions", for_all<B>, has_wrong_directions<B>},
          {"bounds", for_all<B>, has_wrong_bounds<B>},      {"numbers", for_all<B>, has_wrong_numbers<B>},
          {"repeatable", for_all<B>, is_not_repeatable<B>}, {"threads", for_all<B>, minds_threads<B>},
          {"far", for_all<B>, gets_lost_far_away<B>}};
}

#define SIGNORINI_INSTANTIATE(B)                                                            \
  template Assembled<B> assemble_at<B>(const Obstacle<B>&, std::span<const SurfaceVertex>); \
  template std::string wrong_directions<B>(const Made<B>&, const LocalConstraint<B>&);      \
  template std::string wrong_bounds<B>(const LocalConstraint<B>&);                          \
  template std::string wrong_numbers<B>(const Made<B>&, const LocalConstraint<B>&);         \
  template std::vector<VertexCheck<B>> checks_of_vertices<B>();
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini::conformance
