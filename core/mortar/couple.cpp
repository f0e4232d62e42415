#include "core/mortar/couple.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mortar/boxes.hpp"
#include "core/mortar/face_integrals.hpp"
#include "core/mortar/node_seats.hpp"

namespace signorini {
namespace {

// Faces that a thread takes at a time.
constexpr Index faces_at_a_time = 256;
// Shorter than this part of what they would be if all directions were one, directions of a node's faces cancel.
constexpr double cancel = 1e-6;
// What divides the gap of a node between faces of several directions is no less than that: as at an edge of 120
// degrees.
constexpr double least_common = 0.5;
// Where what faces share in a node is of both signs, no less than this part of it is left.
constexpr double left_of_parts = 0.01;
// Of the area of a quadratic element's node the master covers no less: what is divided by less has weights far above
// one, and takes many cycles.
constexpr double least_quadratic_cover = 0.1;
// Nodes with less of the area of a face stand for nothing but rounding: corners of quadratic elements on the axis.
constexpr double least_node = 1e-12;
// Of the extent of what a node sees: by so much what is round misses the normal at most. What edges do is more.
constexpr double round_miss = 0.1;
// Of the same: less is rounding.
constexpr double no_miss = 1e-12;
// Entries of a row of less than this part of its largest one are rounding.
constexpr double no_entry = 1e-14;

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

/// Turns what slave faces see into what slave nodes do.
template <int D, int P>
class Gathering {
 public:
  Gathering(const mortar::Side<D>& slave, const mortar::Creases<D>& creases, bool one_numbering, bool axisymmetric,
            const std::vector<mortar::FaceIntegrals<D, P>>& seen)
      : slave_(slave),
        master_(creases.side()),
        one_numbering_(one_numbering),
        axisymmetric_(axisymmetric),
        seats_(slave.node.size(), creases, seen),
        place_(master_.node.size(), -1),
        at_(places(slave)),
        master_at_(places(master_)) {
    whole_.assign(slave.node.size(), 0);
    around_.assign(slave.node.size(), 0);
    each_share([&](Face, Index p, double share, double of_face) {
      whole_[p] += share;
      around_[p] += of_face;
    });
  }

  void run(const CoupleOptions& options, MortarCoupling<D>& out) {
    for (Index p = 0; p < size(); ++p) {
      nodes_.push_back(sum(p, options));
      orphans_ = orphans_ || nodes_.back().place == Place::orphan;
    }
    front_.assign(slave_.node.size(), 0);
    each_share([&](Face face, Index p, double share, double) {
      if (faces(face, nodes_[p].normal)) front_[p] += share;
    });
    for (Index p = 0; p < size(); ++p)
      if (nodes_[p].place == Place::paired)
        add_node(p, out);
      else
        out.alone.push_back(slave_.node[p]);
  }

 private:
  using Face = mortar::ElementFace<D, P>;
  using Record = mortar::FaceRecord<D, P>;

  using Seat = typename mortar::NodeSeats<D, P>::Seat;

  enum class Place { paired, orphan, alone };  // orphan: alone, but what it is a part of is not

  struct Node {
    Place place = Place::alone;
    double weight = 0, common = 0;
    Point<D> normal{};
    bool left_out = false;  // as CoupleOptions has it
  };

  Index size() const { return static_cast<Index>(slave_.node.size()); }

  static Point<D> plus(Point<D> a, double factor, const Point<D>& b) {
    for (int k = 0; k < D; ++k) a[k] += factor * b[k];
    return a;
  }

  /// Per node of a side its place; of midpoints its coefficient.
  static std::vector<Point<D>> places(const mortar::Side<D>& side) {
    std::vector<Point<D>> out(side.node.size());
    for (Index f = 0; f < static_cast<Index>(side.faces.size()) / Face::parts; ++f) {
      std::array<Point<D>, Face::nodes> at;
      for (Index child = 0; child < Face::parts; ++child)
        for (int i = 0; i < D; ++i) at[Face::node(child, i)] = side.corner[Face(f).part(child)][i];
      if constexpr (P > 1) {
        constexpr auto ends = simplex_edges<D - 1>();
        for (std::size_t k = 0; k < ends.size(); ++k) {
          const Point<D> middle = midpoint<D>(at[ends[k][0]], at[ends[k][1]]);
          at[D + k] = plus(middle, 1 / midpoint_weight, difference<D>(at[D + k], middle));
        }
      }
      const auto point = Face(f).points(side);
      for (std::size_t a = 0; a < point.size(); ++a) out[side.number[point[a]]] = at[a];
    }
    return out;
  }

