#include "estimators/certificate/face_moments.hpp"

#include <cmath>

#include "estimators/certificate/small_solve.hpp"

namespace signorini {
namespace {

/// Of the flux itself: means of both sides, and what is given where something is.
template <int D, int B>
class Targets {
 public:
  Targets(const TrueProblem<D, B>& problem, const ContactForces<D, B>& contact, FaceNumbers& moments)
      : problem_(problem), contact_(contact), moments_(moments) {}

  void add(Index e, const std::array<Gradient<D, B>, D + 1>& flux) {
    const LinearElement<D>& element = problem_.element[e];
    const auto rank = ranks<D>(problem_.mesh.elements[e]);
    for (int k = 0; k <= D; ++k) {
      const Index face = problem_.incidence.face[Offset{e} * (D + 1) + k];
      const auto& sides = problem_.incidence.sides[face];
      const double sign = sides.element[0] == e ? 1 : -1, part = sides.outer() ? 1 : 0.5;
      Gradient<D, B> sum{};
      for (int a = 0; a <= D; ++a)
        if (a != k) signorini::add(1, flux[a], sum);
      // The normal, as long as the face is large, is -D |T| grad phi_k; int_F phi_a phi_b = |F| (1 + [a = b]) / (D (D +
      // 1)).
      const double factor = -sign * part * element.measure / (D + 1);
      for (int a = 0; a <= D; ++a) {
        if (a == k) continue;
        Gradient<D, B> of_vertex = sum;
        signorini::add(1, flux[a], of_vertex);
        const auto t = applied(of_vertex, element.gradient[k]);
        double* m = at<D, B>(moments_, face, place_on_face(rank, k, a));
        for (int i = 0; i < B; ++i) m[i] += factor * t[i];
      }
    }
  }

  /// Of the faces where the mesh ends: along fixed directions it stays.
  void take_given() {
    for (std::size_t n = 0; n < problem_.outer.size(); ++n) {
      const OuterFace<D, B>& outer = problem_.outer[n];
      for (int k = 0; k < D; ++k) {
        std::array<double, B> change = outer.load[k];
        double* m = at<D, B>(moments_, outer.face, k);
        for (int i = 0; i < B; ++i) change[i] += (contact_.on_face.empty() ? 0 : contact_.on_face[n][k][i]) - m[i];
        project(outer.fixed, change);
        for (int i = 0; i < B; ++i) m[i] += change[i];
      }
    }
  }

 private:
  const TrueProblem<D, B>& problem_;
  const ContactForces<D, B>& contact_;
  FaceNumbers& moments_;
};

/// The elements around one vertex, and the least change of moments that balances each.
template <int D, int B>
class VertexPatch {
 public:
  VertexPatch(const TrueProblem<D, B>& problem, const std::vector<std::array<std::array<double, B>, D + 1>>& residuals,
              FaceNumbers& moments)
      : problem_(problem),
        residuals_(residuals),
        moments_(moments),
        number_(static_cast<std::size_t>(problem.elements()), -1) {}

  void balance(Index vertex) {
    gather(vertex);
    divide_residual();
    mixed_ = std::ranges::any_of(faces_, [](const Around& f) { return f.outer && f.outer->fixed.count < B; });
    if (mixed_)
      solve<B>();
    else
      solve<1>();
    change();
    for (const Index e : elements_) number_[e] = -1;
  }

 private:
  /// A face at the vertex that may carry more: between two elements, or where the solution is prescribed.
  struct Around {
    Index first, second;  // elements of the patch; -1: none
    const OuterFace<D, B>* outer;
    double measure;
    double* moment;
  };

  void gather(Index vertex) {
    const Incidence<D>& incidence = problem_.incidence;
    elements_.assign(incidence.at_vertex.begin() + incidence.first_at_vertex[vertex],
                     incidence.at_vertex.begin() + incidence.first_at_vertex[vertex + 1]);
    for (std::size_t n = 0; n < elements_.size(); ++n) number_[elements_[n]] = static_cast<Index>(n);
    right_.assign(elements_.size() * B, 0);
    faces_.clear();
    for (std::size_t n = 0; n < elements_.size(); ++n) {
      const Index e = elements_[n];
      const Simplex<D>& v = problem_.mesh.elements[e];
      const int a = static_cast<int>(std::ranges::find(v, vertex) - v.begin());
      for (int i = 0; i < B; ++i) right_[n * B + static_cast<std::size_t>(i)] = residuals_[e][a][i];
      const auto rank = ranks<D>(v);
      for (int k = 0; k <= D; ++k)
        if (k != a) gather_face(static_cast<Index>(n), e, k, place_on_face(rank, k, a));
    }
  }

  void gather_face(Index n, Index e, int k, int place) {
    const Index face = problem_.incidence.face[Offset{e} * (D + 1) + k];
    const auto& sides = problem_.incidence.sides[face];
    const bool first = sides.element[0] == e;
    double* m = at<D, B>(moments_, face, place);
    for (int i = 0; i < B; ++i) right_[Offset{n} * B + i] -= first ? m[i] : -m[i];
    if (!first) return;
    const LinearElement<D>& element = problem_.element[e];
    const double measure = D * element.measure * length<D>(element.gradient[k]);
    if (!sides.outer())
      faces_.push_back({n, number_[sides.element[1]], nullptr, measure, m});
    else if (const auto& outer = problem_.outer[problem_.outer_of_face[face]]; !outer.open())
      faces_.push_back({n, -1, &outer, measure, m});
  }

