#include "core/mortar/planes.hpp"

#include <cmath>
#include <numeric>

#include "core/base/dot.hpp"
#include "core/mesh/chords.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mortar/sheets.hpp"

namespace signorini::mortar {
namespace {

/// Normals of one plane differ by less: positions may have been cut off by files.
constexpr double coplanar = 1e-6;

template <int D>
bool same(const Point<D>& a, const Point<D>& b) {
  return length<D>(difference<D>(a, b)) <= coplanar;
}

/// What a face stands for is as flat as it is.
template <int D>
bool is_flat(const Creases<D>& creases, Index face) {
  for (int opposite = 0; opposite < D; ++opposite)
    if (!same<D>(creases.normal(face, opposite), creases.side().normal[face])) return false;
  return true;
}

/// Faces with one normal that hang together.
template <int D>
class Patches {
 public:
  explicit Patches(const Creases<D>& creases)
      : creases_(creases),
        side_(creases.side()),
        root_(side_.faces.size()),
        inner_(side_.faces.size() * D),
        round_(side_.faces.size()),
        faint_(side_.faces.size()),
        inside_(side_.faces.size()) {
    std::iota(root_.begin(), root_.end(), Index{0});
    Sheets<D> sheets;
    sheets.find(side_, root_);
    for (Index f = 0; f < std::ssize(root_); ++f) flat_.push_back(is_flat(creases, f));
    for (const auto& [a, b] : sheets.neighbours()) join(a, b);
    for (const auto& [a, b] : sheets.neighbours()) look_at_edge(a, b);
    find_inside();
  }

  /// -1: of none that is a plane.
  Index plane(Index face) {
    const Index patch = root(face);
    return flat_[face] && !round_[patch] && (!faint_[patch] || inside_[patch]) ? patch : -1;
  }

 private:
  using Seat = typename Sheets<D>::Seat;

  bool both_flat(const Seat& a, const Seat& b) const { return flat_[a.face] && flat_[b.face]; }
  bool together(const Seat& a, const Seat& b) const {
    return both_flat(a, b) && same<D>(side_.normal[a.face], side_.normal[b.face]);
  }

  void join(const Seat& a, const Seat& b) {
    if (!together(a, b)) return;
    root_[root(a.face)] = root(b.face);
    for (const Seat& seat : {a, b}) inner_[seat.face * D + seat.opposite] = true;
  }

  /// A turn of less than what is sharp anyway is a crease's only where that is told from facets: by a patch of more
  /// than a row.
  void look_at_edge(const Seat& a, const Seat& b) {
    if (!both_flat(a, b) || together(a, b)) return;
    const double turn = length<D>(difference<D>(side_.normal[a.face], side_.normal[b.face]));
    if (turn > 2 * std::sin(largest_turn / 2)) return;
    std::vector<char>& which = creases_.is_crease(a.face, a.opposite) ? faint_ : round_;
    which[root(a.face)] = which[root(b.face)] = true;
  }

  /// Patches with a node that is on none of their ends.
  void find_inside() {
    std::vector<char> at_end(side_.number.size());
    for (Index f = 0; f < std::ssize(side_.faces); ++f)
      for (int opposite = 0; opposite < D; ++opposite)
        for (int i = 0; i < D && !inner_[f * D + opposite]; ++i)
          if (i != opposite) at_end[side_.faces[f][i]] = true;
    for (Index f = 0; f < std::ssize(side_.faces); ++f)
      for (const Index v : side_.faces[f])
        if (!at_end[v]) inside_[root(f)] = true;
  }

  Index root(Index face) {
    while (root_[face] != face) face = root_[face] = root_[root_[face]];
    return face;
  }

  const Creases<D>& creases_;
  const Side<D>& side_;
  std::vector<Index> root_;                   // per face
  std::vector<char> flat_, inner_;            // per face; per face and corner: the edge opposite is within a patch
  std::vector<char> round_, faint_, inside_;  // at the patch's root: turns without crease; with one of a small angle
};

}  // namespace

template <int D>
Planes<D>::Planes(const Creases<D>& creases) {
  Patches<D> patches(creases);
  for (Index f = 0; f < std::ssize(creases.side().faces); ++f) plane_.push_back(patches.plane(f));
}

template class Planes<2>;
template class Planes<3>;

}  // namespace signorini::mortar