  /// Calls visit(face, node, area of the node in it, area of the face) for all nodes of slave faces.
  template <class Visit>
  void each_share(const Visit& visit) const {
    for (Index f = 0; f < static_cast<Index>(slave_.faces.size()) / Face::parts; ++f) each_share(Face(f), visit);
  }

  /// Weighted as what faces see is: by the radius of bodies of revolution.
  template <class Visit>
  void each_share(Face face, const Visit& visit) const {
    const auto point = face.points(slave_);
    const ElementMap<D, D - 1, P> map = face.map(slave_);
    std::array<double, Face::nodes> mean{};
    double of_face = 0;
    for (const auto& [barycentric, weight] : quadrature5<D - 1>()) {
      const double here = weight * (axisymmetric_ ? map(barycentric)[0] : 1);
      const auto value = basis<P>(barycentric);
      for (std::size_t p = 0; p < mean.size(); ++p) mean[p] += here * value[p];
      of_face += here;
    }
    for (std::size_t p = 0; p < point.size(); ++p)
      visit(face, slave_.number[point[p]], face.area(slave_) * mean[p], face.area(slave_) * of_face);
  }

  bool faces(Face face, const Point<D>& normal) const { return dot(slave_.normal[face.part(0)], normal) >= facing; }

  std::span<const Seat> seats(Index p) const { return seats_.at(p); }

  Node sum(Index p, const CoupleOptions& options) const {
    Node out;
    if (one_numbering_ && master_.number[slave_.node[p]] >= 0) return out;
    const double least = std::max(options.least_cover, P > 1 ? least_quadratic_cover : 0);
    double size = 0;
    for (const Seat& s : seats(p)) {
      const double share = s.record->share[s.corner];
      out.weight += share;
      size += std::abs(share);
      for (int k = 0; k < D; ++k) out.normal[k] += share * s.record->normal[s.corner][k];
    }
    const bool stands_for_some = whole_[p] > least_node * around_[p];
    if (!(stands_for_some && out.weight > least * whole_[p] && out.weight > left_of_parts * size)) {
      out.place = P > 1 && size > 0 ? Place::orphan : Place::alone;
      return out;
    }
    if (std::ranges::binary_search(options.left_out, slave_.node[p])) {
      out.place = Place::orphan;
      out.left_out = true;
      return out;
    }
    // ∫ ψ_p (jump) · (direction) <= ∫ ψ_p (distance) with one jump for all faces of the node: the left-hand side is
    // that times the sum of directions, whose length divides both.
    out.common = length<D>(out.normal);
    if (out.common > cancel * out.weight) out.place = Place::paired;
    for (double& c : out.normal) c /= out.common;
    return out;
  }

  void add_node(Index p, MortarCoupling<D>& out) {
    const Node& node = nodes_[p];
    row_.clear();
    own_.clear();
    bool of_surface = true;
    double gap = 0, taken = 0, nearest = infinity, farthest = -infinity, kink = 0;
    for (const Seat& s : seats(p)) {
      of_surface = of_surface && s.record->of_surface;
      kink = std::max(kink, s.record->kink);
      nearest = std::min(nearest, s.record->nearest);
      farthest = std::max(farthest, s.record->farthest);
      gap += add(s, s.corner, s.record->share[s.corner]);
      if (orphans_) gap += add_orphans(s, part_of_orphans(*s.record, s.corner), taken);
    }
    out.node.push_back(slave_.node[p]);
    out.weight.push_back(node.weight);
    out.covered.push_back(front_[p] > 0 ? node.weight / front_[p] : 1);
    out.taken.push_back(front_[p] > 0 ? taken / front_[p] : 0);
    out.normal.push_back(node.normal);
    const double common = std::max(node.common, least_common * node.weight);
    out.gap.push_back(gap / common);
    out.nearest.push_back(nearest * node.weight / common);
    out.farthest.push_back(farthest * node.weight / common);
    out.kink.push_back(kink);
    take_row(node.weight, out);
    if (of_surface && !axisymmetric_ && own_.empty()) keep_rotations(p, out);
  }

