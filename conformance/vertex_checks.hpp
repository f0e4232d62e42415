#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "conformance/random.hpp"
#include "conformance/subject.hpp"

namespace signorini::conformance {

/// A check that asks for constraints at vertices.
template <int B>
struct VertexCheck {
  std::string_view id;
  bool (*applies)(const Subject& subject, const Made<B>& made);
  /// What was found; "" where nothing is wrong.
  std::string (*wrong)(const Subject& subject, const Made<B>& made, std::span<const SurfaceVertex> vertices);
};

/// What assemble() gives, with the status it ends with.
template <int B>
struct Assembled {
  std::vector<LocalConstraint<B>> constraints;
  Status status;
};

/// Asks for constraints at vertices; what is not set of them is NaN.
template <int B>
Assembled<B> assemble_at(const Obstacle<B>& obstacle, std::span<const SurfaceVertex> vertices);

/// Whether the status is one that a user can mend, or none.
bool is_answer(const Status& status);

/// What a plugin may not answer at a vertex, whatever its input; "" for nothing.
template <int B>
std::string wrong_directions(const Made<B>& made, const LocalConstraint<B>& c);
template <int B>
std::string wrong_bounds(const LocalConstraint<B>& c);
template <int B>
std::string wrong_numbers(const Made<B>& made, const LocalConstraint<B>& c);

template <int B>
std::vector<VertexCheck<B>> checks_of_vertices();
/// Where whatever it depends on is turned, moved or enlarged.
template <int B>
std::vector<VertexCheck<B>> checks_of_equivariance();

std::string describe(std::span<const SurfaceVertex> vertices);

}  // namespace signorini::conformance
