#include "core/geometry/edges.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "core/base/dense.hpp"
#include "core/base/dot.hpp"
#include "core/geometry/groups.hpp"
#include "core/geometry/vector.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

constexpr double digits = 1e-6;         // of the size of all: what files round away
constexpr double one_plane = 1e-6;      // angle
constexpr double few_digits = 4;        // of these, where lengths and angles are compared
constexpr double kink = 0.5;            // of the angle between faces: more than that has to be left of an edge
constexpr double share = 0.25;          // of its half of the angle: less is not turning on
constexpr double alone = 0.2;           // of the angle, where one side alone is seen
constexpr double trifle = 0.05;         // of the angle at another joint
constexpr double little = 0.25;         // likewise, where it is not seen well
constexpr double straight = 1e-3;       // angle
constexpr double around_corner = 0.5;   // cosine: how far one side is looked at
constexpr double askew = 0.3;           // cosine: joints at more than that do not turn on, but aside
constexpr double behind = 0.05;         // of a face's height: what counts as on its side
constexpr double told = 1e-4;           // of the largest moment: less determines nothing
constexpr double determined = 0.999;    // of the slope
constexpr double poor = 5;              // what errors may be multiplied by
constexpr double left_out = 1.0 / 24;   // of the angle's third power: what a quadratic curve is off a circle
constexpr double deviations = 2;        // of what is left of a fit
constexpr int most_layers = 8;          // of faces,
constexpr std::size_t enough = 9;       // and vertices, that a surface is put through
constexpr std::size_t most_points = 4;  // of a section
constexpr int fewest_around = 7;        // plates around the tip of a cone

enum class Kind : std::uint8_t {
  wall,  ///< a border, or an edge by its angle alone
  flat,  ///< up to what digits round away
  open,  ///< to be told
  round,
  sharp,
};

/// Terms of a quadratic surface over its tangent plane: 1, x, x^2 / 2 (, y, x y, y^2 / 2).
template <int D>
constexpr int terms = D == 2 ? 3 : 6;
template <int D>
using Terms = Eigen::Matrix<double, terms<D>, 1>;

template <int D>
Terms<D> value(double x, double y) {
  Terms<D> out;
  out.template head<3>() << 1, x, x * x / 2;
  if constexpr (D == 3) out.template tail<3>() << y, x * y, y * y / 2;
  return out;
}

template <int D>
Terms<D> slope(double x, double y, int along) {
  Terms<D> out;
  if (along == 0)
    out.template head<3>() << 0, 1, x;
  else
    out.template head<3>().setZero();
  if constexpr (D == 3) {
    if (along == 0)
      out.template tail<3>() << 0, y, 0;
    else
      out.template tail<3>() << 1, x, y;
  }
  return out;
}

/// Weighted least squares for the slope along x, with the error that what is left lets expect.
template <int D>
class Surface {
 public:
  struct Slope {
    double value, spread, poor, left;  ///< and what errors of values are multiplied by, and the values' errors
  };
  void add(const Terms<D>& row, double value, double weight) {
    moments_ += weight * row * row.transpose();
    right_ += weight * value * row;
    squares_ += weight * value * value;
    weights_ += weight;
    ++rows_;
  }
  /// Nothing where it is not determined.
  std::optional<Slope> slope() const {
    const auto [own, directions] = eigenpairs(moments_);
    double seen = 0, slope = 0, explained = 0, spread = 0;
    int rank = 0;
    for (int k = 0; k < terms<D>; ++k) {
      if (!(own[k] > told * own[terms<D> - 1])) continue;
      const Terms<D> v = directions.col(k);
      const double part = v.dot(right_);
      seen += v[1] * v[1];
      slope += v[1] * part / own[k];
      explained += part * part / own[k];
      spread += v[1] * v[1] / own[k];
      ++rank;
    }
    if (!(seen > determined)) return {};
    const double left = std::max(squares_ - explained, 0.0);
    return Slope{slope, std::sqrt(spread), std::sqrt(spread * weights_ / rows_),
                 rows_ > rank ? std::sqrt(left / (rows_ - rank)) : 0};
  }

 private:
  Eigen::Matrix<double, terms<D>, terms<D>> moments_ = decltype(moments_)::Zero();
  Terms<D> right_ = Terms<D>::Zero();
  double squares_ = 0, weights_ = 0;
  int rows_ = 0;
};

