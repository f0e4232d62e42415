#include "estimators/certificate/contact_interface.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "core/base/dot.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/pairs/added_gap.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/mortar/boxes.hpp"
#include "core/mortar/segments.hpp"
#include "estimators/certificate/friction_laws.hpp"

namespace signorini {
namespace {

/// Of one: barycentric coordinates, parts of a normal, and heights over the size of the body are zero up to that.
constexpr double flat = 1e-9;
/// As deep as bodies overlap, twice, and a bit.
constexpr double along_normal = 2;

template <int D>
class InterfaceFinder {
 public:
  InterfaceFinder(const Mesh<D>& mesh, const Model<D>& model, const ObstacleTerm<D>& term)
      : mesh_(mesh), model_(model), term_(term), faces_(paired_faces(mesh, term, model.t)) {
    Point<D> low = mesh.points.front(), high = low;
    for (const Point<D>& x : mesh.points)
      for (int i = 0; i < D; ++i) low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
    size_ = length<D>(difference<D>(high, low));
  }

  ContactInterface<D> find(Reasons& reasons) {
    const auto of_slave = corners(faces_.slave), of_master = corners(faces_.master);
    const mortar::Side<D> slave(SurfaceFaces<D>{mesh_.points, of_slave, term_.origin});
    const mortar::Side<D> master(SurfaceFaces<D>{mesh_.points, of_master, term_.origin});
    const mortar::Planes<D> own(mortar::Creases<D>(slave, 1)), planes(mortar::Creases<D>(master, 1));
    const mortar::Boxes<D> boxes(master);
    std::vector<Index> all(of_master.size());
    std::iota(all.begin(), all.end(), Index{0});
    const PointTree<D> tree(boxes.middle, boxes.half, std::move(all));
    CoupleOptions options{.pairing = Pairing::normal, .reach = size_};
    if (const auto overlap = overlap_of_sides<D>(mesh_, term_, faces_, model_.t, mesh_.points))
      options.depth = along_normal * overlap->depth + flat * size_;
    mortar::SegmentFinder<D> finder(slave, master, own, planes, tree, options, true);
    ContactInterface<D> out;
    for (Index f = 0; f < static_cast<Index>(of_slave.size()); ++f)
      if (finder.find(f))
        for (const mortar::Segment<D>& segment : finder.segments()) {
          check_flat(slave, f, master, segment.master);
          add(finder.frame(), segment, f, out);
        }
    out.normal = normal_;
    if (term_.obstacle->friction()) find_laws(out, reasons);
    if (out.pieces.empty())
      reasons.refuse(fmt::format("{}: no faces of the bodies are opposite to each other", term_.origin));
    if (!is_flat_)
      reasons.refuse(
          fmt::format("bodies that touch along faces ({}) that are not in one plane each, parallel to "
                      "each other, are not covered",
                      term_.origin));
    if (!gap_is_linear_)
      reasons.add(
          fmt::format("the gap ({}) is not linear between nodes: its interpolation takes its place", term_.origin));
    return out;
  }

 private:
  std::vector<std::array<Index, D>> corners(const std::vector<Index>& faces) const {
    std::vector<std::array<Index, D>> out;
    out.reserve(faces.size());
    for (const Index f : faces) out.push_back(mesh_.boundary[f].vertices);
    return out;
  }

  /// Against the first faces.
  void check_flat(const mortar::Side<D>& slave, Index f, const mortar::Side<D>& master, Index g) {
    if (first_) {
      first_ = false;
      normal_ = slave.normal[f];
      slave_height_ = dot(normal_, slave.corner[f][0]);
      master_height_ = dot(normal_, master.corner[g][0]);
    }
    for (int i = 0; i < D; ++i)
      is_flat_ = is_flat_ && std::fabs(slave.normal[f][i] - normal_[i]) <= flat &&
                 std::fabs(master.normal[g][i] + normal_[i]) <= flat &&
                 std::fabs(dot(normal_, slave.corner[f][i]) - slave_height_) <= flat * size_ &&
                 std::fabs(dot(normal_, master.corner[g][i]) - master_height_) <= flat * size_;
    is_flat_ = is_flat_ && mesh_.boundary[faces_.slave[f]].curve < 0 && mesh_.boundary[faces_.master[g]].curve < 0;
  }

