#include <algorithm>
#include <span>
#include <utility>

#include "core/base/pivoted_factors.hpp"
#include "core/fem/elements/polynomial_fit.hpp"
#include "core/fem/recovery/stress_reader.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

constexpr int most_layers = 5;        // of elements around a node
constexpr double most_amplified = 5;  // errors of samples
constexpr Offset unknown = -1;

/// The elements around each node.
template <int D, int P>
class ElementsAround {
 public:
  explicit ElementsAround(const Nodes<D>& nodes) : nodes_(nodes), first_(nodes.size() + std::size_t{1}) {
    const auto& elements = nodes.template elements<P>();
    for (const auto& vertices : elements)
      for (const Index p : nodes.of(vertices)) ++first_[p + std::size_t{1}];
    for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
    element_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<Offset> next(first_.begin(), first_.end() - 1);
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (const Index p : nodes.of(elements[e])) element_[next[p]++] = static_cast<Index>(e);
  }

  std::span<const Index> at(Index p) const {
    return std::span(element_).subspan(first_[p], first_[p + std::size_t{1}] - first_[p]);
  }

 private:
  const Nodes<D>& nodes_;
  std::vector<Offset> first_;
  std::vector<Index> element_;
};

/// Numbers of which each is added once.
class Collection {
 public:
  explicit Collection(std::size_t most) : added_(most) {}
  void clear() {
    for (const Index k : numbers_) added_[k] = false;
    numbers_.clear();
  }
  /// Returns whether it was not there.
  bool add(Index k) {
    if (std::exchange(added_[k], true)) return false;
    numbers_.push_back(k);
    return true;
  }
  Index operator[](std::size_t k) const { return numbers_[k]; }
  std::size_t size() const { return numbers_.size(); }
  auto begin() const { return numbers_.begin(); }
  auto end() const { return numbers_.end(); }

 private:
  std::vector<char> added_;
  std::vector<Index> numbers_;
};

template <int D, int P>
class StressRecovery {
 public:
  StressRecovery(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u,
                 const OwnPressure<D>& pressure)
      : nodes_(nodes),
        elements_(nodes.template elements<P>()),
        reader_(nodes, model, u, pressure),
        around_(nodes),
        boundary_(nodes.size()),
        between_materials_(nodes.size()),
        mirrors_(nodes.mesh().mirrors),
        mirrored_(nodes.size()),
        first_neighbour_(nodes.size(), unknown),
        patch_(elements_.size()),
        near_nodes_(nodes.size()),
        grown_nodes_(nodes.size()),
        beside_(nodes.size()) {
    if (P == 2) {  // linear elements are asked in their order, and seldom again
      samples_.reserve(elements_.size() * points().size());
      for (std::size_t e = 0; e < elements_.size(); ++e) add_samples(e, samples_);
    }
    for (const Face<D>& face : nodes.mesh().boundary)
      for (const Index p : nodes.of(face.vertices)) boundary_[p] = true;
    if (model.plane == Plane::axisymmetric) mirrors_.push_back({.axis = 0, .at = 0});
    for (const Mirror& mirror : mirrors_)
      for (Index p = 0; p < nodes.size(); ++p)
        if (lies_on<D>(mirror, nodes.at(p))) mirrored_[p] = true;
    for (Index p = 0; p < nodes.size(); ++p)
      for (const Index e : around_.at(p))
        if (nodes.region(e) != nodes.region(around_.at(p).front())) boundary_[p] = between_materials_[p] = true;
  }

  /// Per node. Linear elements have no points where stresses are better than elsewhere, but what makes them worse
  /// cancels around a node inside whose patch is its own image in it. The fits of the others start from there: first of
  /// those inside, then of those on the boundary.
  std::vector<Stress> run() {
    recovered_.resize(nodes_.size());
    find_midpoints();
    find_regular();
    if constexpr (P == 1) fit_own();
    const auto each = [this](const auto& chosen) {
      for (Index p = 0; p < nodes_.size(); ++p)
        if (!is_midpoint(p) && chosen(p)) recovered_[p] = at(p);
    };
    if (P == 2) each([this](Index p) { return own_[p]; });
    each([this](Index p) { return !boundary_[p] && !own_[p]; });
    each([this](Index p) { return boundary_[p]; });
    for (Index p = 0; p < nodes_.size(); ++p)
      if (is_midpoint(p)) recovered_[p] = seen_[p] == 2 ? mean_of_ends(p) : at(p);
    return std::move(recovered_);
  }

