#include "core/fem/pairs/rigid_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/simplex.hpp"
#include "core/sdk/block.hpp"

namespace signorini {
namespace {

template <int D>
using Block = std::array<double, D * D>;

template <int D>
Block<D> identity() {
  Block<D> out{};
  for (int i = 0; i < D; ++i) out[i * (D + 1)] = 1;
  return out;
}

/// theta x r as a function of the second carrier's unknown, `length` times theta.
template <int D>
Block<D> turning(const Point<D>& r, double length) {
  if constexpr (D == 2)
    return {-r[1] / length, 0, r[0] / length, 0};
  else
    return {0, r[2] / length, -r[1] / length, -r[2] / length, 0, r[0] / length, r[1] / length, -r[0] / length, 0};
}

/// How displacements of the carriers and their unknowns depend on each other.
template <int D>
class Carriers {
 public:
  /// @param arm of the carriers from the point
  Carriers(const std::array<Point<D>, 3>& arm, double length) {
    Matrix motion = Matrix::Zero();
    for (int c = 0; c < D; ++c) {
      put(identity<D>(), c, 0, motion);
      put(turning<D>(arm[c], length), c, 1, motion);
    }
    add_rest(arm, motion);
    const Matrix inverse = motion.inverse();
    for (int c = 0; c < D; ++c)
      for (int k = 0; k < D; ++k) {
        basis_[c][k] = cut(motion, c, k);
        inverse_[c][k] = cut(inverse, c, k);
      }
  }

  /// Of the c-th carrier's displacement and the k-th one's unknown; and of its unknown and that one's displacement.
  const Block<D>& basis(int c, int k) const { return basis_[c][k]; }
  const Block<D>& inverse(int c, int k) const { return inverse_[c][k]; }

 private:
  using Matrix = Eigen::Matrix<double, D * D, D * D>;

  static void put(const Block<D>& M, int c, int k, Matrix& out) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) out(c * D + i, k * D + j) += M[i * D + j];
  }

  static Block<D> cut(const Matrix& from, int c, int k) {
    Block<D> out;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        const double value = from(c * D + i, k * D + j);
        out[i * D + j] = std::abs(value) > rounding_of_differences ? value : 0;
      }
    return out;
  }

  /// Unknowns that are left: how the carriers' distances from each other change.
  static void add_rest(const std::array<Point<D>, 3>& arm, Matrix& motion) {
    Point<D> along = difference<D>(arm[1], arm[0]);
    normalise(along);
    if constexpr (D == 2) {
      for (int i = 0; i < D; ++i) motion(D + i, D + 1) = along[i];
    } else {
      Point<D> across = difference<D>(arm[2], arm[0]);
      const double part = dot(across, along);
      for (int i = 0; i < D; ++i) across[i] -= part * along[i];
      normalise(across);
      for (int i = 0; i < D; ++i) {
        motion(D + i, 2 * D) = along[i];
        motion(2 * D + i, 2 * D + 1) = along[i];
        motion(2 * D + i, 2 * D + 2) = across[i];
      }
    }
  }

  std::array<std::array<Block<D>, D>, D> basis_, inverse_;
};

/// One part on one mesh.
template <int D>
class OnePart {
 public:
  OnePart(const Nodes<D>& nodes, const Model<D>& model, const RigidPart<D>& part)
      : nodes_(nodes),
        surface_(surface(nodes, select_faces(nodes.mesh(), part.on, model.t))),
        axial_(model.plane == Plane::axisymmetric) {
    out_.nodes = surface_.nodes;
    find_point(part);
    find_carriers();
  }

  RigidNodes<D> add_to(JumpBuilder<D>& jumps) const {
    if (axial_)
      add_axial(jumps);
    else
      add(jumps);
    return out_;
  }

 private:
  Point<D> arm(Index p) const { return difference<D>(nodes_.control_point(p), out_.point); }

  void find_point(const RigidPart<D>& part) {
    if (part.point) {
      out_.point = *part.point;
      return;
    }
    if (axial_) return;
    // That of the coarsest mesh's faces: all meshes have to agree on it.
    double all = 0;
    for (const std::array<Index, D>& corners : coarsest_faces()) {
      std::array<Point<D>, D> x;
      for (int i = 0; i < D; ++i) x[i] = nodes_.mesh().points[corners[i]];
      const double measure = length<D>(area_normal(x));
      all += measure;
      for (int i = 0; i < D; ++i)
        for (const Point<D>& corner : x) out_.point[i] += measure / D * corner[i];
    }
    for (double& c : out_.point) c /= all;
  }

