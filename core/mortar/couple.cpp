#include "core/mortar/couple.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mortar/face_integrals.hpp"

namespace signorini {
namespace {

// Faces that a thread takes at a time.
constexpr Index faces_at_a_time = 256;
// Shorter than this part of what they would be if all directions were one, directions of a node's faces cancel.
constexpr double cancel = 1e-6;
// What divides the gap of a node between faces of several directions is no less than that: as at an edge of 120
// degrees.
constexpr double least_common = 0.5;
// Entries of a row of less than this part of its largest one are rounding.
constexpr double rounding = 1e-14;

void check(const CoupleOptions& options, std::string_view place) {
  const auto require = [&](bool fine, const char* what, double found) {
    if (!fine) input_error(place, fmt::format("{} is {}", what, found));
  };
  require(options.reach > 0, "expected a reach of the pairing larger than 0; it", options.reach);
  const double depth = options.depth.value_or(0);
  require(depth >= 0, "expected a depth of the pairing not less than 0; it", depth);
  require(options.least_cover >= 0 && options.least_cover < 1, "expected a least cover from 0 to less than 1; it",
          options.least_cover);
}

/// The boxes around faces.
template <int D>
struct Boxes {
  std::vector<Point<D>> middle, half;

  explicit Boxes(const mortar::Side<D>& side) {
    middle.reserve(side.corner.size());
    half.reserve(side.corner.size());
    for (const auto& corner : side.corner) {
      Point<D> low = corner[0], high = corner[0], m, h;
      for (const Point<D>& x : corner)
        for (int k = 0; k < D; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
      for (int k = 0; k < D; ++k) {
        m[k] = 0.5 * low[k] + 0.5 * high[k];
        h[k] = std::max(high[k] - m[k], m[k] - low[k]);
      }
      middle.push_back(m);
      half.push_back(h);
    }
  }
};

/// Turns what slave faces see into what slave nodes do.
template <int D>
class Gathering {
 public:
  Gathering(const mortar::Side<D>& slave, const mortar::Side<D>& master, bool one_numbering,
            const std::vector<mortar::FaceIntegrals<D>>& seen)
      : slave_(slave), master_(master), one_numbering_(one_numbering), seen_(seen), place_(master.node.size(), -1) {
    list_records();
    whole_.assign(slave.node.size(), 0);
    for (std::size_t f = 0; f < slave.faces.size(); ++f)
      for (const Index v : slave.faces[f]) whole_[slave.number[v]] += slave.area[f] / D;
  }

  void run(const CoupleOptions& options, MortarCoupling<D>& out) {
    for (Index p = 0; p < static_cast<Index>(slave_.node.size()); ++p)
      if (!add_node(p, options, out)) out.alone.push_back(slave_.node[p]);
  }

 private:
  struct Seat {  // of a slave node in the record of a face
    const mortar::FaceIntegrals<D>* part;
    const mortar::FaceRecord<D>* record;
    int corner;
  };

