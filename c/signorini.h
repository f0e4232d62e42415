#ifndef SIGNORINI_H
#define SIGNORINI_H
/*
 * Plain C interface of the solver for matrices and bounds,
 *
 *     min 1/2 x'Ax - b'x   over lower <= x <= upper
 *
 * for a sparse symmetric positive (semi)definite matrix A. See docs/black_box.md. Arrays belong to the caller and are
 * read or written during the call only. No exception leaves a function; a solver serves one thread at a time, different
 * solvers may be used by different threads.
 */
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What the functions return: the exit status of `signorini qp`. */
enum {
  SIGNORINI_SOLVED = 0,
  SIGNORINI_BAD_INPUT = 2,       /* the matrix, a vector or an argument */
  SIGNORINI_ITERATION_LIMIT = 3, /* or the method cannot go on, or rounding leaves too large an error to claim anything;
                                    results are written */
  SIGNORINI_NO_SOLUTION = 4,     /* bounds with nothing between them, energy unbounded below */
  SIGNORINI_FAILURE = 6,         /* memory, or a mistake of this library */
  SIGNORINI_INTERRUPTED = 130    /* by the monitor; results are written */
};

/* Levels of a matrix. The set-up serves any number of right-hand sides and bounds. */
typedef struct signorini_solver signorini_solver;

/* Keeps its members: what else there may be to say later on gets functions of its own. */
typedef struct {
  int iterations, levels;
  double residual;        /* natural residual over its value at the projected zero */
  double algebraic_error; /* estimate of |x - x*| / |x*| in the norm of A */
  double energy;          /* 1/2 x'Ax - b'x */
  double rate;            /* mean reduction of the error per iteration at the end; NaN where it is not known */
  double rounding_error;  /* part of algebraic_error that rounding leaves however long one iterates */
  int32_t limited_by_rounding; /* 1: solved as far as rounding allows, which is not to the tolerance */
} signorini_summary;

/*
 * Sets up a solver for `rows` rows in compressed form: entries row[i] to row[i + 1] - 1 of `column` (from 0) and
 * `value` are those of row i, in any order; both triangles are given. `block` is 1, 2 or 3 consecutive unknowns that
 * belong together, or 0: as the matrix looks like. *solver is null unless SIGNORINI_SOLVED is returned.
 * signorini_create64 is for more than 2^31 entries.
 */
int signorini_create(int32_t rows, const int32_t* row, const int32_t* column, const double* value, int block,
                     signorini_solver** solver);
int signorini_create64(int32_t rows, const int64_t* row, const int32_t* column, const double* value, int block,
                       signorini_solver** solver);

/* Sparse rows as above: entries row[i] to row[i + 1] - 1 of `column` (from 0) and `value` are those of row i. */
typedef struct {
  int32_t rows, columns;
  const int64_t* row;
  const int32_t* column;
  const double* value;
} signorini_rows;

/*
 * What a solver may be told beyond its matrix; zero and null are the defaults. Begin with
 * `signorini_setup setup = SIGNORINI_SETUP;`, which sets its size: later versions of this header add members at its end,
 * and what a program knows of them is told by the size. Levels are chosen by the matrix where no interpolations are
 * given.
 */
typedef struct {
  size_t size;                 /* sizeof(signorini_setup) */
  const char* const* settings; /* "method=tnnmg", "max_iterations=50"...: keys of docs/solver_options.md but those of
                                  scenes: `start`, `algebraic`, `hierarchy` and `bodies`; ended by a null;
                                  signorini_solve() gives the tolerance */
  const double* coordinates;   /* of elastic vectors, `block` for each: their rigid motions have little energy */
  int32_t modes;               /* in place of `coordinates`: how many directions of little energy, */
  const double* near_null;     /* and for each row of the matrix one value per direction */
  int32_t levels;              /* how many interpolations of another multigrid code, coarsest first: one row per fine
                                  vector of `block` unknowns, one column per coarse one */
  const signorini_rows* interpolations;
  const signorini_rows* coarse_matrices; /* one for each, in the same order: Galerkin products; null: computed */
  int one_triangle; /* not 0: the matrix is given by its lower or its upper triangle with the diagonal */
} signorini_setup;

#define SIGNORINI_SETUP \
  { sizeof(signorini_setup), 0, 0, 0, 0, 0, 0, 0, 0 }

/* As signorini_create(); null is allowed for `setup`. */
int signorini_create_with(const signorini_rows* matrix, int block, const signorini_setup* setup,
                          signorini_solver** solver);

/*
 * Solves to a relative error of `tolerance`, in (0, 1). `b` has one value per row, as have the others. Null is allowed
 * for `lower` and `upper` (none; single ones are infinite), `start` (from coarser levels), `multiplier` (Ax - b where a
 * bound holds: at a solution >= 0 at lower bounds, <= 0 at upper ones; exactly 0 elsewhere) and `summary`. What is
 * written is the solution where SIGNORINI_SOLVED is returned, the last iterate with SIGNORINI_ITERATION_LIMIT and
 * SIGNORINI_INTERRUPTED, and nothing with the others.
 */
int signorini_solve(signorini_solver* solver, const double* b, const double* lower, const double* upper,
                    const double* start, double tolerance, double* x, double* multiplier, signorini_summary* summary);

/*
 * The active set of the last solve that wrote results: for each row -1 where x is at its lower bound, 1 at its upper
 * one, 0 between them; equal bounds count by the sign of the multiplier, as lower ones where it is 0.
 */
int signorini_active(const signorini_solver* solver, signed char* active);

/* Why the last call in this thread returned what it did; never null. Rows and columns are counted from 1. */
const char* signorini_message(void);

/* Null is allowed. */
void signorini_destroy(signorini_solver* solver);

/*
 * Another matrix of the same size for the solves from now on, such as that of the next time step: both triangles unless
 * the setup said otherwise. The interpolations between the levels stay, their matrices are computed anew. Where another
 * status than SIGNORINI_SOLVED is returned nothing has changed.
 */
int signorini_set_matrix(signorini_solver* solver, const signorini_rows* matrix);

/*
 * Called after every cycle of a solve from now on, also of those on coarser levels that give a start; `data` is passed
 * on. Once it returns something else than 0 the solve ends with SIGNORINI_INTERRUPTED. It must not throw or jump.
 * Null: none.
 */
typedef int (*signorini_monitor)(int iteration, double residual, double algebraic_error, void* data);
int signorini_set_monitor(signorini_solver* solver, signorini_monitor monitor, void* data);

/* A cycle, or a step of another method. Keeps its members. */
typedef struct {
  int32_t iteration; /* from 1, over all methods that were kept */
  int32_t finest;    /* 1: on the matrix itself; 0: on a coarser level, to give a start */
  int32_t contact;   /* blocks with an unknown at a bound */
  int32_t changed;   /* blocks where that has changed since the last cycle */
  double residual;   /* as in signorini_summary */
  double algebraic_error, energy;
} signorini_cycle;

/* Within the monitor: the cycle after which it is called. */
int signorini_current_cycle(const signorini_solver* solver, signorini_cycle* cycle);

/*
 * The cycles of the last solve that wrote results, in their order: at most `size` of them are written to `cycles`,
 * which may be null where `size` is 0, and *count is how many there are.
 */
int signorini_history(const signorini_solver* solver, int32_t size, signorini_cycle* cycles, int32_t* count);

#ifdef __cplusplus
}
#endif
#endif
