#include "core/fem/recovery/pressure_recovery.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/fem/conditions/fixes.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/revolution.hpp"
#include "core/fem/recovery/fit_limits.hpp"
#include "core/fem/recovery/pressed_faces.hpp"
#include "core/fem/recovery/traction_recovery.hpp"

namespace signorini {
namespace {

constexpr double scatter = 0.01;  // of a pressure: what it may be off by because samples scatter
constexpr double at_edge =
    0.3;  // of the next pressure inside is what a mean at the edge may have without any of its own
constexpr double steep = 1.05;           // from a node near the end of the other body to the next: pressures peak there
constexpr double falls = 0.5;            // from a node in contact to the next one: more is left under a punch
constexpr double most_of_square = 1e12;  // over the square at an edge, beyond it: contact ends there
constexpr double least_width = 0.4;      // of samples, over the way to the next node: two rows of them have 0.5

template <int D, int B>
class Recovery {
 public:
  Recovery(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, const PressedFaces<D, B>& faces)
      : nodes_(nodes),
        plane_(surface.plane()),
        surface_(surface),
        faces_(faces),
        samples_(nodes, surface, faces),
        square_(static_cast<std::size_t>(faces.size())),
        error_(static_cast<std::size_t>(faces.size()), infinity) {
    for (Index k = 0; k < faces.size(); ++k) {
      inside_.push_back(faces.inside(k));
      at_middle_.push_back(faces.node(k).pressure);
    }
    of_squares_ = !all_inside();
    if (nodes.order() == 2) take_off_curvature();
  }

  void fit() {
    for (Index k = 0; k < faces_.size(); ++k) {
      if (!tells(k)) continue;
      ContactNode<B>& node = faces_.node(k);
      const auto found = fitted(k);
      error_[k] = found ? found->error : infinity;
      square_[k] = found ? found->square : node.pressure * node.pressure;
      node.recovered = limited(k, std::sqrt(std::max(square_[k], 0.0)), found && found->of > rings ? found->of : 1);
      if (const double least = at_least(k); least > 0) square_[k] = std::max(square_[k], least * least);
    }
    for (Index k = 0; k < faces_.size(); ++k)
      if (faces_.pressed(k) && !tells(k)) go_on(k);
    for (Index k = 0; k < faces_.size(); ++k)
      if (!faces_.pressed(k) && !faces_.around(k).empty()) square_[k] = beyond(k);
  }

  bool resolved() const {
    const Index k = top();
    if (all_inside()) return !ends() || pressed_nodes() >= enough<D>;
    if (k != unreachable && faces_.at_kink(k) && !many_beside(k)) return false;
    const auto some = samples(k);
    return some.size() >= enough<D> && width(some) >= least_width * way_to_neighbours(k);
  }

  /// Whether there are nodes enough for a fit on either side of an edge or a tip within the contact, away from it.
  bool many_beside(Index k) const {
    const auto inside = static_cast<std::size_t>(std::ranges::count(inside_, true));
    return inside >= 1 + faces_.around(k).size() + 2 * enough<D>;
  }

  bool peaks_at_edge() const {
    const Index k = top();
    if (k == unreachable) return false;
    if (faces_.node(k).recovered > steep * largest_inside() || bears_more_at_end(faces_.node(k).recovered)) return true;
    bool near_end = faces_.at_end(k) || faces_.at_rim(k) || faces_.at_kink(k), drops = false;
    for (const Index other : faces_.around(k)) {
      if (!faces_.pressed(other)) continue;
      near_end = near_end || faces_.at_end(other) || faces_.node(other).hardly_covered();
      drops = drops || faces_.node(k).recovered > steep * faces_.node(other).recovered;
    }
    return near_end && drops;
  }

  /// As a uniform pressure has it, but for rounding, of which the largest may be anywhere.
  double largest_inside() const {
    double largest = 0;
    for (Index k = 0; k < faces_.size(); ++k)
      if (inside_[k]) largest = std::max(largest, faces_.node(k).recovered);
    return largest;
  }

  /// Whether a node that is hardly covered has a force that would be a larger pressure over half of its area.
  bool bears_more_at_end(double largest) const {
    for (Index k = 0; k < faces_.size(); ++k)
      if (faces_.pressed(k) && !tells(k) && faces_.node(k).pressure > steep * largest) return true;
    return false;
  }

  /// See RecoveredPressure.
  double error() const {
    double largest = 0, sum = 0, weight = 0;
    for (Index k = 0; k < faces_.size(); ++k) {
      if (!tells(k)) continue;
      largest = std::max(largest, faces_.node(k).recovered);
      if (!std::isfinite(error_[k])) continue;
      sum += faces_.node(k).area * error_[k];
      weight += faces_.node(k).area;
    }
    const double scale = of_squares_ ? 2 * largest * largest : largest;
    return weight > 0 && scale > 0 ? sum / (weight * scale) : infinity;
  }

