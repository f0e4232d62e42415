#pragma once
#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "core/mortar/face_integrals.hpp"

namespace signorini::mortar {

/// Per slave node the faces around it that see partners of it.
template <int D, int P>
class NodeSeats {
 public:
  /// Of a slave node in the record of a face.
  struct Seat {
    const FaceIntegrals<D, P>* part;
    const FaceRecord<D, P>* record;
    std::size_t corner;
  };

  /// @param nodes how many the slave has
  /// @param creases of the master
  /// @param seen by the slave's faces; is referred to
  NodeSeats(std::size_t nodes, const Creases<D>& creases, const std::vector<FaceIntegrals<D, P>>& seen) {
    list_records(nodes, seen);
    NearestSheet<D> sheet(creases);
    for (std::size_t p = 0; p < nodes; ++p)
      near_.push_back(leave_out_behind({seats_.data() + first_[p], first_[p + 1] - first_[p]}, sheet));
  }

  /// In the order of the faces.
  std::span<const Seat> at(Index node) const { return near_[node]; }

 private:
  // By slave node, in the order of the faces.
  void list_records(std::size_t nodes, const std::vector<FaceIntegrals<D, P>>& seen) {
    first_.assign(nodes + 1, 0);
    const auto each = [&](const auto& visit) {
      for (const auto& part : seen)
        for (const auto& record : part.records)
          for (std::size_t p = 0; p < ElementFace<D, P>::nodes; ++p)
            visit(static_cast<std::size_t>(record.node[p]), Seat{&part, &record, p});
    };
    each([&](std::size_t p, const Seat&) { ++first_[p + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    seats_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    each([&](std::size_t p, const Seat& seat) { seats_[next[p]++] = seat; });
  }

  /// Where the master has an edge or a step at a node, faces on one side of that see what is behind what the others
  /// see.
  static std::span<const Seat> leave_out_behind(std::span<Seat> all, NearestSheet<D>& sheet) {
    if (all.empty()) return {};
    const auto away = [](const Seat& s) { return s.record->nearest + s.record->farthest; };
    const Point<D> direction = looks_along(*std::ranges::min_element(all, {}, away));
    std::vector<SeenPart> parts;
    double size = 0;
    for (const Seat& s : all) {
      // Faces beside an edge of the slave look elsewhere, and see farther.
      const double along = std::max(dot(looks_along(s), direction), 0.0);
      for (SeenPart part : parts_of(s)) {
        part.seen.nearest = std::min(part.seen.nearest, along * part.seen.nearest);
        parts.push_back(part);
      }
      size = std::max(size, s.record->size);
    }
    merge_parts(parts);
    const auto partner = [&](const Seat& s) {
      return std::ranges::any_of(parts_of(s), [&](const SeenPart& p) {
        return p.kept && std::ranges::lower_bound(parts, p.part, {}, &SeenPart::part)->kept;
      });
    };
    sheet.choose(parts, direction, size);
    if (std::ranges::all_of(parts, &SeenPart::kept)) return all;
    // A face that lies along the other side of an edge touches that.
    const auto end = std::stable_partition(all.begin(), all.end(), [&](const Seat& s) {
      sheet.choose(parts, direction, size);
      if (partner(s)) return true;
      sheet.choose(parts, looks_along(s), size);
      return partner(s);
    });
    return {all.begin(), end == all.begin() ? all.end() : end};
  }

  static Point<D> looks_along(const Seat& s) {
    Point<D> out = s.record->normal[s.corner];
    const double norm = length<D>(out);
    for (double& c : out) c /= norm;
    return out;
  }

  static std::span<const SeenPart> parts_of(const Seat& s) {
    return {s.part->parts.data() + s.record->first_part, s.part->parts.data() + s.record->last_part};
  }

  std::vector<std::size_t> first_;
  std::vector<Seat> seats_;
  std::vector<std::span<const Seat>> near_;
};

}  // namespace signorini::mortar