  std::vector<std::array<Index, D>> coarsest_faces() const {
    const Mesh<D>& mesh = nodes_.mesh();
    const Index children = faces_per_coarsest(mesh);
    std::vector<Index> coarsest;
    for (const Index f : surface_.faces) coarsest.push_back(f / children);
    coarsest.erase(std::unique(coarsest.begin(), coarsest.end()), coarsest.end());
    std::vector<std::array<Index, D>> out;
    for (const Index f : coarsest) out.push_back(coarsest_face(mesh, f));
    return out;
  }

  /// Far from each other, so that rounding is small: each the corner of coarsest faces that is farthest off those
  /// before it, of several the first one by coordinates.
  void find_carriers() {
    std::vector<Point<D>> places;
    for (const auto& corners : coarsest_faces())
      for (const Index v : corners) places.push_back(nodes_.mesh().points[v]);
    std::ranges::sort(places);
    out_.length = 0;
    for (const Point<D>& x : places) out_.length = std::max(out_.length, length<D>(difference<D>(x, out_.point)));
    std::vector<Point<D>> chosen{places.front()};
    for (int c = 1; c < (axial_ ? 1 : D); ++c)
      chosen.push_back(
          *std::ranges::max_element(places, {}, [&](const Point<D>& x) { return rounded(distance_off(x, chosen)); }));
    for (std::size_t c = 0; c < chosen.size(); ++c)
      out_.carriers[c] = *std::ranges::find_if(out_.nodes, [&](Index p) { return nodes_.at(p) == chosen[c]; });
  }

  /// Places that are equally far but for rounding are so exactly.
  double rounded(double distance) const {
    constexpr double steps = 1e6;
    return std::round(distance / out_.length * steps);
  }

  static double distance_off(const Point<D>& x, const std::vector<Point<D>>& chosen) {
    Point<D> d = difference<D>(x, chosen[0]);
    if (chosen.size() > 1) {
      Point<D> along = difference<D>(chosen[1], chosen[0]);
      normalise(along);
      const double part = dot(d, along);
      for (int i = 0; i < D; ++i) d[i] -= part * along[i];
    }
    return length<D>(d);
  }

  bool is_carrier(Index p) const { return std::ranges::find(out_.carriers, p) != out_.carriers.end(); }

  static bool is_zero(const Block<D>& M) {
    return std::ranges::all_of(M, [](double m) { return m == 0; });
  }

  void add(JumpBuilder<D>& jumps) const {
    std::array<Point<D>, 3> arms{};
    for (int c = 0; c < D; ++c) arms[c] = arm(out_.carriers[c]);
    const Carriers<D> carriers(arms, out_.length);
    for (int c = 0; c < D; ++c) {
      BlockRow<D> basis, inverse;
      for (int k = 0; k < D; ++k) {
        if (!is_zero(carriers.basis(c, k))) basis[out_.carriers[k]] = carriers.basis(c, k);
        if (!is_zero(carriers.inverse(c, k))) inverse[out_.carriers[k]] = carriers.inverse(c, k);
      }
      jumps.add(out_.carriers[c], std::move(basis), std::move(inverse));
    }
    for (const Index p : out_.nodes)
      if (!is_carrier(p)) add(p, carriers, jumps);
  }

  void add(Index p, const Carriers<D>& carriers, JumpBuilder<D>& jumps) const {
    const Block<D> turn = turning<D>(arm(p), out_.length);
    BlockRow<D> basis, inverse;
    basis[p] = inverse[p] = identity<D>();
    basis[out_.carriers[0]] = identity<D>();
    basis[out_.carriers[1]] = turn;
    for (int k = 0; k < D; ++k) {
      Block<D>& off = inverse[out_.carriers[k]];
      Block<D> turned;
      block::multiply<D>(turn.data(), carriers.inverse(1, k).data(), turned.data());
      for (int i = 0; i < D * D; ++i) off[i] = -carriers.inverse(0, k)[i] - turned[i];
    }
    jumps.add(p, std::move(basis), std::move(inverse));
  }

  void add_axial(JumpBuilder<D>& jumps) const {
    Block<D> along{};
    along[D * D - 1] = 1;
    for (const Index p : out_.nodes)
      if (!is_carrier(p)) jumps.add(p, BlockRow<D>{{out_.carriers[0], along}});
  }

  const Nodes<D>& nodes_;
  const Surface<D> surface_;
  const bool axial_;
  RigidNodes<D> out_;
};

/// Values at the point of a part.
template <int D>
class Driving {
 public:
  Driving(const RigidNodes<D>& nodes, const Model<D>& model) : site_(site<D>(nodes.point, model.t)) {}
  double operator()(const Field& field) const { return field(site_); }

 private:
  Site site_;
};

