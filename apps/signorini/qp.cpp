#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "amg/black_box.hpp"
#include "amg/black_box/recognise_block.hpp"
#include "apps/signorini/commands.hpp"
#include "apps/signorini/console.hpp"
#include "apps/signorini/interrupt.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/io/matrix_market.hpp"
#include "core/io/output_files.hpp"
#include "core/io/report.hpp"
#include "core/scene/solver_options.hpp"

namespace signorini {
namespace fs = std::filesystem;

namespace {

struct Vectors {
  std::vector<double> load, lower, upper, start;
};

Vectors read_vectors(const QpArguments& arguments, Index size) {
  const auto read = [&](const fs::path& file, Infinities infinities) {
    return file.empty() ? std::vector<double>() : read_vector(file, size, infinities);
  };
  return {read(arguments.load, Infinities::refused), read(arguments.lower, Infinities::allowed),
          read(arguments.upper, Infinities::allowed), read(arguments.start, Infinities::refused)};
}

NearNullSpace near_null_space(const QpArguments& arguments, int block, Index rows) {
  if (!arguments.near_null.empty()) {
    if (!arguments.coordinates.empty()) throw Error(Exit::usage, "--near-null and --coordinates exclude each other");
    Columns columns = read_columns(arguments.near_null, rows, 1, most_modes);
    return {columns.columns, std::move(columns.value)};
  }
  if (arguments.coordinates.empty()) return {};
  if (block == 1) throw Error(Exit::usage, "--coordinates needs --block 2 or --block 3");
  const std::vector<double> coordinates = read_columns(arguments.coordinates, rows / block, block, block).value;
  return block == 2 ? rigid_body_modes<2>(coordinates) : rigid_body_modes<3>(coordinates);
}

QpReport::Active active(const std::vector<double>& x, const Vectors& vectors) {
  QpReport::Active count;
  for (std::size_t i = 0; i < x.size(); ++i) {
    count.lower += !vectors.lower.empty() && x[i] == vectors.lower[i];
    count.upper += !vectors.upper.empty() && x[i] == vectors.upper[i];
  }
  return count;
}

SolverOptions options_of(const QpArguments& arguments) {
  SolverOptions options = solver_options(arguments.settings);
  options.tolerance = arguments.tolerance.value_or(options.tolerance);
  options.method = arguments.method.value_or(options.method);
  return options;
}

/// One run of `signorini qp`.
class QpRun {
 public:
  explicit QpRun(const QpArguments& arguments)
      : arguments_(arguments),
        options_(options_of(arguments)),
        outputs_({arguments.matrix, arguments.load, arguments.lower, arguments.upper, arguments.start,
                  arguments.near_null, arguments.coordinates}) {}

  void run() {
    read();
    BlackBox solver = set_up();
    solve(solver);
    write();
    if (!arguments_.out.empty() || !arguments_.report.empty())
      print_of_written([this] { print(); });
    else
      print();
    if (result_.summary.outcome == Outcome::interrupted)
      throw Error(Exit::interrupted, result_.summary.reason + "; what was asked for is of the last iterate");
    fail_unless_solved(result_.summary.converged(), result_.summary.reason);
  }

 private:
  void read() {
    progress_.phase("reading");
    matrix_ = read_matrix(arguments_.matrix);
    if (arguments_.one_triangle) complete(matrix_);
    if (matrix_.rows == 0 || matrix_.rows != matrix_.columns)  // before its rows are asked of the vectors
      input_error(arguments_.matrix.string(),
                  fmt::format("found {} rows and {} columns, expected a square matrix of one row at least",
                              matrix_.rows, matrix_.columns));
    vectors_ = read_vectors(arguments_, matrix_.rows);
    block_ = arguments_.block > 0 ? arguments_.block : recognised_block(matrix_);
    vectors_of_matrix_ = matrix_.rows / block_;
    near_null_ = near_null_space(arguments_, block_, matrix_.rows);
    if (!arguments_.out.empty()) outputs_.add(arguments_.out);
    if (!arguments_.report.empty() && !outputs_.add(arguments_.report))
      throw Error(Exit::usage, fmt::format("{} is both --out and --report", arguments_.out.string()));
    time_.read = lap_.lap();
    stop_if_interrupted();
  }

