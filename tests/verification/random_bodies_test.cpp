// Bodies that fixes and obstacles may or may not hold against their loads, at random. A linear programme of rigid
// motions, written for this test, says which of them have a solution: those are solved, the others are refused.
#include <Eigen/Dense>

#include "core/algebra/products.hpp"
#include "core/base/error.hpp"
#include "core/fem/elements/element.hpp"
#include "random_body.hpp"
#include "run.hpp"

namespace signorini::test {
namespace {

/// The least sum of the components of |w - sum of lambda_i g_i| with lambda >= 0 over |w|: the first phase of the
/// simplex method with Bland's rule. g: one per column.
double distance_to_cone(const Eigen::MatrixXd& g, const Eigen::VectorXd& w) {
  const Eigen::Index m = g.rows(), n = g.cols();
  Eigen::VectorXd sign = w.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; });
  std::vector<Eigen::Index> basis;
  for (Eigen::Index i = 0; i < m; ++i) basis.push_back(n + i);
  const auto column = [&](Eigen::Index j) -> Eigen::VectorXd {
    return j < n ? Eigen::VectorXd(g.col(j)) : Eigen::VectorXd(sign[j - n] * Eigen::VectorXd::Unit(m, j - n));
  };
  for (int round = 0; round < 10000; ++round) {
    Eigen::MatrixXd B(m, m);
    Eigen::VectorXd cost(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      B.col(i) = column(basis[static_cast<std::size_t>(i)]);
      cost[i] = basis[static_cast<std::size_t>(i)] >= n;
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(B);
    const Eigen::VectorXd value = lu.solve(w), y = lu.transpose().solve(cost);
    Eigen::Index enter = 0;
    while (enter < n && !(y.dot(g.col(enter)) > 1e-11 * (1 + y.norm()))) ++enter;
    if (enter == n) return cost.dot(value) / w.norm();
    const Eigen::VectorXd change = lu.solve(column(enter));
    Eigen::Index leave = -1;
    double step = infinity;
    for (Eigen::Index i = 0; i < m; ++i) {
      if (!(change[i] > 1e-11)) continue;
      const double t = std::max(value[i], 0.0) / change[i];
      if (t < step || (t == step && basis[static_cast<std::size_t>(i)] < basis[static_cast<std::size_t>(leave)]))
        step = t, leave = i;
    }
    if (leave < 0) return infinity;
    basis[static_cast<std::size_t>(leave)] = enter;
  }
  return std::nan("");
}

/// How a displacement d at x works along the rigid motions about the origin.
template <int D>
Eigen::VectorXd modes(const Point<D>& x, const Point<D>& d) {
  Eigen::VectorXd out(D == 2 ? 3 : 6);
  for (int i = 0; i < D; ++i) out[i] = d[i];
  if constexpr (D == 2) {
    out[2] = x[0] * d[1] - x[1] * d[0];
  } else {
    const Point<3> turn = cross(x, d);
    for (int i = 0; i < 3; ++i) out[3 + i] = turn[i];
  }
  return out;
}

/// What the loads would do along the motions that fixes leave free and obstacles do not end, over their size: 0 where
/// there is a solution. A judge of its own: it shares the mesh with the program, and nothing else.
template <int D>
double unheld(const RandomBody<D>& body, const Mesh<D>& mesh) {
  const auto faces_on = [&](const std::string& name) {
    for (const Part& part : mesh.parts)
      if (part.name == name) return part.faces;
    std::vector<Index> all;
    for (std::size_t f = 0; f < mesh.boundary.size(); ++f) all.push_back(static_cast<Index>(f));
    return all;
  };
  std::vector<Eigen::VectorXd> held;
  if (!body.fixed_part.empty())
    for (const Index f : faces_on(body.fixed_part))
      for (const Index v : mesh.boundary[f].vertices)
        for (int i = 0; i < D; ++i) {
          Point<D> axis{};
          axis[i] = 1;
          if (body.fixed[i]) held.push_back(modes<D>(mesh.points[v], axis));
        }
  const Eigen::Index n = D == 2 ? 3 : 6;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(std::ssize(held), 1), n);
  for (std::size_t k = 0; k < held.size(); ++k) H.row(static_cast<Eigen::Index>(k)) = held[k].transpose();
  Eigen::FullPivLU<Eigen::MatrixXd> lu(H);
  lu.setThreshold(1e-9);
  if (lu.rank() == n) return 0;
  const Eigen::MatrixXd free = lu.kernel();

