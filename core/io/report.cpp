#include "core/io/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/component/libraries.hpp"

namespace signorini {
namespace {
using Json = nlohmann::ordered_json;

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// `list` as a JSON array; an empty one stays an array.
template <class T, class Convert>
Json array(const std::vector<T>& list, Convert convert) {
  Json result = Json::array();
  for (const T& entry : list) result.push_back(convert(entry));
  return result;
}

Json level(const LevelReport& level, int number) {
  return {{"level", number},          {"vectors", level.vectors}, {"critical", level.critical},
          {"contact", level.contact}, {"changed", level.changed}, {"renewed", level.renewed},
          {"seconds", level.seconds}};
}

Json record(const Summary& summary, const IterationRecord& record) {
  Json levels = Json::array();
  for (std::size_t k = 0; k < record.levels.size(); ++k)
    levels.push_back(level(record.levels[k], summary.level_number(k)));
  return {{"iteration", record.iteration}, {"stage", record.stage},
          {"residual", record.residual},   {"algebraic_error", record.algebraic_error},
          {"energy", record.energy},       {"contact_nodes", record.contact_nodes},
          {"changed", record.changed},     {"levels", std::move(levels)}};
}

Json pair(const std::optional<PairReport>& pair) {
  if (!pair) return nullptr;
  return {{"slave", pair->slave}, {"master", pair->master}, {"reason", pair->reason}};
}

Json contact(const ContactReport& contact) {
  Json json{{"obstacle", contact.obstacle},
            {"body", contact.body},
            {"nodes", contact.nodes},
            {"open_nodes", contact.open_nodes},
            {"area", contact.area},
            {"radius", contact.radius},
            {"force", contact.force},
            {"max_pressure", contact.max_pressure},
            {"resolved", contact.resolved},
            {"slip_nodes", contact.slip_nodes},
            {"stick_nodes", contact.stick_nodes},
            {"normal_force", contact.normal_force},
            {"tangential_force", contact.tangential_force},
            {"moment", contact.moment},
            {"moment_about", contact.moment_about},
            {"motion", contact.motion},
            {"dissipated_in_step", contact.dissipated_in_step},
            {"dissipated", contact.dissipated},
            {"displacement", contact.displacement},
            {"undetermined_nodes", contact.undetermined_nodes},
            {"undetermined_force", contact.undetermined_force},
            {"largest_penetration", contact.largest_penetration},
            {"largest_penetration_between_nodes", contact.penetration_between_nodes},
            {"largest_opening", contact.largest_opening},
            {"pair", pair(contact.pair)}};
  if (!contact.pair) return json;
  json["beyond_nodes"] = contact.beyond_nodes;
  json["other_force"] = contact.pair->force;
  json["other_moment"] = contact.pair->moment;
  return json;
}

Json probe(const ProbeReport& probe) {
  Json result{{"name", probe.name}};
  if (probe.value.size() == 1)
    result["value"] = probe.value.front();
  else
    result["displacement"] = probe.value;
  return result;
}

Json force(const char* key, const ForceReport& force) { return {{key, force.number}, {"force", force.force}}; }

Json balance(const BalanceReport& balance) {
  return {{"body", balance.body},
          {"applied", balance.applied},
          {"reactions", balance.reactions},
          {"contact", balance.contact},
          {"sum", balance.sum()}};
}

Index unknowns(const Summary& summary) { return summary.level_unknowns.empty() ? 0 : summary.level_unknowns.back(); }

bool limited_by_rounding(const Summary& summary) {
  return summary.outcome == Outcome::rounding || summary.outcome == Outcome::inaccurate;
}

Json body(const BodyReport& body) {
  const Summary& summary = body.summary;
  return {{"name", body.name},
          {"converged", summary.converged()},
          {"unknowns", unknowns(summary)},
          {"iterations", summary.iterations},
          {"residual", summary.residual},
          {"algebraic_error", summary.algebraic_error},
          {"rate", summary.rate},
          {"energy", summary.energy},
          {"limited_by_rounding", limited_by_rounding(summary)},
          {"reason", summary.reason},
          {"axisymmetric", body.axisymmetric},
          {"axis_nodes", body.axis_nodes},
          {"symmetry", body.symmetry},
          {"copies", body.copies},
          {"order", body.order},
          {"order_by", body.order_chosen ? "auto" : "scene"}};
}

Json solver(const SolverOptions& options) {
  return {{"method", options.method},
          {"tolerance", options.tolerance},
          {"max_iterations", options.max_iterations},
          {"cycle", options.cycle},
          {"pre", options.pre},
          {"post", options.post},
          {"smoother", options.smoother},
          {"relaxation", options.relaxation},
          {"transfer", options.transfer},
          {"coarse", options.coarse},
          {"truncate", options.truncate},
          {"cut", options.cut},
          {"rotate", options.rotate},
          {"renew", options.renew},
          {"krylov", options.krylov},
          {"threads", options.threads}};
}

Json levels(const Summary& summary) {
  Json result = Json::array();
  for (std::size_t k = 0; k < summary.level_unknowns.size(); ++k)
    result.push_back({{"level", summary.level_number(k)}, {"unknowns", summary.level_unknowns[k]}});
  return result;
}

Json stage(const Stage& stage) {
  return {{"method", stage.method},
          {"linear", text_or_null(stage.linear)},
          {"iterations", stage.iterations},
          {"linear_solves", stage.linear_solves},
          {"factorisations", stage.factorisations},
          {"seconds", stage.seconds},
          {"outcome", outcome_name(stage.outcome)},
          {"reason", stage.reason},
          {"kept", stage.kept}};
}

void add_summary(Json& json, const Summary& summary) {
  json["iterations"] = summary.iterations;
  json["residual"] = summary.residual;
  json["algebraic_error"] = summary.algebraic_error;
  json["rate"] = summary.rate;
  json["energy"] = summary.energy;
  json["linear_phase_from"] = summary.linear_phase_from;
  json["limited_by_rounding"] = limited_by_rounding(summary);
  json["rounding_error"] = summary.rounding_error;
  json["reason"] = summary.reason;
  json["stages"] = array(summary.stages, stage);
  json["solver"] = solver(summary.options);
}

void add_history(Json& json, const Summary& summary) {
  json["history"] = array(summary.history, [&](const IterationRecord& cycle) { return record(summary, cycle); });
}

void add_results(Json& json, const StepReport& step) {
  json["contact"] = array(step.contact, contact);
  json["probes"] = array(step.probes, probe);
  json["reactions"] = array(step.reactions, [](const ForceReport& reaction) { return force("fix", reaction); });
  json["applied"] = array(step.applied, [](const ForceReport& load) { return force("load", load); });
  json["bodies"] = array(step.bodies, body);
  json["balance"] = array(step.balance, balance);
  json["undetermined"] = step.undetermined;
}

Json step(const StepReport& step) {
  Json json{{"t", step.t},
            {"step", step.step},
            {"from", step.from},
            {"halvings", step.halvings},
            {"converged", step.summary.converged()}};
  add_summary(json, step.summary);
  add_results(json, step);
  return json;
}

Json surface_piece(const SurfacePiece& piece) {
  Json json{{"kind", piece.kind}, {"faces", piece.faces}, {"deviation", piece.deviation}, {"size", piece.size}};
  if (piece.center.empty()) {
    if (piece.second > 0) json["angle"] = piece.second * 180 / std::numbers::pi;
    return json;
  }
  json["center"] = piece.center;
  if (!piece.axis.empty()) json["axis"] = piece.axis;
  if (piece.kind != "cone") json["radius"] = piece.radius;
  if (piece.kind == "cone") json["half_angle"] = piece.second;
  if (piece.kind == "torus") json["axis_radius"] = piece.second;
  return json;
}

Json geometry(const GeometryReport& body) {
  return {{"body", body.body}, {"pieces", array(body.pieces, surface_piece)}, {"straightened", body.straightened}};
}

Json failed_step(const FailedStep& step) {
  return {{"step", step.step},
          {"from", step.from},
          {"t", step.t},
          {"iterations", step.iterations},
          {"reason", step.reason}};
}

Json time(const Times& time) {
  return {{"mesh", time.mesh},   {"assemble", time.assemble}, {"setup", time.setup},
          {"solve", time.solve}, {"output", time.output},     {"total", time.total}};
}

Json assemblies(const Assemblies& count) {
  return {{"stiffness", count.stiffness},
          {"load", count.load},
          {"constraints", count.constraints},
          {"hierarchies", count.hierarchies}};
}

/// JSON knows no NaN and no infinity.
void finite_or_null(Json& json) {
  if (json.is_structured())
    for (auto& entry : json) finite_or_null(entry);
  else if (json.is_number_float() && !std::isfinite(json.get<double>()))
    json = nullptr;
}
}  // namespace

std::vector<double> BalanceReport::sum() const {
  std::vector<double> sum(contact.size());
  for (const std::vector<double>* part : {&applied, &reactions, &contact})
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += (*part)[i];
  return sum;
}

std::string elements_text(int order, bool chosen) {
  return fmt::format("{} (order {}{})", order == 2 ? "quadratic" : "linear", order, chosen ? ", chosen by auto" : "");
}

bool Report::converged() const {
  return !interrupted && error.empty() &&
         std::all_of(steps.begin(), steps.end(), [](const StepReport& step) { return step.summary.converged(); });
}

std::string Report::reason() const {
  if (!error.empty()) return error;
  const auto first =
      std::find_if(steps.begin(), steps.end() - 1, [](const StepReport& step) { return !step.summary.converged(); });
  if (first == steps.end() - 1 || !last().summary.converged()) return last().summary.reason;
  return fmt::format("the step at t = {:.4g}: {}", first->t, first->summary.reason);
}

Json to_json(const Summary& summary) {
  Json json{{"converged", summary.converged()}, {"unknowns", unknowns(summary)}, {"levels", levels(summary)}};
  add_summary(json, summary);
  add_history(json, summary);
  finite_or_null(json);
  return json;
}

Json to_json(const Report& report) {
  Json json{{"scene", report.scene},
            {"title", report.title},
            {"dimension", report.dimension},
            {"converged", report.converged()},
            {"interrupted", report.interrupted},
            {"unknowns", unknowns(report.last().summary)},
            {"levels", levels(report.last().summary)}};
  add_summary(json, report.last().summary);
  json["reason"] = report.reason();
  add_history(json, report.last().summary);
  json["hierarchy"] = report.hierarchy;
  json["time"] = time(report.time);
  json["assemblies"] = assemblies(report.time.assemblies);
  json["peak_memory_mb"] = report.peak_memory_mb;
  add_results(json, report.last());
  json["steps"] = array(report.steps, step);
  json["failed_steps"] = array(report.failed, failed_step);
  json["estimate"] = nullptr;  // no estimator ran
  json["plugins"] = array(report.plugins, [](const PluginReport& plugin) {
    return Json{{"id", plugin.id},
                {"file", plugin.file},
                {"version", plugin.version},
                {"licence", text_or_null(licence_of(plugin.file))}};
  });
  json["libraries"] = array(loaded_libraries(), [](const Library& library) {
    return Json{{"file", library.file}, {"licence", text_or_null(library.licence)}};
  });
  json["geometry"] = array(report.geometry, geometry);
  json["warnings"] = report.warnings;
  finite_or_null(json);
  return json;
}

}  // namespace signorini