  /// Both bodies turned as one make no jump along the normal: the mean of the master's places is on the normal through
  /// the slave's. Flat faces of what is round miss it by a part of their sagitta, and what contact alone keeps from
  /// turning, as a shaft in a bore, would turn by that. The smallest change of the weights that mends it.
  void keep_rotations(Index p, MortarCoupling<D>& out) const {
    const std::span<const Index> column(out.column.data() + out.row.end()[-2], out.column.data() + out.row.back());
    double* weight = out.value.data() + out.row.end()[-2];
    const Point<D>& n = out.normal.back();
    const auto across = [&](const Point<D>& x) { return plus(x, -dot(x, n), n); };
    std::vector<Point<D>> place;
    Point<D> miss{}, middle{};
    double all = 0;
    for (std::size_t m = 0; m < column.size(); ++m) {
      place.push_back(across(difference<D>(master_at_[master_.number[column[m]]], at_[p])));
      miss = plus(miss, weight[m], place[m]);
      middle = plus(middle, std::abs(weight[m]), place[m]);
      all += std::abs(weight[m]);
    }
    const double off = length<D>(miss);
    Point<D> along{}, aside{};  // in the tangent plane
    for (int k = 0; k < D; ++k) along[k] = off > 0 ? miss[k] / off : 0;
    if constexpr (D == 3) aside = cross(n, along);
    double moment = 0, mixed = 0, other = 0;
    for (std::size_t m = 0; m < column.size(); ++m) {
      place[m] = plus(place[m], -1 / all, middle);
      const double x = dot(place[m], along), y = dot(place[m], aside);
      moment += std::abs(weight[m]) * x * x;
      mixed += std::abs(weight[m]) * x * y;
      other += std::abs(weight[m]) * y * y;
    }
    const double extent = std::sqrt((moment + other) / all);
    if (off <= no_miss * extent || off > round_miss * extent) return;
    const double turn = D == 3 ? mixed / other : 0, step = off / (moment - turn * mixed);
    const auto by = [&](std::size_t m) {
      return -std::abs(weight[m]) * step * (dot(place[m], along) - turn * dot(place[m], aside));
    };
    for (std::size_t m = 0; m < column.size(); ++m)
      if (!(std::abs(by(m)) <= round_miss)) return;
    for (std::size_t m = 0; m < column.size(); ++m) weight[m] += by(m);
  }

  /// Of what the face's nodes without a place of their own are a part of.
  double part_of_orphans(const Record& record, std::size_t corner) const {
    double sum = 0;
    for (std::size_t p = 0; p < Face::nodes; ++p)
      if (nodes_[record.node[p]].place == Place::paired) sum += std::max(record.share[p], 0.0);
    return sum > 0 ? std::max(record.share[corner], 0.0) / sum : 0;
  }

  /// @param taken gets the area of those that are left out
  double add_orphans(const Seat& s, double part, double& taken) {
    double gap = 0;
    for (std::size_t a = 0; part > 0 && a < Face::nodes; ++a) {
      const Index node = s.record->node[a];
      if (nodes_[node].place != Place::orphan) continue;
      const double share = part * s.record->share[a];
      gap += add(s, a, share);
      if (nodes_[node].left_out) taken += share;
      own_.push_back({slave_.node[node], -share});
    }
    return gap;
  }

  /// Adds a part of ∫ r_p φ_q to the row. @return that of the gap
  double add(const Seat& s, std::size_t corner, double share) {
    for (std::size_t e = s.record->first; e < s.record->last; ++e) {
      const auto& entry = s.part->entries[e];
      Index& place = place_[entry.master];
      if (place < 0) {
        place = static_cast<Index>(row_.size());
        row_.push_back({entry.master, 0});
      }
      row_[place].value += share * entry.value[corner];
    }
    return share * s.record->gap[corner];
  }

