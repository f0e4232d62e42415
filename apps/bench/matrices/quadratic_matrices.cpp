#include "apps/bench/matrices/quadratic_matrices.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCore>

#include "amg/black_box.hpp"
#include "amg/registration.hpp"
#include "apps/bench/matrices/matrices.hpp"
#include "apps/bench/problems.hpp"
#include "apps/scenes/tables.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/assembly/discretize.hpp"

namespace signorini::bench {
namespace {

/// A body, held and loaded, above an obstacle that holds a part of it.
struct Body {
  const char* name;
  std::string scene;
  std::string key;            ///< for the size of its cells
  std::vector<double> sizes;  ///< of them, coarse to fine
};

/// What the black box is given.
struct Matrix {
  Eigen::SparseMatrix<double, Eigen::RowMajor> A;
  Eigen::VectorXd b;
  std::vector<double> lower, upper, coordinates;
};

/// Coefficients by values: of the free nodes only, so that what is prescribed has to be zero.
template <int D, int B>
Eigen::SparseMatrix<double, Eigen::RowMajor> coefficients_by_values(const Nodes<D>& nodes,
                                                                    const std::vector<Index>& number, Index count) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index p, Index q, double weight) {
    for (int i = 0; i < B && number[q] >= 0; ++i) entries.emplace_back(number[p] * B + i, number[q] * B + i, weight);
  };
  for (Index p = 0; p < nodes.size(); ++p) {
    if (number[p] < 0) continue;
    const auto [a, b] = nodes.ends(p);
    if (a == b) {
      add(p, p, 1);
      continue;
    }
    add(p, p, Nodes<D>::midpoint_coefficient(1, 0, 0));
    add(p, a, Nodes<D>::midpoint_coefficient(0, 1, 0));
    add(p, b, Nodes<D>::midpoint_coefficient(0, 0, 1));
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> T(count, count);
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}

template <int D, int B>
Matrix matrix_of(const Nodes<D>& nodes, const Model<B>& model) {
  const DiscreteProblem<B> problem = discretize<D, B>(nodes, model).problem;
  MatrixProblem given = matrix_problem(problem);
  const std::vector<Index> number = free_vectors(problem);
  Matrix out;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index p = 0; p < given.A.rows; ++p)
    for (Offset k = given.A.row[p]; k < given.A.row[p + 1]; ++k)
      entries.emplace_back(p, given.A.column[k], given.A.value[k]);
  out.A.resize(given.A.rows, given.A.rows);
  out.A.setFromTriplets(entries.begin(), entries.end());
  out.b = Eigen::Map<const Eigen::VectorXd>(given.b.data(), static_cast<Eigen::Index>(given.b.size()));
  out.lower = std::move(given.lower);
  out.upper = std::move(given.upper);
  for (Index p = 0; p < nodes.size(); ++p)
    if (number[p] >= 0) out.coordinates.insert(out.coordinates.end(), nodes.at(p).begin(), nodes.at(p).end());
  if (nodes.order() == 1) return out;
  const auto T = coefficients_by_values<D, B>(nodes, number, given.A.rows);
  Eigen::SparseMatrix<double, Eigen::RowMajor> AT = out.A * T;
  out.A = (T.transpose() * AT).pruned(1.0, 1e-14);
  out.b = (T.transpose() * out.b).eval();
  return out;
}

struct Solve {
  int cycles;
  bool solved;
  double seconds;
};

template <int D, int B>
Solve black_box(const Matrix& matrix, bool modes) {
  Stopwatch watch;
  NearNullSpace near_null;
  if constexpr (D == B)
    if (modes) near_null = rigid_body_modes<D>(matrix.coordinates);
  BlackBox solver(matrix.A, B, {}, near_null);
  const Summary summary = solver.solve(matrix.b, matrix.lower, matrix.upper).summary;
  return {summary.iterations, summary.converged(), watch.elapsed()};
}

