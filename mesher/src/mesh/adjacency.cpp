// Neighbours, walls, and the flood that walls stop.
#include "mesh/adjacency.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"
#include "sac/check.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

std::vector<SideEnds> corners_of(const std::vector<MeshEdge>& walls) {
  std::vector<SideEnds> ends;
  ends.reserve(walls.size());
  for (const MeshEdge& wall : walls) ends.push_back({wall.low, wall.high});
  return ends;
}

std::vector<Face> corners_of(const std::vector<MeshFace>& walls) {
  std::vector<Face> corners;
  corners.reserve(walls.size());
  for (const MeshFace& wall : walls) corners.push_back(wall.key());
  return corners;
}

Adjacency adjacency(const std::vector<Corners>& triangles, const std::vector<SideEnds>& walls) {
  const Sides sides(triangles);
  Joined next = joined(sides);
  SAC_EXPECTS(next.in_pairs);
  Adjacency result{std::move(next.neighbours), std::vector<std::uint8_t>(triangles.size())};
  for (const SideEnds& wall : walls) {
    const auto both = sides.of({std::min(wall[0], wall[1]), std::max(wall[0], wall[1])});
    if (both.empty()) {
      throw Error(ErrorCode::bad_mesh, "no edge joins vertices " + std::to_string(wall[0] + 1) +
                                           " and " + std::to_string(wall[1] + 1) +
                                           ", which a segment does");
    }
    for (const Side& side : both) {
      result.walls[side.triangle] |= static_cast<std::uint8_t>(1 << side.corner);
    }
  }
  return result;
}

AdjacencyOf<3> adjacency(const std::vector<Mesh<3>::Simplex>& tetrahedra,
                         const std::vector<Face>& walls) {
  AdjacencyOf<3> result;
  std::array<std::uint32_t, 4> none;
  none.fill(kNoTriangle);
  result.neighbours.assign(tetrahedra.size(), none);
  result.walls.resize(tetrahedra.size());
  std::vector<Face> left = walls;
  make_set(left);
  const auto corner_of = [&](const HalfFace& half) {
    const auto& s = tetrahedra[half.tetrahedron];
    return static_cast<std::size_t>(std::find(s.begin(), s.end(), half.opposite) - s.begin());
  };
  const HalfFaces halves(tetrahedra);
  auto wall = left.begin();
  for (std::size_t i = 0, n = 0; i < halves.size(); i += n) {
    n = halves.partners(i);
    SAC_EXPECTS(n <= 2);
    if (n == 2) {
      const HalfFace &a = halves[i], &b = halves[i + 1];
      result.neighbours[a.tetrahedron][corner_of(a)] = b.tetrahedron;
      result.neighbours[b.tetrahedron][corner_of(b)] = a.tetrahedron;
    }
    if (wall != left.end() && *wall < halves[i].key()) break;  // it is no face
    if (wall == left.end() || *wall != halves[i].key()) continue;
    for (std::size_t k = i; k < i + n; ++k) {
      result.walls[halves[k].tetrahedron] |= static_cast<std::uint8_t>(1 << corner_of(halves[k]));
    }
    ++wall;
  }
  if (wall == left.end()) return result;
  std::string names;
  for (const std::uint32_t v : *wall) names += ' ' + std::to_string(v + 1);
  throw Error(ErrorCode::bad_mesh, "no face has the vertices" + names + ", which a polygon has");
}

template <int D>
std::vector<std::uint32_t> flood(const AdjacencyOf<D>& adjacency) {
  const auto size = static_cast<std::uint32_t>(adjacency.neighbours.size());
  std::vector<std::uint32_t> region(size, UINT32_MAX), reached;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < size; ++first) {
    if (region[first] != UINT32_MAX) continue;
    region[first] = count;
    reached.assign(1, first);
    while (!reached.empty()) {
      const std::uint32_t t = reached.back();
      reached.pop_back();
      for (int i = 0; i <= D; ++i) {
        const std::uint32_t n = adjacency.open_neighbour(t, i);
        if (n == kNoTriangle || region[n] != UINT32_MAX) continue;
        region[n] = count;
        reached.push_back(n);
      }
    }
    ++count;
  }
  return region;
}

template std::vector<std::uint32_t> flood<2>(const AdjacencyOf<2>&);
#ifndef MESHER_PLANE_ONLY
template std::vector<std::uint32_t> flood<3>(const AdjacencyOf<3>&);
#endif

}  // namespace mesher::detail
