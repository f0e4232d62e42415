#include "c/signorini.h"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <new>

#include "amg/black_box.hpp"
#include "amg/black_box/recognise_block.hpp"
#include "c/obstacles.hpp"
#include "c/versioned.hpp"
#include "core/base/error.hpp"
#include "core/solver/options_from_text.hpp"

struct signorini_solver {
  signorini::BlackBox solver;
  std::size_t unknowns;
  signorini::Index vectors;  // blocks of unknowns
  bool one_triangle = false;
  std::vector<signed char> active{};  // of the last solve that wrote results; empty: none did
  signorini_monitor monitor = nullptr;
  void* monitor_data = nullptr;
  const signorini::IterationRecord* cycle = nullptr;  // while the monitor is called
  std::vector<signorini_cycle> history{};             // of the last solve that wrote results
  std::vector<signorini::Index> touching{};           // the same
};

namespace {

using signorini::BlackBox;
using signorini::Error;
using signorini::NearNullSpace;
using signorini::Outcome;
using signorini::SparseRows;

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
SparseRows copy_of(std::int32_t rows, std::int32_t columns, const Position* row, const std::int32_t* column,
                   const double* value) {
  require(row, "row");
  if (rows > 0 && row[rows] > 0) {
    require(column, "column");
    require(value, "value");
  }
  return {rows, columns, row, column, value};
}

std::vector<SparseRows> copies_of(const signorini_rows* matrices, std::int32_t count) {
  std::vector<SparseRows> out;
  out.reserve(static_cast<std::size_t>(count));
  for (std::int32_t k = 0; k < count; ++k)
    out.push_back(
        copy_of(matrices[k].rows, matrices[k].columns, matrices[k].row, matrices[k].column, matrices[k].value));
  return out;
}

signorini::SolverOptions options_of(const char* const* settings) {
  std::vector<std::string> assignments;
  for (; settings && *settings; ++settings) assignments.emplace_back(*settings);
  return signorini::options_from_text(assignments);
}

NearNullSpace near_null_of(const signorini_setup& setup, std::int32_t rows, int block) {
  const auto values = [](const double* array, std::int32_t vectors, std::int32_t per_vector) {
    return std::vector<double>(array, array + std::max<std::ptrdiff_t>(vectors, 0) * per_vector);
  };
  if (setup.modes != 0 || setup.near_null) {
    if (setup.coordinates) signorini::input_error("near_null", "given with coordinates, expected one of them");
    if (setup.modes < 1 || setup.modes > signorini::most_modes)
      signorini::input_error("modes", fmt::format("found {}, expected 1 to {}", setup.modes, signorini::most_modes));
    require(setup.near_null, "near_null");
    return {setup.modes, values(setup.near_null, rows, setup.modes)};
  }
  if (!setup.coordinates) return {};
  if (block != 2 && block != 3)
    signorini::input_error("coordinates", fmt::format("given for blocks of {}, expected 2 or 3 unknowns", block));
  const std::vector<double> coordinates = values(setup.coordinates, rows / block, block);
  return block == 2 ? signorini::rigid_body_modes<2>(coordinates) : signorini::rigid_body_modes<3>(coordinates);
}

BlackBox box_of(const SparseRows& A, int block, const signorini_setup& setup) {
  const signorini::SolverOptions options = options_of(setup.settings);
  const NearNullSpace near_null = near_null_of(setup, A.rows, block);
  if (setup.levels == 0) return BlackBox(A, block, options, near_null);
  if (setup.levels < 0) signorini::input_error("levels", fmt::format("found {}, expected 0 or more", setup.levels));
  if (near_null.modes > 0)
    signorini::input_error("interpolations", "given with a near null space, which has no use for them");
  require(setup.interpolations, "interpolations");
  return BlackBox(A, copies_of(setup.interpolations, setup.levels), block, options,
                  copies_of(setup.coarse_matrices, setup.coarse_matrices ? setup.levels : 0));
}

signorini_setup complete(const signorini_setup* given) {
  if (!given) return SIGNORINI_SETUP;
  constexpr std::size_t first_version = offsetof(signorini_setup, one_triangle) + sizeof given->one_triangle;
  return signorini::versioned(given, first_version, "setup", "signorini_setup", "SIGNORINI_SETUP");
}

/// @param matrix makes a copy of the matrix
template <class Matrix>
int create(const Matrix& matrix, int block, const signorini_setup* given, signorini_solver** solver) noexcept {
  if (solver) *solver = nullptr;
  return guarded([&] {
    require(solver, "solver");
    const signorini_setup setup = complete(given);
    const bool one_triangle = setup.one_triangle != 0;
    const SparseRows A = one_triangle ? signorini::from_triangle(matrix()) : matrix();
    const int found = block == 0 && setup.levels == 0 ? signorini::recognised_block(A) : block;
    BlackBox box = box_of(A, found, setup);
    *solver = new signorini_solver{std::move(box), static_cast<std::size_t>(A.rows), A.rows / found, one_triangle};
    return report(SIGNORINI_SOLVED, "set up");
  });
}

/// As the program's exit status.
int status_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
    case Outcome::rounding:
      return SIGNORINI_SOLVED;
    case Outcome::unbounded:
      return SIGNORINI_NO_SOLUTION;
    case Outcome::iteration_limit:
    case Outcome::inaccurate:
    case Outcome::stuck:
    case Outcome::failed:
      return SIGNORINI_ITERATION_LIMIT;
    case Outcome::interrupted:
      return SIGNORINI_INTERRUPTED;
  }
  return SIGNORINI_FAILURE;
}