  Eigen::VectorXd work = Eigen::VectorXd::Zero(n);
  double size = 0;
  for (const auto& e : mesh.elements) {
    const double volume = linear_element(mesh, e).measure;
    work += volume * modes<D>(centroid<D>(mesh, e), body.body_force);
    size += volume * std::sqrt(dot(body.body_force, body.body_force));
  }
  if (body.traction != Point<D>{})
    for (const Index f : faces_on(body.traction_part)) {
      const Face<D>& face = mesh.boundary[f];
      Point<D> n_area = area_normal(mesh, face), middle{};
      for (const Index v : face.vertices) middle = sum<D>(middle, scaled<D>(1.0 / D, mesh.points[v]));
      const double area = normalise(n_area);
      work += area * modes<D>(middle, body.traction);
      size += area * std::sqrt(dot(body.traction, body.traction));
    }
  const Eigen::VectorXd w = free.transpose() * work;
  if (w.norm() <= 1e-12 * size) return 0;

  std::vector<Eigen::VectorXd> normals;
  for (const RandomObstacle<D>& o : body.obstacles)
    for (const Index f : faces_on(o.part))
      for (const Index v : mesh.boundary[f].vertices) {
        Point<D> normal = o.normal;
        if (!o.plane) {
          normal = sum<D>(mesh.points[v], scaled<D>(-1, o.point));
          normalise(normal);
          if (o.inside) normal = scaled<D>(-1, normal);
        }
        normals.push_back(free.transpose() * modes<D>(mesh.points[v], normal));
      }
  // Forces along the normals balance the loads: -w = sum of lambda n, lambda >= 0.
  Eigen::MatrixXd g(w.size(), std::ssize(normals));
  for (Eigen::Index k = 0; k < g.cols(); ++k) g.col(k) = normals[static_cast<std::size_t>(k)];
  return distance_to_cone(g, -w) * w.norm() / size;
}

struct Tally {
  int solved = 0, crowded = 0, crowded_by_sets = 0, refused = 0, near = 0, blocked = 0, turned = 0, inaccurate = 0,
      wrong = 0;
};

/// The normal of an obstacle at a point of the undeformed body, towards it, and how far the point is from it.
template <int D>
std::pair<Point<D>, double> seen_from(const RandomObstacle<D>& o, const Point<D>& x) {
  const Point<D> away = sum<D>(x, scaled<D>(-1, o.point));
  if (o.plane) return {o.normal, dot(away, o.normal)};
  Point<D> normal = away;
  const double length = normalise(normal);
  return o.inside ? std::pair{scaled<D>(-1, normal), o.radius - length} : std::pair{normal, length - o.radius};
}

/// What is left of the force f when obstacles push along the normals: by all sets of up to D of them.
template <int D>
double unbalanced(const std::vector<Eigen::Matrix<double, D, 1>>& normals, const Eigen::Matrix<double, D, 1>& f) {
  double least = f.norm();
  for (unsigned set = 1; set < 1u << normals.size(); ++set) {
    Eigen::Matrix<double, D, Eigen::Dynamic> N(D, 0);
    for (std::size_t k = 0; k < normals.size(); ++k)
      if (set >> k & 1u) {
        N.conservativeResize(D, N.cols() + 1);
        N.rightCols(1) = normals[k];
      }
    if (N.cols() > D) continue;
    const Eigen::VectorXd part = N.completeOrthogonalDecomposition().solve(f);
    if (part.minCoeff() >= 0) least = std::min(least, (N * part - f).norm());
  }
  return least;
}