 private:
  static std::span<const QuadraturePoint<D>> points() { return stiffness_rule<D, P>(true); }

  bool is_midpoint(Index p) const { return P == 2 && nodes_.ends(p)[0] != nodes_.ends(p)[1]; }

  /// Of each vertex the midpoints of its edges: there its polynomial is asked, too (Zienkiewicz and Zhu, Int. J. Numer.
  /// Methods Eng. 33, 1992).
  void find_midpoints() {
    if (P == 1) return;
    first_midpoint_.assign(nodes_.size() + std::size_t{1}, 0);
    seen_.assign(nodes_.size(), 0);
    const auto each_end = [this](const auto& use) {
      for (Index p = 0; p < nodes_.size(); ++p)
        for (int k = 0; k < 2 && is_midpoint(p); ++k) use(p, nodes_.ends(p)[k]);
    };
    each_end([this](Index, Index end) { ++first_midpoint_[end + std::size_t{1}]; });
    for (std::size_t p = 1; p < first_midpoint_.size(); ++p) first_midpoint_[p] += first_midpoint_[p - 1];
    midpoint_.resize(static_cast<std::size_t>(first_midpoint_.back()));
    std::vector<Offset> next(first_midpoint_.begin(), first_midpoint_.end() - 1);
    each_end([&](Index p, Index end) { midpoint_[next[end]++] = p; });
  }

  /// Those inside, on no plane of symmetry nor the axis, with linear elements in a patch that is its own image in them.
  /// In space other nodes have stresses as good as those of these, but beside planes of symmetry.
  void find_regular() {
    inner_.resize(nodes_.size());
    regular_.resize(nodes_.size());
    own_.resize(nodes_.size());
    for (Index p = 0; p < nodes_.size(); ++p) {
      inner_[p] = !boundary_[p];
      const bool usual = inner_[p] && !mirrored_[p];
      regular_[p] = usual && (P == 2 || (needs_regular() && is_own_image(p)));
      own_[p] = regular_[p] || (usual && D == 3 && !is_beside_mirror(p));
    }
  }

  /// Whether some nodes may take theirs from regular ones.
  bool needs_regular() const { return P == 1 && (D == 2 || !mirrors_.empty()); }

  /// Nodes that share elements with this one, of linear elements. Until it is asked again.
  std::span<const Index> neighbours(Index p) {
    Offset& first = first_neighbour_[p];
    if (first == unknown) {
      beside_.clear();
      for (const Index e : around_.at(p))
        for (const Index q : nodes_.of(elements_[e]))
          if (q != p) beside_.add(q);
      first = std::ssize(neighbour_);
      neighbour_.push_back(static_cast<Index>(beside_.size()));
      neighbour_.insert(neighbour_.end(), beside_.begin(), beside_.end());
    }
    return std::span(neighbour_)
        .subspan(static_cast<std::size_t>(first) + 1, static_cast<std::size_t>(neighbour_[first]));
  }

  /// Of one that is on none.
  bool is_beside_mirror(Index p) {
    if (mirrors_.empty()) return false;
    return std::ranges::any_of(neighbours(p), [this](Index q) { return mirrored_[q]; });
  }

  bool is_own_image(Index p) {
    constexpr double same = 0.1;  // of the way to a neighbour; where refinement follows a curve it is a part of h
    const auto around = neighbours(p);
    return std::ranges::all_of(around, [&](Index q) {
      const Point<D> there = difference<D>(nodes_.at(q), nodes_.at(p));
      return std::ranges::any_of(around, [&](Index other) {
        Point<D> off = difference<D>(nodes_.at(other), nodes_.at(p));
        for (int i = 0; i < D; ++i) off[i] += there[i];
        return dot<D>(off, off) <= same * same * dot<D>(there, there);
      });
    });
  }

  /// Adds what a vertex's polynomial is at the midpoints of its edges.
  void add_at_midpoints(Index vertex, const PolynomialFit<2, D, 6>& fit) {
    for (Offset k = first_midpoint_[vertex]; k < first_midpoint_[vertex + std::size_t{1}]; ++k) {
      const Index p = midpoint_[k];
      const auto found = fit.at(difference<D>(nodes_.at(p), nodes_.at(vertex)), most_amplified);
      if (!found) continue;
      ++seen_[p];
      for (int i = 0; i < 6; ++i) recovered_[p][i] += (*found)[i];
    }
  }