signorini_cycle cycle_of(const signorini::IterationRecord& record, signorini::Index vectors) {
  const bool finest = record.levels.empty() || record.levels.back().vectors == vectors;
  return {record.iteration,       finest,       record.contact_nodes, record.changed, record.residual,
          record.algebraic_error, record.energy};
}

signorini::Monitor monitor_of(signorini_solver& solver) {
  if (!solver.monitor) return {};
  return [&solver](const signorini::IterationRecord& record) {
    solver.cycle = &record;
    const int stop = solver.monitor(record.iteration, record.residual, record.algebraic_error, solver.monitor_data);
    solver.cycle = nullptr;
    return stop == 0;
  };
}

signorini_summary summary_of(const signorini::Summary& s) {
  return {s.iterations,     static_cast<int>(s.level_unknowns.size()),
          s.residual,       s.algebraic_error,
          s.energy,         s.rate,
          s.rounding_error, s.outcome == Outcome::rounding || s.outcome == Outcome::inaccurate};
}

}  // namespace

int signorini_create(std::int32_t rows, const std::int32_t* row, const std::int32_t* column, const double* value,
                     int block, signorini_solver** solver) {
  return create([&] { return copy_of(rows, rows, row, column, value); }, block, nullptr, solver);
}

int signorini_create64(std::int32_t rows, const std::int64_t* row, const std::int32_t* column, const double* value,
                       int block, signorini_solver** solver) {
  return create([&] { return copy_of(rows, rows, row, column, value); }, block, nullptr, solver);
}

int signorini_create_with(const signorini_rows* matrix, int block, const signorini_setup* setup,
                          signorini_solver** solver) {
  const auto copy = [&] {
    require(matrix, "matrix");
    return copies_of(matrix, 1).front();
  };
  return create(copy, block, setup, solver);
}

int signorini_solve(signorini_solver* solver, const double* b, const double* lower, const double* upper,
                    const double* start, double tolerance, double* x, double* multiplier, signorini_summary* summary) {
  return guarded([&] {
    require(solver, "solver");
    require(b, "b");
    require(x, "x");
    const auto values = [&](const double* array) { return std::span(array, array ? solver->unknowns : 0); };
    solver->solver.set_tolerance(tolerance);
    BlackBox::Result result =
        solver->solver.solve(values(b), values(lower), values(upper), values(start), monitor_of(*solver));
    const int status = status_of(result.summary.outcome);
    if (status == SIGNORINI_SOLVED || status == SIGNORINI_ITERATION_LIMIT || status == SIGNORINI_INTERRUPTED) {
      std::ranges::copy(result.x, x);
      if (multiplier) std::ranges::copy(result.multiplier, multiplier);
      if (summary) *summary = summary_of(result.summary);
      solver->active = std::move(result.active);
      solver->touching = std::move(result.touching);
      solver->history.clear();
      for (const auto& record : result.summary.history) solver->history.push_back(cycle_of(record, solver->vectors));
    }
    return report(status, result.summary.reason.c_str());
  });
}