/// The largest force that is out of balance over the largest that acts, or over what rounding makes of elastic forces
/// where that is more: free components carry none, obstacles only push. In global coordinates and with the obstacles as
/// the scene has them: nothing here knows how the program stores them. Adds to `crowded` whether obstacles met at a
/// vertex along more directions than there are dimensions, or along nearly parallel ones.
template <int D>
double imbalance(const RandomBody<D>& body, const Mesh<D>& mesh, Model<D> model, const Solution<D>& solution,
                 bool& crowded) {
  using Vector = Eigen::Matrix<double, D, 1>;
  model.obstacles.clear();
  model.fixes.clear();
  const DiscreteProblem<D> problem = discretize(mesh, model).problem;
  const std::vector<double> u = to_global(solution.discretization.problem, solution.x);
  std::vector<double> r(u.size());
  residual<D>(problem.A, u.data(), problem.b.data(), r.data());
  double worst = 0, load = 0, stiffest = 0, farthest = 0, deepest = 0;
  for (Index p = 0; p < problem.A.size(); ++p)
    for (int k = 0; k < D; ++k) {
      load = std::max(load, std::abs(problem.b[Offset{p} * D + k]));
      stiffest = std::max(stiffest, problem.A.diagonal(p)[k * (D + 1)]);
      farthest = std::max(farthest, std::abs(u[Offset{p} * D + k]));
    }
  const auto on = [&](const std::string& part) {
    std::vector<char> out(mesh.points.size());
    const auto take = [&](Index f) {
      for (const Index v : mesh.boundary[f].vertices) out[v] = 1;
    };
    bool named = false;
    for (const Part& known : mesh.parts)
      if (known.name == part) {
        named = true;
        for (const Index f : known.faces) take(f);
      }
    if (!named)
      for (std::size_t f = 0; f < mesh.boundary.size(); ++f) take(static_cast<Index>(f));
    return out;
  };
  double acting = load;  // or what an obstacle presses with
  std::vector<std::vector<char>> acts;
  for (const auto& o : body.obstacles) acts.push_back(on(o.part));
  const std::vector<char> fixed = body.fixed_part.empty() ? std::vector<char>(mesh.points.size()) : on(body.fixed_part);
  for (Index p = 0; p < problem.A.size(); ++p) {
    const auto restricted = [&](const double* v) {
      Vector out;
      for (int k = 0; k < D; ++k) out[k] = fixed[p] && body.fixed[k] ? 0 : v[k];
      return out;
    };
    std::vector<Vector> normals, here;
    for (std::size_t o = 0; o < body.obstacles.size(); ++o) {
      if (!acts[o][p]) continue;
      const auto [normal, distance] = seen_from<D>(body.obstacles[o], mesh.points[p]);
      double gap = distance;
      for (int k = 0; k < D; ++k) gap += normal[k] * u[Offset{p} * D + k];
      deepest = std::max(deepest, -gap / (1 + farthest));
      here.push_back(restricted(normal.data()));
      if (gap > 1e-11 * (1 + farthest)) continue;
      normals.push_back(here.back());
      acting = std::max(acting, restricted(r.data() + Offset{p} * D).norm());
    }
    crowded = crowded || here.size() > D;
    for (std::size_t i = 0; i < here.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        crowded = crowded || std::abs(here[i].dot(here[j])) > 0.9998 * here[i].norm() * here[j].norm();
    worst = std::max(worst, unbalanced<D>(normals, -restricted(r.data() + Offset{p} * D)));
  }
  if (deepest > 1e-11) return infinity;
  return worst / std::max(acting, 1e-10 * stiffest * farthest);
}

/// Whether rounding of displacements that all of the body moves by may be forces of a thousandth of the loads.
template <int D>
bool rounding_is_felt(const Discretization<D>& d, const std::vector<double>& u) {
  double load = 0, stiffest = 0, farthest = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    load = std::max(load, std::abs(d.load[i]));
    stiffest = std::max(stiffest, d.problem.A.diagonal(static_cast<Index>(i / D))[i % D * (D + 1)]);
    farthest = std::max(farthest, std::abs(u[i]));
  }
  return std::numeric_limits<double>::epsilon() * stiffest * farthest > 1e-3 * load;
}