template <int D>
double angle_between(const Point<D>& a, const Point<D>& b) {
  return 2 * std::atan2(length<D>(difference<D>(a, b)), length<D>(plus<D>(a, 1, b)));
}

/// What one side of a joint shows: by how much the surface there turns from the face to its normal at the joint, in the
/// direction that the joint turns in, and how far it is from that by the terms that a quadratic surface leaves out.
struct Turn {
  double angle = 0, error = 0;
};

struct Side {
  bool flat = false;
  std::vector<Index> next;      ///< joints across the face, as face and tip, where it may turn on
  std::vector<Index> beside;    ///< these, and the others of the face
  std::optional<Turn> section;  ///< of plane sections across the joint
  std::optional<Turn> surface;  ///< of the surface through vertices
  std::optional<Turn> fan;      ///< around a tip that the joint ends at
  bool rim = false;             ///< it ends nearby, where there are no faces any more
};

template <int D>
class EdgeFinder {
 public:
  EdgeFinder(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces, const Joints<D>& joints,
             double crease, const std::vector<std::array<Point<D>, D>>& normal)
      : points_(points), faces_(faces), joints_(joints), crease_(crease), joint_normal_(normal) {}

  Edges run() {
    measure();
    if (!joint_normal_.empty()) {
      for (Index i = 0; i < count(); ++i)
        if (kind_[i] == Kind::open) kind_[i] = turns_itself(i) ? Kind::round : Kind::sharp;
    } else {
      find_plates();
      decide();
    }
    Edges out{std::vector<std::uint8_t>(static_cast<std::size_t>(joints_.count), 0), angle_};
    for (Index i = 0; i < count(); ++i)
      if (kind_[i] == Kind::wall || kind_[i] == Kind::sharp || kind_[i] == Kind::open) out.sharp[joints_.number[i]] = 1;
    return out;
  }

 private:
  Index count() const { return static_cast<Index>(joints_.beyond.size()); }
  const Point<D>& corner(Index i, int k) const { return points_[faces_[i / D][(i + k) % D]]; }
  const Point<D>& corner_of(Index f, int k) const { return points_[faces_[f][k]]; }
  const Point<D>& tip(Index i) const { return points_[faces_[i / D][i % D]]; }
  Index end(Index i, int k) const { return faces_[i / D][(i % D + 1 + k) % D]; }
  Point<D> middle(Index i) const {
    Point<D> out{};
    for (int k = 0; k < D - 1; ++k) out = plus<D>(out, 1.0 / (D - 1), points_[end(i, k)]);
    return out;
  }

  const Point<D>& normal_at(Index i) const {
    return joint_normal_.empty() ? normal_[i / D] : joint_normal_[i / D][i % D];
  }

  void measure() {
    Point<D> low, high;
    low.fill(infinity);
    high.fill(-infinity);
    for (const auto& face : faces_) {
      Point<D> n;
      if constexpr (D == 2) {
        const Point<D> d = difference<D>(points_[face[1]], points_[face[0]]);
        n = {d[1], -d[0]};
      } else {
        n = cross(difference<D>(points_[face[1]], points_[face[0]]), difference<D>(points_[face[2]], points_[face[0]]));
      }
      const double area = length<D>(n);
      normal_.push_back(unit<D>(n));
      for (int t = 0; t < D; ++t) {
        double base = 1;
        if constexpr (D == 3) base = length<D>(difference<D>(points_[face[(t + 2) % 3]], points_[face[(t + 1) % 3]]));
        height_.push_back(area / base);
        for (int k = 0; k < D; ++k) {
          low[k] = std::min(low[k], points_[face[t]][k]);
          high[k] = std::max(high[k], points_[face[t]][k]);
        }
      }
    }
    size_ = faces_.empty() ? 0 : length<D>(difference<D>(high, low));
    angle_.assign(joints_.beyond.size(), 0);
    kind_.assign(joints_.beyond.size(), Kind::wall);
    for (Index i = 0; i < count(); ++i) {
      const Index j = joints_.beyond[i];
      if (j < 0) continue;
      angle_[i] = angle_between<D>(normal_at(i), normal_at(j));
      if (angle_[i] > crease_) continue;
      const double least = std::max(one_plane, digits * size_ / std::min(height_[i], height_[j]));
      kind_[i] = angle_[i] <= least ? Kind::flat : Kind::open;
    }
  }

