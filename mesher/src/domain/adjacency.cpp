// Neighbours, walls, and the flood that walls stop.
#include "domain/adjacency.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "mesher/error.hpp"
#include "mesher/mesh_data.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

std::uint32_t Adjacency::open_neighbour(std::uint32_t t, int i) const {
  return is_wall(t, i) ? kNoTriangle : neighbours[t][i];
}

std::vector<Edge> ends_of(const std::vector<MeshEdge>& walls) {
  std::vector<Edge> ends;
  ends.reserve(walls.size());
  for (const MeshEdge& wall : walls) ends.push_back({wall.low, wall.high});
  return ends;
}

Adjacency adjacency(const std::vector<Corners>& triangles, const std::vector<Edge>& walls) {
  const Sides sides(triangles);
  Joined next = joined(sides);
  SAC_EXPECTS(next.in_pairs);
  Adjacency result{std::move(next.neighbours), std::vector<std::uint8_t>(triangles.size())};
  for (const Edge& wall : walls) {
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

std::vector<std::uint32_t> flood(const Adjacency& adjacency) {
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
      for (int i = 0; i < 3; ++i) {
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

}  // namespace mesher::detail
