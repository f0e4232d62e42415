#pragma once
#include "stack.hpp"

namespace signorini::test {

inline double decades(Random& random, double range) { return std::pow(10.0, random.between(-range, range)); }

/// @param order of the elements: bodies that touch each other have one
inline Material any_material(Random& random, int order) {
  Material out{decades(random, 1.5), random.between(0, 0.45), order};
  if (order == 2 && random.chance(0.3)) out.poisson = random.chance(0.5) ? 0.49 : 0.499;
  return out;
}

/// By how much a block under one stress widens, over that stress.
template <int D>
double widening(const Stack<D>& column, const Material& m) {
  return m.poisson / m.young * (column.in_strain() ? 1 + m.poisson : 1);
}

/// Blocks of one cross-section, free sideways, so that the stress is the same everywhere: see expected_force().
template <int D>
Stack<D> random_column(Random& random) {
  Stack<D> out;
  using enum Kind;
  constexpr Kind plane_kinds[] = {files, files, shapes, symmetric, axisymmetric},
                 space_kinds[] = {files, files, shapes, symmetric, solids};
  out.kind = (D == 2 ? plane_kinds : space_kinds)[random.below(5)];
  out.plane = random.chance(0.5) ? "strain" : "stress";
  out.only_down = true;
  out.on_plane = random.chance(0.4);
  out.steps = 1 + random.below(2);
  out.refinements = out.kind == solids ? 0 : random.below(D == 2 ? 3 : 2);
  Point<D> from{}, width;
  for (double& w : width) w = random.between(0.5, 1.5);
  if (out.kind == symmetric) from[0] = -width[0] / 2;
  if (out.kind == axisymmetric) from[0] = random.chance(0.5) ? 0 : random.between(0.3, 2);
  const bool alike = random.chance(0.3);
  const int order = 1 + random.below(2);
  const Material first = any_material(random, order);
  if (alike && !out.on_plane && random.chance(0.7)) out.friction = random.between(0.05, 1);
  double height = 0, gaps = 0;
  const int n = 1 + random.below(D == 2 ? 4 : 3);
  if (n == 1) out.on_plane = true, out.friction = 0;
  for (int k = 0; k < n; ++k) {
    const double gap = k > 0 || out.on_plane ? 0.01 * (random.below(3) - 1) * random.between(0.5, 1) : 0;
    Block<D> block;
    block.from = from, block.from[D - 1] = height + gap;
    for (int i = 0; i < D; ++i) {
      block.to[i] = block.from[i] + (i == D - 1 ? random.between(0.3, 1) : width[i]);
      block.cells[i] = 1 + random.below(3);
    }
    if (out.kind == symmetric) block.cells[0] *= 2;
    height = block.to[D - 1], gaps += gap;
    out.blocks.push_back(block), out.gaps.push_back(gap);
    out.materials.push_back(alike ? first : any_material(random, order));
  }
  // A second step pairs blocks where the first one has moved them to: they are to widen by the same.
  if (out.steps > 1)
    for (Material& m : out.materials) {
      if (!alike) m.poisson = std::max(m.poisson, 0.05);
      m.young *= widening(out, m) / widening(out, out.materials[0]);
    }
  out.motion[D - 1] = -gaps - random.between(0.005, 0.02) * (random.chance(0.15) ? -1 : 1);
  return out;
}

/// What presses through a column.
template <int D>
double expected_force(const Stack<D>& column, double t) {
  double closed = -t * column.motion[D - 1], compliance = 0, area = 1;
  for (std::size_t k = 0; k < column.blocks.size(); ++k) {
    const Block<D>& b = column.blocks[k];
    const Material& m = column.materials[k];
    closed -= column.gaps[k];
    compliance += (b.to[D - 1] - b.from[D - 1]) * (column.in_strain() ? 1 - m.poisson * m.poisson : 1) / m.young;
  }
  const Block<D>& b = column.blocks[0];
  for (int i = 0; i + 1 < D; ++i) area *= b.to[i] - b.from[i];
  if (column.kind == Kind::axisymmetric) area = 3.14159265358979323846 * (b.to[0] * b.to[0] - b.from[0] * b.from[0]);
  return std::max(closed, 0.0) / compliance * area;
}

/// Blocks that overhang each other, of any materials, with or without friction, whose top is moved anywhere downwards.
template <int D>
Stack<D> random_pile(Random& random) {
  Stack<D> out;
  out.plane = random.chance(0.5) ? "strain" : "stress";
  out.steps = 1 + random.below(3);
  out.refinements = random.below(D == 2 ? 3 : 2);
  out.on_plane = random.chance(0.3);
  if (random.chance(0.6)) out.friction = random.between(0.05, 0.5);
  const int n = 1 + random.below(D == 2 ? 4 : 3);
  if (n == 1) out.on_plane = true;
  const int order = 1 + random.below(2);
  double height = 0;
  for (int k = 0; k < n; ++k) {
    const double gap = (k > 0 || out.on_plane) && random.chance(0.5) ? random.between(-0.004, 0.004) : 0;
    Block<D> block;
    for (int i = 0; i + 1 < D; ++i) {
      const double middle = random.between(-0.2, 0.2), half = random.between(0.4, 0.8);
      block.from[i] = middle - half, block.to[i] = middle + half;
      block.cells[i] = 1 + random.below(3);
    }
    block.from[D - 1] = height + gap;
    block.to[D - 1] = height = block.from[D - 1] + random.between(0.3, 0.8);
    block.cells[D - 1] = 1 + random.below(2);
    out.blocks.push_back(block), out.gaps.push_back(gap);
    out.materials.push_back(any_material(random, order));
  }
  for (int i = 0; i + 1 < D; ++i) out.motion[i] = random.chance(0.5) ? random.between(-0.02, 0.02) : 0;
  out.motion[D - 1] = -0.01 * n - random.between(0, 0.02);
  return out;
}

}  // namespace signorini::test
