// A finite element code of its own, linear triangles for plane strain, that leaves contact and friction to signorini.
//
// An elastic block (0, 2) x (0, 1), Young's modulus 1, Poisson's ratio 0.3, is lowered by 0.03 onto the floor y = 0 and
// pushed aside by 0.01, with Coulomb's friction 0.3. `signorini solve` has for the same triangles (the scene is in
// docs/own_obstacles.md) the energy and the force of the floor below; this program compares with them.
//   ./friction [cells along y]      default: 16, which is compared
#include <Eigen/SparseCore>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include <signorini/matrix/black_box.hpp>
#include <signorini/matrix/obstacle_by_name.hpp>

using Matrix = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

/// Nodes in rows of constant y, from the bottom; each cell is cut along its diagonal from (0, 0) to (1, 1).
struct Mesh {
  explicit Mesh(int cells) : columns(2 * cells), rows(cells), h(1.0 / cells) {}

  int columns, rows;
  double h;

  int nodes() const { return (columns + 1) * (rows + 1); }
  int node(int i, int j) const { return j * (columns + 1) + i; }
  std::array<double, 2> at(int p) const { return {p % (columns + 1) * h, p / (columns + 1) * h}; }
};

/// Adds the stiffness of a triangle.
void add_triangle(const Mesh& mesh, const std::array<int, 3>& node, Entries& entries) {
  constexpr double young = 1, poisson = 0.3;
  constexpr double mu = young / (2 * (1 + poisson)), lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  const auto a = mesh.at(node[0]), b = mesh.at(node[1]), c = mesh.at(node[2]);
  const double twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  const double gradient[3][2] = {{(b[1] - c[1]) / twice_area, (c[0] - b[0]) / twice_area},
                                 {(c[1] - a[1]) / twice_area, (a[0] - c[0]) / twice_area},
                                 {(a[1] - b[1]) / twice_area, (b[0] - a[0]) / twice_area}};
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) {
      const double *u = gradient[p], *v = gradient[q], product = u[0] * v[0] + u[1] * v[1];
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k) {
          const double density = lambda * u[i] * v[k] + mu * (u[k] * v[i] + (i == k ? product : 0));
          entries.emplace_back(2 * node[p] + i, 2 * node[q] + k, twice_area / 2 * density);
        }
    }
}

Matrix stiffness(const Mesh& mesh) {
  Entries entries;
  for (int j = 0; j < mesh.rows; ++j)
    for (int i = 0; i < mesh.columns; ++i) {
      const int a = mesh.node(i, j), b = mesh.node(i + 1, j), c = mesh.node(i + 1, j + 1), d = mesh.node(i, j + 1);
      add_triangle(mesh, {a, b, c}, entries);
      add_triangle(mesh, {a, c, d}, entries);
    }
  Matrix A(2 * mesh.nodes(), 2 * mesh.nodes());
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// What a rigid obstacle is: a signed distance, and the normal that points from there to the body.
struct Floor final : signorini::DistanceFunction {
  signorini::Distance at(const double* point, const double*, signorini::Status&) const noexcept override {
    return {point[1], {0, 1, 0}};
  }
};

/// Contact with friction, of the plugin `coulomb`, at the nodes of the bottom.
signorini::BlockObstacle<2> floor_below(const Mesh& mesh) {
  signorini::BlockObstacle<2> out;
  out.obstacle = signorini::obstacle_by_name<2>("coulomb", {"friction=0.3"}, std::make_shared<Floor>());
  out.name = "floor";
  for (int i = 0; i <= mesh.columns; ++i) {
    const int p = mesh.node(i, 0);
    signorini::SurfaceVertex place{};
    place.position[0] = mesh.at(p)[0];
    place.normal[1] = -1;                                               // outer normal of the body
    place.measure = i == 0 || i == mesh.columns ? mesh.h / 2 : mesh.h;  // integral of the node's basis function
    out.blocks.push_back(p);
    out.places.push_back(place);
  }
  return out;
}

/// The top is moved: equal bounds prescribe an unknown.
void move_top(const Mesh& mesh, std::vector<double>& lower, std::vector<double>& upper) {
  for (int i = 0; i <= mesh.columns; ++i) {
    const int p = mesh.node(i, mesh.rows);
    lower[2 * p] = upper[2 * p] = 0.01;
    lower[2 * p + 1] = upper[2 * p + 1] = -0.03;
  }
}

bool differs(const char* what, double found, double expected) {
  std::printf("%-9s %.12e\n", what, found);
  const double tolerance = 1e-8 * std::abs(expected);
  if (std::abs(found - expected) <= tolerance) return false;
  std::printf("expected  %.12e\n", expected);
  return true;
}

int main(int count, char** arguments) {
  const bool compared = count < 2 || std::atoi(arguments[1]) <= 0;
  const Mesh mesh(compared ? 16 : std::atoi(arguments[1]));
  std::vector<double> coordinates;
  for (int p = 0; p < mesh.nodes(); ++p) coordinates.insert(coordinates.end(), {mesh.at(p)[0], mesh.at(p)[1]});

  signorini::SolverOptions options;
  options.tolerance = 1e-12;
  signorini::BlackBox solver(stiffness(mesh), 2, options, signorini::rigid_body_modes<2>(coordinates));
  solver.set_obstacles<2>({floor_below(mesh)});

  const std::size_t unknowns = 2 * static_cast<std::size_t>(mesh.nodes());
  std::vector<double> lower(unknowns, -HUGE_VAL), upper(unknowns, HUGE_VAL), load(unknowns, 0.0);
  move_top(mesh, lower, upper);
  const auto result = solver.solve(load, lower, upper);
  if (!result.summary.converged()) {
    std::printf("%s\n", result.summary.reason.c_str());
    return 1;
  }
  double force[2] = {};  // of the floor on the block
  for (int i = 0; i <= mesh.columns; ++i)
    for (int k = 0; k < 2; ++k) force[k] += result.multiplier[2 * mesh.node(i, 0) + k];
  std::printf("%zu unknowns on %zu levels, %d cycles; %zu nodes on the floor\n", unknowns,
              result.summary.level_unknowns.size(), result.summary.iterations, result.touching.size());
  if (!compared) return 0;
  bool wrong = differs("energy", result.summary.energy, 0.0011308034481109647);
  wrong = differs("force x", force[0], -0.0065081163559104335) || wrong;
  wrong = differs("force y", force[1], 0.0730729357028616) || wrong;
  return wrong ? 1 : 0;
}
