#include "amg/signorini.h"

#include <algorithm>
#include <concepts>
#include <new>

#include "amg/black_box.hpp"
#include "core/base/error.hpp"

struct signorini_solver {
  signorini::BlackBox solver;
  std::size_t unknowns;
};

namespace {

using signorini::BlackBox;
using signorini::Error;
using signorini::Outcome;

thread_local std::string message;

int report(int status, const char* text) noexcept {
  try {
    message = text;
  } catch (const std::bad_alloc&) {
    message.clear();
  }
  return status;
}

/// What action() returns, or the status of what it throws.
template <class Action>
int guarded(const Action& action) noexcept {
  try {
    return action();
  } catch (const Error& error) {
    const bool no_solution = error.status() == signorini::Exit::no_solution;
    return report(no_solution ? SIGNORINI_NO_SOLUTION : SIGNORINI_BAD_INPUT, error.what());
  } catch (const std::bad_alloc&) {
    return report(SIGNORINI_FAILURE, "out of memory");
  } catch (const std::exception& error) {
    return report(SIGNORINI_FAILURE, error.what());
  } catch (...) {
    return report(SIGNORINI_FAILURE, "unknown exception");
  }
}

void require(const void* pointer, const char* name) {
  if (!pointer) signorini::input_error(name, "is null, expected an array");
}

template <std::integral Position>
int create(std::int32_t rows, const Position* row, const std::int32_t* column, const double* value, int block,
           signorini_solver** solver) noexcept {
  if (solver) *solver = nullptr;
  return guarded([&] {
    require(solver, "solver");
    require(row, "row");
    if (rows > 0 && row[rows] > 0) {
      require(column, "column");
      require(value, "value");
    }
    BlackBox box(signorini::SparseRows(rows, rows, row, column, value), block);
    *solver = new signorini_solver{std::move(box), static_cast<std::size_t>(rows)};
    return report(SIGNORINI_SOLVED, "set up");
  });
}

int status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
    case Outcome::rounding:
      return SIGNORINI_SOLVED;
    case Outcome::unbounded:
      return SIGNORINI_NO_SOLUTION;
    case Outcome::iteration_limit:
      return SIGNORINI_ITERATION_LIMIT;
    case Outcome::interrupted:
    case Outcome::stuck:
    case Outcome::violated:
      break;  // neither a monitor nor an obstacle
  }
  return SIGNORINI_FAILURE;
}

signorini_summary summary_of(const signorini::Summary& s) {
  return {s.iterations, static_cast<int>(s.level_unknowns.size()), s.residual, s.algebraic_error, s.energy, s.rate};
}

}  // namespace

int signorini_create(std::int32_t rows, const std::int32_t* row, const std::int32_t* column, const double* value,
                     int block, signorini_solver** solver) {
  return create(rows, row, column, value, block, solver);
}

int signorini_create64(std::int32_t rows, const std::int64_t* row, const std::int32_t* column, const double* value,
                       int block, signorini_solver** solver) {
  return create(rows, row, column, value, block, solver);
}

int signorini_solve(signorini_solver* solver, const double* b, const double* lower, const double* upper,
                    const double* start, double tolerance, double* x, double* multiplier, signorini_summary* summary) {
  return guarded([&] {
    require(solver, "solver");
    require(b, "b");
    require(x, "x");
    const auto values = [&](const double* array) { return std::span(array, array ? solver->unknowns : 0); };
    solver->solver.set_tolerance(tolerance);
    const BlackBox::Result result = solver->solver.solve(values(b), values(lower), values(upper), values(start));
    const int status = status_of(result.summary.outcome);
    if (status == SIGNORINI_SOLVED || status == SIGNORINI_ITERATION_LIMIT) {
      std::ranges::copy(result.x, x);
      if (multiplier) std::ranges::copy(result.multiplier, multiplier);
      if (summary) *summary = summary_of(result.summary);
    }
    return report(status, result.summary.reason.c_str());
  });
}

const char* signorini_message() { return message.c_str(); }

void signorini_destroy(signorini_solver* solver) { delete solver; }