template <int D, int B>
void compare(const Body& body, bool quick) {
  for (std::size_t k = 0; k < body.sizes.size() - (quick ? 1 : 0); ++k) {
    const std::string size =
        body.key == "cells" ? fmt::format("[{}]", fmt::join(std::vector<int>(D, static_cast<int>(body.sizes[k])), ", "))
                            : fmt::format("{}", body.sizes[k]);
    const std::vector<std::string> overrides{"body.0.order=2", fmt::format("body.0.{}={}", body.key, size)};
    const Scene scene = parse_scene(body.scene, "body.toml", ".", overrides);
    Registry registry = solver_components();
    load_plugins(scene, registry);
    const MeshHierarchy<D> hierarchy = build_hierarchy<D>(scene, B);
    const Model<B> model = build_model<B>(scene, D, registry, 1);
    const Matrix linear = matrix_of<D, B>(Nodes<D>(hierarchy.finest(), 1), model);
    const Matrix quadratic = matrix_of<D, B>(Nodes<D>(hierarchy.finest(), 2), model);
    for (const bool modes : {false, true}) {
      if (modes && B == 1) continue;
      const Solve one = black_box<D, B>(linear, modes), two = black_box<D, B>(quadratic, modes);
      fmt::print("| {}{} | {} | {}{} | {}{} | {:.2f} | {:.2f} |\n", body.name, modes ? ", rigid motions" : "",
                 linear.A.rows(), one.cycles, one.solved ? "" : " (limit)", two.cycles, two.solved ? "" : " (limit)",
                 static_cast<double>(two.cycles) / one.cycles, two.seconds / one.seconds);
      std::fflush(stdout);
    }
  }
}

std::string membrane(const std::string& shape, const std::string& lower) {
  return "[[body]]\nname = \"body\"\nequation = \"diffusion\"\n" + shape + tables::fix("body", "boundary", "[0]") +
         tables::load("body", "[-1]") + tables::floor("body", lower);
}

std::string solid(const std::string& shape, const std::string& held, const std::string& load, const std::string& on,
                  const std::string& distance, const std::string& normal) {
  return "[[body]]\nname = \"body\"\nyoung = 1\npoisson = 0.3\n" + shape + "[[fix]]\nbody = \"body\"\n" + held +
         "\nvalue = " + (normal.size() > 6 ? "[0, 0, 0]" : "[0, 0]") + "\n" + tables::load("body", load) +
         "[[obstacle]]\ntype = \"contact\"\nbody = \"body\"\n" + on + "\nshape = \"expression\"\ndistance = \"" +
         distance + "\"\nnormal = " + normal + "\n";
}

const std::string square = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [4, 4]\n",
                  cube = "shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [4, 4, 4]\n",
                  disk = "shape = \"disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.3\n",
                  ball = "shape = \"ball\"\ncenter = [0, 0, 0]\nradius = 1\nsize = 0.5\n";

}  // namespace

void print_quadratic_matrices(bool quick) {
  fmt::print(
      "\n## Matrices of quadratic elements\n\n| problem | unknowns | linear: cycles | quadratic: cycles | cycles over "
      "| "
      "time over |\n| --- | --- | --- | --- | --- | --- |\n");
  compare<2, 1>({"square", membrane(square, "-0.05"), "cells", {50, 158, 270}}, quick);
  compare<2, 1>({"disk", membrane(disk, "-0.1"), "size", {0.035, 0.012}}, quick);
  compare<3, 1>({"cube", membrane(cube, "-0.03"), "cells", {11, 23, 33}}, quick);
  compare<3, 1>({"ball", membrane(ball, "-0.1"), "size", {0.16, 0.07}}, quick);
  compare<2, 2>({"elastic square",
                 solid(square, "on = \"top\"", "[0, -1]", "on = \"bottom\"", "y + 0.3 * (x - 0.5)^2", "[0, 1]"),
                 "cells",
                 {35, 110, 190}},
                quick);
  compare<2, 2>({"elastic disk",
                 solid(disk, "where = \"y > 0.5\"", "[0, -1]", "on = \"boundary\"", "y + 1.02", "[0, 1]"),
                 "size",
                 {0.05, 0.017}},
                quick);
  compare<3, 3>({"elastic cube",
                 solid(cube, "on = \"top\"", "[0, 0, -1]", "on = \"bottom\"", "z + 0.3 * ((x - 0.5)^2 + (y - 0.5)^2)",
                       "[0, 0, 1]"),
                 "cells",
                 {7, 15, 22}},
                quick);
  compare<3, 3>({"elastic ball",
                 solid(ball, "where = \"z > 0.5\"", "[0, 0, -1]", "on = \"boundary\"", "z + 1.02", "[0, 0, 1]"),
                 "size",
                 {0.22, 0.1}},
                quick);
}

}  // namespace signorini::bench