  /// Of curved faces: those on both sides turn by far more than the angle between them.
  bool turns_itself(Index i) const {
    const auto turn = [&](Index at) {
      double most = 0;
      for (int k = 1; k < D; ++k)
        most = std::max(most, angle_between<D>(normal_at(at), normal_at(at / D * D + (at + k) % D)));
      return most;
    };
    return angle_[i] <= kink * (turn(i) + turn(joints_.beyond[i])) / 2;
  }

  void find_plates() {
    Groups plates(faces_.size());
    for (Index i = 0; i < count(); ++i)
      if (kind_[i] == Kind::flat) plates.join(i / D, joints_.beyond[i] / D);
    Index n = 0;
    plate_ = plates.numbered(n);
    faces_of_.resize(static_cast<std::size_t>(n));
    for (std::size_t f = 0; f < faces_.size(); ++f) faces_of_[plate_[f]].push_back(static_cast<Index>(f));
    inner_.assign(static_cast<std::size_t>(n), 0);
    free_.resize(static_cast<std::size_t>(n));
    if constexpr (D == 2) {
      for (Index p = 0; p < n; ++p) inner_[p] = faces_of_[p].size() > 1;
    } else {
      find_divided_plates();
    }
  }

  /// Vertices inside a plate, and those that divide a straight side of it where nothing goes on smoothly.
  void find_divided_plates() {
    std::vector<std::vector<Index>> corners(points_.size());
    for (Index c = 0; c < count(); ++c) corners[faces_[c / D][c % D]].push_back(c);
    struct Here {
      Index plate;
      double angle = 0;
      bool rim = false, open = false;
    };
    for (std::size_t v = 0; v < corners.size(); ++v) {
      std::vector<Here> here;
      for (const Index c : corners[v]) {
        const Index f = c / D;
        auto at = std::ranges::find(here, plate_[f], &Here::plate);
        if (at == here.end()) at = here.insert(here.end(), Here{plate_[f]});
        const Point<D> a = difference<D>(corner_of(f, (c + 1) % D), tip(c)),
                       b = difference<D>(corner_of(f, (c + 2) % D), tip(c));
        at->angle += angle_between<D>(unit<D>(a), unit<D>(b));
        for (int t = 0; t < D; ++t) {
          if (t == c % D) continue;
          const Kind kind = kind_[f * D + t];
          at->rim = at->rim || kind == Kind::wall;
          at->open = at->open || kind == Kind::open;
        }
      }
      for (const Here& h : here) {
        if (h.open) continue;
        if (!h.rim)
          inner_[h.plate] = 1;
        else if (std::abs(h.angle - std::numbers::pi) < straight)
          free_[h.plate].push_back(static_cast<Index>(v));
      }
    }
  }

  /// Whether the plate on this side of a joint is divided across it.
  bool is_flat(Index i) const {
    const Index plate = plate_[i / D];
    if (inner_[plate] != 0) return true;
    if constexpr (D == 3) {
      if (free_[plate].empty()) return false;
      const Point<D> from = middle(i), up = across(i);
      const auto over = [&](Index v) { return dot(difference<D>(points_[v], from), up); };
      double most = 0;
      for (const Index f : faces_of_[plate])
        for (const Index v : faces_[f]) most = std::max(most, over(v));
      return std::ranges::any_of(free_[plate],
                                 [&](Index v) { return over(v) > behind * most && over(v) < (1 - behind) * most; });
    }
    return false;
  }

  /// The unit direction across a joint into its face.
  Point<D> across(Index i) const {
    Point<D> out = difference<D>(tip(i), points_[end(i, 0)]);
    if constexpr (D == 3) {
      const Point<D> along = unit<D>(difference<D>(points_[end(i, 1)], points_[end(i, 0)]));
      out = plus<D>(out, -dot(out, along), along);
    }
    return unit<D>(out);
  }

  bool is_convex(Index i) const { return dot(difference<D>(tip(joints_.beyond[i]), middle(i)), normal_[i / D]) < 0; }

  bool is_wall(Index i) const { return kind_[i] == Kind::wall || kind_[i] == Kind::sharp; }

