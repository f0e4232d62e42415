#include "apps/bench/peers/model_matrices.hpp"

#include <array>

namespace signorini::bench {
namespace {

using Node = std::array<int, 3>;  // x first

class Grid {
 public:
  Grid(int dimension, int nodes, const Coefficient& coefficient)
      : dimension_(dimension), nodes_(nodes), coefficient_(coefficient) {}

  SparseRows matrix() const {
    SparseRows A;
    for (Node at{}; at[dimension_ - 1] < nodes_; step(at)) add_row(at, A);
    A.rows = A.columns = static_cast<Index>(A.row.size()) - 1;
    return A;
  }

 private:
  void step(Node& at) const {
    ++at[0];
    for (int i = 0; i + 1 < dimension_ && at[i] == nodes_; ++i) {
      at[i] = 0;
      ++at[i + 1];
    }
  }

  Index number(const Node& at) const { return at[0] + nodes_ * (at[1] + nodes_ * at[2]); }

  double value(const Node& at) const {
    int boxes = 0;
    for (int i = 0; i < dimension_; ++i) boxes += 8 * at[i] / nodes_;
    return boxes % 2 ? coefficient_.jump : 1;
  }

  /// Columns ascend: neighbours before the node by falling directions, after it by rising ones.
  void add_row(const Node& at, SparseRows& A) const {
    double diagonal = 0;
    std::array<double, 3> before{}, after{};
    for (int i = 0; i < dimension_; ++i) {
      before[i] = between(at, i, -1);
      after[i] = between(at, i, 1);
      diagonal += before[i] + after[i];
    }
    for (int i = dimension_; i-- > 0;) add(neighbour(at, i, -1), i, -before[i], A);
    A.column.push_back(number(at));
    A.value.push_back(diagonal);
    for (int i = 0; i < dimension_; ++i) add(neighbour(at, i, 1), i, -after[i], A);
    A.row.push_back(static_cast<Offset>(A.column.size()));
  }

  static Node neighbour(Node at, int direction, int side) {
    at[direction] += side;
    return at;
  }

  bool inside(const Node& at, int direction) const { return at[direction] >= 0 && at[direction] < nodes_; }

  double between(const Node& at, int direction, int side) const {
    const Node other = neighbour(at, direction, side);
    const double a = value(at), b = inside(other, direction) ? value(other) : a;
    return (direction == 0 ? coefficient_.anisotropy : 1) * 2 * a * b / (a + b);
  }

  void add(const Node& at, int direction, double entry, SparseRows& A) const {
    if (!inside(at, direction)) return;
    A.column.push_back(number(at));
    A.value.push_back(entry);
  }

  int dimension_, nodes_;
  Coefficient coefficient_;
};

}  // namespace

SparseRows diffusion_matrix(int dimension, int nodes, const Coefficient& coefficient) {
  return Grid(dimension, nodes, coefficient).matrix();
}

}  // namespace signorini::bench
