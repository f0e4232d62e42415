#pragma once
#include "core/base/dot.hpp"
#include "core/mortar/creases.hpp"
#include "core/mortar/sheets.hpp"

namespace signorini::mortar {

/// The least and the largest of some distances.
struct Distances {
  double nearest = infinity, farthest = -infinity;

  void add(double distance) { nearest = std::min(nearest, distance), farthest = std::max(farthest, distance); }
  void add(const Distances& other) {
    nearest = std::min(nearest, other.nearest), farthest = std::max(farthest, other.farthest);
  }
};

/// A face of the master that a slave face, or those around a node, see.
struct SeenPart {
  Index part;
  Distances seen;
  bool kept = true;  ///< as a partner
};

/// By ascending part, each once.
inline void merge_parts(std::vector<SeenPart>& parts) {
  std::ranges::sort(parts, {}, &SeenPart::part);
  std::size_t count = 0;
  for (const SeenPart& p : parts)
    if (count > 0 && parts[count - 1].part == p.part) {
      parts[count - 1].seen.add(p.seen);
      parts[count - 1].kept |= p.kept;
    } else {
      parts[count++] = p;
    }
  parts.resize(count);
}

/// Of what is in front of faces of the slave, side by side, what these may touch: the nearest sheet of the master, and
/// what does not fall back behind an edge or a step of that. Keeps its memory.
template <int D>
class NearestSheet {
 public:
  /// Keeps a reference.
  explicit NearestSheet(const Creases<D>& master) : master_(master) {}

  /// Tells which parts are kept.
  /// @param parts ascending
  /// @param direction in which the slave looks, of length 1
  /// @param size of its faces
  void choose(std::vector<SeenPart>& parts, const Point<D>& direction, double size);

  /// Whether what is kept does not hang together.
  bool apart() const { return apart_; }
  /// The largest difference of slopes on both sides of an edge between parts that are kept.
  double kink(const std::vector<SeenPart>& parts, const Point<D>& direction) const;

 private:
  enum class State : char { unknown, kept, behind };
  using Seat = typename Sheets<D>::Seat;

  void follow_edges(const Point<D>& direction);
  bool falls_back(const Seat& from, const Seat& to, const Point<D>& direction) const;
  Point<D> slope(const Seat& seat, const Point<D>& direction) const;

  const Creases<D>& master_;
  Sheets<D> sheets_;
  Index nearest_ = 0;
  bool apart_ = false;
  std::vector<Index> numbers_;       // of the parts
  std::vector<Distances> seen_;      // per sheet, at the place of its first part
  std::vector<State> state_, next_;  // likewise
};

/// By how much the distance grows per way along the slave, as a vector, where the master has a normal; with what is
/// along the direction added, which is of length 1.
template <int D>
Point<D> slope_along(Point<D> normal, const Point<D>& direction) {
  const double along = dot(normal, direction);
  for (double& c : normal) c /= along;
  return normal;
}

}  // namespace signorini::mortar
