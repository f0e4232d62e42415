#include "core/io/report_rows.hpp"

#include <iterator>
#include <numbers>
#include <utility>

#include "core/component/libraries.hpp"
#include "core/solver/option_table.hpp"

namespace signorini::report {
namespace {

Json warnings(const Report& report, const auto& of) {
  Json list = Json::array();
  for (const Warning& warning : report.warnings) list.push_back(of(warning));
  return list;
}

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Index unknowns(const Summary& summary) { return summary.level_unknowns.empty() ? 0 : summary.level_unknowns.back(); }

bool limited_by_rounding(const Summary& summary) {
  return summary.outcome == Outcome::rounding || summary.outcome == Outcome::inaccurate;
}

/// A level with its number.
struct Size {
  int level;
  Index unknowns;
};
struct Phases {
  int level;
  LevelReport done;
};

struct Cycle {
  const Summary& summary;
  const IterationRecord& record;
};

std::vector<Size> sizes(const Summary& summary) {
  std::vector<Size> all;
  for (std::size_t k = 0; k < summary.level_unknowns.size(); ++k)
    all.push_back({summary.level_number(k), summary.level_unknowns[k]});
  return all;
}

std::vector<Phases> phases(const Cycle& cycle) {
  std::vector<Phases> all;
  for (std::size_t k = 0; k < cycle.record.levels.size(); ++k)
    all.push_back({cycle.summary.level_number(k), cycle.record.levels[k]});
  return all;
}

std::vector<Cycle> cycles(const Summary& summary) {
  std::vector<Cycle> all;
  for (const IterationRecord& record : summary.history) all.push_back({summary, record});
  return all;
}

}  // namespace

template <>
struct Table<Size> {
  static constexpr const char* name = "level";
  static std::vector<Row<Size>> rows() {
    return {
        member("level", &Size::level, "0 is the coarsest mesh; levels below it, by the matrix, are -1, -2 and so on"),
        member("unknowns", &Size::unknowns, "free unknowns")};
  }
};

template <>
struct Table<Phases> {
  static constexpr const char* name = "level_of_cycle";
  static std::vector<Row<Phases>> rows() {
    std::vector<Row<Phases>> all{member("level", &Phases::level, "its number, as in `levels`")};
    const std::vector<Row<LevelReport>> done{
        member("vectors", &LevelReport::vectors,
               "the level's vectors: unknowns that belong together, as those of a node"),
        member("critical", &LevelReport::critical, "those with a direction in contact"),
        {{"contact", Kind::numbers, "contact by direction"}, [](const LevelReport& l) -> Json { return l.contact; }},
        member("changed", &LevelReport::changed, "vectors whose phase changed"),
        member("renewed", &LevelReport::renewed, "rows of the matrix that were recomputed"),
        member("seconds", &LevelReport::seconds, "the time without the coarser levels")};
    add(all, of_part<Phases>(done, [](const Phases& p) -> const LevelReport& { return p.done; }));
    return all;
  }
};

template <>
struct Table<Cycle> {
  static constexpr const char* name = "cycle";
  static std::vector<Row<Cycle>> rows() {
    using R = IterationRecord;
    const std::vector<Row<R>> of_record{
        member("iteration", &R::iteration, "its number, from 1"),
        {{"stage", Kind::whole, "the number of its stage, from 0"}, [](const R& r) -> Json { return r.stage; }},
        member("residual", &R::residual, "the natural residual over its value at the projected zero"),
        member("algebraic_error", &R::algebraic_error, "estimate of the relative error in the energy norm"),
        member("energy", &R::energy, "of the iterate"),
        member("contact_nodes", &R::contact_nodes, "nodes with a direction in contact"),
        member("changed", &R::changed, "nodes whose phase has changed since the last cycle")};
    std::vector<Row<Cycle>> all = of_part<Cycle>(of_record, [](const Cycle& c) -> const R& { return c.record; });
    all.push_back(
        {{"levels", Kind::objects, "what it did on each level, coarsest first", false, false, &object_spec<Phases>},
         [](const Cycle& c) { return as_objects(phases(c)); }});
    return all;
  }
};

template <>
struct Table<Stage> {
  static constexpr const char* name = "stage";
  static std::vector<Row<Stage>> rows() {
    return {
        member("method", &Stage::method, "as of `solver`"),
        {{"linear", Kind::text, "the linear solver of methods that need one", true},
         [](const Stage& s) { return text_or_null(s.linear); }},
        member("iterations", &Stage::iterations,
               "those that count in `iterations`; 0 of methods that \"auto\" goes on with"),
        member("linear_solves", &Stage::linear_solves,
               "on the finest level, up to three for `rounding_error` included"),
        member("factorisations", &Stage::factorisations, "on the finest level, set-ups of preconditioners included"),
        member("seconds", &Stage::seconds, "the time that it took"),
        {{"outcome", Kind::text, "how it ended: \"solved\", \"iteration limit\", \"interrupted\" and so on"},
         [](const Stage& s) -> Json { return outcome_name(s.outcome); }},
        member("reason", &Stage::reason, "why it ended"),
        member("kept", &Stage::kept, "false: the next stage started where this one had")};
  }
};

template <>
struct Table<SolverOptions> {
  static constexpr const char* name = "solver";
  static std::vector<Row<SolverOptions>> rows() {
    std::vector<Row<SolverOptions>> all;
    for (const auto& option : option_table())
      std::visit([&](auto of) { all.push_back(member(option.name, of, option.help)); }, option.member);
    return all;
  }
};

namespace {

Row<Summary> reason() {
  return member("reason", &Summary::reason, "why the solve ended, with the value and the threshold that it met");
}

std::vector<Row<Summary>> figures() {
  return {
      {{"unknowns", Kind::whole, "free unknowns on the finest level"},
       [](const Summary& s) -> Json { return unknowns(s); }},
      member("iterations", &Summary::iterations,
             "cycles on the finest level; with method \"pdas\" or \"newton\" its steps"),
      member("residual", &Summary::residual, "the natural residual over its value at the projected zero"),
      member("algebraic_error", &Summary::algebraic_error,
             "estimate of the relative error of the algebraic solution in the energy norm"),
      member("rate", &Summary::rate,
             "mean reduction of the corrections' energy norm over the last four cycles with one above rounding; null "
             "where there are not two"),
      member("energy", &Summary::energy, "1/2 x'Ax - b'x, and what friction and other functionals add"),
      member("linear_phase_from", &Summary::linear_phase_from, "the first cycle from which no phase changed; 0: none"),
      {{"limited_by_rounding", Kind::flag, "as far as the machine's precision allows, which is not to the tolerance"},
       [](const Summary& s) -> Json { return limited_by_rounding(s); }},
      member("rounding_error", &Summary::rounding_error,
             "part of `algebraic_error` that no iteration removes; 0: far below the tolerance")};
}

std::vector<Row<Summary>> work() {
  return {objects("stages", &Summary::stages, "the methods in the order in which they ran"),
          object("solver", &Summary::options, "the options of the solver, with the method that \"auto\" stood for")};
}

Row<Summary> levels() {
  return {{"levels", Kind::objects, "the sizes of all levels, coarsest first", false, false, &object_spec<Size>},
          [](const Summary& s) { return as_objects(sizes(s)); }};
}

Row<Summary> history() {
  return {{"history", Kind::objects, "all cycles of the stages that were kept; energies rise where a method lets them",
           false, false, &object_spec<Cycle>},
          [](const Summary& s) { return as_objects(cycles(s)); }};
}

}  // namespace

template <>
struct Table<PairReport> {
  static constexpr const char* name = "pair";
  static std::vector<Row<PairReport>> rows() {
    return {member("slave", &PairReport::slave, "the body whose nodes the condition is at"),
            member("master", &PairReport::master, "the other body"),
            member("reason", &PairReport::reason, "why this one is the slave")};
  }
};

template <>
struct Table<BoltReport> {
  static constexpr const char* name = "bolt";
  static std::vector<Row<BoltReport>> rows() {
    using B = BoltReport;
    return {member("force", &B::force, "that it pulls by; negative: it is pushed"),
            member("shortening", &B::shortening,
                   "length by which the two sides of the cut are pulled into each other, the same all over it"),
            member("locked", &B::locked,
                   "whether the shortening is that of an earlier step; then the force is what comes of it, else it is "
                   "`pretension`")};
  }
};

template <>
struct Table<ContactReport> {
  static constexpr const char* name = "contact";
  static std::vector<Row<ContactReport>> rows() {
    using C = ContactReport;
    std::vector<Row<C>> all{
        member("obstacle", &C::obstacle, "number of the scene's `[[obstacle]]`, from 0"),
        member("body", &C::body, "the body that it acts on"),
        member("nodes", &C::nodes, "nodes in contact, or tied"),
        member("tied", &C::tied, "whether the two bodies are tied to each other"),
        member("open_nodes", &C::open_nodes, "nodes that it may reach besides"),
        member("area", &C::area, "of the contact, up to its edge within faces; in 2D a length"),
        member("radius", &C::radius, "of a disk of that area; in 2D half the length"),
        member("force", &C::force, "what the obstacle exerts on the body"),
        member("max_pressure", &C::max_pressure, "the largest recovered pressure"),
        member("resolved", &C::resolved, "whether there are nodes enough inside the contact for pressures"),
        member("slip_nodes", &C::slip_nodes, "of those in contact, where there is friction: those that slip"),
        member("stick_nodes", &C::stick_nodes, "and those that stick"),
        member("normal_force", &C::normal_force,
               "the part of `force` along the obstacle's normals, as a sum of vectors"),
        member("tangential_force", &C::tangential_force, "and the part across them"),
        member("moment", &C::moment,
               "of `force`, with undeformed positions (of bodies that have moved past each other or an obstacle: "
               "where they touch): about the z-axis in 2D, else three entries; of scalar bodies none"),
        member("moment_about", &C::moment_about,
               "the point that the moment is about: the `point` of a plane, the `center` of a round shape, else the "
               "origin"),
        member("motion", &C::motion, "how far that point of a rigid obstacle has moved since t = 0"),
        member("dissipated_in_step", &C::dissipated_in_step, "work of friction in this step, never negative"),
        member("dissipated", &C::dissipated, "the same since the first step"),
        member(
            "displacement", &C::displacement,
            "mean of the nodes that the obstacle may reach, weighted by their area; of two bodies those of the slave"),
        member("undetermined_nodes", &C::undetermined_nodes,
               "of those in contact, held by a fix along the obstacle's normal: what presses counts as the obstacle's"),
        member("undetermined_force", &C::undetermined_force, "the sum of the forces that press there"),
        member("largest_penetration", &C::largest_penetration,
               "how far a node of the deformed body is inside the obstacle; null where the obstacle cannot tell"),
        member("largest_penetration_between_nodes", &C::penetration_between_nodes, "the same of points between nodes"),
        member("largest_opening", &C::largest_opening, "how far a node that counts as in contact is off the obstacle"),
        member("depth", &C::depth,
               "by how much more some nodes in contact have come along the obstacle's normal than others: what contact "
               "flattens"),
        {{"pair", Kind::object, "of two bodies which one is the slave, and why; else null", true, false,
          &object_spec<PairReport>},
         [](const C& c) { return c.pair ? as_object(*c.pair) : Json(nullptr); }}};
    // Keys that only two bodies have.
    all.push_back({{"beyond_nodes", Kind::whole,
                    "of two bodies: nodes in contact that the other one is no longer in front of", false, true},
                   [](const C& c) { return c.pair ? Json(c.beyond_nodes) : left_out(); }});
    all.push_back({{"other_force", Kind::numbers, "of two bodies: what the obstacle exerts on `other`", false, true},
                   [](const C& c) { return c.pair ? Json(c.pair->force) : left_out(); }});
    all.push_back({{"other_moment", Kind::numbers, "its moment about `moment_about`", false, true},
                   [](const C& c) { return c.pair ? Json(c.pair->moment) : left_out(); }});
    all.push_back({{"bolt", Kind::object, "of a tie with `pretension`: what the bolt does", false, true,
                    &object_spec<BoltReport>},
                   [](const C& c) { return c.bolt ? as_object(*c.bolt) : left_out(); }});
    return all;
  }
};

template <>
struct Table<ProbeReport> {
  static constexpr const char* name = "probe";
  static std::vector<Row<ProbeReport>> rows() {
    using P = ProbeReport;
    return {member("name", &P::name, "as in the scene"),
            {{"displacement", Kind::numbers, "of the point; elastic bodies", false, true},
             [](const P& p) { return p.value.size() == 1 ? left_out() : Json(p.value); }},
            {{"value", Kind::number, "at the point; scalar bodies", false, true},
             [](const P& p) { return p.value.size() == 1 ? Json(p.value.front()) : left_out(); }}};
  }
};

namespace {

/// Loads and fixes say the same under different names.
struct Reaction {
  ForceReport of;
};
struct Applied {
  ForceReport of;
};
struct SpringForce {
  ForceReport of;
};

template <class T>
std::vector<T> each(const std::vector<ForceReport>& forces) {
  std::vector<T> all;
  all.reserve(forces.size());
  for (const ForceReport& force : forces) all.push_back({force});
  return all;
}

template <class T>
std::vector<Row<T>> force_rows(const char* number, const char* of, const char* force) {
  const std::vector<Row<ForceReport>> rows{member(number, &ForceReport::number, of),
                                           member("force", &ForceReport::force, force)};
  return of_part<T>(rows, [](const T& t) -> const ForceReport& { return t.of; });
}

}  // namespace

namespace {

template <class T>
std::vector<Row<T>> holding_rows(const char* number, const char* of) {
  auto rows = force_rows<T>(number, of, "what it exerts on the body");
  rows.push_back({{"moment", Kind::numbers,
                   "of that about the origin, with the undeformed positions: about the z-axis in 2D, else three "
                   "entries; elastic bodies that are not of revolution",
                   false, true},
                  [](const T& t) { return t.of.moment.empty() ? left_out() : Json(t.of.moment); }});
  return rows;
}

}  // namespace

template <>
struct Table<Reaction> {
  static constexpr const char* name = "reaction";
  static std::vector<Row<Reaction>> rows() {
    return holding_rows<Reaction>("fix", "number of the scene's `[[fix]]`, from 0");
  }
};

template <>
struct Table<Applied> {
  static constexpr const char* name = "applied";
  static std::vector<Row<Applied>> rows() {
    auto rows = force_rows<Applied>("load", "number of the scene's `[[load]]`, from 0", "its sum");
    rows.push_back({{"open_area", Kind::number, "that it acts on; loads with `where_open`", false, true},
                    [](const Applied& a) { return a.of.open_area ? Json(*a.of.open_area) : left_out(); }});
    return rows;
  }
};

template <>
struct Table<SpringForce> {
  static constexpr const char* name = "spring";
  static std::vector<Row<SpringForce>> rows() {
    return holding_rows<SpringForce>("spring", "number of the scene's `[[spring]]`, from 0");
  }
};

template <>
struct Table<RigidReport> {
  static constexpr const char* name = "rigid";
  static std::vector<Row<RigidReport>> rows() {
    using R = RigidReport;
    return {
        member("rigid", &R::number, "number of the scene's `[[rigid]]`, from 0"),
        member("point", &R::point, "the point about which it turns, undeformed; an axisymmetric body needs none"),
        member("displacement", &R::displacement, "of the point"),
        member("rotation", &R::rotation, "in radians, about the z-axis in 2D, else three entries"),
        member("force", &R::force, "on the part: the applied force, or the force needed for a prescribed displacement"),
        member("torque", &R::torque,
               "about the point: the applied torque, or the torque needed for a prescribed rotation")};
  }
};

template <>
struct Table<BalanceReport> {
  static constexpr const char* name = "balance";
  static std::vector<Row<BalanceReport>> rows() {
    using B = BalanceReport;
    return {member("body", &B::body, "its name"),
            member("applied", &B::applied, "the sum of loads, and of forces on rigid parts"),
            member("reactions", &B::reactions,
                   "the sum of the forces of fixes and springs, and of those needed for prescribed displacements of "
                   "rigid parts"),
            member("contact", &B::contact, "the sum of the forces of obstacles"),
            {{"sum", Kind::numbers, "of all three: zero, apart from the algebraic error"},
             [](const B& b) -> Json { return b.sum(); }}};
  }
};

template <>
struct Table<BodyReport> {
  static constexpr const char* name = "body";
  static std::vector<Row<BodyReport>> rows() {
    using B = BodyReport;
    std::vector<Row<B>> all{
        member("name", &B::name, "as in the scene; for bodies that are solved together, their names"),
        {{"converged", Kind::flag, "whether it is solved"}, [](const B& b) -> Json { return b.summary.converged(); }}};
    std::vector<Row<Summary>> own = figures();
    std::erase_if(own, [](const Row<Summary>& row) {
      return row.key.name == "linear_phase_from" || row.key.name == "rounding_error";
    });
    own.push_back(reason());
    add(all, of_part<B>(own, [](const B& b) -> const Summary& { return b.summary; }));
    add(all, {member("axisymmetric", &B::axisymmetric, "whether it is; then results are those of the whole body"),
              member("axis_nodes", &B::axis_nodes, "nodes that the axis holds"),
              member("symmetry", &B::symmetry, "planes of symmetry, \"x = 0\"; results are those of the whole"),
              member("copies", &B::copies, "number of equal parts that the body has, of which one is meshed"),
              member("order", &B::order, "of its elements: 1 or 2"),
              {{"order_by", Kind::text, "\"scene\", or \"auto\" where the program chose it"},
               [](const B& b) -> Json { return b.order_chosen ? "auto" : "scene"; }}});
    return all;
  }
};

namespace {

/// What a step has found.
std::vector<Row<StepReport>> results() {
  using S = StepReport;
  return {objects("contact", &S::contact, "what each obstacle does"),
          objects("probes", &S::probes, "the solution at the scene's points"),
          {{"reactions", Kind::objects, "what each fix exerts", false, false, &object_spec<Reaction>},
           [](const S& s) { return as_objects(each<Reaction>(s.reactions)); }},
          {{"springs", Kind::objects, "what each spring exerts", false, false, &object_spec<SpringForce>},
           [](const S& s) { return as_objects(each<SpringForce>(s.springs)); }},
          {{"applied", Kind::objects, "the sum of each load", false, false, &object_spec<Applied>},
           [](const S& s) { return as_objects(each<Applied>(s.applied)); }},
          objects("rigid", &S::rigid, "how each rigid part has moved, and what moves it"),
          objects("balance", &S::balance, "the forces on each body"),
          objects("bodies", &S::bodies, "the solve of each body; those that may touch each other are solved as one"),
          member("undetermined", &S::undetermined,
                 "motions of a body that neither loads nor fixes nor obstacles determine")};
}

std::vector<Row<StepReport>> of_summary(const std::vector<Row<Summary>>& rows) {
  return of_part<StepReport>(rows, [](const StepReport& step) -> const Summary& { return step.summary; });
}

std::vector<Row<Report>> of_last(const std::vector<Row<StepReport>>& rows) {
  return of_part<Report>(rows, [](const Report& report) -> const StepReport& { return report.last(); });
}

}  // namespace

template <>
struct Table<EstimateParts> {
  static constexpr const char* name = "estimate_parts";
  static std::vector<Row<EstimateParts>> rows() {
    using P = EstimateParts;
    return {member("discretisation", &P::discretisation, "of the finite elements"),
            member("algebra", &P::algebra, "of the solver, as it estimates that itself"),
            member("contact", &P::contact, "what obstacles push times the distance to them"),
            member("oscillation", &P::oscillation, "of loads that are not constant in elements"),
            member("geometry", &P::geometry, "of the mesh's boundary; null: not known"),
            member("friction", &P::friction, "of friction; null: not known")};
  }
};

template <>
struct Table<GoalReport> {
  static constexpr const char* name = "goal";
  static std::vector<Row<GoalReport>> rows() {
    using G = GoalReport;
    return {member("name", &G::name, "as the scene has it"), member("value", &G::value, "what was found"),
            member("error", &G::error, "about how far off that is; null: not known")};
  }
};

namespace {

/// How large an error is.
std::vector<Row<EstimateReport>> error_numbers() {
  using E = EstimateReport;
  return {
      member("lower", &E::lower,
             "what the energy is at least above that of the true solution, see `total`; null: there are no bounds"),
      member("upper", &E::upper, "and at most"),
      member("estimated", &E::estimated,
             "what meshes are refined by: `upper`, or where there are no bounds what the estimator takes it for"),
      {{"relative_lower", Kind::number, "the same, relative to the energy of deformation, 1/2 a(v, v)"},
       [](const E& e) -> Json { return e.relative_lower(); }},
      {{"relative_upper", Kind::number, "and at most"}, [](const E& e) -> Json { return e.relative_upper(); }},
      {{"relative_estimated", Kind::number, "and about"}, [](const E& e) -> Json { return e.relative_estimated(); }},
      member("guaranteed", &E::guaranteed,
             "whether the true number certainly lies between the bounds, apart from rounding"),
      {{"goal", Kind::object, "the number that meshes are refined for; null: the energy", true, false,
        &object_spec<GoalReport>},
       [](const E& e) { return e.goal ? as_object(*e.goal) : Json(nullptr); }}};
}

}  // namespace

template <>
struct Table<EstimateReport> {
  static constexpr const char* name = "estimate";
  static std::vector<Row<EstimateReport>> rows() {
    using E = EstimateReport;
    std::vector<Row<E>> all = error_numbers();
    add(all,
        {member("total", &E::total,
                "the energy J(v) = 1/2 a(v, v) - f(v), with what friction takes, of v: the solution u_h of the finite "
                "elements, moved to the right side of obstacles between nodes. The energy of the true solution is "
                "between `total` - `upper` and `total` - `lower`"),
         member("lifted", &E::lifted, "J(v) - J(u_h): what moving it took"),
         member("energy", &E::energy, "that of deformation, 1/2 a(v, v), of v"),
         member("reasons", &E::reasons, "why nothing is guaranteed, in sentences"),
         object("parts", &E::parts, "what `upper` consists of"),
         member("seconds", &E::seconds, "the time that it took")});
    return all;
  }
};

template <>
struct Table<AdaptiveStep> {
  static constexpr const char* name = "refinement";
  static std::vector<Row<AdaptiveStep>> rows() {
    using S = AdaptiveStep;
    std::vector<Row<S>> all{member("elements", &S::elements, "of the mesh"), member("unknowns", &S::unknowns, "on it"),
                            member("iterations", &S::iterations, "that the solve took, from the solution before"),
                            member("energy", &S::energy, "that is minimised")};
    add(all, of_part<S>(error_numbers(), [](const S& s) -> const EstimateReport& { return s.error; }));
    all.push_back(member("seconds", &S::seconds, "since the beginning of the run"));
    return all;
  }
};

namespace {

Row<StepReport> estimate() {
  return {{"estimate", Kind::object, "bounds of the energy error, see how_good.md; null: not asked for", true, false,
           &object_spec<EstimateReport>},
          [](const StepReport& s) { return s.estimate ? as_object(*s.estimate) : Json(nullptr); }};
}

}  // namespace

template <>
struct Table<StepReport> {
  static constexpr const char* name = "step";
  static std::vector<Row<StepReport>> rows() {
    using S = StepReport;
    std::vector<Row<S>> all{
        member("t", &S::t, "the step parameter at its end"),
        member("step", &S::step, "number of the scene's step, from 1"),
        member("from", &S::from, "the step parameter where it starts"),
        member("halvings", &S::halvings, "how often the step was cut in two to get this part; 0: a whole one"),
        {{"converged", Kind::flag, "whether this step is solved"},
         [](const S& s) -> Json { return s.summary.converged(); }}};
    add(all, of_summary({reason()}));
    add(all, results());
    std::vector<Row<Summary>> own = figures();
    own.erase(own.begin());  // unknowns are the same in all of them
    add(all, of_summary(own));
    all.push_back(estimate());
    add(all, of_summary(work()));
    return all;
  }
};

template <>
struct Table<FailedStep> {
  static constexpr const char* name = "failed_step";
  static std::vector<Row<FailedStep>> rows() {
    using F = FailedStep;
    return {member("step", &F::step, "number of the scene's step, from 1"), member("from", &F::from, "where it starts"),
            member("t", &F::t, "where it ends"), member("iterations", &F::iterations, "that were made"),
            member("reason", &F::reason, "why it was cut")};
  }
};

template <>
struct Table<Times> {
  static constexpr const char* name = "time";
  static std::vector<Row<Times>> rows() {
    return {member("mesh", &Times::mesh, "seconds for meshes"),
            member("assemble", &Times::assemble, "for matrices and loads"),
            member("setup", &Times::setup, "for levels of the solver"),
            member("solve", &Times::solve, "for iterations"),
            member("output", &Times::output, "for results and files"),
            member("total", &Times::total, "for all of it")};
  }
};

template <>
struct Table<Assemblies> {
  static constexpr const char* name = "assemblies";
  static std::vector<Row<Assemblies>> rows() {
    using A = Assemblies;
    return {member("stiffness", &A::stiffness, "matrices"), member("load", &A::load, "right-hand sides"),
            member("constraints", &A::constraints, "prescribed values, bounds and frames"),
            member("hierarchies", &A::hierarchies, "choices of levels by the matrix")};
  }
};

template <>
struct Table<PluginReport> {
  static constexpr const char* name = "plugin";
  static std::vector<Row<PluginReport>> rows() {
    using P = PluginReport;
    return {member("id", &P::id, "what scenes call it"),
            member("file", &P::file, "that it was loaded from"),
            member("version", &P::version, "its own one"),
            {{"licence", Kind::text, "as SPDX names it; null: it does not say", true},
             [](const P& p) { return text_or_null(licence_of(p.file)); }}};
  }
};

template <>
struct Table<Library> {
  static constexpr const char* name = "library";
  static std::vector<Row<Library>> rows() {
    return {member("file", &Library::file, "that it was loaded from"),
            {{"licence", Kind::text, "includes the licences of the libraries it is linked with; null: it does not say",
              true},
             [](const Library& l) { return text_or_null(l.licence); }}};
  }
};

namespace {

bool is_shape(const SurfacePiece& piece) { return !piece.center.empty(); }

/// A number of some kinds of pieces only.
Row<SurfacePiece> of_some(const char* name, const char* help, bool (*has)(const SurfacePiece&),
                          double (*value)(const SurfacePiece&)) {
  return {{name, Kind::number, help, false, true},
          [=](const SurfacePiece& piece) { return has(piece) ? Json(value(piece)) : left_out(); }};
}

}  // namespace

template <>
struct Table<SurfacePiece> {
  static constexpr const char* name = "piece";
  static std::vector<Row<SurfacePiece>> rows() {
    using P = SurfacePiece;
    return {member("kind", &P::kind, "such as \"plane\", \"sphere\", \"smooth\" or \"facets\""),
            member("faces", &P::faces, "of the coarsest mesh"),
            member("deviation", &P::deviation,
                   "of vertices from a shape; of other kinds the largest distance from the flat faces"),
            member("size", &P::size, "diagonal of the box around it"),
            of_some(
                "angle", "of smooth pieces the largest one smoothed over, in degrees",
                [](const P& p) { return !is_shape(p) && p.second > 0; },
                [](const P& p) { return p.second * 180 / std::numbers::pi; }),
            {{"center", Kind::numbers, "of shapes", false, true},
             [](const P& p) { return is_shape(p) ? Json(p.center) : left_out(); }},
            {{"axis", Kind::numbers, "of shapes that have one", false, true},
             [](const P& p) { return is_shape(p) && !p.axis.empty() ? Json(p.axis) : left_out(); }},
            of_some(
                "radius", "of round shapes", [](const P& p) { return is_shape(p) && p.kind != "cone"; },
                [](const P& p) { return p.radius; }),
            of_some(
                "half_angle", "of a cone, in radians", [](const P& p) { return is_shape(p) && p.kind == "cone"; },
                [](const P& p) { return p.second; }),
            of_some(
                "axis_radius", "of a torus", [](const P& p) { return is_shape(p) && p.kind == "torus"; },
                [](const P& p) { return p.second; })};
  }
};

template <>
struct Table<GeometryReport> {
  static constexpr const char* name = "geometry";
  static std::vector<Row<GeometryReport>> rows() {
    using G = GeometryReport;
    return {member("body", &G::body, "its name"), objects("pieces", &G::pieces, "of its boundary"),
            member("straightened", &G::straightened,
                   "curved elements that were made straight, so that none is turned inside out")};
  }
};

template <>
struct Table<Report> {
  static constexpr const char* name = "report";
  static std::vector<Row<Report>> rows() {
    std::vector<Row<Report>> all = head();
    add(all, of_last(results()));
    add(all, {{{"warnings", Kind::texts, "what was printed as warnings"},
               [](const Report& r) { return warnings(r, [](const Warning& w) { return Json(w.text); }); }},
              {{"warning_ids", Kind::texts, "what kinds these are, one by one: ids of warnings.md"},
               [](const Report& r) { return warnings(r, [](const Warning& w) { return Json(w.id); }); }}});
    add(all, of_last(of_summary(figures())));
    add(all, of_last({estimate()}));
    add(all, middle());
    add(all, of_last(of_summary({levels()})));
    add(all, of_last(of_summary(work())));
    add(all, tail());
    add(all, of_last(of_summary({history()})));
    return all;
  }

