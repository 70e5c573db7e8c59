// The regions of a mesh at one time: adjacency, flood, seeds.
#include <algorithm>

#include "domain/adjacency.hpp"
#include "domain/labels.hpp"
#include "domain/locate.hpp"
#include "mesher/domain.hpp"

namespace mesher {
namespace {

using detail::Adjacency;
using detail::Holding;

// Calls visit(triangle, corner) for all triangles around a vertex, given one of them.
template <class Visit>
void for_each_around(const Adjacency& adjacency, const Mesh<2>& mesh, std::uint32_t vertex,
                     std::uint32_t first, Visit&& visit) {
  const auto corner_of = [&](std::uint32_t t) {
    const auto& corners = mesh.simplices[t];
    return static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
  };
  std::uint32_t t = first;
  do {  // counterclockwise, until the boundary
    const int i = corner_of(t);
    visit(t, i);
    t = adjacency.neighbours[t][detail::next_corner(i)];
  } while (t != kNoTriangle && t != first);
  if (t == first) return;
  t = adjacency.neighbours[first][detail::previous_corner(corner_of(first))];
  while (t != kNoTriangle) {
    const int i = corner_of(t);
    visit(t, i);
    t = adjacency.neighbours[t][detail::previous_corner(i)];
  }
}

class Finder {
 public:
  Finder(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls, const std::vector<Seed>& seeds)
      : mesh_(mesh),
        walls_(walls),
        seeds_(seeds),
        adjacency_(detail::adjacency(mesh.simplices, detail::ends_of(walls))) {}

  Domain run(Extent extent) {
    domain_.region_of = detail::flood(adjacency_);
    count_triangles();
    place_seeds();
    label();
    domain_.keeps_all = detail::keeps_all(extent, encloses_);
    find_faults();
    domain_.neighbours = std::move(adjacency_.neighbours);
    return std::move(domain_);
  }

 private:
  void count_triangles() {
    auto& regions = domain_.regions;
    for (std::uint32_t t = 0; t < mesh_.simplices.size(); ++t) {
      const std::uint32_t r = domain_.region_of[t];
      if (r == regions.size()) {
        regions.push_back({{}, t, 0, 0, {}});
        open_.push_back(false);
      }
      ++regions[r].triangles;
      for (int i = 0; i < 3; ++i) {
        if (adjacency_.neighbours[t][i] == kNoTriangle && !adjacency_.is_wall(t, i)) {
          open_[r] = true;
        }
      }
    }
  }

  void place_seeds() {
    std::vector<Point<2>> places;
    for (const Seed& seed : seeds_) places.push_back(seed.at);
    holder_ = detail::first_holding(
        places, mesh_.simplices.size(), [&](std::size_t t) { return corners(t); }, kNoTriangle);
    counting_.resize(domain_.regions.size());
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      const bool placed = holder_[i] != kNoTriangle && !is_on_wall(i);
      region_.push_back(placed ? domain_.region_of[holder_[i]] : kNoRegion);
      if (placed) counting_[region_[i]].add(seeds_[i].name);
    }
  }

  void label() {
    for (std::uint32_t r = 0; r < domain_.regions.size(); ++r) {
      domain_.regions[r].label = counting_[r].label(open_[r]);
      encloses_ = encloses_ || !open_[r];
    }
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      if (region_[i] == kNoRegion || seeds_[i].name.kind == SeedKind::hole) continue;
      Region& region = domain_.regions[region_[i]];
      if (detail::counting_seed(region.label) != seeds_[i].name) continue;
      region.attribute = seeds_[i].attribute;
      region.max_area = seeds_[i].max_area;
    }
  }

  void find_faults() {
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      if (const auto fault = fault_of(i)) domain_.faults.push_back(*fault);
    }
    std::sort(domain_.faults.begin(), domain_.faults.end(),
              [](const SeedFault& a, const SeedFault& b) { return a.seed < b.seed; });
  }

  [[nodiscard]] std::optional<SeedFault> fault_of(std::size_t i) const {
    const Seed& seed = seeds_[i];
    if (holder_[i] == kNoTriangle) {
      return SeedFault{SeedFault::Kind::outside, seed.name, seed.at, {}, {}};
    }
    if (region_[i] == kNoRegion) {
      return SeedFault{SeedFault::Kind::on_segment, seed.name, seed.at, {}, line_at(i)};
    }
    return detail::fault_in(seed, domain_.regions[region_[i]].label, domain_.keeps_all);
  }

  [[nodiscard]] std::array<Point<2>, 3> corners(std::size_t t) const {
    const auto& c = mesh_.simplices[t];
    return {mesh_.vertices[c[0]], mesh_.vertices[c[1]], mesh_.vertices[c[2]]};
  }

  // Calls visit(triangle, edge) for each side of an edge that the seed is on or at an end of.
  template <class Visit>
  void for_each_side_at(std::size_t seed, Visit&& visit) const {
    const std::uint32_t t = holder_[seed];
    const Holding held = *detail::holding(corners(t), seeds_[seed].at);
    if (held.where == Holding::Where::edge) visit(t, held.index);
    if (held.where != Holding::Where::vertex) return;
    for_each_around(adjacency_, mesh_, mesh_.simplices[t][held.index], t,
                    [&](std::uint32_t around, int corner) {
                      visit(around, detail::next_corner(corner));
                      visit(around, detail::previous_corner(corner));
                    });
  }

  [[nodiscard]] bool is_on_wall(std::size_t seed) const {
    bool found = false;
    for_each_side_at(
        seed, [&](std::uint32_t t, int edge) { found = found || adjacency_.is_wall(t, edge); });
    return found;
  }

  // Cost: O(walls); there is a fault to speak of.
  [[nodiscard]] std::optional<FeatureId> line_at(std::size_t seed) const {
    std::optional<FeatureId> least;
    for_each_side_at(seed, [&](std::uint32_t t, int edge) {
      const auto& c = mesh_.simplices[t];
      const auto ends = std::minmax(c[detail::next_corner(edge)], c[detail::previous_corner(edge)]);
      for (const MeshEdge& wall : walls_) {
        if (!wall.line || std::pair(wall.low, wall.high) != std::pair(ends.first, ends.second)) {
          continue;
        }
        if (!least || *wall.line < *least) least = wall.line;
      }
    });
    return least;
  }

  const Mesh<2>& mesh_;
  const std::vector<MeshEdge>& walls_;
  const std::vector<Seed>& seeds_;
  Adjacency adjacency_;
  Domain domain_;
  std::vector<bool> open_;                  // one per region
  std::vector<detail::Counting> counting_;  // likewise
  std::vector<std::uint32_t> holder_;       // one per seed: a triangle that holds it
  std::vector<std::uint32_t> region_;       // likewise; kNoRegion on a wall
  bool encloses_ = false;
};

}  // namespace

Domain find_domain(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls,
                   const std::vector<Seed>& seeds, Extent extent) {
  detail::check_seeds(seeds);
  return Finder(mesh, walls, seeds).run(extent);
}

}  // namespace mesher