  // By slave node, in the order of the faces.
  void list_records() {
    first_.assign(slave_.node.size() + 1, 0);
    const auto each = [&](const auto& visit) {
      for (const auto& part : seen_)
        for (const auto& record : part.records)
          for (int p = 0; p < D; ++p)
            visit(static_cast<std::size_t>(slave_.number[slave_.faces[record.face][p]]), Seat{&part, &record, p});
    };
    each([&](std::size_t p, const Seat&) { ++first_[p + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    seats_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    each([&](std::size_t p, const Seat& seat) { seats_[next[p]++] = seat; });
  }

  bool add_node(Index p, const CoupleOptions& options, MortarCoupling<D>& out) {
    const Index node = slave_.node[p];
    if (one_numbering_ && master_.number[node] >= 0) return false;
    const std::span<const Seat> seats(seats_.data() + first_[p], first_[p + 1] - first_[p]);
    double weight = 0, gap = 0;
    Point<D> normal{};
    for (const Seat& s : seats) {
      const double share = s.record->share[s.corner];
      weight += share;
      gap += share * s.record->gap[s.corner];
      for (int k = 0; k < D; ++k) normal[k] += share * s.record->direction[k];
    }
    if (!(weight > options.least_cover * whole_[p])) return false;
    // ∫ ψ_p (jump) · (direction) <= ∫ ψ_p (distance) with one jump for all faces of the node: the left-hand side is
    // that times the sum of directions, whose length divides both.
    const double common = length<D>(normal);
    if (!(common > cancel * weight)) return false;
    for (double& c : normal) c /= common;
    out.node.push_back(node);
    out.weight.push_back(weight);
    out.normal.push_back(normal);
    out.gap.push_back(gap / std::max(common, least_common * weight));
    add_row(seats, weight, out);
    return true;
  }

  void add_row(std::span<const Seat> seats, double weight, MortarCoupling<D>& out) {
    row_.clear();
    for (const Seat& s : seats) {
      const double part = s.record->share[s.corner] / weight;
      for (std::size_t e = s.record->first; e < s.record->last; ++e) {
        const auto& entry = s.part->entries[e];
        Index& place = place_[entry.master];
        if (place < 0) {
          place = static_cast<Index>(row_.size());
          row_.push_back({entry.master, 0});
        }
        row_[place].value += part * entry.value[s.corner];
      }
    }
    double largest = 0, sum = 0;
    for (const Weight& w : row_) {
      largest = std::max(largest, std::abs(w.value));
      place_[w.master] = -1;
    }
    std::erase_if(row_, [&](const Weight& w) { return std::abs(w.value) <= rounding * largest; });
    for (const Weight& w : row_) sum += w.value;
    std::ranges::sort(row_, {}, &Weight::master);
    for (const Weight& w : row_) {
      out.column.push_back(master_.node[w.master]);
      out.value.push_back(w.value / sum);  // the sum is one up to rounding, which strips make larger
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }

  struct Weight {
    Index master;
    double value;
  };

  const mortar::Side<D>& slave_;
  const mortar::Side<D>& master_;
  const bool one_numbering_;
  const std::vector<mortar::FaceIntegrals<D>>& seen_;
  std::vector<std::size_t> first_;
  std::vector<Seat> seats_;
  std::vector<double> whole_;  // area of a node, covered or not
  std::vector<Index> place_;
  std::vector<Weight> row_;
};

/// What each part of the slave sees; the parts do not depend on the number of threads.
template <int D>
std::vector<mortar::FaceIntegrals<D>> integrate(const mortar::Side<D>& slave, const mortar::Side<D>& master,
                                                const CoupleOptions& options, bool one_numbering, Crew* crew) {
  const Boxes<D> boxes(master);
  std::vector<Index> all(master.faces.size());
  std::iota(all.begin(), all.end(), Index{0});
  const PointTree<D> tree(boxes.middle, boxes.half, std::move(all));
  const auto faces = static_cast<Index>(slave.faces.size());
  std::vector<mortar::FaceIntegrals<D>> parts((slave.faces.size() + faces_at_a_time - 1) / faces_at_a_time);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    mortar::FaceIntegrator<D> integrator(slave, master, tree, options, one_numbering);
    for (std::size_t i; (i = next++) < parts.size();) {
      const auto first = static_cast<Index>(i) * faces_at_a_time;
      for (Index f = first; f < std::min(faces, first + faces_at_a_time); ++f) integrator.add(f, parts[i]);
    }
  };
  if (crew && parts.size() > 1)
    crew->run(work);
  else
    work();
  return parts;
}

}  // namespace

template <int D>
MortarCoupling<D> couple(const SurfaceFaces<D>& slave, const SurfaceFaces<D>& master, const CoupleOptions& options,
                         Crew* crew) {
  check(options, slave.place);
  const mortar::Side<D> slave_side(slave), master_side(master);
  const bool one_numbering = slave.points.data() == master.points.data();
  const auto seen = integrate(slave_side, master_side, options, one_numbering, crew);
  MortarCoupling<D> out;
  for (const mortar::FaceIntegrals<D>& part : seen) {
    if (part.deepest.depth > out.deepest.depth) out.deepest = part.deepest;
    out.lumped += part.lumped;
    out.layered += part.layered;
  }
  Gathering<D>(slave_side, master_side, one_numbering, seen).run(options, out);
  return out;
}

template MortarCoupling<2> couple(const SurfaceFaces<2>&, const SurfaceFaces<2>&, const CoupleOptions&, Crew*);
template MortarCoupling<3> couple(const SurfaceFaces<3>&, const SurfaceFaces<3>&, const CoupleOptions&, Crew*);

}  // namespace signorini