 private:
  static std::vector<Row<Report>> head() {
    using R = Report;
    return {
        member("scene", &R::scene, "the file"),
        member("title", &R::title, "as in the scene"),
        member("dimension", &R::dimension, "2 or 3"),
        {{"converged", Kind::flag, "whether all steps are solved"}, [](const R& r) -> Json { return r.converged(); }},
        member("interrupted", &R::interrupted,
               "ended before all was solved: the steps that were finished are there, of a single one the last iterate"),
        {{"reason", Kind::text,
          "why the solve ended, with the value and the threshold that it met; the first step that failed goes first"},
         [](const R& r) -> Json { return r.reason(); }}};
  }
  static std::vector<Row<Report>> middle() {
    using R = Report;
    return {objects("steps", &R::steps, "all steps, or parts of them; the keys beside are those of the last one"),
            objects("failed_steps", &R::failed, "what was cut in two and solved in parts"),
            object("time", &R::time, "seconds, and on what they were spent"),
            {{"refinements", Kind::objects, "of an adaptive run: the meshes, one after the other", false, false,
              &object_spec<AdaptiveStep>},
             [](const R& r) { return as_objects(r.adaptive ? r.adaptive->steps : std::vector<AdaptiveStep>{}); }},
            {{"refinement_ended", Kind::text, "why there are no more of them; empty: no adaptive run"},
             [](const R& r) -> Json { return r.adaptive ? r.adaptive->reason : ""; }},
            member("peak_memory_mb", &R::peak_memory_mb, "the largest memory, in 2^20 bytes"),
            {{"assemblies", Kind::object, "how often something was computed, over all levels and steps", false, false,
              &object_spec<Assemblies>},
             [](const R& r) { return as_object(r.time.assemblies); }},
            member("hierarchy", &R::hierarchy,
                   "\"meshes\", or \"matrix\": all levels below the finest mesh are chosen by the matrix")};
  }
  static std::vector<Row<Report>> tail() {
    using R = Report;
    return {
        objects("geometry", &R::geometry, "what the boundary of bodies from mesh files is taken for"),
        objects("plugins", &R::plugins, "the plugins that the scene names"),
        {{"libraries", Kind::objects, "the project's libraries that were loaded", false, false, &object_spec<Library>},
         [](const R&) { return as_objects(loaded_libraries()); }}};
  }
};

template <>
struct Table<QpReport::Active> {
  static constexpr const char* name = "active";
  static std::vector<Row<QpReport::Active>> rows() {
    return {member("lower", &QpReport::Active::lower, "unknowns at their lower bounds"),
            member("upper", &QpReport::Active::upper, "unknowns at their upper bounds")};
  }
};

template <>
struct Table<QpReport::Times> {
  static constexpr const char* name = "qp_time";
  static std::vector<Row<QpReport::Times>> rows() {
    using T = QpReport::Times;
    return {member("read", &T::read, "seconds for reading"), member("setup", &T::setup, "for levels of the solver"),
            member("solve", &T::solve, "for iterations"), member("total", &T::total, "for all of it")};
  }
};

template <>
struct Table<QpReport> {
  static constexpr const char* name = "qp";
  static std::vector<Row<QpReport>> rows() {
    using Q = QpReport;
    const auto of_summary = [](const std::vector<Row<Summary>>& part) {
      return of_part<Q>(part, [](const Q& q) -> const Summary& { return q.summary; });
    };
    std::vector<Row<Q>> all{
        {{"converged", Kind::flag, "whether it is solved"}, [](const Q& q) -> Json { return q.summary.converged(); }}};
    add(all, of_summary({reason()}));
    add(all, {member("block", &Q::block, "consecutive unknowns that belong together"),
              object("active", &Q::active, "unknowns at bounds")});
    add(all, of_summary(figures()));
    add(all, {object("time", &Q::time, "seconds, and on what they were spent")});
    add(all, of_summary({levels()}));
    add(all, of_summary(work()));
    add(all, of_summary({history()}));
    return all;
  }
};

Json whole_report(const Report& report) { return as_object(report); }
Json qp_report(const QpReport& report) { return as_object(report); }
const ObjectSpec& report_spec() { return object_spec<Report>(); }
const ObjectSpec& qp_spec() { return object_spec<QpReport>(); }

}  // namespace signorini::report