  Side look(Index i) const {
    Side side;
    if (is_flat(i)) {
      side.flat = true;
      side.section = side.surface = Turn{};
      return side;
    }
    const double sign = is_convex(i) ? 1 : -1;
    if constexpr (D == 2) {
      side.section = turn_of_section(i, middle(i), {}, side.next);
    } else {
      const Point<D>&a = points_[end(i, 0)], &b = points_[end(i, 1)];
      const Point<D> along = unit<D>(difference<D>(b, a));
      int found = 0;
      Turn sum;
      for (const double part : {0.2, 0.47, 0.8})
        if (const auto turn = turn_of_section(i, plus<D>(a, part, difference<D>(b, a)), along, side.next)) {
          ++found;
          sum.angle += turn->angle;
          sum.error += turn->error;
        }
      if (found > 0) side.section = Turn{sum.angle / found, sum.error / found};
    }
    if (side.section) side.section->angle *= sign;
    if constexpr (D == 3)
      if (const auto fan = fan_of(i); fan && fan->plates >= fewest_around)
        side.fan = Turn{sign * fan->turn.angle, fan->turn.error};
    side.beside = side.next;
    for (int t = 0; t < D && !side.next.empty(); ++t)
      if (t != i % D) side.beside.push_back(i / D * D + t);
    return side;
  }

  void look_farther(Index i, Side& side) const {
    if (D == 2 || side.flat || side.next.empty()) return;
    side.surface = turn_of_surface(i, side.rim);
    if (side.surface && !is_convex(i)) side.surface->angle *= -1;
  }

  /// The way across a face from a point of a joint, straight on in the plane across the joint: where it meets joints.
  /// @param along the direction of the joint
  /// @param next the first one of these that is more or less parallel to where it began
  std::optional<Turn> turn_of_section(Index i, const Point<D>& from, const Point<D>& along,
                                      std::vector<Index>& next) const {
    const Point<D> x = across(i), z = normal_[i / D];
    std::vector<Point<2>> row{{0, 0}};
    std::optional<double> end_slope;
    double turned = 0;
    bool any = false;
    std::size_t most_steps = faces_of_[plate_[i / D]].size() + 4;
    for (std::size_t step = 0; step < most_steps && row.size() < most_points; ++step) {
      const Index out = way_out(i, from, along);
      const Index other = joints_.beyond[out];
      if (kind_[out] != Kind::flat) {
        const Point<D> off = difference<D>(meeting(out, from, along), from);
        row.push_back({dot(off, x), dot(off, z)});
        if (is_wall(out)) break;
        if (!any && (D == 2 || std::abs(dot(across(out), x)) > askew)) {
          next.push_back(out);
          any = true;
        }
        const Point<D>& n = normal_[other / D];
        const double up = dot(n, z);
        if (up < around_corner) break;
        turned = std::max(turned, angle_between<D>(n, z));
        if (is_flat(other)) {
          end_slope = -dot(n, x) / up;
          break;
        }
        most_steps += faces_of_[plate_[other / D]].size();
      }
      i = other;
    }
    if (row.size() + (end_slope ? 1 : 0) < 3 || !any) return {};
    Surface<2> curve;
    const double h = row.back()[0], first = row[1][0];
    for (const Point<2>& p : row) {
      const double near = std::max(p[0], first / 2) / first;
      curve.add(value<2>(p[0] / h, 0), p[1], 1 / (near * near));
    }
    if (end_slope) curve.add(slope<2>(1, 0, 0), *end_slope * h, first * first / (h * h));
    const auto found = curve.slope();
    if (!found) return {};
    return Turn{std::atan(found->value / h), error_of(turned)};
  }

  static double error_of(double turned) { return left_out * turned * turned * turned; }

  /// Plates all around an end of a joint.
  struct Fan {
    std::ptrdiff_t plates = 0;
    bool to_rim = true;  ///< they end where the surface does, or at a flat part
    Turn turn;  ///< straight sections run into ever wider plates; the circle turns by as much as these are wide at the
                ///< tip
  };

