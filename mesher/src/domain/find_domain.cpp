// The regions of a mesh at one time: adjacency, flood, seeds.
#include <algorithm>
#include <utility>

#include "domain/labels.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/locate.hpp"
#include "mesher/domain.hpp"

namespace mesher {
namespace {

template <int D>
class Finder {
 public:
  Finder(const Mesh<D>& mesh, const std::vector<WallOf<D>>& walls,
         const std::vector<Seed<D>>& seeds)
      : mesh_(mesh),
        walls_(walls),
        seeds_(seeds),
        adjacency_(detail::adjacency(mesh.simplices, detail::corners_of(walls))) {}

  Domain<D> run(Extent extent) {
    domain_.region_of = detail::flood<D>(adjacency_);
    count_simplices();
    place_seeds();
    label();
    domain_.keeps_all = detail::keeps_all(extent, encloses_);
    find_faults();
    domain_.neighbours = std::move(adjacency_.neighbours);
    return std::move(domain_);
  }

 private:
  void count_simplices() {
    auto& regions = domain_.regions;
    for (std::uint32_t t = 0; t < mesh_.simplices.size(); ++t) {
      const std::uint32_t r = domain_.region_of[t];
      if (r == regions.size()) {
        regions.push_back({{}, t, 0, 0, {}});
        open_.push_back(false);
      }
      ++regions[r].triangles;
      for (int i = 0; i <= D; ++i) {
        if (neighbour(t, i) == kNoTriangle && !adjacency_.is_wall(t, i)) open_[r] = true;
      }
    }
  }

  void place_seeds() {
    std::vector<Point<D>> places;
    for (const Seed<D>& seed : seeds_) places.push_back(seed.at);
    holders_.resize(seeds_.size());
    detail::for_each_holding<D>(
        places, mesh_.simplices.size(), [&](std::size_t t) { return corners(t); },
        [&](std::uint32_t seed, std::uint32_t t, unsigned sides) {
          holders_[seed].push_back({t, sides});
        });
    counting_.resize(domain_.regions.size());
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      const bool placed = !holders_[i].empty() && !is_on_wall(i);
      region_.push_back(placed ? domain_.region_of[holders_[i].front().simplex] : kNoRegion);
      if (placed) counting_[region_[i]].add(seeds_[i].id);
    }
  }

  void label() {
    for (std::uint32_t r = 0; r < domain_.regions.size(); ++r) {
      domain_.regions[r].label = counting_[r].label(open_[r]);
      encloses_ = encloses_ || !open_[r];
    }
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      if (region_[i] == kNoRegion || seeds_[i].id.kind == SeedKind::hole) continue;
      Region& region = domain_.regions[region_[i]];
      if (detail::counting_seed(region.label) != seeds_[i].id) continue;
      region.attribute = seeds_[i].attribute;
      region.max_measure = seeds_[i].max_measure;
    }
  }

  void find_faults() {
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      if (const auto fault = fault_of(i)) domain_.faults.push_back(*fault);
    }
    std::sort(domain_.faults.begin(), domain_.faults.end(),
              [](const SeedFault<D>& a, const SeedFault<D>& b) { return a.seed < b.seed; });
  }

  [[nodiscard]] std::optional<SeedFault<D>> fault_of(std::size_t i) const {
    const Seed<D>& seed = seeds_[i];
    if (holders_[i].empty()) {
      return SeedFault<D>{SeedFault<D>::Kind::outside, seed.id, seed.at, {}, {}};
    }
    if (region_[i] == kNoRegion) {
      return SeedFault<D>{SeedFault<D>::Kind::on_segment, seed.id, seed.at, {}, wall_at(i)};
    }
    return detail::fault_in(seed, domain_.regions[region_[i]].label, domain_.keeps_all);
  }

  [[nodiscard]] std::uint32_t neighbour(std::uint32_t t, int i) const {
    return adjacency_.neighbours[t][static_cast<std::size_t>(i)];
  }
  [[nodiscard]] std::array<Point<D>, D + 1> corners(std::size_t t) const {
    std::array<Point<D>, D + 1> places;
    for (std::size_t i = 0; i < places.size(); ++i) {
      places[i] = mesh_.vertices[mesh_.simplices[t][i]];
    }
    return places;
  }

  // Calls visit(simplex, side) for each side that the seed is on.
  template <class Visit>
  void for_each_side_at(std::size_t seed, Visit&& visit) const {
    for (const Holder& holder : holders_[seed]) {
      for (int i = 0; i <= D; ++i) {
        if ((holder.sides >> i & 1) != 0) visit(holder.simplex, i);
      }
    }
  }

  [[nodiscard]] bool is_on_wall(std::size_t seed) const {
    bool found = false;
    for_each_side_at(
        seed, [&](std::uint32_t t, int side) { found = found || adjacency_.is_wall(t, side); });
    return found;
  }

  static Feature name(const MeshEdge& wall) { return wall.line ? Feature(*wall.line) : Feature(); }
  static Feature name(const MeshFace& wall) {
    return wall.polygon ? Feature(*wall.polygon) : Feature();
  }
  // The corners of a side, ascending.
  [[nodiscard]] std::array<std::uint32_t, D> side_of(std::uint32_t t, int across) const {
    std::array<std::uint32_t, D> side;
    std::size_t n = 0;
    for (std::size_t i = 0; i <= D; ++i) {
      if (std::cmp_not_equal(i, across)) side[n++] = mesh_.simplices[t][i];
    }
    std::sort(side.begin(), side.end());
    return side;
  }

  // Cost: O(walls); there is a fault to speak of.
  [[nodiscard]] Feature wall_at(std::size_t seed) const {
    Feature least;
    const auto all = detail::corners_of(walls_);
    for_each_side_at(seed, [&](std::uint32_t t, int side) {
      const auto corners = side_of(t, side);
      for (std::size_t i = 0; i < walls_.size(); ++i) {
        const Feature id = name(walls_[i]);
        if (id == Feature() || all[i] != corners) continue;
        if (least == Feature() || id < least) least = id;
      }
    });
    return least;
  }

  // A closed simplex that holds a seed, and the sides that the seed is on: bit i, side i.
  struct Holder {
    std::uint32_t simplex;
    unsigned sides;
  };
  const Mesh<D>& mesh_;
  const std::vector<WallOf<D>>& walls_;
  const std::vector<Seed<D>>& seeds_;
  detail::AdjacencyOf<D> adjacency_;
  Domain<D> domain_;
  std::vector<bool> open_;                    // one per region
  std::vector<detail::Counting> counting_;    // likewise
  std::vector<std::vector<Holder>> holders_;  // one per seed; ascending
  std::vector<std::uint32_t> region_;         // likewise; kNoRegion on a wall
  bool encloses_ = false;
};

}  // namespace

template <int D>
Domain<D> find_domain(const Mesh<D>& mesh, const std::vector<WallOf<D>>& walls,
                      const std::vector<Seed<D>>& seeds, Extent extent) {
  detail::check_seeds(seeds);
  return Finder<D>(mesh, walls, seeds).run(extent);
}

template Domain<2> find_domain(const Mesh<2>&, const std::vector<MeshEdge>&,
                               const std::vector<Seed<2>>&, Extent);
#ifndef MESHER_PLANE_ONLY
template Domain<3> find_domain(const Mesh<3>&, const std::vector<MeshFace>&,
                               const std::vector<Seed<3>>&, Extent);
#endif

}  // namespace mesher