  double area() const {
    double sum = 0;
    for (std::size_t f = 0; f < faces_.faces().size(); ++f) sum += positive(f);
    return sum;
  }

 private:
  /// Nodes inside the contact within some rings of neighbours.
  std::vector<typename PressedFaces<D, B>::Reached> neighbourhood(Index from, int wanted) const {
    return faces_.around(from, {wanted, most_rings, enough<D>}, [&](Index k) -> bool { return inside_[k]; });
  }

  /// Squares of pressures where the contact has an edge. Without one there is no reason for these, whose mean is above
  /// the square of the pressures' where these scatter.
  std::vector<Sample<D - 1>> samples(Index k, int wanted) const {
    return samples_.around(k, neighbourhood(k, wanted), [&](const auto& s) {
      const double pressure = inside_[k] ? at_middle_[s.node] : faces_.node(s.node).pressure;
      return of_squares_ ? pressure * pressure : pressure;
    });
  }
  std::vector<Sample<D - 1>> samples(Index k) const { return samples(k, inside_[k] ? rings : rings_beyond); }

  double square_of(double fitted) const { return of_squares_ ? fitted : fitted * std::abs(fitted); }
  double pressure_of(double fitted) const { return std::sqrt(std::max(square_of(fitted), 0.0)); }

  /// Of quadratic elements, whose forces are good enough for it: those of linear ones are too large by about as much.
  /// Away from the edge: next to it the polynomials change from node to node.
  void take_off_curvature() {
    std::vector<double> found = at_middle_;
    for (Index k = 0; k < faces_.size(); ++k)
      if (inside_[k] && std::ranges::all_of(faces_.around(k), [&](Index other) -> bool { return inside_[other]; }))
        found[k] -= curvature(k);
    at_middle_ = std::move(found);
  }

  using Place = std::array<double, D - 1>;

  /// Whether it is pressed, and says something of the pressure.
  bool tells(Index k) const { return faces_.pressed(k) && !faces_.node(k).hardly_covered(); }

  /// Whether another body ends within the contact.
  bool ends() const {
    for (Index k = 0; k < faces_.size(); ++k)
      if (faces_.pressed(k) && (faces_.at_end(k) || faces_.node(k).hardly_covered())) return true;
    return false;
  }

  std::size_t pressed_nodes() const {
    std::size_t count = 0;
    for (Index k = 0; k < faces_.size(); ++k) count += tells(k);
    return count;
  }

  /// No node is at the edge.
  bool all_inside() const {
    for (Index k = 0; k < faces_.size(); ++k)
      if (tells(k) && !inside_[k]) return false;
    return true;
  }

  /// Where the largest pressure is.
  Index top() const {
    Index out = unreachable;
    for (Index k = 0; k < faces_.size(); ++k)
      if (tells(k) && (out == unreachable || faces_.node(k).recovered > faces_.node(out).recovered)) out = k;
    return out;
  }

  double way_to_neighbours(Index k) const {
    double way = 0;
    const TangentPlane<D> plane = samples_.plane_at(k);
    for (const Index other : faces_.around(k)) {
      if (other == unreachable) continue;
      for (const double x : plane(nodes_.at(faces_.node(other).vertex))) way = std::max(way, std::abs(x));
    }
    return way;
  }

  /// Standard deviation of the places of samples, along the direction in which that is least.
  static double width(const std::vector<Sample<D - 1>>& some) {
    if constexpr (D == 2) return infinity;
    const auto n = static_cast<double>(some.size());
    Place mean{};
    for (const auto& sample : some)
      for (std::size_t i = 0; i < D - 1; ++i) mean[i] += sample.x[i] / n;
    double xx = 0, xy = 0, yy = 0;
    for (const auto& sample : some) {
      const double x = sample.x[0] - mean[0], y = sample.x[D - 2] - mean[D - 2];
      xx += x * x / n, xy += x * y / n, yy += y * y / n;
    }
    return std::sqrt(std::max(0.0, (xx + yy) / 2 - std::hypot((xx - yy) / 2, xy)));
  }

  /// By how much the mean around a node differs from the pressure at its middle, were it what is fitted to the means.
  /// Only where that bulges: pressures under a punch do not, and no polynomial follows them.
  double curvature(Index k) const {
    const auto some = samples(k);
    if (!enough_for_quadratic(some)) return 0;
    PolynomialFit<2, D - 1> fit(some);
    fit.sum_up();
    const auto pressure = [&](const Place& x) {
      const auto found = fit.at(x);
      return found ? pressure_of(found->front()) : 0;
    };
    const ContactNode<B>& node = faces_.node(k);
    const TangentPlane<D> plane = samples_.plane_at(k);
    if (!bulges(k, pressure)) return 0;
    const double more = surface_.mean(node, [&](const Point<D>& x) { return pressure(plane(x)); }) -
                        pressure(plane(samples_.middle(k)));
    const double most = (excess - 1) * node.pressure;
    return std::clamp(more, -most, most);
  }

