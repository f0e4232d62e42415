#pragma once
#include <functional>
#include <utility>
#include <vector>

#include "core/algebra/block_matrix.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"

/// Springs and elastic foundations: a traction -K u on faces, with K = sum over the components of the spring's frame of
/// k_i d_i d_i^T. Their energy is 1/2 times the integral of u . K u.
namespace signorini {

/// Adds the second derivative of that energy to a matrix whose pattern has all pairs of nodes of an element. It stays
/// symmetric to the last bit.
template <int D, int B>
void add_springs(const Nodes<D>& nodes, const Model<B>& model, BlockMatrix<B>& A);

/// Adds what a spring exerts on the nodes, of all minus the matrix of add_springs() times u; both in global coordinates
/// and B per node.
template <int D, int B>
void add_spring_forces(const Nodes<D>& nodes, const Model<B>& model, const Spring<B>& spring,
                       const std::vector<double>& u, std::vector<double>& forces);
template <int D, int B>
void add_spring_forces(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                       std::vector<double>& forces);

/// A point where a spring holds the body along a direction.
template <int B>
struct SpringHold {
  std::array<double, B> direction;              ///< of length one
  std::vector<std::pair<Index, double>> nodes;  ///< with the values of their basis functions there
};

/// Calls use(hold) for points of all springs and each direction along which the stiffness is positive there: a motion
/// that moves none of them along it has no energy in springs.
template <int D, int B>
void each_spring_hold(const Nodes<D>& nodes, const Model<B>& model,
                      const std::function<void(const SpringHold<B>&)>& use);

/// K of a spring at a place with this normal, row-major; of one given in total per measure of `whole`.
template <int D, int B>
std::array<double, B * B> spring_matrix(const Spring<B>& spring, double whole, const Point<D>& x,
                                        const Point<D>& normal, double t);

/// What the stiffness of a spring is divided by: the measure of its faces if it is given in total, of those on both
/// sides of planes of symmetry that they go on beyond; else 1.
template <int D, int B>
double spring_whole(const Nodes<D>& nodes, const Model<B>& model, const Spring<B>& spring);

}  // namespace signorini