  std::optional<Fan> fan_of(Index i) const {
    for (int k = 0; k < D - 1; ++k) {
      const Index tip = end(i, k);
      Fan fan;
      std::vector<double> width{0}, angle;  // of plates, and at the joints behind them
      Index in = i;
      do {
        const Index f = in / D, at = static_cast<Index>(std::ranges::find(faces_[f], tip) - faces_[f].begin());
        const Index out = D * f + (3 - at - in % D), rim = D * f + at;
        const auto towards = [&](Index j) { return unit<D>(difference<D>(points_[faces_[f][j]], points_[tip])); };
        width.back() += angle_between<D>(towards(in % D), towards(out % D));
        fan.to_rim = fan.to_rim && (is_wall(rim) || is_flat(joints_.beyond[rim]));
        in = joints_.beyond[out];
        if (is_wall(out)) break;
        if (kind_[out] == Kind::flat || in == i) continue;
        angle.push_back(is_convex(out) ? angle_[out] : -angle_[out]);
        width.push_back(0);
      } while (in != i);
      if (in != i || angle.empty()) continue;
      fan.plates = std::ssize(width);
      fan.turn = {angle[0] * width[0] / (width[0] + width[1]), error_of(angle[0])};
      return fan;
    }
    return {};
  }

  /// The joint where a plane leaves a face that it has come into through another one.
  Index way_out(Index i, const Point<D>& from, const Point<D>& along) const {
    if constexpr (D == 2) return i / D * D + (i + 1) % D;
    const auto side = [&](const Point<D>& p) { return dot(difference<D>(p, from), along); };
    const Index f = i / D, b = (i + 1) % D;  // one end of the joint, the other one is next
    return f * D + (side(tip(i)) * side(corner_of(f, static_cast<int>(b))) > 0 ? b : (b + 1) % D);
  }

  Point<D> meeting(Index i, const Point<D>& from, const Point<D>& along) const {
    if constexpr (D == 2) return points_[end(i, 0)];
    const Point<D>&a = points_[end(i, 0)], &b = points_[end(i, D - 2)];
    const double u = dot(difference<D>(a, from), along), v = dot(difference<D>(b, from), along);
    return plus<D>(a, u == v ? 0.5 : std::clamp(u / (u - v), 0.0, 1.0), difference<D>(b, a));
  }

  /// From the face to the tangent, at the middle of a joint, of the surface on the face's side.
  std::optional<Turn> turn_of_surface(Index i, bool& rim) const {
    const Index first = i / D;
    const Point<D> from = middle(i), x = across(i), z = normal_[first];
    Point<D> y{};
    if constexpr (D == 3) y = cross(z, x);
    const double h = height_[i];
    std::vector<Index> faces{first}, vertices(faces_[first].begin(), faces_[first].end());
    struct Tangent {
      Index vertex;
      Point<D> normal;
    };
    std::vector<Tangent> tangents;
    const auto ahead = [&](Index f) {
      return std::ranges::all_of(faces_[f],
                                 [&](Index v) { return dot(difference<D>(points_[v], from), x) >= -behind * h; });
    };
    std::size_t begin = 0;
    double turned = 0;
    for (int layer = 0; layer < most_layers; ++layer) {
      const std::size_t last = faces.size();
      for (; begin < last; ++begin)
        for (int t = 0; t < D; ++t) {
          const Index at = faces[begin] * D + t, other = joints_.beyond[at];
          rim = rim || other < 0;
          if (at == i || is_wall(at)) continue;
          const Index g = other / D;
          if (std::ranges::find(faces, g) != faces.end() || dot(normal_[g], z) < around_corner) continue;
          if (kind_[at] != Kind::flat && is_flat(other)) {
            for (int k = 0; k < D - 1; ++k) tangents.push_back({end(at, k), normal_[g]});
            continue;
          }
          if (!ahead(g)) continue;
          faces.push_back(g);
          turned = std::max(turned, angle_between<D>(normal_[g], z));
          for (const Index v : faces_[g])
            if (std::ranges::find(vertices, v) == vertices.end()) vertices.push_back(v);
        }
      const bool all = begin == faces.size();
      if (vertices.size() < enough && !all) continue;
      const auto weight = [&](const Point<D>& p) {
        const double near = std::max(length<D>(p), h / 2) / h;
        return 1 / (near * near);
      };
      double hx = 0, hy = 0, all_weights = 0;  // about the extent of what counts
      for (const Index v : vertices) {
        const Point<D> p = difference<D>(points_[v], from);
        hx += weight(p) * dot(p, x) * dot(p, x);
        hy += weight(p) * dot(p, y) * dot(p, y);
        all_weights += weight(p);
      }
      hx = std::sqrt(hx / all_weights);
      hy = hy > 0 ? std::sqrt(hy / all_weights) : 1;
      Surface<D> surface;
      for (const Index v : vertices) {
        const Point<D> p = difference<D>(points_[v], from);
        surface.add(value<D>(dot(p, x) / hx, dot(p, y) / hy), dot(p, z), weight(p));
      }
      for (const auto& [v, n] : tangents) {
        const Point<D> p = difference<D>(points_[v], from);
        const double px = dot(p, x) / hx, py = dot(p, y) / hy, nz = dot(n, z);
        surface.add(slope<D>(px, py, 0), -dot(n, x) / nz * hx, weight(p));
        if constexpr (D == 3) surface.add(slope<D>(px, py, 1), -dot(n, y) / nz * hy, weight(p));
      }
      if (const auto found = surface.slope(); found && found->poor * h < poor * hx)
        return Turn{std::atan(found->value / hx),
                    found->spread * (error_of(turned) * std::max(hx, hy) + deviations * found->left) / hx};
      if (all) break;
    }
    return {};
  }