  /// By differences over the way to the neighbours.
  template <class Pressure>
  bool bulges(Index k, const Pressure& pressure) const {
    const double way = way_to_neighbours(k);
    double sum = 0;
    for (std::size_t i = 0; i < D - 1; ++i)
      for (const double side : {-way, way}) {
        Place x{};
        x[i] = side;
        sum += pressure(x) - pressure({});
      }
    return sum < 0;
  }

  /// At the edge of a punch: the pressure is larger than at all neighbours.
  bool rises(Index k) const {
    return !inside_[k] && std::ranges::all_of(faces_.around(k), [&](Index other) {
      return !faces_.pressed(other) || faces_.node(other).pressure < faces_.node(k).pressure;
    });
  }

  /// To a node that hardly anything is in front of: what its own force says is left out, and nothing is larger there
  /// than beside it.
  void go_on(Index k) {
    ContactNode<B>& node = faces_.node(k);
    double sum = 0, least = infinity, largest = 0;
    int count = 0;
    for (const Index other : faces_.around(k)) {
      if (!faces_.pressed(other)) continue;
      const double there = faces_.node(other).recovered;
      sum += there, ++count;
      least = std::min(least, there), largest = std::max(largest, there);
    }
    if (count > 0) {
      const auto inside = fitted(k);
      const double found = inside ? std::sqrt(std::max(inside->square, 0.0)) : sum / count;
      node.recovered = std::clamp(found, least, largest);
    }
    square_[k] = node.recovered * node.recovered;
  }

  struct Fitted {
    double square;
    int of = rings;           ///< rings of neighbours
    double error = infinity;  ///< of what is fitted
  };
  std::optional<Fitted> fitted(Index k) const {
    const auto some = samples(k);
    if (inside_[k]) return fitted_to_more(k, some);
    if (some.size() < enough<D> || (tells(k) && rises(k))) return {};
    const auto found = fitted_value(some);
    return found ? std::optional(Fitted{square_of(*found)}) : std::nullopt;
  }

  /// The forces on nodes scatter where the other body's faces are larger: of several neighbourhoods the one from which
  /// the pressure is known best. They grow up to where they meet the edge, towards which pressures are no polynomials.
  std::optional<Fitted> fitted_to_more(Index k, std::vector<Sample<D - 1>> some) const {
    std::optional<Fitted> out;
    std::optional<FittedValue> best;
    for (int wanted = rings;; some = faded(samples(k, wanted), wanted)) {
      const auto here = fitted_value_and_error(some);
      if (!here) break;
      if (!best || here->error < best->error) best = here, out = {square_of(here->value), wanted, here->error};
      if (best->error <= (of_squares_ ? 2 : 1) * scatter * std::abs(best->value)) break;
      if (++wanted > most_rings || meets_edge(k, wanted)) break;
    }
    return out;
  }

  /// Samples count the less the farther off they are, to nothing in the next ring: else what scatters in waves, as
  /// forces do from face to face of the other body, is seen or not as the number of rings has it.
  static std::vector<Sample<D - 1>> faded(std::vector<Sample<D - 1>> some, int rings_of_it) {
    const auto square = [](const Place& x) { return std::inner_product(x.begin(), x.end(), x.begin(), 0.0); };
    double farthest = 0;
    for (const auto& sample : some) farthest = std::max(farthest, square(sample.x));
    const double next_ring = farthest * (1 + 1.0 / rings_of_it) * (1 + 1.0 / rings_of_it);
    for (auto& sample : some) sample.weight = std::pow(1 - square(sample.x) / next_ring, 2);
    return some;
  }

  bool meets_edge(Index k, int wanted) const {
    return std::ranges::any_of(neighbourhood(k, wanted), [&](const auto& reached) {
      return std::ranges::any_of(faces_.around(reached.node), [&](Index other) -> bool { return !inside_[other]; });
    });
  }

  /// By the means around, of as many rings as it was found from where these are more than usual.
  double limited(Index k, double pressure, int of) const {
    double least = faces_.node(k).pressure, largest = least;
    const auto add = [&](Index other) {
      const double mean = faces_.pressed(other) ? faces_.node(other).pressure : 0;
      least = std::min(least, mean);
      largest = std::max(largest, mean);
    };
    std::ranges::for_each(faces_.around(k), add);
    if (of > rings)
      for (const auto& reached : neighbourhood(k, of)) add(reached.node);
    return std::clamp(pressure, std::max(least, at_least(k)), excess * largest);
  }

