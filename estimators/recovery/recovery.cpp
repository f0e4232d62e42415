// How far stresses are from smooth ones: polynomials are fitted to the stresses around each vertex, and the energy of
// what is between the two is taken for the error (Zienkiewicz and Zhu, The superconvergent patch recovery, 1992). Each
// vertex has a polynomial per material. The smooth stress has their values at vertices, at midpoints of edges the mean
// of those of the ends, and the elements' degree.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/base/pivoted_factors.hpp"
#include "core/fem/elements/polynomial_fit.hpp"
#include "core/mesh/element_map.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

constexpr double most_amplified = 5;  // errors of samples, at the vertex

/// What is summed up around a vertex, of one material, and then the polynomial that is nearest to it.
/// @tparam Degree of polynomials, that of elements
/// @tparam C components of a stress
template <int D, int Degree, int C>
struct Patch {
  using Stress = std::array<double, C>;
  static constexpr int terms = polynomial_terms(D, Degree);

  Index region;
  Index next;       ///< of the same vertex; -1: none
  int degree = -1;  ///< of the polynomial, 0 to Degree
  double samples = 0, squares = 0;
  std::array<double, terms*(terms + 1) / 2> normal{};  ///< the lower triangle of its matrix
  std::array<Stress, terms> coefficient{};             ///< the right-hand side, then the polynomial

  void add(const std::array<double, D>& x, const double* stress) {
    const auto row = monomials<Degree, D>(x);
    for (int i = 0, k = 0; i < terms; ++i) {
      for (int j = 0; j <= i; ++j) normal[k++] += row[i] * row[j];
      for (int c = 0; c < C; ++c) coefficient[i][c] += row[i] * stress[c];
    }
    ++samples;
    for (const double at : x) squares += at * at;
  }

  void fit() {
    if (Degree == 2 && fit_first<terms>())
      degree = Degree;
    else if (fit_first<D + 1>())
      degree = 1;
    else if (fit_first<1>())
      degree = 0;
  }

  Stress at(const std::array<double, D>& x) const {
    const auto row = monomials<Degree, D>(x);
    Stress out{};
    for (int i = 0; i < terms; ++i)
      for (int c = 0; c < C; ++c) out[c] += row[i] * coefficient[i][c];
    return out;
  }

 private:
  /// By that many terms, where the samples decide these.
  template <int Terms>
  bool fit_first() {
    if (samples < (Terms > 1 ? Terms + D : 1)) return false;
    const double scale = squares > 0 ? std::sqrt(samples / squares) : 1;  // so that places are of the size of one
    const auto size = [&](int term) { return term == 0 ? 1 : term <= D ? scale : scale * scale; };
    std::array<std::array<double, Terms>, Terms> H{};
    for (int i = 0, k = 0; i < Terms; ++i)
      for (int j = 0; j <= i; ++j) H[i][j] = normal[k++] * size(i) * size(j);
    const PivotedFactors<Terms> factors(H);
    if (!factors.definite(dependent_samples)) return false;
    const std::array<double, Terms> here{1};
    if (!(factors.solve(here)[0] <= most_amplified * most_amplified)) return false;
    for (int c = 0; c < C; ++c) {
      std::array<double, Terms> moments;
      for (int i = 0; i < Terms; ++i) moments[i] = coefficient[i][c] * size(i);
      const auto found = factors.solve(moments);
      for (int i = 0; i < terms; ++i) coefficient[i][c] = i < Terms ? found[i] * size(i) : 0;
    }
    return true;
  }
};

template <int D, int Degree, int C>
class Recovery {
 public:
  using Stress = std::array<double, C>;

  Recovery(const SampledStress& stress, Status& status)
      : stress_(stress), status_(status), first_(static_cast<std::size_t>(stress.vertices()), -1) {
    patches_.reserve(static_cast<std::size_t>(stress.elements()) / 2);  // in the plane there are about as many corners
  }

  void run(double* of_element) {
    each_element(StressRule::best, [&](Index) { sum_up(); });
    for (Patch<D, Degree, C>& patch : patches_) patch.fit();
    each_element(StressRule::exact, [&](Index e) { of_element[e] = error(e); });
  }

 private:
  template <class Use>
  void each_element(StressRule rule, const Use& use) {
    for (Index e = 0; e < stress_.elements() && status_.ok(); ++e) {
      stress_.read(e, rule, element_, status_);
      use(e);
    }
  }

  /// Of a vertex and the element's material; -1: there is none yet.
  Index find(Index vertex) const {
    Index k = first_[vertex];
    while (k >= 0 && patches_[k].region != element_.region) k = patches_[k].next;
    return k;
  }
  const Patch<D, Degree, C>& patch_of(Index vertex) const { return patches_[find(vertex)]; }
  Patch<D, Degree, C>& make_patch(Index vertex) {
    if (const Index found = find(vertex); found >= 0) return patches_[found];
    patches_.push_back({element_.region, first_[vertex]});
    first_[vertex] = static_cast<Index>(patches_.size()) - 1;
    return patches_.back();
  }