template <int D>
[[noreturn]] void refuse_fix(const Nodes<D>& nodes, const Model<D>& model, const FixedDirections<D>& fixed,
                             Index part) {
  Index fix = -1;
  for (int k = 0; k < fixed.count; ++k) fix = std::max(fix, fixed.fix[k]);
  input_error(model.fixes[fix].on.origin,
              fmt::format("prescribes the displacement at ({}), where {} moves the body; expected 'displacement' and "
                          "'rotation' there, or faces apart from it",
                          fmt::join(nodes.at(fixed.vertex), ", "), model.rigid[part].on.origin));
}

}  // namespace

template <int D>
std::vector<RigidNodes<D>> add_rigid_parts(const Nodes<D>& nodes, const Model<D>& model, JumpBuilder<D>& jumps) {
  std::vector<RigidNodes<D>> out;
  for (const RigidPart<D>& rigid : model.rigid) {
    const OnePart<D> part(nodes, model, rigid);
    for (const Index p : surface(nodes, select_faces(nodes.mesh(), rigid.on, model.t)).nodes)
      for (std::size_t k = 0; k < out.size(); ++k)
        if (std::ranges::binary_search(out[k].nodes, p))
          input_error(rigid.on.origin, fmt::format("at ({}) {} moves the same node; expected faces apart from these",
                                                   fmt::join(nodes.at(p), ", "), model.rigid[k].on.origin));
    out.push_back(part.add_to(jumps));
  }
  return out;
}

template <int D>
void hold(const Nodes<D>& nodes, const Model<D>& model, const std::vector<RigidNodes<D>>& parts,
          std::vector<FixedDirections<D>>& fixes) {
  for (Index number = 0; number < std::ssize(parts); ++number) {
    const RigidNodes<D>& part = parts[number];
    const RigidPart<D>& table = model.rigid[number];
    const Driving<D> value(part, model);
    const Index by = by_rigid_part(number);
    std::erase_if(fixes, [&](const FixedDirections<D>& fixed) {
      if (!std::ranges::binary_search(part.nodes, fixed.vertex)) return false;
      if (std::any_of(fixed.fix, fixed.fix + fixed.count, [](Index fix) { return fix >= 0; }))
        refuse_fix(nodes, model, fixed, number);
      return true;
    });
    const auto prescribe = [&](FixedDirections<D>& fixed, int i, double v0) {
      double axis[D] = {};
      axis[i] = 1;
      fixed.add(axis, v0, by);
    };
    for (const Index p : part.nodes) {
      FixedDirections<D> fixed{.vertex = p};
      if (p == part.carriers[0]) {
        if (model.plane == Plane::axisymmetric) prescribe(fixed, 0, 0);
        for (int i = 0; i < D; ++i)
          if (table.displacement[i]) prescribe(fixed, i, value(*table.displacement[i]));
      } else if (p == part.carriers[1]) {
        for (int i = 0; i < D; ++i)
          if (i >= RigidPart<D>::rotations)
            prescribe(fixed, i, 0);
          else if (table.rotation[i])
            prescribe(fixed, i, part.length * value(*table.rotation[i]));
      } else {
        fixed.hold_rest(by);
      }
      if (fixed.count > 0) fixes.push_back(fixed);
    }
  }
  std::ranges::sort(fixes, {}, &FixedDirections<D>::vertex);
}

template <int D>
void add_rigid_loads(const Nodes<D>& nodes, const Model<D>& model, const PairedBodies<D>& pairs,
                     std::vector<double>& load) {
  if (pairs.rigid.empty()) return;
  std::vector<double> forces(static_cast<std::size_t>(nodes.size()) * D);
  for (std::size_t k = 0; k < pairs.rigid.size(); ++k) {
    const RigidNodes<D>& part = pairs.rigid[k];
    const Driving<D> value(part, model);
    for (int i = 0; i < D; ++i) forces[Offset{part.carriers[0]} * D + i] = value(model.rigid[k].force[i]);
    for (int i = 0; i < RigidPart<D>::rotations && part.carriers[1] >= 0; ++i)
      forces[Offset{part.carriers[1]} * D + i] = value(model.rigid[k].torque[i]) / part.length;
  }
  transform_forces_back(*pairs.jumps, forces);
  for (std::size_t k = 0; k < load.size(); ++k) load[k] += forces[k];
}

#define SIGNORINI_INSTANTIATE(D)                                                                          \
  template std::vector<RigidNodes<D>> add_rigid_parts(const Nodes<D>&, const Model<D>&, JumpBuilder<D>&); \
  template void hold(const Nodes<D>&, const Model<D>&, const std::vector<RigidNodes<D>>&,                 \
                     std::vector<FixedDirections<D>>&);                                                   \
  template void add_rigid_loads(const Nodes<D>&, const Model<D>&, const PairedBodies<D>&, std::vector<double>&);
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
