#include "apps/bench/choice/kept_aside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "amg/black_box.hpp"
#include "apps/bench/matrices/matrices.hpp"
#include "apps/bench/processor_time.hpp"
#include "core/scene/solver_options.hpp"

namespace signorini::bench {
namespace {

/// Sums of edges: ties w (x_i - x_j)^2 / 2, or w x_i^2 / 2 to zero.
class Graph {
 public:
  explicit Graph(Index vertices) : row_(static_cast<std::size_t>(vertices)) {}

  void tie(Index i, Index j, double weight) {
    hold(i, weight);
    hold(j, weight);
    row_[i][j] -= weight;
    row_[j][i] -= weight;
  }
  void hold(Index i, double weight) { row_[i][i] += weight; }
  /// Any entry and its mirror image.
  void add(Index i, Index j, double value) {
    row_[i][j] += value;
    if (i != j) row_[j][i] += value;
  }

  SparseRows matrix() const {
    SparseRows A;
    A.rows = A.columns = static_cast<Index>(row_.size());
    for (const auto& row : row_) {
      for (const auto& [column, value] : row) A.column.push_back(column), A.value.push_back(value);
      A.row.push_back(static_cast<Offset>(A.column.size()));
    }
    return A;
  }

 private:
  std::vector<std::map<Index, double>> row_;
};

/// The same numbers with every library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0; }
  double decades(double low, double high) { return std::pow(10, between(low, high)); }

 private:
  std::mt19937 engine_;
};

/// n x n unknowns within a square whose boundary is held.
struct Square {
  Index n;
  Index at(Index i, Index j) const { return i * n + j; }
  bool inside(Index i, Index j) const { return i >= 0 && i < n && j >= 0 && j < n; }
  double x(Index i) const { return (i + 1.0) / (n + 1); }
};

/// A five-point stencil with a coefficient for each of its edges.
template <class Coefficient>
Graph five_points(Square s, const Coefficient& c) {
  Graph g(s.n * s.n);
  const auto edge = [&](Index i, Index j, Index k, Index l) {
    const double w = c((s.x(i) + s.x(k)) / 2, (s.x(j) + s.x(l)) / 2);
    if (s.inside(i, j) && s.inside(k, l)) return g.tie(s.at(i, j), s.at(k, l), w);
    g.hold(s.inside(i, j) ? s.at(i, j) : s.at(k, l), w);
  };
  for (Index i = -1; i < s.n; ++i)
    for (Index j = -1; j < s.n; ++j) {
      if (j >= 0) edge(i, j, i + 1, j);
      if (i >= 0) edge(i, j, i, j + 1);
    }
  return g;
}

double bump(double x, double y) { return 0.1 * std::sin(7 * x) * std::sin(5 * y + 2 * x) - 0.05; }

MatrixProblem above(const Graph& g, double load, std::vector<double> lower) {
  MatrixProblem out{g.matrix(), {}, std::move(lower), {}};
  out.b.assign(out.lower.size(), load);
  out.upper.assign(out.lower.size(), infinity);
  return out;
}

template <class Height>
std::vector<double> heights(Square s, const Height& height) {
  std::vector<double> out;
  for (Index i = 0; i < s.n; ++i)
    for (Index j = 0; j < s.n; ++j) out.push_back(height(s.x(i), s.x(j)));
  return out;
}

/// Points at random in the unit square; ties to those within a radius.
struct Points {
  std::vector<double> x, y;
  double radius;