  std::array<double, D> seen_from(int corner, const auto& x) const {
    std::array<double, D> out;
    for (int i = 0; i < D; ++i) out[i] = x[i] - element_.at[corner][i];
    return out;
  }

  void sum_up() {
    for (int a = 0; a <= D; ++a) {
      Patch<D, Degree, C>& around = make_patch(element_.corner[a]);
      for (const StressSample& sample : samples()) around.add(seen_from(a, sample.x), sample.stress);
    }
  }

  std::span<const StressSample> samples() const { return {element_.sample, static_cast<std::size_t>(element_.count)}; }

  /// The polynomials of an element's vertices. Those whose stresses decide none of the highest degree, as at corners of
  /// the body, take the others'.
  struct Around {
    const Patch<D, Degree, C>* of[D + 1];
    int degree = 0, most = 0;  ///< the highest degree, and how many have it
  };
  Around around() const {
    Around out;
    for (int a = 0; a <= D; ++a) {
      out.of[a] = &patch_of(element_.corner[a]);
      if (out.of[a]->degree > out.degree) out.degree = out.of[a]->degree, out.most = 0;
      if (out.of[a]->degree == out.degree) ++out.most;
    }
    return out;
  }

  /// Their mean at a place in the element, each with its hat function's part.
  Stress blended(const Around& around, const std::array<double, D + 1>& barycentric) const {
    double others = 0;
    std::array<double, D> x{};
    for (int a = 0; a <= D; ++a) {
      if (around.of[a]->degree < around.degree) others += barycentric[a] / around.most;
      for (int i = 0; i < D; ++i) x[i] += barycentric[a] * element_.at[a][i];
    }
    Stress out{};
    for (int a = 0; a <= D; ++a) {
      const double part = around.of[a]->degree < around.degree ? 0 : barycentric[a] + others;
      if (part == 0) continue;
      const Stress own = around.of[a]->at(seen_from(a, x));
      for (int c = 0; c < C; ++c) out[c] += part * own[c];
    }
    return out;
  }

  /// Coefficients, see basis(), of a stress of the elements' degree that has these values at their nodes.
  std::array<Stress, element_nodes<D, Degree>> smooth() const {
    constexpr auto edges = simplex_edges<D>();
    std::array<Stress, element_nodes<D, Degree>> out;
    const Around polynomials = around();
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = blended(polynomials, node_place<D>(k));
    for (std::size_t k = D + 1; k < out.size(); ++k)
      for (int c = 0; c < C; ++c) {
        const double middle = (out[edges[k - D - 1][0]][c] + out[edges[k - D - 1][1]][c]) / 2;
        out[k][c] = middle + (out[k][c] - middle) / midpoint_weight;
      }
    return out;
  }

  double error(Index e) const {
    const auto coefficients = smooth();
    double sum = 0;
    for (const StressSample& point : samples()) {
      std::array<double, D + 1> barycentric;
      std::copy_n(point.barycentric, D + 1, barycentric.begin());
      const auto value = basis<Degree>(barycentric);
      Stress off{};
      for (int c = 0; c < C; ++c) {
        off[c] = -point.stress[c];
        for (std::size_t k = 0; k < value.size(); ++k) off[c] += value[k] * coefficients[k][c];
      }
      sum += point.weight * stress_.energy(e, point, off.data());
    }
    return sum;
  }

  const SampledStress& stress_;
  Status& status_;
  std::vector<Index> first_;  // per vertex, of patches_; -1: none
  std::vector<Patch<D, Degree, C>> patches_;
  SampledElement element_;
};

class RecoveryEstimator final : public ErrorEstimator {
 public:
  void estimate(const SampledStress& stress, double* of_element, Status& status) const noexcept override {
    sdk::guarded(status, [&] {
      if (stress.dimension() == 2)
        by_order<2>(stress, of_element, status);
      else
        by_order<3>(stress, of_element, status);
    });
  }

 private:
  template <int D>
  static void by_order(const SampledStress& stress, double* of_element, Status& status) {
    if (stress.order() == 1)
      by_components<D, 1>(stress, of_element, status);
    else
      by_components<D, 2>(stress, of_element, status);
  }
  template <int D, int Degree>
  static void by_components(const SampledStress& stress, double* of_element, Status& status) {
    if (stress.components() == D)
      Recovery<D, Degree, D>(stress, status).run(of_element);
    else
      Recovery<D, Degree, 6>(stress, status).run(of_element);
  }
};

void register_all(Registrar& registrar, Status& status) {
  registrar.estimator({"recovery",
                       "no bounds, but about how large the energy error is: how far stresses are from smooth "
                       "ones, in about a quarter of the time of the solve",
                       sdk::create_estimator<RecoveryEstimator>},
                      status);
}

}  // namespace
}  // namespace signorini

SIGNORINI_PLUGIN("recovery", "1.0.0", "energy errors by recovered stresses", signorini::register_all, "BSD-3-Clause");