/// What is wrong with recovered pressures, whatever the contact is: edges, corners, single nodes.
template <int D>
std::string odd_pressures(const Mesh<D>& mesh, const Model<D>& model, const Solution<D>& solution) {
  const Nodes<D> nodes(mesh);
  const ContactState<D> state = contact_state<D, D>(nodes, model, solution.discretization, solution.x);
  for (std::size_t o = 0; o < state.obstacles.size(); ++o) {
    double largest = 0, reach = 0, most = 0;
    for (const ContactNode<D>& node : state.nodes) {
      if (node.obstacle != static_cast<Index>(o)) continue;
      largest = std::max(largest, node.pressure);
      most = std::max(most, node.recovered);
      if (node.contact && node.pressure > 0) reach += D * node.area;  // all of the faces around it
      if (!(node.recovered >= 0) || (!node.contact && node.recovered != 0))
        return fmt::format("a pressure of {} at node {}", node.recovered, node.vertex);
    }
    const ContactSummary<D>& sum = state.obstacles[o];
    if (!(most <= 1.25 * largest * (1 + 1e-12)) || sum.max_pressure != most)
      return fmt::format("a pressure of {}, {} of the nodes'", most, largest);
    if (!(sum.area >= 0 && sum.area <= reach * (1 + 1e-12)) || (largest > 0 && sum.area == 0))
      return fmt::format("{} in contact, {} within reach", sum.area, reach);
  }
  return "";
}

template <int D>
void judge_one(std::uint64_t seed, Bodies bodies, Tally& tally) {
  const RandomBody<D> body(seed, bodies);
  const Scene scene = parse_scene(body.text, "test.toml", ".", {});
  Registry registry = solver_components();
  load_plugins(scene, registry);
  Times times;
  const Progress quiet;
  const MeshHierarchy<D> meshes = build_hierarchy<D>(scene, D);
  const double by = unheld<D>(body, meshes.finest());
  if (by > 1e-12 && by < 1e-9) return void(++tally.near);
  const bool expected = by <= 1e-12;
  std::string found;
  try {
    NestedSolver<D, D> solver(meshes, scene.solver, registry, quiet, times);
    const Model<D> model = build_model<D>(scene, D, registry, 1);
    const Solution<D> solution = solver.solve(model);
    const bool converged = solution.summary.converged();
    bool crowded = false;
    const double off = expected && converged ? imbalance<D>(body, meshes.finest(), model, solution, crowded)
                       : expected            ? infinity
                                             : 0;
    // Where rounding hides the forces it is said that there is no solution to the tolerance, in one way or another:
    // what counts as limited by rounding a run refuses once it finds that the forces do not balance.
    const bool limited = !converged || solution.summary.outcome == Outcome::rounding;
    if (!(off <= 1e-4) && limited && rounding_is_felt<D>(solution.discretization, solution.x))
      ++tally.inaccurate;
    else if (!converged)
      found = "not converged: " + solution.summary.reason;
    else if (!expected)
      found = "solved";
    else if (!(off <= 1e-4))
      found = fmt::format("forces out of balance by {}", off);
    else if (const std::string odd = odd_pressures<D>(meshes.finest(), model, solution); !odd.empty())
      found = odd;
    else
      ++tally.solved, tally.crowded += crowded,
          tally.crowded_by_sets += crowded && solution.summary.stages.back().method == "pdas";
  } catch (const Error& error) {
    if (error.status() == Exit::no_solution && !expected)
      ++tally.refused;
    else if (body.moved && std::string(error.what()).find("no solution at (") != std::string::npos)
      ++tally.blocked;
    else if (expected && std::string(error.what()).find("only where it has turned by") != std::string::npos)
      ++tally.turned;
    else
      found = error.what();
  }
  if (found.empty()) return;
  ++tally.wrong;
  ADD_FAILURE() << "seed " << seed << ": the judge says " << (expected ? "held" : "free") << " (" << by
                << "), found: " << found << '\n'
                << (std::getenv("SHOW") ? body.text : "");
}