  /// Equally among the elements, in the directions in which no face carries it.
  void divide_residual() {
    FixedDirections<B> carried;
    for (const Around& face : faces_)
      for (int k = 0; face.outer && k < face.outer->fixed.count; ++k) carried.add(face.outer->fixed.direction[k], 0, 0);
    std::array<double, B> mean{};
    for (std::size_t n = 0; n < elements_.size(); ++n)
      for (int i = 0; i < B; ++i) mean[i] += right_[n * B + i] / static_cast<double>(elements_.size());
    project(carried, mean);
    for (std::size_t n = 0; n < elements_.size(); ++n)
      for (int i = 0; i < B; ++i) right_[n * B + i] -= mean[i];
  }

  /// The Laplacian for K components at once: L y = right, a change of |F| (y_first - y_second) through F.
  template <int K>
  void solve() {
    const std::size_t size = elements_.size() * K;
    matrix_.assign(size * size, 0);
    for (const Around& face : faces_)
      for (int i = 0; i < K; ++i)
        for (int j = 0; j < K; ++j) add_entry<K>(face, i, j, size);
    factorise(size);
    for (int c = 0; c < (K == 1 ? B : 1); ++c) substitute(size, c, K == 1 ? B : 1);
  }

  template <int K>
  void add_entry(const Around& face, int i, int j, std::size_t size) {
    double weight = i == j ? face.measure : 0;
    if (face.outer && K > 1) {
      weight = 0;
      for (int k = 0; k < face.outer->fixed.count; ++k)
        weight += face.measure * face.outer->fixed.direction[k][i] * face.outer->fixed.direction[k][j];
    }
    const auto entry = [&](Index n, Index m) -> double& {
      return matrix_[(static_cast<std::size_t>(n) * K + i) * size + static_cast<std::size_t>(m) * K + j];
    };
    entry(face.first, face.first) += weight;
    if (face.second < 0) return;
    entry(face.second, face.second) += weight;
    entry(face.first, face.second) -= weight;
    entry(face.second, face.first) -= weight;
  }

  /// L = U' D U in place; a pivot that is rounding, of a constant that nothing holds, becomes infinite.
  void factorise(std::size_t size) {
    constexpr double nothing = 1e-11;
    for (std::size_t k = 0; k < size; ++k) {
      double* row = matrix_.data() + k * size;
      double whole = row[k];
      for (std::size_t m = 0; m < k; ++m) {
        const double* other = matrix_.data() + m * size;
        const double factor = other[k] / other[m];
        if (factor == 0) continue;
        for (std::size_t j = k; j < size; ++j) row[j] -= factor * other[j];
      }
      if (row[k] <= nothing * whole) row[k] = infinity;
    }
  }

  void substitute(std::size_t size, int from, int stride) {
    const auto x = [&](std::size_t k) -> double& { return right_[k * static_cast<std::size_t>(stride) + from]; };
    for (std::size_t k = 0; k < size; ++k) {
      const double* row = matrix_.data() + k * size;
      const double part = x(k) / row[k];
      for (std::size_t j = k + 1; j < size; ++j) x(j) -= row[j] * part;
    }
    for (std::size_t k = size; k-- > 0;) {
      const double* row = matrix_.data() + k * size;
      double sum = x(k);
      for (std::size_t j = k + 1; j < size; ++j) sum -= row[j] * x(j);
      x(k) = sum / row[k];
    }
  }

  void change() {
    for (const Around& face : faces_) {
      std::array<double, B> by;
      for (int i = 0; i < B; ++i) {
        by[i] = right_[Offset{face.first} * B + i];
        if (face.second >= 0) by[i] -= right_[Offset{face.second} * B + i];
      }
      if (face.outer && face.outer->fixed.count < B) {  // along its fixed directions only
        std::array<double, B> free = by;
        project(face.outer->fixed, free);
        for (int i = 0; i < B; ++i) by[i] -= free[i];
      }
      for (int i = 0; i < B; ++i) face.moment[i] += face.measure * by[i];
    }
  }

  const TrueProblem<D, B>& problem_;
  const std::vector<std::array<std::array<double, B>, D + 1>>& residuals_;
  FaceNumbers& moments_;
  std::vector<Index> number_;  // of each element in the patch
  std::vector<Index> elements_;
  std::vector<Around> faces_;
  std::vector<double> right_, matrix_;
  bool mixed_ = false;
};

}  // namespace

template <int D, int B>
FaceNumbers equilibrated_moments(const TrueProblem<D, B>& problem, const ElementFlux<D, B>& flux,
                                 const ContactForces<D, B>& contact) {
  FaceNumbers moments(static_cast<std::size_t>(problem.incidence.faces()) * D * B);
  std::vector<std::array<std::array<double, B>, D + 1>> residuals;
  residuals.reserve(problem.element.size());
  Targets<D, B> targets(problem, contact, moments);
  for (Index e = 0; e < problem.elements(); ++e) {
    const auto s = flux(e);
    targets.add(e, s);
    residuals.push_back(element_residuals<D, B>(problem, e, s, contact));
  }
  targets.take_given();
  VertexPatch<D, B> patch(problem, residuals, moments);
  for (Index p = 0; p < problem.mesh.vertices(); ++p) patch.balance(p);
  return moments;
}

template <int D, int B>
void moments_to_values(FaceNumbers& numbers) {
  const std::size_t faces = numbers.size() / (D * B);
  for (std::size_t f = 0; f < faces; ++f)
    for (int i = 0; i < B; ++i) {
      double* m = numbers.data() + f * D * B + i;
      double sum = 0;
      for (int k = 0; k < D; ++k) sum += m[k * B];
      for (int k = 0; k < D; ++k) m[k * B] = D * (D + 1) * (m[k * B] - sum / (D + 1));
    }
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                   \
  template FaceNumbers equilibrated_moments<D, B>(const TrueProblem<D, B>&, const ElementFlux<D, B>&, \
                                                  const ContactForces<D, B>&);                        \
  template void moments_to_values<D, B>(FaceNumbers&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
