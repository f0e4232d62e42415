#include "estimators/stress_at_points.hpp"

#include <algorithm>
#include <memory>

#include "core/base/pivoted_factors.hpp"
#include "core/fem/recovery/stress_reader.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

/// The flux of a scalar solution.
template <int D, int P>
class FluxReader {
 public:
  FluxReader(const Nodes<D>& nodes, const Model<1>& model, const std::vector<double>& u, const OwnPressure<1>&)
      : nodes_(nodes), law_(model), t_(model.t), u_(u) {}

  struct Read {
    std::array<double, 6> stress;
    double measure;
  };
  Read at(std::size_t e, const ElementMap<D, D, P>& map, const std::array<double, D + 1>& barycentric) const {
    const LinearElement<D> flat = linear_element(map.flat(barycentric));
    const auto node = nodes_.of(nodes_.template elements<P>()[e]);
    const Gradient<D, 1> g = gradient<D, 1>(basis_gradients<P>(flat.gradient, barycentric), node, u_);
    const double diffusion = law_.at(site_in<D>(nodes_, e, map(barycentric), t_)).diffusion;
    Read out{{}, flat.measure};
    for (int i = 0; i < D; ++i) out.stress[i] = diffusion * g[0][i];
    return out;
  }

 private:
  const Nodes<D>& nodes_;
  const MaterialLaw<1> law_;
  const double t_;
  const std::vector<double>& u_;
};

/// The energies of stresses in a model's materials.
template <int D, int B>
class StressEnergy {
 public:
  explicit StressEnergy(const Model<B>& model)
      : law_(model), orthotropic_(model), axes_(has_plane_stress(model) ? 2 : 3) {}

  double at(const Site& where, const double* s) const {
    if (orthotropic_.acts_in(where.region)) return orthotropic(orthotropic_.at(where), s);
    const Material<B> m = law_.at(where);
    const double trace = s[0] + s[1] + s[2];
    double squares = 0;
    for (int k = 0; k < 6; ++k) squares += (k < 3 ? 1 : 2) * s[k] * s[k];
    return (squares - m.lambda / (axes_ * m.lambda + 2 * m.mu) * trace * trace) / (4 * m.mu);
  }

 private:
  static double orthotropic(const ElasticMatrix<D>& C, const double* s) {
    constexpr std::size_t N = strain_components<D>;
    std::array<std::array<double, N>, N> rows;
    StrainVector<D> stress;
    for (std::size_t i = 0; i < N; ++i) {
      stress[i] = s[i];
      for (std::size_t j = 0; j < N; ++j) rows[i][j] = C[i * N + j];
    }
    if (rows[2][2] == 0) rows[2][2] = 1;  // plane stress: there is none across
    return dot(stress, PivotedFactors<static_cast<int>(N)>(rows).solve(stress)) / 2;
  }

  const MaterialLaw<B> law_;
  const OrthotropicLaw<D> orthotropic_;
  const int axes_;
};

template <int D>
class StressEnergy<D, 1> {
 public:
  explicit StressEnergy(const Model<1>& model) : law_(model) {}
  double at(const Site& where, const double* flux) const {
    double squares = 0;
    for (int i = 0; i < D; ++i) squares += flux[i] * flux[i];
    return squares / (2 * law_.at(where).diffusion);
  }

 private:
  const MaterialLaw<1> law_;
};

template <int D, int B, int P>
class StressAtPoints final : public SampledStress {
 public:
  StressAtPoints(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                 const OwnPressure<B>& pressure)
      : nodes_(nodes), model_(model), pressure_(pressure), reader_(nodes, model, u, pressure_), energy_(model) {}

  int dimension() const noexcept override { return D; }
  int order() const noexcept override { return P; }
  int components() const noexcept override { return B == 1 ? D : 6; }
  Index vertices() const noexcept override { return nodes_.mesh().vertices(); }
  Index elements() const noexcept override { return static_cast<Index>(nodes_.template elements<P>().size()); }

  void read(Index element, StressRule rule, SampledElement& out, Status& status) const noexcept override {
    sdk::guarded(status, [&] {
      const auto e = static_cast<std::size_t>(element);
      const auto& vertices = nodes_.template elements<P>()[e];
      const ElementMap<D, D, P> map(nodes_.mesh(), vertices);
      for (int a = 0; a <= D; ++a) {
        out.corner[a] = vertices[a];
        std::ranges::copy(nodes_.mesh().points[vertices[a]], out.at[a]);
      }
      out.region = nodes_.region(e);
      sample(e, map,
             rule == StressRule::best ? stiffness_rule<D, P>(true)
             : P == 1                 ? quadrature2<D>()
                                      : quadrature5<D>(),
             out);
    });
  }

  double energy(Index element, const StressSample& where, const double* stress) const noexcept override {
    Point<D> x;
    std::copy_n(where.x, D, x.begin());
    return energy_.at(site_in<D>(nodes_, static_cast<std::size_t>(element), x, model_.t), stress);
  }

 private:
  void sample(std::size_t e, const ElementMap<D, D, P>& map, std::span<const QuadraturePoint<D>> rule,
              SampledElement& out) const {
    auto read = reader_.at(e, map, barycentre<D>());
    StressSample* to = out.sample;
    for (const auto& [barycentric, weight] : rule) {
      if (P > 1) read = reader_.at(e, map, barycentric);  // linear elements have one
      const Point<D> x = map(barycentric);
      std::ranges::copy(x, to->x);
      std::ranges::copy(barycentric, to->barycentric);
      std::ranges::copy(read.stress, to->stress);
      to->weight = weight * read.measure * circumference<D>(model_.plane, x);
      ++to;
    }
    out.count = static_cast<int>(rule.size());
  }

  using Reader = std::conditional_t<B == 1, FluxReader<D, P>, StressReader<D, P>>;

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  const OwnPressure<B> pressure_;
  const Reader reader_;
  const StressEnergy<D, B> energy_;
};

}  // namespace

template <int D, int B>
std::unique_ptr<SampledStress> stress_at_points(const Nodes<D>& nodes, const Model<B>& model,
                                                const std::vector<double>& u, const OwnPressure<B>& pressure) {
  return with_order(nodes, [&](auto order) -> std::unique_ptr<SampledStress> {
    return std::make_unique<StressAtPoints<D, B, order>>(nodes, model, u, pressure);
  });
}

#define SIGNORINI_INSTANTIATE(D, B)                                                          \
  template std::unique_ptr<SampledStress> stress_at_points(const Nodes<D>&, const Model<B>&, \
                                                           const std::vector<double>&, const OwnPressure<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
