#pragma once
#include "core/sdk/block.hpp"

namespace signorini {

/// Exact minimiser d of 1/2 d'Md - r'd over lower <= d <= upper, B unknowns, with lower <= 0 <= upper (infinite bounds
/// allowed). It is the best among the admissible minimisers of all faces of the box; faces without bounds cost nothing.
template <int B>
struct BoxMinimiser {
  /// The minimiser of a scalar problem, from that of the unbounded one. NaN stays visible.
  static double clamp(double x, double lower, double upper) requires(B == 1) { return block::clamp(x, lower, upper); }

  static void correct(const double* M, const double* inverse, const double* r, const double* lower, const double* upper,
                      double* d) {
    block::product<B>(inverse, r, d);
    if (inside(d, lower, upper, (1u << B) - 1)) return;
    if constexpr (B == 1)
      d[0] = block::clamp(d[0], lower[0], upper[0]);
    else
      search_faces(M, r, lower, upper, d);
  }

 private:
  static bool inside(const double* d, const double* lower, const double* upper, unsigned components) {
    for (int k = 0; k < B; ++k)
      if ((components >> k & 1u) && !(d[k] >= lower[k] && d[k] <= upper[k])) return false;
    return true;
  }

  static double energy(const double* M, const double* r, const double* d) {
    double Md[B], e = 0;
    block::product<B>(M, d, Md);
    for (int k = 0; k < B; ++k) e += (0.5 * Md[k] - r[k]) * d[k];
    return e;
  }

  // Every choice of "free, at lower, at upper" per component, written as a number to base three; 0 (all free) has been
  // tried already. A vertex of the box always is admissible; where a bound is infinite its component stays free.
  static void search_faces(const double* M, const double* r, const double* lower, const double* upper, double* best) {
    int faces = 1;
    for (int k = 0; k < B; ++k) faces *= 3;
    double least = 0;
    for (int k = 0; k < B; ++k) best[k] = 0;
    for (int face = 1; face < faces; ++face) {
      double d[B];
      unsigned free = 0;
      if (!pin(face, lower, upper, d, free)) continue;
      minimise_free(M, r, free, d);
      if (!inside(d, lower, upper, free)) continue;
      if (const double e = energy(M, r, d); e < least) {
        least = e;
        for (int k = 0; k < B; ++k) best[k] = d[k];
      }
    }
  }

  static bool pin(int face, const double* lower, const double* upper, double* d, unsigned& free) {
    for (int k = 0; k < B; ++k, face /= 3) {
      d[k] = 0;
      if (face % 3 == 0) {
        free |= 1u << k;
        continue;
      }
      d[k] = face % 3 == 1 ? lower[k] : upper[k];
      if (!(std::fabs(d[k]) < infinity)) return false;
    }
    return true;
  }

  static void minimise_free(const double* M, const double* r, unsigned free, double* d) {
    double rest[B], y[B];
    for (int k = 0; k < B; ++k) rest[k] = r[k];
    block::subtract_product<B>(M, d, rest);
    block::solve<B>(M, rest, free, y);
    for (int k = 0; k < B; ++k) d[k] += y[k];
  }
};

}  // namespace signorini
