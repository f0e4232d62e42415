#include "core/mortar/face_integrals.hpp"

#include "core/mortar/dual_basis.hpp"

namespace signorini::mortar {

template <int D>
void FaceIntegrator<D>::add(Index face, FaceIntegrals<D>& to) {
  constexpr int K = D - 1;
  if (!finder_.find(face)) return;
  const FaceFrame<D>& frame = finder_.frame();
  const DualBasis<D> dual(frame, finder_.segments());
  note_overlap(face, to.deepest);
  to.lumped += dual.lumped();
  to.layered += finder_.layered();
  const double scale = slave_.area[face] / frame.area;  // from the plane to the slave
  to.records.push_back({face, frame.direction, {}, {}, to.entries.size(), 0});
  FaceRecord<D>& record = to.records.back();
  for (int p = 0; p < D; ++p) record.share[p] = scale * dual.share(p);
  for (const Segment<D>& s : finder_.segments()) {
    const Moments<K> m = moments(s.piece, dual.axes());
    std::array<typename DualBasis<D>::Integral, D> r;
    for (int p = 0; p < D; ++p) {
      r[p] = dual.integral(m, p);
      record.gap[p] += frame.size * dual.of(r[p], s.gap);
    }
    for (int i = 0; i < D; ++i) {
      FaceEntry<D>& to_node = entry(master_.faces[s.master][i], to);
      for (int p = 0; p < D; ++p) to_node.value[p] += dual.of(r[p], s.shape[i]);
    }
  }
  record.last = to.entries.size();
}

// That of a point in the last record.
template <int D>
FaceEntry<D>& FaceIntegrator<D>::entry(Index point, FaceIntegrals<D>& to) {
  const Index q = master_.number[point];
  if (place_[q] < to.records.back().first || place_[q] >= to.entries.size() || to.entries[place_[q]].master != q) {
    place_[q] = to.entries.size();
    to.entries.push_back({q, {}});
  }
  return to.entries[place_[q]];
}

template <int D>
void FaceIntegrator<D>::note_overlap(Index face, DeepestOverlap<D>& deepest) const {
  const FaceFrame<D>& frame = finder_.frame();
  for (const Segment<D>& s : finder_.segments())
    for (int i = 0; i < s.piece.count; ++i) {
      const Point<D - 1>& y = s.piece.corner[i];
      const double depth = -frame.size * s.gap(y);
      if (depth > deepest.depth) deepest = {depth, frame.place(y, frame.height(y)), face, s.master};
    }
}

template class FaceIntegrator<2>;
template class FaceIntegrator<3>;

}  // namespace signorini::mortar
