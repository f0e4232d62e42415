#include "core/geometry/joints.hpp"

#include "core/mesh/simplex.hpp"
#include "core/mesh/subsimplices.hpp"

namespace signorini::geometry {

template <int D>
Joints<D> find_joints(Index vertices, const std::vector<std::array<Index, D>>& faces) {
  Joints<D> out;
  const auto count = static_cast<Offset>(faces.size() * D);
  const auto vertices_of = [&](Offset i) { return sorted(joint_of<D>(faces[i / D], static_cast<int>(i % D))); };
  if constexpr (D == 2) {
    for (Offset i = 0; i < count; ++i) out.number.push_back(vertices_of(i)[0]);
    out.count = vertices;
  } else {
    const Numbering edges = number_subsimplices<2>(vertices, count, vertices_of);
    out.number = edges.number;
    out.count = edges.distinct;
  }
  std::vector<std::array<Index, 2>> at(static_cast<std::size_t>(out.count), {-1, -1});
  std::vector<int> faces_at(static_cast<std::size_t>(out.count), 0);
  for (Offset i = 0; i < count; ++i)
    if (const int k = faces_at[out.number[i]]++; k < 2) at[out.number[i]][k] = static_cast<Index>(i);
  out.beyond.assign(static_cast<std::size_t>(count), -1);
  for (Index j = 0; j < out.count; ++j) {
    if (faces_at[j] != 2) continue;
    const auto [a, b] = at[j];
    out.beyond[a] = b;
    out.beyond[b] = a;
  }
  return out;
}

template Joints<2> find_joints<2>(Index, const std::vector<std::array<Index, 2>>&);
template Joints<3> find_joints<3>(Index, const std::vector<std::array<Index, 3>>&);

}  // namespace signorini::geometry
