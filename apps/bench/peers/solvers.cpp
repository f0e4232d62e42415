#include "apps/bench/peers/solvers.hpp"

#include "apps/bench/peers/accuracy.hpp"
#include "apps/bench/peers/active_set.hpp"
#include "apps/bench/peers/ipopt.hpp"
#include "apps/bench/peers/petsc.hpp"
#include "apps/bench/processor_time.hpp"

namespace signorini::bench {
namespace {

const PetscPreconditioner gamg{"-pc_type gamg"}, ml{"-pc_type ml"};
const PetscPreconditioner rigid_gamg{"-pc_type gamg", false, true};
const PetscPreconditioner grid{
    "-mg_levels_ksp_type richardson -mg_levels_ksp_max_it 1 -mg_levels_pc_type sor -mg_coarse_ksp_type preonly "
    "-mg_coarse_pc_type lu",
    true};

class Listing {
 public:
  Listing(const std::string& problem, const Benchmark& benchmark)
      : instance_(benchmark.instance), elastic_(instance_.block > 1), boomeramg_(boomeramg(problem)) {
    with_meshes(benchmark);
    without_bounds(benchmark);
    with_matrix();
    add("signorini AMG-CG", Given::matrix, false, algebraic_cg(instance_));
  }

  std::vector<Contestant> take() { return std::move(out_); }

 private:
  void with_meshes(const Benchmark& benchmark) {
    add("signorini", Given::meshes, true, benchmark.nested);
    newton("multigrid", grid, true);
    newton("BoomerAMG", boomeramg_, true);
    if (elastic_) newton("ML", ml, true);
    sets("BoomerAMG", boomeramg_);
    sets("GAMG", gamg);
    if (elastic_) sets("GAMG with rigid modes", rigid_gamg);
    sets("ML", ml);
#ifdef SIGNORINI_AMGCL
    sets("AMGCL", amgcl(), {}, Given::meshes);
#endif
    sets("CHOLMOD", cholmod_solver, {}, Given::meshes);
  }

  void without_bounds(const Benchmark& benchmark) {
    add("signorini multigrid-CG", Given::meshes, false, benchmark.multigrid_cg);
    cg("multigrid", grid);
    cg("BoomerAMG", boomeramg_);
    cg("GAMG", gamg);
    if (elastic_) cg("GAMG with rigid modes", rigid_gamg);
    cg("ML", ml);
#ifdef SIGNORINI_AMGCL
    add("AMGCL-CG", Given::meshes, false,
        [this_instance = &instance_, make = amgcl()](double t) { return linear(*this_instance, make, t); });
#endif
  }

  void with_matrix() {
    const ActiveSetOptions renewed{1e-2, 1, false}, lagged{1e-1, 10, false};
    add("signorini black box", Given::matrix, true, black_box(instance_));
    newton("BoomerAMG", boomeramg_, false);
    if (elastic_) newton("ML", ml, false);
    sets("BoomerAMG", boomeramg_, renewed);
    if (elastic_) sets("GAMG", gamg, lagged);
#ifdef SIGNORINI_AMGCL
    sets("AMGCL", amgcl(), lagged, Given::matrix);
#endif
    sets("CHOLMOD", cholmod_solver, renewed, Given::matrix);
    add("IPOPT", Given::matrix, true, [this_instance = &instance_](double t) { return ipopt(*this_instance, t); });
  }

  void add(std::string name, Given given, bool bounded, Solver solver) {
    out_.push_back({std::move(name), given, bounded, std::move(solver)});
  }

  void newton(const std::string& name, const PetscPreconditioner& by, bool nested) {
    add(std::string("PETSc SNESVI, ") + (nested ? "grid sequencing, " : "") + name,
        nested ? Given::meshes : Given::matrix, true,
        [&instance = instance_, by, nested](double t) { return petsc_newton(instance, by, nested, t); });
  }

  void cg(const std::string& name, const PetscPreconditioner& by) {
    add("PETSc CG, " + name, Given::meshes, false,
        [&instance = instance_, by](double t) { return petsc_cg(instance, by, t); });
  }

  void sets(const std::string& name, const PetscPreconditioner& by, const ActiveSetOptions& options = {}) {
    add((options.nested ? "nested active sets, " : "active sets, ") + name,
        options.nested ? Given::meshes : Given::matrix, true,
        [&instance = instance_, by, options](double t) { return petsc_active_set(instance, by, options, t); });
  }

  void sets(const std::string& name, const MakeLinearSolver& make, const ActiveSetOptions& options, Given given) {
    add((options.nested ? "nested active sets, " : "active sets, ") + name, given, true,
        [&instance = instance_, make, options](double t) { return active_set(instance, make, options, t); });
  }

#ifdef SIGNORINI_AMGCL
  MakeLinearSolver amgcl() const {
    return [block = instance_.block] { return amgcl_solver(block); };
  }

  static Attempt linear(const Instance& instance, const MakeLinearSolver& make, double tolerance) {
    Attempt out;
    const ProcessorTime time;
    const auto solver = make();
    solver->set_up(instance.finest().A, instance.levels.back().coordinates);
    out.x.assign(instance.free_load.size(), 0.0);
    out.iterations = solver->solve(instance.free_load, out.x, tolerance);
    out.seconds = time.elapsed();
    return out;
  }
#endif

  const Instance& instance_;
  bool elastic_;
  PetscPreconditioner boomeramg_;
  std::vector<Contestant> out_;
};

}  // namespace

PetscPreconditioner boomeramg(const std::string& problem) {
  const std::string set = " -pc_hypre_boomeramg_", extended = set + "interp_type ext+i" + set + "P_max 4";
  if (problem == "S2") return {"-pc_type hypre"};
  if (problem == "S3")
    return {"-pc_type hypre" + set + "coarsen_type PMIS" + set + "strong_threshold 0.25" + set + "agg_nl 1" + extended};
  return {"-pc_type hypre" + set + "coarsen_type HMIS" + set + "strong_threshold 0.5" + extended};
}

std::vector<Contestant> contestants(const std::string& problem, const Benchmark& benchmark) {
  return Listing(problem, benchmark).take();
}

}  // namespace signorini::bench
