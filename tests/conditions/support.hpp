#pragma once
#include <Eigen/Dense>

#include "core/fem/assembly/assemble.hpp"
#include "core/fem/elements/select.hpp"
#include "driver/driver.hpp"
#include "tests/verification/run.hpp"

namespace signorini::test {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

/// A body with an obstacle far off, as every scene of one run has it.
inline std::string text_of(const std::string& body, const std::string& rest) {
  return "[[body]]\nname = \"b\"\n" + body + "\n" + rest;
}
inline std::string table(const std::string& name, const std::string& keys) {
  return "[[" + name + "]]\nbody = \"b\"\n" + keys + "\n";
}

template <int D>
Vector<D> point(const Point<D>& x) {
  return Eigen::Map<const Vector<D>>(x.data());
}

/// The sum of forces at nodes.
template <int D>
Vector<D> sum(const std::vector<double>& forces) {
  Vector<D> out = Vector<D>::Zero();
  for (std::size_t k = 0; k < forces.size(); ++k) out[static_cast<Eigen::Index>(k % D)] += forces[k];
  return out;
}

/// Their moment about a point, in space: in the plane it is along z.
template <int D>
Eigen::Vector3d moment(const Nodes<D>& nodes, const std::vector<double>& forces, const Vector<D>& about) {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  for (Index p = 0; p < nodes.size(); ++p) {
    Eigen::Vector3d arm = Eigen::Vector3d::Zero(), force = arm;
    arm.head<D>() = point<D>(nodes.control_point(p)) - about;
    force.head<D>() = Eigen::Map<const Vector<D>>(forces.data() + Offset{p} * D);
    out += arm.cross(force);
  }
  return out;
}

/// What elements exert at the nodes of a solution.
template <int D>
std::vector<double> internal_forces(const Run<D, D>& solved) {
  const BlockMatrix<D> A = stiffness<D, D>(solved.nodes(), solved.model);
  std::vector<double> out(solved.u().size());
  for (Index p = 0; p < A.size(); ++p)
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          out[Offset{p} * D + i] += A.at(k)[i * D + j] * solved.u()[Offset{A.column[k]} * D + j];
  return out;
}

/// The displacement of the nodes, those between vertices at their places.
template <int D>
Vector<D> displacement(const std::vector<double>& at_vertices, Index v) {
  return Eigen::Map<const Vector<D>>(at_vertices.data() + Offset{v} * D);
}

/// The message of a scene that is refused.
template <class Make>
std::string refusal(const Make& make) {
  try {
    make();
  } catch (const Error& e) {
    return e.what();
  }
  return "not refused";
}

}  // namespace signorini::test