  void take_row(double weight, MortarCoupling<D>& out) {
    double largest = 0, sum = 0;
    for (Weight& w : row_) {
      place_[w.node] = -1;
      w = {master_.node[w.node], w.value / weight};
      largest = std::max(largest, std::abs(w.value));
    }
    std::ranges::sort(own_, {}, &Weight::node);
    for (const Weight& w : own_) {  // an orphan of two faces has one entry
      if (row_.empty() || row_.back().node != w.node) row_.push_back({w.node, 0});
      row_.back().value += w.value / weight;
    }
    std::erase_if(row_, [&](const Weight& w) { return std::abs(w.value) <= no_entry * largest; });
    for (const Weight& w : row_) sum += w.value;
    std::ranges::sort(row_, {}, &Weight::node);
    for (const Weight& w : row_) {
      out.column.push_back(w.node);
      out.value.push_back(w.value / sum);  // the sum is one up to rounding, which strips make larger
    }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }

  struct Weight {
    Index node;
    double value;
  };

  const mortar::Side<D>& slave_;
  const mortar::Side<D>& master_;
  const bool one_numbering_, axisymmetric_;
  const mortar::NodeSeats<D, P> seats_;
  std::vector<double> whole_, around_;  // area of a node, covered or not, and of its faces
  std::vector<double> front_;           // area of a node in faces along its normal
  std::vector<Node> nodes_;
  bool orphans_ = false;  // there are some
  std::vector<Index> place_;
  std::vector<Point<D>> at_, master_at_;  // per node of a side
  std::vector<Weight> row_, own_;
};

/// What each part of the slave sees; the parts do not depend on the number of threads.
template <int D, int P>
std::vector<mortar::FaceIntegrals<D, P>> integrate(const mortar::Side<D>& slave, const mortar::Creases<D>& creases,
                                                   const CoupleOptions& options, bool one_numbering, Crew* crew) {
  const mortar::Boxes<D> boxes(creases.side());
  const mortar::Planes<D> own(mortar::Creases<D>(slave, P)), planes(creases);
  std::vector<Index> all(creases.side().faces.size());
  std::iota(all.begin(), all.end(), Index{0});
  const PointTree<D> tree(boxes.middle, boxes.half, std::move(all));
  const Index faces = static_cast<Index>(slave.faces.size()) / mortar::ElementFace<D, P>::parts;
  std::vector<mortar::FaceIntegrals<D, P>> parts((static_cast<std::size_t>(faces) + faces_at_a_time - 1) /
                                                 faces_at_a_time);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    mortar::FaceIntegrator<D, P> integrator(slave, creases, own, planes, tree, options, one_numbering);
    for (std::size_t i; (i = next++) < parts.size();) {
      const auto first = static_cast<Index>(i) * faces_at_a_time;
      for (Index f = first; f < std::min(faces, first + faces_at_a_time); ++f)
        integrator.add(mortar::ElementFace<D, P>(f), parts[i]);
    }
  };
  if (crew && parts.size() > 1)
    crew->run(work);
  else
    work();
  return parts;
}

template <int D, int P>
MortarCoupling<D> couple(const mortar::Side<D>& slave, const mortar::Side<D>& master, bool one_numbering,
                         const CoupleOptions& options, Crew* crew) {
  const mortar::Creases<D> creases(master, P);
  const auto seen = integrate<D, P>(slave, creases, options, one_numbering, crew);
  MortarCoupling<D> out;
  for (const auto& part : seen) {
    if (part.deepest.depth > out.deepest.depth) out.deepest = part.deepest;
    out.lumped += part.lumped;
    out.layered += part.layered;
  }
  Gathering<D, P>(slave, creases, one_numbering, options.axisymmetric, seen).run(options, out);
  return out;
}

}  // namespace

template <int D>
MortarCoupling<D> couple(const SurfaceFaces<D>& slave, const SurfaceFaces<D>& master, const CoupleOptions& options,
                         Crew* crew) {
  check(options, slave.place);
  assert(slave.order == master.order);
  const mortar::Side<D> slave_side(slave), master_side(master);
  const bool one_numbering = slave.points.data() == master.points.data();
  return slave.order == 1 ? couple<D, 1>(slave_side, master_side, one_numbering, options, crew)
                          : couple<D, 2>(slave_side, master_side, one_numbering, options, crew);
}

template MortarCoupling<2> couple(const SurfaceFaces<2>&, const SurfaceFaces<2>&, const CoupleOptions&, Crew*);
template MortarCoupling<3> couple(const SurfaceFaces<3>&, const SurfaceFaces<3>&, const CoupleOptions&, Crew*);

}  // namespace signorini
