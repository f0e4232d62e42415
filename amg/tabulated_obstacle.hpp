#pragma once
#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/sdk/obstacle.hpp"

namespace signorini {

/// Bounds at blocks of a matrix as numbers, row after row: lower <= direction . v <= upper along `directions` unit
/// vectors of B entries each.
template <int B>
struct ObstacleTable {
  std::vector<Index> blocks;         ///< their numbers from 0, ascending
  int directions = 1;                ///< at each of them: 1 to B
  std::vector<double> direction;     ///< directions * B per block; empty: the first coordinate axes
  std::vector<double> lower, upper;  ///< directions per block, infinite where there is none; empty: none
  int width = 0;                     ///< numbers of a functional per block: at most most_data
  std::vector<double> data;          ///< width per block, as LocalConstraint::data
};

/// An obstacle whose bounds are a table, for codes that know normals and gaps themselves.
///
///   TabulatedObstacle<3, CoulombLaw<3>> contact({blocks, 1, normals, minus_gaps, {}, 2, coefficients});
///
/// @tparam Law BoxObstacle<B>, or an obstacle with a functional of which assemble() is left to be said, such as
///     CoulombLaw<B>
template <int B, class Law>
class TabulatedObstacle : public Law {
 public:
  /// @param law what the constructor of Law takes
  /// @throws Error(Exit::input) where the lengths of the table do not fit to each other
  template <class... Arguments>
  explicit TabulatedObstacle(ObstacleTable<B> table, Arguments&&... law)
      : Law(std::forward<Arguments>(law)...), table_(std::move(table)) {
    const std::size_t rows = table_.blocks.size();
    if (table_.directions < 1 || table_.directions > B) refuse("directions", table_.directions, "1 to", B);
    if (table_.width < 0 || table_.width > most_data) refuse("numbers per block", table_.width, "0 to", most_data);
    const std::size_t bounds = rows * static_cast<std::size_t>(table_.directions);
    expect("entries of directions", table_.direction, bounds * B);
    expect("lower bounds", table_.lower, bounds);
    expect("upper bounds", table_.upper, bounds);
    const std::size_t numbers = rows * static_cast<std::size_t>(table_.width);
    if (table_.data.size() != numbers)
      refuse("numbers", static_cast<long>(table_.data.size()), "", static_cast<long>(numbers));
  }

  ObstacleDescriptor descriptor() const noexcept override {
    return {1, {{"table", B, 2 * table_.directions}}, table_.width};
  }

  /// The rows of the blocks that SurfaceVertex::vertex names.
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* constraints,
                Status& status) const noexcept override {
    for (std::size_t i = 0; i < count; ++i) {
      const auto found = std::ranges::lower_bound(table_.blocks, vertices[i].vertex);
      if (found == table_.blocks.end() || *found != vertices[i].vertex)
        return status.fail(static_cast<int>(Exit::input), "the obstacle's table has no row for it");
      take(static_cast<std::size_t>(found - table_.blocks.begin()), constraints[i]);
    }
  }

 private:
  void take(std::size_t row, LocalConstraint<B>& out) const noexcept {
    out.directions = table_.directions;
    for (int k = 0; k < table_.directions; ++k) {
      const std::size_t at = row * static_cast<std::size_t>(table_.directions) + static_cast<std::size_t>(k);
      for (int i = 0; i < B; ++i)
        out.direction[k][i] =
            table_.direction.empty() ? (i == k ? 1 : 0) : table_.direction[at * B + static_cast<std::size_t>(i)];
      out.lower[k] = table_.lower.empty() ? -infinity : table_.lower[at];
      out.upper[k] = table_.upper.empty() ? infinity : table_.upper[at];
    }
    const auto width = static_cast<std::size_t>(table_.width);
    std::copy_n(table_.data.begin() + static_cast<Offset>(row * width), width, out.data);
  }

  static void expect(const char* what, const std::vector<double>& found, std::size_t expected) {
    if (!found.empty() && found.size() != expected)
      refuse(what, static_cast<long>(found.size()), "none or", static_cast<long>(expected));
  }

  [[noreturn]] static void refuse(const char* what, long found, const char* or_else, long expected) {
    char text[200];
    std::snprintf(text, sizeof text, "found %ld %s, expected%s%s %ld", found, what, *or_else ? " " : "", or_else,
                  expected);
    input_error("table of an obstacle", text);
  }

  ObstacleTable<B> table_;
};

}  // namespace signorini
