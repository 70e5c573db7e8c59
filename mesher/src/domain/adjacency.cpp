// Sides are sorted by counting their lower ends, then among the few of one end.
#include "domain/adjacency.hpp"

#include <algorithm>
#include <span>
#include <string>

#include "mesher/mesh_data.hpp"
#include "sac/check.hpp"

namespace mesher::detail {
namespace {

struct Side {
  std::uint32_t high;
  std::uint32_t triangle;
  int edge;
};

Edge ends_of(const Corners& t, int edge) {
  const auto [low, high] = std::minmax(t[next_corner(edge)], t[previous_corner(edge)]);
  return {low, high};
}

// The sides of all triangles by their lower end.
class Sides {
 public:
  explicit Sides(const std::vector<Corners>& triangles) {
    std::uint32_t vertices = 0;
    for (const Corners& t : triangles)
      vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    count(triangles, vertices);
    place(triangles);
    for (std::uint32_t v = 0; v < vertices; ++v) {
      std::sort(sides_.begin() + start_[v], sides_.begin() + start_[v + 1],
                [](const Side& a, const Side& b) { return a.high < b.high; });
    }
  }

  [[nodiscard]] std::size_t vertices() const { return start_.size() - 1; }
  [[nodiscard]] std::span<const Side> at(std::uint32_t low) const {
    return std::span(sides_).subspan(start_[low], start_[low + 1] - start_[low]);
  }
  /// The one or two sides of an edge; none if there is no such edge.
  [[nodiscard]] std::span<const Side> of(const Edge& edge) const {
    if (edge[0] >= vertices()) return {};
    const auto all = at(edge[0]);
    const auto first = std::lower_bound(all.begin(), all.end(), edge[1],
                                        [](const Side& s, std::uint32_t v) { return s.high < v; });
    auto last = first;
    while (last != all.end() && last->high == edge[1]) ++last;
    return {first, last};
  }

 private:
  void count(const std::vector<Corners>& triangles, std::uint32_t vertices) {
    start_.assign(vertices + std::size_t{1}, 0);
    for (const Corners& t : triangles) {
      for (int i = 0; i < 3; ++i) ++start_[ends_of(t, i)[0] + 1];
    }
    for (std::uint32_t v = 0; v < vertices; ++v) start_[v + 1] += start_[v];
  }
  void place(const std::vector<Corners>& triangles) {
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    sides_.resize(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const Edge ends = ends_of(triangles[t], i);
        sides_[next[ends[0]]++] = {ends[1], t, i};
      }
    }
  }

  std::vector<std::size_t> start_;
  std::vector<Side> sides_;
};

void link(const Sides& sides, Adjacency& adjacency) {
  for (std::uint32_t v = 0; v < sides.vertices(); ++v) {
    const auto all = sides.at(v);
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Side &a = all[i - 1], &b = all[i];
      if (a.high != b.high) continue;
      SAC_EXPECTS(i < 2 || all[i - 2].high != b.high);
      adjacency.neighbours[a.triangle][a.edge] = b.triangle;
      adjacency.neighbours[b.triangle][b.edge] = a.triangle;
    }
  }
}

}  // namespace

std::uint32_t Adjacency::open_neighbour(std::uint32_t t, int i) const {
  return is_wall(t, i) ? kNoTriangle : neighbours[t][i];
}

Adjacency adjacency(const std::vector<Corners>& triangles, const std::vector<Edge>& walls) {
  Adjacency result{std::vector<std::array<std::uint32_t, 3>>(triangles.size()),
                   std::vector<std::uint8_t>(triangles.size())};
  for (auto& three : result.neighbours) three.fill(kNoTriangle);
  const Sides sides(triangles);
  link(sides, result);
  for (const Edge& wall : walls) {
    const auto both = sides.of({std::min(wall[0], wall[1]), std::max(wall[0], wall[1])});
    if (both.empty()) {
      throw Error(ErrorCode::bad_mesh, "no edge joins vertices " + std::to_string(wall[0] + 1) +
                                           " and " + std::to_string(wall[1] + 1) +
                                           ", which a segment does");
    }
    for (const Side& side : both) {
      result.walls[side.triangle] |= static_cast<std::uint8_t>(1 << side.edge);
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
