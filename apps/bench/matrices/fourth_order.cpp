#include "apps/bench/matrices/fourth_order.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <string>

#include "amg/black_box.hpp"

namespace signorini::bench {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

struct Programme {
  std::string name;
  Matrix A;
  Eigen::VectorXd b, lower, upper;

  Programme(std::string called, Matrix matrix)
      : name(std::move(called)),
        A(std::move(matrix)),
        b(Eigen::VectorXd::Zero(A.rows())),
        lower(b),
        upper(Eigen::VectorXd::Constant(A.rows(), infinity)) {}
};

/// n rows with these entries on the diagonal and beside it, to either side.
Matrix diagonals(int n, std::initializer_list<double> entries) {
  std::vector<Eigen::Triplet<double>> all;
  for (int i = 0; i < n; ++i) {
    int away = 0;
    for (const double value : entries) {
      if (i + away < n) all.emplace_back(i, i + away, value);
      if (away > 0 && i >= away) all.emplace_back(i, i - away, value);
      ++away;
    }
  }
  Matrix A(n, n);
  A.setFromTriplets(all.begin(), all.end());
  return A;
}

/// 13 points, on so many inner nodes a side of a square, pressed onto a floor.
Programme plate(int nodes, bool clamped) {
  const Matrix line = diagonals(nodes, {2, -1});
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j)
      for (Matrix::InnerIterator entry(line, j); entry; ++entry) {
        entries.emplace_back(i * nodes + j, i * nodes + entry.col(), entry.value());
        entries.emplace_back(j * nodes + i, entry.col() * nodes + i, entry.value());
      }
  Matrix L(nodes * nodes, nodes * nodes);
  L.setFromTriplets(entries.begin(), entries.end());
  Matrix A = L * L;
  const auto ends = [=](int i) { return (i == 0) + (i == nodes - 1); };
  for (int i = 0; clamped && i < nodes; ++i)
    for (int j = 0; j < nodes; ++j) A.coeffRef(i * nodes + j, i * nodes + j) += 2 * (ends(i) + ends(j));
  Programme out(clamped ? "clamped plate" : "supported plate", std::move(A));
  out.b.setConstant((clamped ? -3000 : -1000) / std::pow(nodes + 1, 4));
  out.lower.setConstant(-1);
  return out;
}

Programme pentdi(int n, double diagonal) {
  Programme out(diagonal == 6 ? "beam, load of PENTDI" : "PENTDI", diagonals(n, {diagonal, -4, 1}));
  const int half = n / 2;
  out.b[0] = out.b[half - 1] = 3;
  out.b[1] = out.b[half - 2] = -1;
  out.b[half] = -4;
  out.b.tail(n - half - 2).setConstant(-1);
  return out;
}

/// Clamped, pressed onto a floor: as much of it touches for all n.
Programme beam(int n) {
  Programme out("beam, even load", diagonals(n, {6, -4, 1}));
  out.b.setConstant(-3000 / std::pow(n + 1, 4));
  out.lower.setConstant(-1);
  return out;
}

Programme chenhark(int n) {
  Programme out("CHENHARK", diagonals(n, {6, -4, 1}));
  const int half = n / 2, degenerate = n / 10;
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(n);
  solution.head(half).setOnes();
  out.b = out.A * solution;
  out.b.tail(n - half - degenerate).array() -= 1;
  return out;
}

Programme biggsb1(int n) {
  Programme out("BIGGSB1", diagonals(n, {4, -2}));
  out.b[0] = out.b[n - 1] = 2;
  out.upper.setConstant(0.9);
  out.lower[n - 1] = -infinity;
  out.upper[n - 1] = infinity;
  return out;
}

std::string cycles(const Programme& p, const char* coarsening) {
  SolverOptions options;
  options.coarsening = coarsening;
  options.max_iterations = 60;
  const Summary summary = BlackBox(p.A, 1, options).solve(p.b, p.lower, p.upper).summary;
  const auto solves = [](const Stage& stage) {
    return stage.linear_solves == 0 && (stage.outcome == Outcome::converged || stage.outcome == Outcome::rounding);
  };
  const char* by = !summary.converged()                          ? ", unsolved"
                   : summary.stages.back().linear_solves == 0    ? ""
                   : std::ranges::any_of(summary.stages, solves) ? ", refined"
                                                                 : ", then others";
  return fmt::format("{}{}", summary.iterations, by);
}

void row(const Programme& p) {
  fmt::print("| {} | {} | {} | {} |\n", p.name, p.A.rows(), cycles(p, "auto"), cycles(p, "classical"));
  std::fflush(stdout);
}

}  // namespace

void print_fourth_order(bool quick) {
  fmt::print(
      "\n## Plates, beams and programmes of CUTEst\n\n| problem | unknowns | cycles | with coarsening classical |\n"
      "| --- | --- | --- | --- |\n");
  const std::vector<int> plates = quick ? std::vector{33, 65, 129, 257} : std::vector{33, 65, 129, 257, 513, 1025};
  for (const bool clamped : {true, false})
    for (const int nodes : plates) row(plate(nodes, clamped));
  for (const int n : quick ? std::vector{1000, 5000, 50000} : std::vector{1000, 5000, 50000, 200000}) row(beam(n));
  for (const int n : {1000, 5000, 50000}) row(pentdi(n, 6));
  for (const int n : {1000, 5000, 50000}) row(chenhark(n));
  row(pentdi(50000, 12));
  row(biggsb1(20000));
}

}  // namespace signorini::bench