  void add(const mortar::FaceFrame<D>& frame, const mortar::Segment<D>& segment, Index f, ContactInterface<D>& out) {
    const Index slave = faces_.slave[f], master = faces_.master[segment.master];
    const std::array<double, D> added = added_at(slave);
    mortar::each_simplex(segment.piece, [&](const std::array<Point<D - 1>, D>& simplex) {
      FacingPiece<D> piece{slave, master, {}, {}, {}, 0};
      piece.measure = std::fabs(mortar::signed_measure<D - 1>(simplex)) * std::pow(frame.size, D - 1);
      for (int c = 0; c < D; ++c) {
        const auto at_slave = coordinates(frame.shape, simplex[c]), at_master = coordinates(segment.shape, simplex[c]);
        const double distance = master_height_ - slave_height_;
        piece.gap[c] = std::fabs(distance) <= term_.adjust ? 0 : distance;
        for (int i = 0; i < D; ++i) piece.gap[c] += at_slave[i] * added[i];
        piece.on_slave[c] = by_number(slave, at_slave);
        piece.on_master[c] = by_number(master, at_master);
      }
      out.pieces.push_back(piece);
    });
  }

  /// What is within rounding of an edge or a corner is there.
  static std::array<double, D> coordinates(const std::array<mortar::Affine<D - 1>, D>& shape, const Point<D - 1>& y) {
    std::array<double, D> out;
    double sum = 0;
    for (int i = 0; i < D; ++i) {
      const double value = shape[i](y);
      out[i] = value < flat ? 0 : value > 1 - flat ? 1 : value;
      sum += out[i];
    }
    for (double& c : out) c /= sum;
    return out;
  }

  /// In the order of face_vertices().
  std::array<double, D> by_number(Index face, const std::array<double, D>& at) const {
    const auto& vertices = mesh_.boundary[face].vertices;
    const auto ascending = sorted(vertices);
    std::array<double, D> out;
    for (int i = 0; i < D; ++i) out[std::ranges::find(ascending, vertices[i]) - ascending.begin()] = at[i];
    return out;
  }

  /// What the obstacle adds to the distance, at the corners of a face of the slave.
  std::array<double, D> added_at(Index face) {
    const auto& v = mesh_.boundary[face].vertices;
    std::array<double, D> out;
    for (int i = 0; i < D; ++i) out[i] = added_gap<D>(term_, mesh_.points[v[i]], normal_);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < i; ++j) {
        const double there = added_gap<D>(term_, midpoint<D>(mesh_.points[v[i]], mesh_.points[v[j]]), normal_);
        gap_is_linear_ = gap_is_linear_ && std::fabs(there - (out[i] + out[j]) / 2) <= same_value * size_;
      }
    return out;
  }

  void find_laws(ContactInterface<D>& out, Reasons& reasons) const {
    out.law.resize(mesh_.points.size());
    for (const Index face : faces_.slave) {
      const auto& v = mesh_.boundary[face].vertices;
      for (const Index p : v) out.law[p] = law_at(mesh_.points[p]);
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < i; ++j)
          check_linear(out.law[v[i]], out.law[v[j]], law_at(midpoint<D>(mesh_.points[v[i]], mesh_.points[v[j]])),
                       term_.origin, reasons);
    }
    if (std::ranges::any_of(out.law, [](const FrictionLaw& law) { return law.coefficient > 0; }))
      tell_frozen(term_.origin, reasons);
  }
  FrictionLaw law_at(const Point<D>& place) const {
    return law_of(*term_.obstacle, asked_between<D>(term_, place, normal_));
  }

  const Mesh<D>& mesh_;
  const Model<D>& model_;
  const ObstacleTerm<D>& term_;
  const PairedFaces faces_;
  double size_;
  bool first_ = true, is_flat_ = true, gap_is_linear_ = true;
  Point<D> normal_{};
  double slave_height_ = 0, master_height_ = 0;
};

}  // namespace

template <int D>
ContactInterface<D> contact_interface(const Mesh<D>& mesh, const Model<D>& model, const ObstacleTerm<D>& term,
                                      Reasons& reasons) {
  return InterfaceFinder<D>(mesh, model, term).find(reasons);
}

template ContactInterface<2> contact_interface(const Mesh<2>&, const Model<2>&, const ObstacleTerm<2>&, Reasons&);
template ContactInterface<3> contact_interface(const Mesh<3>&, const Model<3>&, const ObstacleTerm<3>&, Reasons&);

}  // namespace signorini
