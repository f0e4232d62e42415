#include "core/fem/assembly/resultant.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <bit>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/across.hpp"
#include "core/mesh/mirror.hpp"

namespace signorini {
namespace {

template <int D>
using SpaceVector = Eigen::Matrix<double, D, 1>;
template <int D>
using SpaceMatrix = Eigen::Matrix<double, D, D>;

template <int D>
SpaceVector<D> vector(const Point<D>& x) {
  return Eigen::Map<const SpaceVector<D>>(x.data());
}

/// What a load acts on, on both sides of the planes of symmetry that it goes on beyond.
template <int D>
struct Extent {
  double measure = 0;
  SpaceVector<D> centroid = SpaceVector<D>::Zero();
  SpaceMatrix<D> second = SpaceMatrix<D>::Zero();  ///< moments about the centroid: integrals of (x - c) (x - c)^T
  std::vector<Mirror> across;                      ///< these planes
};

template <int D, int B>
Extent<D> extent_of(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load, bool turns) {
  Extent<D> out;
  const std::vector<Mirror>& mirrors = nodes.mesh().mirrors;
  const Planes planes = mirrors.empty() ? 0 : planes_across(nodes, load.on, model.t);
  for (std::size_t m = 0; m < mirrors.size(); ++m)
    if (planes >> m & 1u) out.across.push_back(mirrors[m]);
  integrate_load(nodes, model, load, false, [&](const auto& point) {
    out.measure += point.weight;
    out.centroid += point.weight * vector<D>(point.x);
  });
  out.centroid /= out.measure;
  for (const Mirror& mirror : out.across) out.centroid[mirror.axis] = mirror.at;
  if (turns)
    integrate_load(nodes, model, load, false, [&](const auto& point) {
      const SpaceVector<D> r = vector<D>(point.x) - out.centroid;
      out.second += point.weight * r * r.transpose();
    });
  for (const Mirror& mirror : out.across) {
    out.measure *= 2;
    const double along = 2 * out.second(mirror.axis, mirror.axis);
    out.second *= 2;
    out.second.row(mirror.axis).setZero();
    out.second.col(mirror.axis).setZero();
    out.second(mirror.axis, mirror.axis) = along;
  }
  return out;
}

[[noreturn]] void refuse_total(const std::string& origin, const Mirror& mirror, const std::string& what) {
  input_error(origin,
              fmt::format("{}, and what it acts on goes on beyond the plane of symmetry {}: the total is that of both "
                          "sides, which cancel each other there; expected 0",
                          what, plane_name(mirror)));
}

template <int D>
void check_force(const Extent<D>& extent, const std::string& origin, SpaceVector<D>& force) {
  for (const Mirror& mirror : extent.across) {
    if (std::abs(force[mirror.axis]) > rounding_of_differences * force.norm())
      refuse_total(origin, mirror,
                   fmt::format("the load has a force of {:g} along {}", force[mirror.axis], axis_name(mirror.axis)));
    force[mirror.axis] = 0;
  }
}

/// Moments are axial vectors: those along the normal of a plane are symmetric about it.
template <class Moment>
void check_moment(const std::vector<Mirror>& across, const std::string& origin, double size, Moment& moment) {
  for (const Mirror& mirror : across)
    for (Eigen::Index k = 0; k < moment.size(); ++k) {
      if (moment.size() == 3 && k == mirror.axis) continue;
      if (std::abs(moment[k]) > rounding_of_differences * size)
        refuse_total(origin, mirror,
                     fmt::format("the load has a moment of {:g} about {} through the centroid of what it acts on",
                                 moment[k], moment.size() == 3 ? axis_name(static_cast<int>(k)) : "z"));
      moment[k] = 0;
    }
}

/// r x f.
Eigen::Matrix<double, 1, 1> moment_of(const SpaceVector<2>& r, const SpaceVector<2>& f) {
  return Eigen::Matrix<double, 1, 1>(r[0] * f[1] - r[1] * f[0]);
}
SpaceVector<3> moment_of(const SpaceVector<3>& r, const SpaceVector<3>& f) { return r.cross(f); }

/// The matrix W of w x r = W r whose tractions W (x - c) have this moment.
SpaceMatrix<2> spin(const SpaceMatrix<2>& second, const Eigen::Matrix<double, 1, 1>& moment) {
  const double w = moment[0] / second.trace();
  return SpaceMatrix<2>{{0, -w}, {w, 0}};
}
SpaceMatrix<3> spin(const SpaceMatrix<3>& second, const SpaceVector<3>& moment) {
  const SpaceMatrix<3> inertia = second.trace() * SpaceMatrix<3>::Identity() - second;
  const SpaceVector<3> w = inertia.ldlt().solve(moment);
  return SpaceMatrix<3>{{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
}

/// base + W (x - c), as the field of each component.
template <int D>
void write(const SpaceVector<D>& base, const SpaceMatrix<D>& W, const SpaceVector<D>& c, Load<D>& load) {
  const std::string& origin = load.total->origin;
  for (int i = 0; i < D; ++i) {
    load.value[i] = base[i];
    if (W.row(i).isZero(0)) continue;
    const SpaceVector<D> row = W.row(i).transpose();
    load.value[i] = Field(
        [at = base[i], row, c](const Site& site) {
          double sum = at;
          for (int j = 0; j < D; ++j) sum += row[j] * (site.x[j] - c[j]);
          return sum;
        },
        fmt::format("component {} of a total", i), origin, false, false);
  }
}

}  // namespace

template <int D, int B>
Load<B> distributed(const Nodes<D>& nodes, const Model<B>& model, const Load<B>& load) {
  if (!load.total) return load;
  const Resultant<B>& total = *load.total;
  const Site now = site<D>({}, model.t);
  const Extent<D> extent = extent_of(nodes, model, load, !total.torque.empty());
  Load<B> out = load;
  if constexpr (B == 1) {
    out.value[0] = total.force[0](now) / extent.measure;
  } else {
    SpaceVector<D> force;
    for (int i = 0; i < D; ++i) force[i] = total.force[i](now);
    check_force<D>(extent, total.origin, force);
    SpaceMatrix<D> W = SpaceMatrix<D>::Zero();
    if (!total.torque.empty()) {
      const SpaceVector<D> arm =
          total.about ? SpaceVector<D>(extent.centroid - vector<D>(*total.about)) : SpaceVector<D>::Zero();
      auto moment = moment_of(arm, force);  // that of the force alone
      for (Eigen::Index k = 0; k < moment.size(); ++k)
        moment[k] = total.torque[static_cast<std::size_t>(k)](now) - moment[k];
      check_moment(extent.across, total.origin, moment.norm() + 2 * arm.norm() * force.norm(), moment);
      W = spin(extent.second, moment);
    }
    write<D>(force / extent.measure, W, extent.centroid, out);
  }
  return out;
}

#define SIGNORINI_INSTANTIATE(D, B) \
  template Load<B> distributed<D, B>(const Nodes<D>&, const Model<B>&, const Load<B>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