struct Seeds {
  int first, last;
};

/// RANDOM_BODIES: how many instead of a few hundred, or the first and the last one, as in 601-700. SHOW prints those
/// that went wrong.
Seeds seeds(int few) {
  const char* wanted = std::getenv("RANDOM_BODIES");
  if (!wanted) return {1, few};
  const std::string text = wanted;
  const std::size_t dash = text.find('-');
  if (dash == std::string::npos) return {1, std::stoi(text)};
  return {std::stoi(text.substr(0, dash)), std::stoi(text.substr(dash + 1))};
}

template <int D>
void judge_all(int few, Bodies bodies) {
  const auto [first, last] = seeds(few);
  Tally tally;
  for (int seed = first; seed <= last; ++seed) judge_one<D>(static_cast<std::uint64_t>(seed), bodies, tally);
  show(
      "{}D: {} solved, {} of them with crowded vertices, {} refused, {} too near to tell, {} moved into obstacles, "
      "{} too stiff, {} wrong\n",
      D, tally.solved, tally.crowded, tally.refused, tally.near, tally.blocked, tally.inaccurate, tally.wrong);
  if (last - first < 50) return;  // too few to tell
  EXPECT_GT(tally.solved, (last - first) / 10);
  EXPECT_GT(tally.refused, (last - first) / 10);
  EXPECT_GT(tally.crowded, (last - first) / 50);
}

// Stiff bodies that fall far beside what they deform.
TEST(RandomBodies, FarAwayFromWhereTheyBegin) {
  Tally tally;
  for (const int seed : {625, 1637}) judge_one<2>(static_cast<std::uint64_t>(seed), Bodies::soft, tally);
  for (const int seed : {432, 1345, 2088, 3210, 4285, 4941})
    judge_one<3>(static_cast<std::uint64_t>(seed), Bodies::soft, tally);
  show("{} solved, {} refused, {} too near to tell, {} too stiff\n", tally.solved, tally.refused, tally.near,
       tally.inaccurate);
  EXPECT_EQ(tally.solved, 7);
  EXPECT_EQ(tally.turned, 1);
}

// An obstacle on the wrong side of its faces holds the body after hundreds of turns: what rounding leaves of the forces
// there decides nothing.
TEST(RandomBodies, ThatTurnTooFarAreRefused) {
  Tally tally;
  judge_one<2>(11, Bodies::stiff_and_moved, tally);
  EXPECT_EQ(tally.turned, 1);
}

// Cycles are slow here, and obstacles meet at vertices along more directions than there are dimensions.
TEST(RandomBodies, AreSolvedByActiveSetsToo) {
  Tally tally;
  judge_one<3>(479, Bodies::soft, tally);
  judge_one<2>(1912, Bodies::soft, tally);
  judge_one<3>(1433, Bodies::soft, tally);
  judge_one<3>(1657, Bodies::stiff_and_moved, tally);
  EXPECT_EQ(tally.solved, 4);
  EXPECT_EQ(tally.crowded_by_sets, 3);
}

// Two obstacles hold an edge of the body between them, with forces that are small beside stiffness times way; it may
// turn about that edge.
TEST(RandomBodies, KeepTheirForcesWhereAMotionIsLeft) {
  Tally tally;
  judge_one<3>(730, Bodies::stiff_and_moved, tally);
  EXPECT_EQ(tally.solved, 1);
}

TEST(RandomBodies, AreSolvedOrRefusedAsALinearProgrammeSays2D) { judge_all<2>(250, Bodies::soft); }
TEST(RandomBodies, AreSolvedOrRefusedAsALinearProgrammeSays3D) { judge_all<3>(100, Bodies::soft); }
TEST(RandomBodies, AreMovedHoweverStiffTheyAre2D) { judge_all<2>(250, Bodies::stiff_and_moved); }
TEST(RandomBodies, AreMovedHoweverStiffTheyAre3D) { judge_all<3>(100, Bodies::stiff_and_moved); }

}  // namespace
}  // namespace signorini::test
