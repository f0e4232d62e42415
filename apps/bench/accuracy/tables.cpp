#include "apps/bench/accuracy/tables.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/bench/accuracy/known_answers.hpp"
#include "apps/bench/scratch_folder.hpp"
#include "core/io/picture.hpp"

namespace signorini::bench {
namespace {

using Names = std::array<std::string, quantities>;
constexpr std::size_t with_sign = 4;  // the others are means of squares

Names names_of(const AccuracyProblem& problem) {
  return {"force",
          "largest pressure",
          problem.width,
          problem.probe ? problem.probe : "",
          "pressure, mean square",
          "stress, mean square"};
}

struct Row {
  std::string series;
  Answer answer;
  Errors errors;
};

std::string percent(std::size_t quantity, double error) {
  const double value = 100 * error;
  const char* sign = quantity < with_sign ? "+" : "";
  return std::abs(value) < 0.01 ? fmt::format(fmt::runtime(fmt::format("{{:{}.1e}} %", sign)), value)
                                : fmt::format(fmt::runtime(fmt::format("{{:{}.2f}} %", sign)), value);
}

/// One problem: its table as Markdown, and a picture of linear and quadratic elements.
class Table {
 public:
  explicit Table(const AccuracyProblem& problem) : problem_(problem), names_(names_of(problem)) {
    const Errors any = errors_of(problem.exact, problem.exact, problem.pressure);
    const bool known[] = {!std::isnan(any[0]), !std::isnan(any[1]),    !std::isnan(any[2]),
                          !std::isnan(any[3]), bool(problem.pressure), !problem.exact.stress.empty()};
    for (std::size_t k = 0; k < quantities; ++k)
      if (known[k]) shown_.push_back(k);
  }

  void print() {
    fmt::print("\n## {}\n\n{}\n\n| elements | unknowns | seconds | cycles |", problem_.title, problem_.about);
    for (const std::size_t k : shown_) fmt::print(" {} |", names_[k]);
    fmt::print("\n| --- | --- | --- | --- |");
    for (std::size_t k = 0; k < shown_.size(); ++k) fmt::print(" --- |");
    fmt::print("\n");
    for (const AccuracyProblem::Series& series : problem_.series) print(series);
  }

  const std::vector<Row>& rows() const { return rows_; }

  void draw(const std::filesystem::path& picture) const {
    std::vector<Panel> panels;
    for (const bool seconds : {false, true}) {
      Panel& panel = panels.emplace_back();
      panel.title = problem_.title + ": linear (dashed) and quadratic elements";
      panel.label = "relative error";
      panel.across = seconds ? "seconds" : "unknowns";
      panel.view = View::lines;
      panel.logarithmic = true;
      for (std::size_t q = 0; q < shown_.size(); ++q)
        for (const int order : {0, 1}) panel.lines.push_back(line(order, q, seconds));
    }
    painter().panels(picture, panels);
  }

 private:
  void print(const AccuracyProblem::Series& series) {
    for (int k = 0; k <= series.finest; ++k) {
      std::vector<std::string> overrides = series.overrides;
      overrides.push_back(fmt::format("refine.uniform={}", k));
      const Answer answer = solve(problem_.question, overrides);
      const Row& row = rows_.emplace_back(series.name, answer, errors_of(answer, problem_.exact, problem_.pressure));
      fmt::print("| {} | {:.0f} | {:.2f} | {} |", row.series, answer.unknowns, answer.seconds, answer.cycles);
      for (const std::size_t q : shown_) fmt::print(" {} |", percent(q, row.errors[q]));
      fmt::print("\n");
      std::fflush(stdout);
    }
    if (series.finest < 2) return;
    const Errors &finer = rows_.back().errors, &coarser = rows_[rows_.size() - 3].errors;
    fmt::print("| *order, of the last three* | | | |");
    for (const std::size_t q : shown_) fmt::print(" *{:.1f}* |", std::log2(std::abs(coarser[q] / finer[q])) / 2);
    fmt::print("\n");
  }

  /// Of the first two series.
  Line line(int series, std::size_t shown, bool seconds) const {
    const std::size_t quantity = shown_[shown];
    Line out;
    out.dashed = series == 0;
    out.style = static_cast<int>(shown);
    if (!out.dashed) out.name = names_[quantity];
    for (const Row& row : rows_)
      if (row.series == problem_.series[series].name)
        out.points.push_back({seconds ? row.answer.seconds : row.answer.unknowns, std::abs(row.errors[quantity])});
    return out;
  }

  const AccuracyProblem& problem_;
  Names names_;
  std::vector<std::size_t> shown_;
  std::vector<Row> rows_;
};

/// What it takes to have both.
void print_cheapest(const std::vector<Row>& rows, double force, double peak) {
  const Row* best = nullptr;
  for (const Row& row : rows)
    if (std::abs(row.errors[0]) <= force && std::abs(row.errors[1]) <= peak &&
        (!best || row.answer.seconds < best->answer.seconds))
      best = &row;
  fmt::print("\nForce to {:g} % and largest pressure to {:g} %: ", 100 * force, 100 * peak);
  if (best)
    fmt::print("{:.2f} s ({}, {:.0f} unknowns).\n", best->answer.seconds, best->series, best->answer.unknowns);
  else
    fmt::print("by none of these.\n");
}

}  // namespace

void print_accuracy(bool quick, const std::string& only, const std::filesystem::path& pictures) {
  const ScratchFolder scratch("accuracy");
  for (const NamedProblem& named : accuracy_problems()) {
    if (std::string_view(named.name).find(only) == std::string_view::npos) continue;
    const AccuracyProblem problem = named.make(quick ? 2 : 0, scratch.path());
    Table table(problem);
    table.print();
    if (named.make == ball_in_space) print_cheapest(table.rows(), 0.001, 0.005);
    if (pictures.empty()) continue;
    const std::string picture = fmt::format("accuracy_{}.png", named.name);
    table.draw(pictures / picture);
    fmt::print("\n![{}: errors over unknowns and over seconds]({})\n", problem.title, picture);
  }
}

}  // namespace signorini::bench
