#ifndef SIGNORINI_H
#define SIGNORINI_H
/*
 * Plain C interface of the solver for matrices, bounds and obstacles,
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

/*
 * What an energy of the caller sees of one block, all in the block's local coordinates: component k is along direction
 * k of the obstacle, the others are orthogonal to all directions. Keeps its members.
 */
typedef struct {
  int32_t unknowns;           /* of the block: 1, 2 or 3; that many values have `lower`, `upper` and `last` */
  const double *lower, *upper; /* bounds, infinite where there is none, equal where a component is prescribed */
  const double* number;        /* the energy's own numbers, of this block */
  const double* last;          /* values after the last load step, zero in the first: signorini_next_step() */
  const double* before;        /* `number` at the end of the last load step, zero in the first */
  unsigned tangential;         /* bit k: component k is orthogonal to the obstacle's first direction */
} signorini_slot;

/*
 * An energy phi that is added at each block: convex, and smooth but for kinks. Functions may be called by several
 * threads at a time and must not throw or jump; M is the block's own unknowns x unknowns matrix, row-major. They see no
 * block's number: what differs between blocks is in `number`. Begin with `signorini_energy energy = SIGNORINI_ENERGY;`.
 */
typedef struct {
  size_t size; /* sizeof(signorini_energy) */
  /* phi(to) - phi(from), without cancellation */
  double (*change)(const signorini_slot* slot, const double* from, const double* to, void* data);
  /* the one-sided derivative of phi at `at` along `step` */
  double (*slope)(const signorini_slot* slot, const double* at, const double* step, void* data);
  /* y: the minimiser of 1/2 (y-x)'M(y-x) - r'(y-x) + phi(y) within the bounds, which it meets exactly, like kinks */
  void (*minimise)(const signorini_slot* slot, const double* M, const double* r, const double* x, double* y,
                   void* data);
  /* gradient and Hessian (row-major) at x of the piece of phi that x is on; both are zero before. Components at a kink
     stay zero there and get their bit set in *critical */
  void (*linearise)(const signorini_slot* slot, const double* x, double* gradient, double* hessian, unsigned* critical,
                    void* data);
  /* null, or: phi depends on the solution, as Coulomb's friction does: `number`, which slot->number is a copy of, is
     written anew from x and the residual r = b - Ax before each cycle */
  void (*renew)(const signorini_slot* slot, const double* M, const double* r, const double* x, double* number,
                void* data);
  /* null, or: makes the numbers those of a block that stands for `ratio` as much of the surface. Without it starts from
     coarser levels leave phi out */
  void (*scale)(double ratio, double* number, void* data);
  void* data; /* passed on */
} signorini_energy;

#define SIGNORINI_ENERGY \
  { sizeof(signorini_energy), 0, 0, 0, 0, 0, 0, 0 }

/*
 * An obstacle at some blocks: lower <= direction . v <= upper for the unknowns v of each, B of them. Begin with
 * `signorini_obstacle obstacle = SIGNORINI_OBSTACLE;`. Arrays are copied.
 */
typedef struct {
  size_t size;             /* sizeof(signorini_obstacle) */
  const char* name;        /* for messages; null: "obstacle" */
  int32_t blocks;          /* it acts on so many, */
  const int32_t* block;    /* these, from 0, ascending: block p is rows p * B to p * B + B - 1 */
  int32_t directions;      /* at each of them: 1 to B */
  const double* direction; /* blocks x directions x B: unit vectors, such as the outer normals of what is in the way;
                              null: the first coordinate axes */
  const double* lower;     /* blocks x directions; null, or infinite: none. A gap is a lower bound -gap */
  const double* upper;
  const double* friction; /* null, or: for each block the coefficient of Coulomb's friction along one direction */
  const signorini_energy* energy; /* null, or: an energy of the caller, in place of friction */
  int32_t numbers;                /* of the energy per block: 0 to 8 */
  const double* number;           /* blocks x numbers */
} signorini_obstacle;

#define SIGNORINI_OBSTACLE \
  { sizeof(signorini_obstacle), 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0 }

/*
 * Obstacles for the solves from now on, in place of those before, which also forget the last load step; `count` 0: none.
 * They act together with the bounds of signorini_solve(). `multiplier` is then all of Ax - b at their blocks. Several
 * may act on one block, one of them with friction or an energy. Where another status than SIGNORINI_SOLVED is returned
 * nothing has changed; the message names obstacle and block. A wrong energy, as far as it is noticed, makes
 * signorini_solve() return SIGNORINI_BAD_INPUT.
 */
int signorini_set_obstacles(signorini_solver* solver, int32_t count, const signorini_obstacle* const* obstacles);

/* A load step ends with the last solution with obstacles: friction counts slip from there. */
int signorini_next_step(signorini_solver* solver);

/* For each block: 1 where an obstacle held it in the last solve that wrote results, else 0. */
int signorini_touching(const signorini_solver* solver, signed char* touching);

#ifdef __cplusplus
}
#endif
#endif