  Stress mean_of_ends(Index p) const {
    Stress out = recovered_[p];
    for (double& s : out) s /= 2;
    return out;
  }

  Stress at(Index p) {
    const auto elements = around_.at(p);
    if (elements.empty()) return {};
    if (!boundary_[p])
      if (const auto found = P == 2 && own_[p] ? inside(p) : from_regular(p)) return *found;
    Stress sum{};
    int materials = 0;
    for (auto first = elements.begin(); first != elements.end(); ++first) {
      const auto same = [&](Index e) { return nodes_.region(e) == nodes_.region(*first); };
      if (std::any_of(elements.begin(), first, same)) continue;
      patch_.clear();
      for (const Index e : elements)
        if (same(e)) patch_.add(e);
      const Stress s = of_patch(p);
      for (int k = 0; k < 6; ++k) sum[k] += s[k];
      ++materials;
    }
    for (double& s : sum) s /= materials;
    return sum;
  }

  /// Of linear elements those that take it from their own: sums over elements, which are asked twice in the order that
  /// they lie in memory, whose nodes lie beside each other, too. Where these decide nothing nodes are left to others.
  void fit_own() {
    constexpr int terms = D + 1;
    std::vector<std::array<double, terms*(terms + 1) / 2>> sums(own_.size());  // then the first `terms` are the weights
    for (const auto& vertices : elements_)
      each_own(vertices, [&](Index p, const std::array<double, terms>& row) {
        for (int i = 0, k = 0; i < terms; ++i)
          for (int j = 0; j <= i; ++j) sums[p][k++] += row[i] * row[j];
      });
    for (Index p = 0; p < nodes_.size(); ++p)
      if (own_[p]) own_[p] = find_weights<terms>(sums[p]);
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const Stress here = reader_.at(e, ElementMap<D, D, P>(nodes_.mesh(), elements_[e]), barycentre<D>()).stress;
      each_own(elements_[e], [&](Index p, const std::array<double, terms>& row) {
        double weight = 0;
        for (int i = 0; i < terms; ++i) weight += sums[p][i] * row[i];
        for (int k = 0; k < 6; ++k) recovered_[p][k] += weight * here[k];
      });
    }
  }

  /// Calls use(p, terms of a linear polynomial at the centroid, seen from there) for nodes of an element.
  template <class Use>
  void each_own(const Simplex<D>& vertices, const Use& use) const {
    const Point<D> middle = centroid<D>(nodes_.mesh(), vertices);
    for (const Index p : nodes_.of(vertices))
      if (own_[p]) use(p, monomials<1, D>(difference<D>(middle, nodes_.at(p))));
  }

  /// Of samples around a node, for the value there, in place of the lower triangle of their normal matrix.
  /// @return whether they decide it
  template <int Terms, std::size_t N>
  static bool find_weights(std::array<double, N>& sums) {
    const double count = sums[0];
    double squares = 0;
    for (int i = 1, k = 2; i < Terms; k += ++i + 1) squares += sums[k];
    if (count < Terms + D || !(squares > 0)) return false;
    const double scale = std::sqrt(count / squares);
    std::array<std::array<double, Terms>, Terms> H{};
    for (int i = 0, k = 0; i < Terms; ++i)
      for (int j = 0; j <= i; ++j) H[i][j] = sums[k++] * (i > 0 ? scale : 1) * (j > 0 ? scale : 1);
    const PivotedFactors<Terms> factors(H);
    std::array<double, Terms> here{1};
    const auto weights = factors.solve(here);
    if (!factors.definite(dependent_samples) || !(weights[0] <= most_amplified * most_amplified)) return false;
    for (int i = 0; i < Terms; ++i) sums[i] = weights[i] * (i > 0 ? scale : 1);
    return true;
  }

  /// The usual case, without a patch that may grow: of one material, on no plane of symmetry nor the axis.
  std::optional<Stress> inside(Index p) {
    const std::size_t count = points().size();
    const Point<D>& origin = nodes_.at(p);
    near_.clear();
    for (const Index e : around_.at(p))
      for (std::size_t q = 0; q < count; ++q) {
        near_.push_back(samples_[e * count + q]);
        for (int i = 0; i < D; ++i) near_.back().x[i] -= origin[i];
      }
    return fit<P>(p);
  }

  /// From regular nodes around it, where these have it between them, so that their errors do not grow; else from those
  /// farther away as well: what makes the stresses of its own elements worse would spread to the boundary from there.
  std::optional<Stress> from_regular(Index p) {
    if (P == 2) return {};
    near_nodes_.clear();
    near_nodes_.add(p);
    std::size_t first = 0;
    for (int ring = 0; ring < 2; ++ring) add_ring(first);
    for (const double amplified : {1.0, most_amplified}) {
      if (amplified > 1) add_ring(first);
      near_.clear();
      for (const Index q : near_nodes_)
        if (regular_[q]) near_.push_back({nodes_.at(q), recovered_[q]});
      if (const auto found = fitted<2>(p, amplified)) return found;
    }
    return {};
  }

  /// Of nodes that share elements with those from `first` on, which becomes the first one of the ring; not across the
  /// boundary, nor to another material.
  void add_ring(std::size_t& first) {
    const std::size_t last = near_nodes_.size();
    for (; first < last; ++first)
      if (const Index p = near_nodes_[first]; !boundary_[p])
        for (const Index q : neighbours(p)) near_nodes_.add(q);
  }

  Stress of_patch(Index p) {
    if constexpr (P == 1)
      if (boundary_[p]) return from_inside(p);
    const bool outermost = boundary_[p];
    start_layers();
    if (outermost) add_layer();
    for (int layer = outermost ? 2 : 1; layer <= most_layers; ++layer, add_layer()) {
      add_elements();
      if (const auto found = outermost ? fitted<2>(p) : fitted<P>(p)) return *found;
    }
    return roughly(p);
  }

  /// Of the elements in the patch.
  Stress roughly(Index p) {
    add_elements();
    return fitted<1>(p).value_or(mean());
  }

  /// Of linear elements a node at the boundary: from nodes inside, of the same material as the patch.
  Stress from_inside(Index p) {
    near_nodes_.clear();
    for (const Index e : patch_)
      for (const Index q : nodes_.of(elements_[e])) near_nodes_.add(q);
    std::size_t first = 0;
    for (int layer = 2; layer <= most_layers; ++layer) {
      add_ring_of(nodes_.region(patch_[0]), first);
      near_.clear();
      for (const Index q : near_nodes_)
        if (inner_[q]) near_.push_back({nodes_.at(q), recovered_[q]});
      if (const auto found = fitted<2>(p)) return *found;
    }
    start_layers();
    for (int layer = 1; layer <= most_layers; ++layer) add_layer();
    return roughly(p);
  }

  /// As add_ring(), along and across what bounds a material, but not out of it.
  void add_ring_of(Index region, std::size_t& first) {
    for (const std::size_t last = near_nodes_.size(); first < last; ++first) {
      const Index p = near_nodes_[first];
      if (!between_materials_[p]) {
        for (const Index q : neighbours(p)) near_nodes_.add(q);
        continue;
      }
      for (const Index e : around_.at(p))
        if (nodes_.region(e) == region)
          for (const Index q : nodes_.of(elements_[e])) near_nodes_.add(q);
    }
  }

  void start_layers() {
    grown_ = 0;
    grown_nodes_.clear();
  }

  /// Of elements of the same material.
  void add_layer() {
    for (const std::size_t last = patch_.size(); grown_ < last; ++grown_)
      for (const Index p : nodes_.of(elements_[patch_[grown_]])) {
        if (!grown_nodes_.add(p)) continue;
        for (const Index e : around_.at(p))
          if (nodes_.region(e) == nodes_.region(patch_[0])) patch_.add(e);
      }
  }

  void add_elements() {
    near_.clear();
    const std::size_t count = points().size();
    for (const Index e : patch_) {
      if (P == 1) {
        add_samples(e, near_);
        continue;
      }
      const auto first = samples_.begin() + static_cast<Offset>(e * count);
      near_.insert(near_.end(), first, first + static_cast<Offset>(count));
    }
  }

  void add_samples(std::size_t e, std::vector<Sample<D, 6>>& samples) const {
    const ElementMap<D, D, P> map(nodes_.mesh(), elements_[e]);
    for (const auto& q : points()) samples.push_back({map(q.barycentric), reader_.at(e, map, q.barycentric).stress});
  }

  /// Of a node on planes of symmetry the samples beyond them. The axis of a body of revolution is such a plane of its
  /// meridian: there, too, stresses are even functions of the distance, and shear is odd.
  void add_images(Index p) {
    constexpr int shear[3][2] = {{3, 5}, {3, 4}, {4, 5}};  // those that change their sign
    for (const Mirror& mirror : mirrors_) {
      if (!lies_on<D>(mirror, nodes_.at(p))) continue;
      for (std::size_t k = 0, count = near_.size(); k < count; ++k) {
        if (lies_on<D>(mirror, near_[k].x)) continue;
        Sample<D, 6> image = near_[k];
        image.x = reflected<D>(mirror, image.x);
        for (const int s : shear[mirror.axis]) image.value[s] = -image.value[s];
        near_.push_back(image);
      }
    }
  }

  template <int Degree>
  std::optional<Stress> fitted(Index p, double amplified = most_amplified) {
    add_images(p);
    for (auto& sample : near_)
      for (int i = 0; i < D; ++i) sample.x[i] -= nodes_.at(p)[i];
    return fit<Degree>(p, amplified);
  }

  /// Of what is near, seen from the node.
  template <int Degree>
  std::optional<Stress> fit(Index p, double amplified = most_amplified) {
    if (near_.size() < polynomial_terms(D, Degree) + std::size_t{D}) return {};
    PolynomialFit<Degree, D, 6> fit(near_);
    const auto found = fit.at({}, amplified);
    if constexpr (P == 2 && Degree == 2)
      if (found && !is_midpoint(p) && !between_materials_[p]) {
        fit.sum_up();
        add_at_midpoints(p, fit);
      }
    return found;
  }

  Stress mean() const {
    Stress sum{};
    for (const auto& sample : near_)
      for (int k = 0; k < 6; ++k) sum[k] += sample.value[k] / static_cast<double>(near_.size());
    return sum;
  }

  const Nodes<D>& nodes_;
  const std::vector<std::array<Index, element_nodes<D, P>>>& elements_;
  const StressReader<D, P> reader_;
  const ElementsAround<D, P> around_;
  std::vector<Sample<D, 6>> samples_;               // of all elements, where these are quadratic
  std::vector<char> boundary_, between_materials_;  // per node; the latter ones are on the boundary, too
  std::vector<Mirror> mirrors_;                     // the axis of a body of revolution among them
  std::vector<char> mirrored_;                      // per node: whether it lies on one
  std::vector<char> inner_, regular_;               // per node: not on the boundary; see find_regular()
  std::vector<char> own_;                           // likewise: takes its stress from its own elements
  std::vector<Offset> first_neighbour_;             // per node that was asked for: in neighbour_
  std::vector<Index> neighbour_;                    // how many share elements with it, and these
  std::vector<Offset> first_midpoint_;              // per node, one more: in midpoint_
  std::vector<Index> midpoint_;                     // of edges, by their ends
  std::vector<char> seen_;                          // per midpoint: by how many of its ends' polynomials
  std::vector<Stress> recovered_;                   // per node
  Collection patch_, near_nodes_, grown_nodes_;     // elements around a node, and nodes of these
  Collection beside_;                               // see neighbours()
  std::size_t grown_ = 0;                           // elements of the patch with all those around them
  std::vector<Sample<D, 6>> near_;
};

}  // namespace

template <int D>
std::vector<Stress> nodal_stress(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u,
                                 const OwnPressure<D>& pressure) {
  std::vector<Stress> out(nodes.mesh().points.size());
  with_order(nodes, [&](auto order) {
    const std::vector<Stress> recovered = StressRecovery<D, order>(nodes, model, u, pressure).run();
    for (Index v = 0; v < nodes.mesh().vertices(); ++v) out[v] = recovered[nodes.of_vertex(v)];
  });
  return out;
}

template std::vector<Stress> nodal_stress(const Nodes<2>&, const Model<2>&, const std::vector<double>&,
                                          const OwnPressure<2>&);
template std::vector<Stress> nodal_stress(const Nodes<3>&, const Model<3>&, const std::vector<double>&,
                                          const OwnPressure<3>&);

}  // namespace signorini