int signorini_active(const signorini_solver* solver, signed char* active) {
  return guarded([&] {
    require(solver, "solver");
    require(active, "active");
    if (solver->active.size() != solver->unknowns) signorini::input_error("solver", "has no results yet");
    std::ranges::copy(solver->active, active);
    return report(SIGNORINI_SOLVED, "the active set of the last solve");
  });
}

const char* signorini_message() { return message.c_str(); }

void signorini_destroy(signorini_solver* solver) { delete solver; }

int signorini_set_matrix(signorini_solver* solver, const signorini_rows* matrix) {
  return guarded([&] {
    require(solver, "solver");
    require(matrix, "matrix");
    const SparseRows A = copies_of(matrix, 1).front();
    solver->solver.set_matrix(solver->one_triangle ? signorini::from_triangle(A) : A);
    return report(SIGNORINI_SOLVED, "set up");
  });
}

int signorini_set_monitor(signorini_solver* solver, signorini_monitor monitor, void* data) {
  return guarded([&] {
    require(solver, "solver");
    solver->monitor = monitor;
    solver->monitor_data = data;
    return report(SIGNORINI_SOLVED, "monitored");
  });
}

int signorini_current_cycle(const signorini_solver* solver, signorini_cycle* cycle) {
  return guarded([&] {
    require(solver, "solver");
    require(cycle, "cycle");
    if (!solver->cycle) signorini::input_error("solver", "is not within its monitor");
    *cycle = cycle_of(*solver->cycle, solver->vectors);
    return report(SIGNORINI_SOLVED, "the cycle at hand");
  });
}

int signorini_history(const signorini_solver* solver, std::int32_t size, signorini_cycle* cycles, std::int32_t* count) {
  return guarded([&] {
    require(solver, "solver");
    require(count, "count");
    if (size < 0) signorini::input_error("size", fmt::format("found {}, expected 0 or more", size));
    if (size > 0) require(cycles, "cycles");
    const auto& all = solver->history;
    std::copy_n(all.begin(), std::min<std::size_t>(static_cast<std::size_t>(size), all.size()), cycles);
    *count = static_cast<std::int32_t>(all.size());
    return report(SIGNORINI_SOLVED, "the cycles of the last solve");
  });
}

int signorini_set_obstacles(signorini_solver* solver, std::int32_t count, const signorini_obstacle* const* obstacles) {
  return guarded([&] {
    require(solver, "solver");
    if (count < 0) signorini::input_error("count", fmt::format("found {}, expected 0 or more", count));
    if (count > 0) require(obstacles, "obstacles");
    switch (solver->unknowns / static_cast<std::size_t>(solver->vectors)) {
      case 1:
        solver->solver.set_obstacles<1>(signorini::obstacles_from_c<1>(count, obstacles));
        break;
      case 2:
        solver->solver.set_obstacles<2>(signorini::obstacles_from_c<2>(count, obstacles));
        break;
      default:
        solver->solver.set_obstacles<3>(signorini::obstacles_from_c<3>(count, obstacles));
    }
    return report(SIGNORINI_SOLVED, "obstacles are set");
  });
}

int signorini_next_step(signorini_solver* solver) {
  return guarded([&] {
    require(solver, "solver");
    solver->solver.next_step();
    return report(SIGNORINI_SOLVED, "the next load step");
  });
}

int signorini_touching(const signorini_solver* solver, signed char* touching) {
  return guarded([&] {
    require(solver, "solver");
    require(touching, "touching");
    if (solver->active.size() != solver->unknowns) signorini::input_error("solver", "has no results yet");
    std::fill_n(touching, solver->vectors, static_cast<signed char>(0));
    for (const signorini::Index block : solver->touching) touching[block] = 1;
    return report(SIGNORINI_SOLVED, "what obstacles hold");
  });
}
