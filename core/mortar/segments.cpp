#include "core/mortar/segments.hpp"

#include <cmath>
#include <numeric>

namespace signorini::mortar {
namespace {

// Cosine of the angle up to which normals count as opposite: 60 degrees, less rounding.
constexpr double facing = 0.5 - 1e-9;
// Pieces of less than this part of their face are rounding.
constexpr double no_piece = 1e-14;
// Segments that overlap by less than this part of their face do so by rounding.
constexpr double whole = 1e-9;
// The direction towards the closest points is known when a step changes it by less than this angle: distances then are
// known up to the square of it.
constexpr double settled = 1e-4;
constexpr int most_steps = 8;

template <int K>
std::array<double, 2> range(const Affine<K>& f, const Piece<K>& piece) {
  std::array<double, 2> out{infinity, -infinity};
  for (int i = 0; i < piece.count; ++i) {
    const double value = f(piece.corner[i]);
    out = {std::min(out[0], value), std::max(out[1], value)};
  }
  return out;
}

}  // namespace

template <int D>
bool SegmentFinder<D>::find(Index face) {
  layered_ = along_plane_ = false;
  look(face, slave_.normal[face]);
  if (options_.pairing == Pairing::normal) {
    look_along_plane(face);
  } else {
    for (int step = 0; step < most_steps && !segments_.empty(); ++step) {
      const Point<D> next = mean_direction();
      if (length<D>(difference<D>(next, frame_.direction)) < settled) break;
      look(face, next);
    }
  }
  drop_hidden();
  if (segments_.empty() || !in_reach()) return false;
  part_layers();
  return true;
}

template <int D>
void SegmentFinder<D>::look_along_plane(Index face) {
  if (own_planes_.of(face) >= 0) return;
  const Index plane = plane_in_front();
  if (plane < 0) return;
  Point<D> direction = master_.normal[segments_.front().master];
  for (double& c : direction) c = -c;
  look(face, direction);
  along_plane_ = plane_in_front() == plane;
  if (!along_plane_) look(face, slave_.normal[face]);
}

/// That which all of the face sees; -1: there is none.
template <int D>
Index SegmentFinder<D>::plane_in_front() const {
  if (segments_.empty()) return -1;
  const Index plane = planes_.of(segments_.front().master);
  double covered = 0;
  for (const Segment<D>& s : segments_) {
    if (planes_.of(s.master) != plane) return -1;
    covered += measure(s.piece);
  }
  return covered >= (1 - whole) * frame_.area ? plane : -1;
}

template <int D>
void SegmentFinder<D>::look(Index face, const Point<D>& direction) {
  segments_.clear();
  averted_.clear();
  frame_ = FaceFrame<D>(slave_.corner[face], direction);
  low_ = high_ = frame_.corner[0];
  for (const Point<K>& y : frame_.corner)
    for (int k = 0; k < K; ++k) {
      low_[k] = std::min(low_[k], y[k]);
      high_[k] = std::max(high_[k], y[k]);
    }
  // A face in reach with one corner counts as a whole: the master may be farther off elsewhere, but by no more than the
  // face is long as long as it rises by no more than 45 degrees.
  front_ = options_.reach / frame_.size + 1;
  behind_ = options_.depth.value_or(options_.reach) / frame_.size + 1;
  const auto height = std::ranges::minmax(frame_.corner_height);
  const auto may_hold = [&](const typename PointTree<D>::Box& box) {
    for (int k = 0; k < D; ++k) {
      double middle = 0, half = 0;
      for (int i = 0; i < D; ++i) {
        middle += frame_.axis[k][i] * (0.5 * (box.low[i] + box.high[i]) - frame_.origin[i]);
        half += std::abs(frame_.axis[k][i]) * (0.5 * (box.high[i] - box.low[i]));
      }
      const double from = k < K ? low_[std::min(k, K - 1)] : height.min - behind_;
      const double to = k < K ? high_[std::min(k, K - 1)] : height.max + front_;
      if (middle + half < from || middle - half > to) return false;
    }
    return true;
  };
  tree_.search(may_hold, [&](Index other) { consider(face, other); });
}

template <int D>
bool SegmentFinder<D>::shares_node(Index face, Index other) const {
  for (const Index v : slave_.faces[face])
    for (const Index w : master_.faces[other])
      if (v == w) return true;
  return false;
}

// Adds the segment of a master face, if there is one.
template <int D>
void SegmentFinder<D>::consider(Index face, Index other) {
  const Point<D>& normal = master_.normal[other];
  if (-dot(normal, slave_.normal[face]) < facing || -dot(normal, frame_.direction) < facing) {
    averted_.push_back(other);
    return;
  }
  if (one_numbering_ && shares_node(face, other)) return;
  std::array<Point<K>, D> corner;
  std::array<double, D> height;
  for (int i = 0; i < D; ++i) height[i] = frame_.map(master_.corner[other][i], corner[i]);
  for (int k = 0; k < K; ++k) {
    double low = corner[0][k], high = low;
    for (int i = 1; i < D; ++i) low = std::min(low, corner[i][k]), high = std::max(high, corner[i][k]);
    if (high <= low_[k] || low >= high_[k]) return;
  }
  Segment<D> out{other, barycentric<K>(corner), -frame_.height, Piece<K>(frame_.corner)};
  for (const Affine<K>& f : out.shape) {
    out.piece = clipped(out.piece, f);
    if (out.piece.empty()) return;
  }
  if (measure(out.piece) <= no_piece * frame_.area) return;
  for (int i = 0; i < D; ++i) out.gap.add(height[i], out.shape[i]);
  const auto [least, most] = range(out.gap, out.piece);
  if (least <= front_ && most >= -behind_) segments_.push_back(out);
}

template <int D>
bool SegmentFinder<D>::in_reach() const {
  return std::ranges::any_of(segments_, [&](const Segment<D>& s) {
    const auto [least, most] = range(s.gap, s.piece);
    return least <= front_ - 1 && most >= 1 - behind_;
  });
}

// What lies behind a slave face is an overlap, unless the way there leads out of the master before.
template <int D>
void SegmentFinder<D>::drop_hidden() {
  if (averted_.empty()) return;
  std::erase_if(segments_, [this](const Segment<D>& s) { return is_hidden(s); });
}

template <int D>
bool SegmentFinder<D>::is_hidden(const Segment<D>& segment) const {
  const Moments<K> m = moments(segment.piece);
  Point<K> middle;
  for (int k = 0; k < K; ++k) middle[k] = m.first[k] / m.measure;
  const double behind = segment.gap(middle);
  if (behind >= 0) return false;
  return std::ranges::any_of(averted_, [&](Index other) {
    std::array<Point<K>, D> corner;
    std::array<double, D> height;
    for (int i = 0; i < D; ++i) height[i] = frame_.map(master_.corner[other][i], corner[i]);
    const auto shape = barycentric<K>(corner);
    double gap = -frame_.height(middle);
    for (int i = 0; i < D; ++i) {
      const double part = shape[i](middle);
      if (!(part >= 0)) return false;  // one that is seen from its edge has no coordinates
      gap += part * height[i];
    }
    return behind < gap && gap < 0;
  });
}

// Against the master's normal, its mean over what is seen.
template <int D>
Point<D> SegmentFinder<D>::mean_direction() const {
  Point<D> sum{};
  for (const Segment<D>& s : segments_) {
    const double area = measure(s.piece);
    for (int k = 0; k < D; ++k) sum[k] -= area * master_.normal[s.master][k];
  }
  const double norm = length<D>(sum);
  for (double& c : sum) c /= norm;
  return sum;
}

// Where masters lie behind each other only what is nearest counts. Faces that hang together by edges, all facing the
// slave, do not unless they cover more than there is.
template <int D>
void SegmentFinder<D>::part_layers() {
  double sum = 0;
  for (const Segment<D>& s : segments_) sum += measure(s.piece);
  if (sum <= (1 + whole) * frame_.area && in_one_sheet()) return;
  const double left = split_by_nearness();
  layered_ = sum - left > whole * frame_.area;
  if (layered_) segments_.swap(nearest_);
}

template <int D>
bool SegmentFinder<D>::in_one_sheet() {
  masters_.clear();
  for (const Segment<D>& s : segments_) masters_.push_back(s.master);
  sheets_.find(master_, masters_);
  return sheets_.count() == 1;
}

/// Makes nearest_ of the segments: what is nearer takes its part of the face first.
/// @return the measure of what they cover
template <int D>
double SegmentFinder<D>::split_by_nearness() {
  nearest_.clear();
  away_.clear();
  for (const Segment<D>& s : segments_) {
    const auto [least, most] = range(s.gap, s.piece);
    away_.push_back(std::abs(least + most));
  }
  order_.resize(segments_.size());
  std::iota(order_.begin(), order_.end(), Index{0});
  std::ranges::sort(order_, [this](Index a, Index b) {
    return away_[a] != away_[b] ? away_[a] < away_[b] : segments_[a].master < segments_[b].master;
  });
  double covered = 0;
  rest_.assign(1, Piece<K>(frame_.corner));
  for (const Index s : order_) {
    next_.clear();
    for (Piece<K> inside : rest_) {
      for (const Affine<K>& f : segments_[s].shape) {
        each_simplex(clipped(inside, -f), [this](const std::array<Point<K>, K + 1>& simplex) {
          if (signed_measure<K>(simplex) > no_piece * frame_.area) next_.emplace_back(simplex);
        });
        inside = clipped(inside, f);
      }
      const double area = measure(inside);
      if (area <= no_piece * frame_.area) continue;
      covered += area;
      nearest_.push_back(segments_[s]);
      nearest_.back().piece = inside;
    }
    rest_.swap(next_);
  }
  return covered;
}

template class SegmentFinder<2>;
template class SegmentFinder<3>;

}  // namespace signorini::mortar