  /// At the edge of a smooth contact a hat function that reaches into it by its whole width has a mean of 4/15 of the
  /// pressure at its other end. What more there is at a node is pressure of its own, however the fit goes on there.
  double at_least(Index k) const {
    double largest = 0;
    for (const Index other : faces_.around(k))
      if (faces_.pressed(other)) largest = std::max(largest, faces_.node(other).pressure);
    return faces_.node(k).pressure - at_edge * largest;
  }

  /// At a node without contact. Beside one that is hardly covered alone there is nothing to go on from.
  double beyond(Index k) const {
    double sum = 0;
    int count = 0;
    bool punched = false;
    for (const Index other : faces_.around(k))
      if (faces_.pressed(other)) sum += square_[other], ++count, punched = punched || rises(other);
    if (count == 0) return -hardly_covered_beside(k);
    const auto found = fitted(k);
    if (found && !punched && found->square <= falls * sum / count) return found->square;
    const double reach = faces_.reach(k);
    return -sum / count * std::min((1 - reach) / reach, most_of_square);
  }

  double hardly_covered_beside(Index k) const {
    double largest = 0;
    for (std::size_t f = 0; f < faces_.faces().size(); ++f)
      if (std::ranges::find(faces_.corners(f), k) != faces_.corners(f).end())
        for (const Index other : faces_.corners(f))
          if (faces_.pressed(other)) largest = std::max(largest, square_[other]);
    return largest;
  }

  /// Measure of the part of a face where the linear function with the squares at its corners is positive, as far as
  /// another body is in front of its nodes. Corners that it is not in front of do not end the contact within the face:
  /// that body does. Nor do nodes whose share is their neighbours'.
  double positive(std::size_t f) const {
    const Face<D>& face = nodes_.mesh().boundary[faces_.faces()[f]];
    std::array<double, D> value;
    double sum = 0, covered = 0;
    int pressed = 0, unknown = 0;
    bool taken = false;  // what presses at the others
    for (const Index k : faces_.corners(f)) {
      if (k == unreachable) {
        ++unknown;
        continue;
      }
      covered += faces_.node(k).covered;
      taken = taken || faces_.node(k).taken > 0;
      if (faces_.pressed(k)) sum += square_[k], ++pressed;
    }
    if (taken) covered += unknown;
    for (int c = 0; c < D; ++c) {
      const Index k = faces_.corners(f)[c];
      value[c] = k == unreachable || faces_.node(k).hardly_covered() ? sum / std::max(pressed, 1) : square_[k];
    }
    return face_measure(nodes_, faces_.faces()[f]) * part(face, value) * covered / D;
  }

  double part(const Face<D>& face, const std::array<double, D>& value) const {
    const auto plus = std::ranges::count_if(value, [](double v) { return v > 0; });
    if (plus == 0) return 0;
    if (plus == D) return mean_circumference<D>(plane_, nodes_.mesh(), face.vertices);
    const auto alone = std::ranges::find_if(value, [&](double v) { return (v > 0) == (plus == 1); });
    double corner = 1;
    for (auto other = value.begin(); other != value.end(); ++other)
      if (other != alone) corner *= *alone / (*alone - *other);
    if (plane_ == Plane::axisymmetric) {
      std::array<double, D> middle;  // of what is cut off at the corner
      middle.fill(corner / D);
      middle[alone - value.begin()] = 1 - corner / D * (D - 1);
      const double whole = mean_circumference<D>(plane_, nodes_.mesh(), face.vertices);
      corner *= circumference<D>(plane_, combine<D>(nodes_.mesh(), face.vertices, middle));
      return plus == 1 ? corner : whole - corner;
    }
    return plus == 1 ? corner : 1 - corner;
  }

  const Nodes<D>& nodes_;
  const Plane plane_;
  const ContactSurface<D, B>& surface_;
  const PressedFaces<D, B>& faces_;
  const SurfaceSamples<D, B> samples_;
  std::vector<bool> inside_;
  std::vector<double> at_middle_;  // the pressure at the middle of each node's basis function
  bool of_squares_ = true;         // are fits
  std::vector<double> square_;     // of the pressure, per node; it goes on beyond the edge
  std::vector<double> error_;      // of what is fitted, per node; infinite: not known
};

}  // namespace

template <int D, int B>
RecoveredPressure recover_pressure(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, Index obstacle,
                                   double least_force, std::vector<ContactNode<B>>& contact) {
  const PressedFaces<D, B> faces(nodes, surface, obstacle, least_force, contact);
  Recovery<D, B> recovery(nodes, surface, faces);
  recovery.fit();
  if constexpr (B > 1) recover_traction(nodes, surface, faces);
  return {recovery.area(), recovery.resolved(), recovery.peaks_at_edge(), recovery.error()};
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                        \
  template RecoveredPressure recover_pressure(const Nodes<D>&, const ContactSurface<D, B>&, Index, double, \
                                              std::vector<ContactNode<B>>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