  Points(Random& random, Index n) : radius(std::sqrt(8 / (std::numbers::pi * n))) {
    for (Index p = 0; p < n; ++p) x.push_back(random.between(0, 1)), y.push_back(random.between(0, 1));
  }
  template <class Visit>
  void each_pair(const Visit& visit) const {
    const auto cells = static_cast<Index>(1 / radius);
    std::vector<std::vector<Index>> bin(static_cast<std::size_t>(cells) * cells);
    const auto cell = [&](double t) { return std::min(static_cast<Index>(t * cells), cells - 1); };
    for (Index p = 0; p < static_cast<Index>(x.size()); ++p) bin[cell(x[p]) * cells + cell(y[p])].push_back(p);
    for (Index p = 0; p < static_cast<Index>(x.size()); ++p)
      for (Index i = std::max(cell(x[p]) - 1, 0); i <= std::min(cell(x[p]) + 1, cells - 1); ++i)
        for (Index j = std::max(cell(y[p]) - 1, 0); j <= std::min(cell(y[p]) + 1, cells - 1); ++j)
          for (const Index q : bin[i * cells + j]) {
            const double d = std::hypot(x[p] - x[q], y[p] - y[q]);
            if (q < p && d < radius) visit(p, q, d);
          }
  }
  std::vector<double> heights() const {
    std::vector<double> out;
    for (std::size_t p = 0; p < x.size(); ++p) out.push_back(bump(x[p], y[p]));
    return out;
  }
};

MatrixProblem irregular_points() {
  Random random(1);
  const Points points(random, 20'000);
  Graph g(20'000);
  points.each_pair([&](Index p, Index q, double d) { g.tie(p, q, points.radius / (d + 0.01 * points.radius)); });
  for (Index p = 0; p < 20'000; ++p) g.hold(p, points.x[p] < 0.02 || points.x[p] > 0.98 ? 1.0 : 1e-6);
  return above(g, -4e-4, points.heights());
}

MatrixProblem random_weights() {
  Random random(2);
  const Points points(random, 20'000);
  Graph g(20'000);
  points.each_pair([&](Index p, Index q, double) { g.tie(p, q, random.decades(-2, 2)); });
  for (Index p = 0; p < 20'000; p += 50) g.hold(p, 1);
  return above(g, -1e-2, points.heights());
}

MatrixProblem small_world() {
  Random random(3);
  constexpr Index n = 20'000;
  Graph g(n);
  std::vector<double> lower;
  for (Index p = 0; p < n; ++p) {
    g.tie(p, (p + 1) % n, 1);
    g.tie(p, (p + 2) % n, 1);
    if (random.between(0, 1) < 0.02) g.tie(p, static_cast<Index>(random.between(0, n - 1)), 0.5);
    g.hold(p, 1e-5);
    lower.push_back(0.3 * std::sin(40 * std::numbers::pi * p / n) - 0.2);
  }
  return above(g, -1e-4, std::move(lower));
}

// Nine points: bilinear elements for a tensor turned by 30 degrees, weak across by 1000.
MatrixProblem rotated() {
  const Square s{140};
  const double phi = std::numbers::pi / 6, c = std::cos(phi), t = std::sin(phi), weak = 1e-3;
  const double xx = c * c + weak * t * t, yy = t * t + weak * c * c, xy = (1 - weak) * c * t;
  Graph g(s.n * s.n);
  constexpr int corner[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const double at[2] = {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)};
  double K[4][4] = {};
  for (const double u : at)
    for (const double v : at)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
          const auto gradient = [&](int k, double* d) {
            const double sx = corner[k][0] ? 1 : -1, sy = corner[k][1] ? 1 : -1;
            d[0] = sx * (corner[k][1] ? v : 1 - v);
            d[1] = sy * (corner[k][0] ? u : 1 - u);
          };
          double da[2], db[2];
          gradient(a, da), gradient(b, db);
          K[a][b] += 0.25 * (xx * da[0] * db[0] + yy * da[1] * db[1] + xy * (da[0] * db[1] + da[1] * db[0]));
        }
  for (Index i = -1; i < s.n; ++i)
    for (Index j = -1; j < s.n; ++j)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b <= a; ++b) {
          const Index ia = i + corner[a][0], ja = j + corner[a][1], ib = i + corner[b][0], jb = j + corner[b][1];
          if (s.inside(ia, ja) && s.inside(ib, jb)) g.add(s.at(ia, ja), s.at(ib, jb), K[a][b]);
        }
  return above(g, -4.0 / (s.n * s.n), heights(s, bump));
}

MatrixProblem checkerboard() {
  const Square s{150};
  const auto c = [](double x, double y) {
    return (static_cast<int>(7 * x) + static_cast<int>(7 * y)) % 2 == 0 ? 1e4 : 1.0;
  };
  return above(five_points(s, c), -8.0 / (s.n * s.n), heights(s, bump));
}

MatrixProblem channels() {
  const Square s{150};
  const auto c = [](double x, double y) {
    return std::exp(3 * (std::sin(13 * x + 4 * y) + std::sin(9 * y - 17 * x) + std::sin(23 * x * y)));
  };
  return above(five_points(s, c), -8.0 / (s.n * s.n), heights(s, bump));
}

// One implicit step of heat conduction between a floor and a ceiling.
MatrixProblem time_step() {
  const Square s{180};
  Graph g = five_points(s, [](double x, double) { return x < 0.5 ? 1.0 : 30.0; });
  for (Index p = 0; p < s.n * s.n; ++p) g.hold(p, 0.02);
  MatrixProblem out{g.matrix(), {}, heights(s, bump), {}};
  out.upper = heights(s, [](double x, double y) { return bump(x, y) + 0.06 + 0.05 * x; });
  out.b = heights(s, [](double x, double y) { return 0.01 * std::cos(31 * x) * std::cos(19 * y); });
  return out;
}

/// n x n x n unknowns within a cube, ties of three strengths along the axes.
MatrixProblem layers() {
  constexpr Index n = 28;
  Random random(4);
  Graph g(n * n * n);
  std::vector<double> lower;
  std::vector<double> layer;
  for (Index k = 0; k <= n; ++k) layer.push_back(random.decades(-1.5, 1.5));
  const auto at = [](Index i, Index j, Index k) { return (i * n + j) * n + k; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) {
        const double w[3] = {1, 0.1, layer[k]};
        if (i + 1 < n) g.tie(at(i, j, k), at(i + 1, j, k), w[0]);
        if (j + 1 < n) g.tie(at(i, j, k), at(i, j + 1, k), w[1]);
        if (k + 1 < n) g.tie(at(i, j, k), at(i, j, k + 1), w[2]);
        if (i == 0 || j == n - 1) g.hold(at(i, j, k), 1);
        lower.push_back(k == 0 || k == n - 1 ? bump(double(i) / n, double(j) / n) : -infinity);
      }
  return above(g, -1e-3, std::move(lower));
}

// Twenty-seven points: the sum of paths in all directions of a cube, one-sided on all vertices.
MatrixProblem full_stencil() {
  constexpr Index n = 24;
  Graph g(n * n * n);
  std::vector<double> lower;
  const auto at = [](Index i, Index j, Index k) { return (i * n + j) * n + k; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) {
        for (int d = 14; d < 27; ++d) {
          const Index a = i + d / 9 - 1, b = j + d / 3 % 3 - 1, c = k + d % 3 - 1;
          const double w = 1.0 / (std::abs(a - i) + std::abs(b - j) + std::abs(c - k));
          if (a < n && b >= 0 && b < n && c >= 0 && c < n)
            g.tie(at(i, j, k), at(a, b, c), w);
          else
            g.hold(at(i, j, k), w);
        }
        lower.push_back(bump(double(i) / n, double(j) / n) - 0.1 * std::cos(6.0 * k / n));
      }
  return above(g, -5e-3, std::move(lower));
}

// Two unknowns for a joint: springs along the edges and one diagonal of squares, of random stiffness; a floor below.
MatrixProblem springs() {
  constexpr Index n = 80;
  Random random(5);
  Graph g(2 * n * n);
  const auto at = [](Index i, Index j) { return 2 * (i * n + j); };
  const auto spring = [&](Index p, Index q, double dx, double dy) {
    const double w = random.decades(-0.5, 0.5), d[2] = {dx, dy};
    for (int k = 0; k < 2; ++k)
      for (int l = 0; l < 2; ++l) {
        const double value = w * d[k] * d[l];
        if (k <= l) g.add(p + k, p + l, value), g.add(q + k, q + l, value);
        g.add(p + k, q + l, -value);
      }
  };
  const double half = std::sqrt(0.5);
  MatrixProblem out;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      if (i + 1 < n) spring(at(i, j), at(i + 1, j), 1, 0);
      if (j + 1 < n) spring(at(i, j), at(i, j + 1), 0, 1);
      if (i + 1 < n && j + 1 < n) spring(at(i, j), at(i + 1, j + 1), half, half);
      if (i + 1 < n && j > 0) spring(at(i, j), at(i + 1, j - 1), half, -half);
      if (j == n - 1)
        for (int k = 0; k < 2; ++k) g.hold(at(i, j) + k, 1);
      out.b.insert(out.b.end(), {0, -1e-4});
      const double x = double(i) / n;
      out.lower.insert(out.lower.end(), {-infinity, j == 0 ? -0.1 + 0.15 * (x - 0.5) * (x - 0.5) : -infinity});
    }
  out.A = g.matrix();
  out.upper.assign(out.b.size(), infinity);
  return out;
}

struct Row {
  const char* name;
  MatrixProblem (*make)();
  int block = 1;
};

const std::vector<Row> rows{{"irregular points", irregular_points},
                            {"random weights", random_weights},
                            {"small world", small_world},
                            {"rotated anisotropy", rotated},
                            {"checkerboard", checkerboard},
                            {"channels", channels},
                            {"time step", time_step},
                            {"layers", layers},
                            {"full stencil", full_stencil},
                            {"springs", springs, 2}};

void print(const Row& row) {
  const MatrixProblem problem = row.make();
  Comparison comparison([&](const Overrides& settings) {
    const ProcessorTime time;
    BlackBox solver(problem.A, row.block, solver_options(settings));
    const Summary summary = solver.solve(problem.b, problem.lower, problem.upper).summary;
    return Trial{summary.iterations, summary.converged(), time.elapsed()};
  });
  for (const Overrides& method : kept_aside::methods)
    comparison.try_method(method,
                          method.front() == "solver.method=pdas" ? std::vector<Overrides>{} : kept_aside::lists);
  comparison.confirm();
  fmt::print("| {} | {} | {} |\n", row.name, problem.b.size(), comparison.row());
  std::fflush(stdout);
}

}  // namespace

void print_kept_aside_matrices(const std::string& only) {
  fmt::print(
      "\n## Matrices kept aside\n\n"
      "| problem | unknowns | cycles | best | its cycles | failed | default over best |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Row& row : rows)
    if (std::string(row.name).find(only) != std::string::npos) print(row);
}

}  // namespace signorini::bench
