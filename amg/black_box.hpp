#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "amg/black_box/block_obstacle.hpp"
#include "core/algebra/near_null_space.hpp"
#include "core/algebra/sparse_rows.hpp"
#include "core/solver/options.hpp"
#include "methods/solve.hpp"

namespace signorini {

/// min 1/2 x'Ax - b'x over lower <= x <= upper for a symmetric positive (semi)definite matrix A, without any mesh.
///
///   BlackBox solver(A);                                      // an Eigen::SparseMatrix<double>, or SparseRows
///   BlackBox::Result result = solver.solve(b, lower, upper);
///
/// The set-up serves any number of right-hand sides and bounds. Everything that is wrong with the input is an Error
/// naming the place; messages count rows and columns from 1.
class BlackBox {
 public:
  /// Numbers of the caller: a vector of the standard library, a pointer and a length, and whatever is a vector of
  /// doubles for Eigen, a Map, a segment, a column or row, an expression. None are copied that lie one after the other.
  class Values : public std::span<const double> {
   public:
    using std::span<const double>::span;
    Values(std::span<const double> values) : span(values) {}     // NOLINT: conversions are what it is for
    Values(const std::vector<double>& values) : span(values) {}  // NOLINT
    template <class Vector>
    Values(const Eigen::MatrixBase<Vector>& values) : Values(values.derived(), own(values.derived())) {}  // NOLINT

   private:
    template <class Vector>
    static constexpr bool in_memory = (Vector::Flags & Eigen::DirectAccessBit) != 0;

    /// A copy of what lies elsewhere than one after the other, or nowhere; null where there is no need.
    template <class Vector>
    static std::shared_ptr<const Eigen::VectorXd> own(const Vector& values) {
      static_assert(Vector::IsVectorAtCompileTime, "one value per unknown: a vector");
      static_assert(std::is_same_v<typename Vector::Scalar, double>, "doubles, see cast<double>()");
      if constexpr (in_memory<Vector>)
        if (values.size() < 2 || values.innerStride() == 1) return nullptr;
      auto copy = std::make_shared<Eigen::VectorXd>(values.size());
      for (Eigen::Index i = 0; i < values.size(); ++i) (*copy)[i] = values.coeff(i);
      return copy;
    }

    template <class Vector>
    Values(const Vector& values, std::shared_ptr<const Eigen::VectorXd> copy)
        : span(copy ? copy->data() : data_of(values), static_cast<std::size_t>(values.size())),
          copy_(std::move(copy)) {}

    template <class Vector>
    static const double* data_of(const Vector& values) {
      if constexpr (in_memory<Vector>)
        return values.data();
      else
        return nullptr;
    }

    std::shared_ptr<const Eigen::VectorXd> copy_;
  };

  struct Result {
    std::vector<double> x;
    /// A x - b where a bound holds: at a solution >= 0 at lower bounds, <= 0 at upper ones; exactly 0 elsewhere, and
    /// where it has the other sign. With obstacles all of A x - b, the force on it, at the blocks that they act on.
    std::vector<double> multiplier;
    /// -1 at the lower bound, 1 at the upper one, 0 between them; equal bounds: by the sign of the multiplier, -1 where
    /// it is 0.
    std::vector<signed char> active;
    std::vector<Index> touching;  ///< with obstacles: the blocks that one of them holds, ascending
    Summary summary;
  };

  /// Levels chosen by the matrix.
  /// @param block 1, 2 or 3 unknowns that belong together, such as the displacement of a mesh vertex, in consecutive
  ///     rows; 0: as recognised_block() finds
  /// @param near_null what levels by aggregation represent exactly, such as rigid_body_modes() of an elastic body; only
  ///     unless options.coarsening = "classical"
  /// @throws Error(Exit::input) for a matrix that is not symmetric, not square or seen not to be positive semidefinite,
  ///     and a near null space that does not fit
  explicit BlackBox(const SparseRows& A, int block = 0, const SolverOptions& options = {},
                    const NearNullSpace& near_null = {});

  /// Levels by the interpolations of another linear multigrid code, coarsest first: one row per fine vector, one column
  /// per coarse one, weights of any sign. With blocks, a vector is a block, all of whose components are interpolated
  /// alike, by a scalar weight. None at all is a single level.
  /// @param coarse_matrices of that code, one for each interpolation, in the same order; none: they are computed. Only
  ///     Galerkin products P'AP of the next finer matrix will do: with others a cycle may raise the energy. Where
  ///     phases are truncated their rows are computed anew in any case; where one has zero rows, all are computed.
  /// @throws Error(Exit::input) for a matrix as above, and naming the interpolation or the coarse matrix that does not
  ///     fit
  BlackBox(const SparseRows& A, std::span<const SparseRows> interpolations, int block = 1,
           const SolverOptions& options = {}, std::span<const SparseRows> coarse_matrices = {});

  ~BlackBox();
  BlackBox(BlackBox&&) noexcept;
  BlackBox& operator=(BlackBox&&) noexcept;

  /// For the solves from now on.
  /// @throws Error(Exit::input) outside (0, 1); nothing has changed then
  void set_tolerance(double tolerance);

  /// Bounds may be infinite, and lower and upper ones equal. Whether a solution was found, or what prevented it, is in
  /// the summary's outcome.
  /// @param lower, upper, start one value per unknown; empty: none, and nested iteration
  /// @throws Error(Exit::input) for sizes that do not fit and values that are not numbers, Error(Exit::no_solution)
  ///     where a lower bound lies above the upper one, or no bound holds the load in a row of A that is zero
  Result solve(const Values& b, const Values& lower = {}, const Values& upper = {}, const Values& start = {},
               const Monitor& monitor = {});

  /// Another matrix of the same size for the solves from now on, such as that of the next time step: the interpolations
  /// between the levels stay, their matrices are computed anew. The more the matrices differ the more cycles it takes.
  /// @throws Error(Exit::input) for a matrix as above, or of another size; nothing has changed then
  void set_matrix(const SparseRows& A);

  /// Obstacles for the solves from now on, in place of those before, which also forget the last load step: all that the
  /// kernel knows, with directions of their own, faces and energies. They are asked for their bounds here and now.
  /// Bounds of solve() and equal ones, which prescribe unknowns, may act on the same blocks. The matrix is kept twice
  /// then. A start is taken as it is, and energies are 1/2 x'Ax - b'x plus what obstacles add.
  ///
  ///   solver.set_obstacles<2>({{floor, blocks, places, "floor"}});
  ///
  /// @tparam B the block size that the solver was set up with; none at all: bounds alone again
  /// @throws Error(Exit::input) for another block size, blocks that do not exist or are given twice, places that do not
  ///     fit, are no numbers or have no unit normal, no measure for an obstacle that adds to the energy; whatever the
  ///     obstacle complains about. Nothing has changed then
  template <int B>
  void set_obstacles(std::vector<BlockObstacle<B>> obstacles);

  /// A load step ends with the last solution: from now on friction counts slip from there, and functionals find their
  /// numbers in Slot::before.
  /// @throws Error(Exit::input) where no solve with obstacles has ended yet
  void next_step();

 private:
  class Solver;
  class InUnits;
  template <int B>
  class BlockSolver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace signorini
