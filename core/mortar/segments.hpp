#pragma once
#include "core/mesh/point_tree.hpp"
#include "core/mortar/face_frame.hpp"
#include "core/mortar/planes.hpp"
#include "core/mortar/sheets.hpp"
#include "core/mortar/side.hpp"

namespace signorini::mortar {

/// The part of a slave face that sees one face of the master, in the slave face's frame.
template <int D>
struct Segment {
  Index master;                        ///< number of the face
  std::array<Affine<D - 1>, D> shape;  ///< its barycentric coordinates
  Affine<D - 1> gap;                   ///< the master's height less the slave's
  Piece<D - 1> piece;
};

/// Cuts slave faces along the edges of the master. Keeps its memory from face to face.
template <int D>
class SegmentFinder {
 public:
  static constexpr int K = D - 1;

  /// Refers to all of them.
  /// @param own, planes of the slave and of the master
  /// @param tree of the boxes around the master's faces
  /// @param one_numbering faces that share a node do not pair
  SegmentFinder(const Side<D>& slave, const Side<D>& master, const Planes<D>& own, const Planes<D>& planes,
                const PointTree<D>& tree, const CoupleOptions& options, bool one_numbering)
      : slave_(slave),
        master_(master),
        own_planes_(own),
        planes_(planes),
        tree_(tree),
        options_(options),
        one_numbering_(one_numbering) {}

  /// @return whether it sees the master; then the segments, which do not overlap, and the frame are those of the face
  bool find(Index face);

  const FaceFrame<D>& frame() const { return frame_; }
  const std::vector<Segment<D>>& segments() const { return segments_; }
  bool layered() const { return layered_; }  ///< masters behind each other were left out
  /// Whether the face looks along the normal of a plane, not its own: it is part of something bent, all of which sees
  /// that plane. Distances to a plane stay exact however far bodies slide, and so does the direction of forces; along
  /// normals of what is bent they are so to first order only.
  bool along_plane() const { return along_plane_; }

 private:
  void look(Index face, const Point<D>& direction);
  void consider(Index face, Index other);
  bool shares_node(Index face, Index other) const;
  bool in_reach() const;
  Point<D> mean_direction() const;
  void look_along_plane(Index face);
  Index plane_in_front() const;
  void drop_hidden();
  bool is_hidden(const Segment<D>& segment) const;
  void part_layers();
  bool in_one_sheet();
  double split_by_nearness();

  const Side<D>& slave_;
  const Side<D>& master_;
  const Planes<D>&own_planes_, &planes_;
  const PointTree<D>& tree_;
  const CoupleOptions& options_;
  const bool one_numbering_;

  FaceFrame<D> frame_;
  Point<K> low_, high_;  // of the slave face in the plane
  double front_ = 0, behind_ = 0;
  bool layered_ = false, along_plane_ = false;
  std::vector<Segment<D>> segments_, nearest_;
  std::vector<Index> averted_;  // faces of the master that do not face it
  std::vector<Piece<K>> rest_, next_;
  std::vector<Index> order_, masters_;
  std::vector<double> away_;
  Sheets<D> sheets_;
};

}  // namespace signorini::mortar
