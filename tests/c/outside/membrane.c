/* A membrane on a square that a load presses onto a floor. */
#include <stdio.h>
#include <stdlib.h>

#include <signorini/c/signorini.h>

enum { side = 200, unknowns = side * side };

/* The five-point stencil on the inner nodes of a grid, row by row. */
static int32_t fill(int32_t* row, int32_t* column, double* value) {
  int32_t k = 0;
  for (int i = 0; i < unknowns; ++i) {
    const int x = i % side, y = i / side;
    row[i] = k;
    column[k] = i, value[k++] = 4;
    if (x > 0) column[k] = i - 1, value[k++] = -1;
    if (x + 1 < side) column[k] = i + 1, value[k++] = -1;
    if (y > 0) column[k] = i - side, value[k++] = -1;
    if (y + 1 < side) column[k] = i + side, value[k++] = -1;
  }
  return row[unknowns] = k;
}

int main(void) {
  static int32_t row[unknowns + 1], column[5 * unknowns];
  static double value[5 * unknowns], load[unknowns], floor_at[unknowns], x[unknowns], force[unknowns];
  fill(row, column, value);
  signorini_solver* solver;
  if (signorini_create(unknowns, row, column, value, 1, &solver) != SIGNORINI_SOLVED) {
    fprintf(stderr, "%s\n", signorini_message());
    return 1;
  }
  for (int step = 1; step <= 3; ++step) { /* the floor sinks; each step starts from the one before */
    signorini_summary summary;
    double pressure = 0;
    for (int i = 0; i < unknowns; ++i) {
      load[i] = -1.0 / unknowns;
      floor_at[i] = -0.02 * step;
    }
    const double* start = step == 1 ? NULL : x;
    if (signorini_solve(solver, load, floor_at, NULL, start, 1e-8, x, force, &summary) != SIGNORINI_SOLVED) {
      fprintf(stderr, "%s\n", signorini_message());
      return 1;
    }
    for (int i = 0; i < unknowns; ++i) pressure += force[i];
    printf("floor %g carries %.4f: %d cycles on %d levels\n", floor_at[0], pressure, summary.iterations,
           summary.levels);
  }
  signorini_destroy(solver);
  return 0;
}