  bool is_of_pyramid(Index i) const {
    if constexpr (D == 2) return false;
    const auto fan = fan_of(i);
    return fan && fan->to_rim && fan->plates < fewest_around;
  }

  struct Open {
    Index joint;
    std::array<Side, 2> sides;
  };

  /// Largest angles first: what they part is not looked at together any more.
  void decide() {
    std::vector<Index> order;
    for (Index i = 0; i < count(); ++i)
      if (kind_[i] == Kind::open && joints_.beyond[i] > i) order.push_back(i);
    std::ranges::stable_sort(order, [&](Index i, Index j) { return angle_[i] > angle_[j]; });
    std::vector<Index> of_pyramids;
    std::ranges::copy_if(order, std::back_inserter(of_pyramids), [&](Index i) { return is_of_pyramid(i); });
    for (const Index i : of_pyramids) set(i, Kind::sharp);
    std::vector<Open> open;
    for (const Index i : order) {
      if (kind_[i] != Kind::open) continue;
      if (is_trifle(i, trifle)) {
        set(i, Kind::round);
        continue;
      }
      Open here{i, {look(i), look(joints_.beyond[i])}};
      for (const bool farther : {false, true}) {
        if (kind_[i] != Kind::open) break;
        if (farther) {
          look_farther(i, here.sides[0]);
          look_farther(joints_.beyond[i], here.sides[1]);
        }
        if (turns_on(angle_[i], here.sides)) set(i, Kind::round);
      }
      if (kind_[i] != Kind::open) continue;
      if (is_sharp(angle_[i], here.sides))
        set(i, Kind::sharp);
      else
        open.push_back(std::move(here));
    }
    for (bool more = true; more;) {
      more = false;
      for (const Open& here : open)
        if (kind_[here.joint] == Kind::open &&
            (is_trifle(here.joint, little) || goes_on(angle_[here.joint], here.sides))) {
          set(here.joint, Kind::round);
          more = true;
        }
    }
    for (const Open& one : open)
      for (const Open& other : open)
        if (one.joint < other.joint && are_regular(one, other))
          set(one.joint, Kind::round), set(other.joint, Kind::round);
  }

  /// Two joints across one face, with nothing that turns on beyond: three faces of the same height at the same angle,
  /// but for digits, are those of a round, as those of a whole polygon are.
  bool are_regular(const Open& one, const Open& other) const {
    const auto leads_to = [](const Open& from, int side, Index joint) {
      const auto& next = from.sides[side].next;  // of three sections in space
      return !next.empty() && std::ranges::count(next, joint) == std::ssize(next);
    };
    const auto ends = [](const Side& side) { return !side.flat && side.next.empty(); };
    for (const int a : {0, 1})
      for (const int b : {0, 1}) {
        const Index i = a == 0 ? one.joint : joints_.beyond[one.joint],
                    j = b == 0 ? other.joint : joints_.beyond[other.joint];
        if (!leads_to(one, a, j) || !leads_to(other, b, i) || !ends(one.sides[1 - a]) || !ends(other.sides[1 - b]))
          continue;
        const double least = few_digits * digits * size_, h = height_[i];
        const auto same = [&](Index at) { return std::abs(height_[at] - h) <= least; };
        return is_convex(i) == is_convex(j) && same(j) && same(joints_.beyond[i]) && same(joints_.beyond[j]) &&
               std::abs(angle_[i] - angle_[j]) <= least / h;
      }
    return false;
  }

