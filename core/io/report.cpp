#include "core/io/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/io/report_rows.hpp"

namespace signorini {
namespace {
using Json = nlohmann::ordered_json;

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

Json to_json(const QpReport& report) {
  Json json = report::qp_report(report);
  finite_or_null(json);
  return json;
}

Json to_json(const Report& report) {
  Json json = report::whole_report(report);
  finite_or_null(json);
  return json;
}

}  // namespace signorini