  void complete(SparseRows& matrix) const {
    try {
      matrix = from_triangle(matrix);
    } catch (const Error& error) {
      input_error(arguments_.matrix.string(), fmt::format("{}; expected one triangle of a matrix alone, in a file that "
                                                          "says 'general' (--one-triangle)",
                                                          error.what()));
    }
  }

  /// What is refused here is wrong with the matrix.
  BlackBox set_up() {
    progress_.phase(fmt::format("setting up {} unknowns", matrix_.rows));
    try {
      return BlackBox(std::exchange(matrix_, {}), block_, options_, std::exchange(near_null_, {}));
    } catch (const Error& error) {
      throw Error(error.status(), fmt::format("{}: {}", arguments_.matrix.string(), error.what()));
    }
  }

  void solve(BlackBox& solver) {
    time_.setup = lap_.lap();
    progress_.phase("solving");
    stop_if_interrupted();
    const auto monitor = [this](const IterationRecord& record) {
      const bool finest = record.levels.empty() || record.levels.back().vectors == vectors_of_matrix_;
      if (finest != std::exchange(finest_, finest)) progress_.solving({finest, options_.tolerance});
      progress_.cycle(record);
      return !interrupted();
    };
    result_ = solver.solve(vectors_.load, vectors_.lower, vectors_.upper, vectors_.start, monitor);
    if (result_.summary.outcome == Outcome::unbounded)
      throw Error(Exit::no_solution, fmt::format("{}: {}", arguments_.matrix.string(), result_.summary.reason));
    time_.setup += result_.summary.setup_seconds;  // levels that waited for the bounds
    time_.solve = lap_.lap() - result_.summary.setup_seconds;
    active_ = active(result_.x, vectors_);
  }

  void write() {
    progress_.phase("writing");
    if (!arguments_.out.empty()) outputs_.write(arguments_.out, matrix_market(result_.x));
    time_.total = watch_.elapsed();
    if (!arguments_.report.empty()) outputs_.write(arguments_.report, report_text());
    outputs_.commit();
    progress_.end();
  }

  std::string report_text() const {
    const auto json = to_json(QpReport{result_.summary, block_, active_, time_});
    return json.dump(2) + '\n';
  }

  void print() const {
    print_summary(progress_, result_.summary, result_.summary.converged(), result_.summary.reason);
    if (arguments_.block == 0 && block_ > 1) fmt::print("blocks of {} unknowns, recognised in the matrix\n", block_);
    fmt::print("{} unknowns at lower, {} at upper bounds\n", active_.lower, active_.upper);
    fmt::print("seconds: read {:.2f}, setup {:.2f}, solve {:.2f}, total {:.2f}; {:.0f} MB\n", time_.read, time_.setup,
               time_.solve, time_.total, peak_memory_mb());
    for (const fs::path& file : {arguments_.out, arguments_.report})
      if (!file.empty() && file != "-") fmt::print("wrote {}\n", file.string());
  }

  const QpArguments& arguments_;
  const SolverOptions options_;
  const Console progress_{false, Live::tables};
  Stopwatch watch_, lap_;
  QpReport::Times time_;
  SparseRows matrix_;  // until the set-up
  int block_ = 1;
  Index vectors_of_matrix_ = 0;
  bool finest_ = false;  // the cycles are on the matrix itself
  Vectors vectors_;
  NearNullSpace near_null_;
  OutputFiles outputs_;
  BlackBox::Result result_;
  QpReport::Active active_;
};

}  // namespace

void qp_command(const QpArguments& arguments) { QpRun(arguments).run(); }

}  // namespace signorini