  /// Less than this part of what one of the faces turns by at another joint, a round one.
  bool is_trifle(Index i, double part) const {
    for (const Index at : {i, joints_.beyond[i]})
      for (int t = 0; t < D; ++t)
        if (const Index other = at / D * D + t; kind_[other] == Kind::round && part * angle_[other] > angle_[i])
          return true;
    return false;
  }

  void set(Index i, Kind kind) { kind_[i] = kind_[joints_.beyond[i]] = kind; }

  static constexpr std::array ways{&Side::section, &Side::surface, &Side::fan};

  static bool is_round(double angle, const Turn& a, const Turn& b) {
    const double left = angle - a.angle - b.angle;
    return left <= kink * angle ||
           std::abs(left) <= std::max(kink * (std::abs(a.angle) + std::abs(b.angle)), a.error + b.error);
  }

  /// Both sides turn on like the joint.
  static bool turns_on(double angle, const std::array<Side, 2>& sides) {
    return std::ranges::any_of(ways, [&](auto way) {
      const auto own = [&](const Side& s) { return !s.flat && s.*way && (s.*way)->angle >= share * angle / 2; };
      return own(sides[0]) && own(sides[1]) && is_round(angle, *(sides[0].*way), *(sides[1].*way));
    });
  }

  /// Both sides are seen, and say that they do not. Sections of triangles that lie anyhow have kinks of their own.
  static bool is_sharp(double angle, const std::array<Side, 2>& sides) {
    const auto round = [&](auto way) {
      return sides[0].*way && sides[1].*way && is_round(angle, *(sides[0].*way), *(sides[1].*way));
    };
    constexpr auto last = D == 2 ? &Side::section : &Side::surface;
    return sides[0].*last && sides[1].*last && std::ranges::none_of(ways, round);
  }

  /// The largest angle of round joints across a face.
  double most_of(const Side& side) const {
    double most = 0;
    for (const Index i : side.next)
      if (kind_[i] == Kind::round) most = std::max(most, angle_[i]);
    return most;
  }

  /// What is round on one side goes on across the joint.
  bool goes_on(double angle, const std::array<Side, 2>& sides) const {
    for (int k = 0; k < 2; ++k) {
      const Side &here = sides[k], &there = sides[1 - k];
      if (std::ranges::none_of(here.beside, [&](Index i) { return kind_[i] == Kind::round; })) continue;
      if (D == 3 && (here.surface || here.rim) && (there.surface || there.rim) && !(here.surface && there.surface) &&
          most_of(there) > 0 && most_of(here) + most_of(there) >= kink * angle)
        return true;
      for (const auto way : ways) {
        if (!(here.*way) || (way == &Side::section && here.surface && D == 3)) continue;
        const Turn& turn = *(here.*way);
        if (there.*way
                ? is_round(angle, turn, *(there.*way))
                : turn.angle + turn.error >= alone * angle || angle <= std::max(std::abs(turn.angle), turn.error))
          return true;
      }
    }
    return false;
  }
  std::span<const Point<D>> points_;
  const std::vector<std::array<Index, D>>& faces_;
  const Joints<D>& joints_;
  double crease_, size_ = 0;
  const std::vector<std::array<Point<D>, D>>& joint_normal_;
  std::vector<Point<D>> normal_;
  std::vector<double> height_, angle_;  // per face and tip
  std::vector<Kind> kind_;              // likewise
  std::vector<Index> plate_;            // per face
  std::vector<std::vector<Index>> faces_of_, free_;
  std::vector<std::uint8_t> inner_;
};

}  // namespace

template <int D>
Edges find_edges(std::span<const Point<D>> points, const std::vector<std::array<Index, D>>& faces,
                 const Joints<D>& joints, double crease, const std::vector<std::array<Point<D>, D>>& normal) {
  return EdgeFinder<D>(points, faces, joints, crease, normal).run();
}

template Edges find_edges<2>(std::span<const Point<2>>, const std::vector<std::array<Index, 2>>&, const Joints<2>&,
                             double, const std::vector<std::array<Point<2>, 2>>&);
template Edges find_edges<3>(std::span<const Point<3>>, const std::vector<std::array<Index, 3>>&, const Joints<3>&,
                             double, const std::vector<std::array<Point<3>, 3>>&);

}  // namespace signorini::geometry
