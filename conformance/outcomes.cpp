#include <fmt/format.h>

#include <utility>

#include "conformance/kit.hpp"
#include "conformance/table.hpp"

namespace signorini::conformance {

void Outcomes::pass(std::string_view id) { passed_[std::string(check_named(id).id)] = true; }

void Outcomes::fail(std::string_view id, std::string found, std::string example) {
  failed_.try_emplace(std::string(id), Failure{check_named(id), std::move(found), std::move(example)});
}

void Outcomes::note(std::string text) { notes_.push_back(std::move(text)); }

Verdict Outcomes::verdict(std::string type) const {
  Verdict out{std::move(type), {}, {}, notes_};
  for (const Check& check : all_checks()) {
    const std::string id(check.id);
    if (const auto found = failed_.find(id); found != failed_.end())
      out.failures.push_back(found->second);
    else if (passed_.contains(id))
      out.passed.push_back(check);
  }
  return out;
}

std::string text_of(const Verdict& verdict) {
  std::string text = verdict.passed.empty() ? "" : "passed:";
  for (const Check& check : verdict.passed) text += fmt::format(" {}", check.id);
  if (!text.empty()) text += '\n';
  for (const Failure& failure : verdict.failures)
    text += fmt::format("FAILED: {}\n  expected: {}\n  found: {}\n  example: {}\n  read: {}\n", failure.check.id,
                        failure.check.expected, failure.found, failure.example, failure.check.page);
  for (const std::string& note : verdict.notes) text += fmt::format("note: {}\n", note);
  return text +
         fmt::format("{}: {} checks passed, {} failed\n", verdict.type, verdict.passed.size(), verdict.failures.size());
}

}  // namespace signorini::conformance
