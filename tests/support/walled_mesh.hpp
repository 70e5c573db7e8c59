// A triangulation that is edited, with walls and seeds, as plain sets; and the regions that follow
// it by its changes. After each change they are compared with regions found from scratch.
#pragma once

#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <vector>

#include "domain/regions.hpp"
#include "mesh/canonical.hpp"
#include "mesher/mesher.hpp"
#include "walled_grid.hpp"

namespace support {

using mesher::Point;
using Places2 = std::array<Point<2>, 2>;  // of an edge's ends, ascending
using Places3 = std::array<Point<2>, 3>;  // of a triangle's corners, from the smallest

class WalledMesh {
 public:
  using Walls = std::set<Places2>;
  using Seeds = std::map<mesher::SeedId, mesher::Seed<2>>;
  using Labels = std::map<Places3, mesher::RegionLabel>;

  /// What shall be. Walls that are no edges of the mesh are left out.
  void follow(const mesher::Mesh<2>& mesh, Walls walls, const Seeds& seeds) {
    const std::set<Places3> now = triangles_of(mesh);
    keep_edges(now, walls);
    const mesher::detail::RegionsChange change = change_to(now, walls, seeds);
    triangles_ = now;
    walls_ = std::move(walls);
    seeds_ = seeds;
    if (!regions_) {
      begin();
    } else {
      check(regions_->update(change));
    }
    forget_unused();
    regions_->check_invariants();
  }

  [[nodiscard]] const Walls& walls() const { return walls_; }
  [[nodiscard]] const Seeds& seeds() const { return seeds_; }
  [[nodiscard]] const std::set<Places3>& triangles() const { return triangles_; }
  [[nodiscard]] mesher::detail::Regions& regions() { return *regions_; }
  [[nodiscard]] Point<2> place(std::uint32_t v) const { return places_[v]; }

  /// The change from what is to that, with numbers for new vertices.
  [[nodiscard]] mesher::detail::RegionsChange change_to(const std::set<Places3>& now,
                                                        const Walls& walls, const Seeds& seeds) {
    mesher::detail::RegionsChange change;
    for (const auto& t : triangles_) {
      if (!now.contains(t)) change.triangles_out.push_back(number(t));
    }
    for (const auto& t : now) {
      if (!triangles_.contains(t)) change.triangles_in.push_back(number(t));
    }
    for (const auto& e : walls_) {
      if (!walls.contains(e)) change.walls_out.push_back({number(e[0]), number(e[1])});
    }
    for (const auto& e : walls) {
      if (!walls_.contains(e)) change.walls_in.push_back({number(e[1]), number(e[0])});
    }
    for (const auto& [name, seed] : seeds_) {
      const auto it = seeds.find(name);
      if (it == seeds.end() || it->second != seed) change.seeds_out.push_back(name);
    }
    for (const auto& [name, seed] : seeds) {
      const auto it = seeds_.find(name);
      if (it == seeds_.end() || it->second != seed) change.seeds_in.push_back(seed);
    }
    return change;
  }

  [[nodiscard]] static std::set<Places3> triangles_of(const mesher::Mesh<2>& mesh) {
    std::set<Places3> all;
    for (const auto& t : mesh.simplices) {
      all.insert({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    }
    return all;
  }
  [[nodiscard]] static Walls edges_of(const std::set<Places3>& triangles) {
    Walls edges;
    for (const auto& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
        edges.insert({low, high});
      }
    }
    return edges;
  }

 private:
  void begin() {
    std::vector<Corners> triangles;
    std::vector<Edge> walls;
    std::vector<mesher::Seed<2>> seeds;
    for (const auto& t : triangles_) triangles.push_back(number(t));
    for (const auto& e : walls_) walls.push_back({number(e[0]), number(e[1])});
    for (const auto& [name, seed] : seeds_) seeds.push_back(seed);
    regions_ = std::make_unique<mesher::detail::Regions>(
        triangles, walls, seeds, [this](std::uint32_t v) { return places_[v]; });
    labels_ = find_labels();
  }

  static void keep_edges(const std::set<Places3>& triangles, Walls& walls) {
    const Walls edges = edges_of(triangles);
    std::erase_if(walls, [&](const Places2& e) { return !edges.contains(e); });
  }

  std::uint32_t number(const Point<2>& p) {
    const auto it = numbers_.find(p);
    if (it != numbers_.end()) return it->second;
    std::uint32_t v = static_cast<std::uint32_t>(places_.size());
    if (free_.empty()) {
      places_.push_back(p);
    } else {
      v = free_.back();
      free_.pop_back();
      places_[v] = p;
    }
    numbers_[p] = v;
    return v;
  }
  Corners number(const Places3& t) { return {number(t[0]), number(t[1]), number(t[2])}; }

  // Numbers are used again, as a mesher's are.
  void forget_unused() {
    std::set<Point<2>> used;
    for (const auto& t : triangles_) used.insert(t.begin(), t.end());
    std::erase_if(numbers_, [&](const auto& entry) {
      if (used.contains(entry.first)) return false;
      free_.push_back(entry.second);
      return true;
    });
  }

  // From scratch, over vertices in canonical order.
  Labels find_labels() const {
    std::map<Point<2>, std::uint32_t> index;
    for (const auto& t : triangles_) {
      for (const auto& p : t) index.emplace(p, 0);
    }
    mesher::Mesh<2> mesh;
    for (auto& [p, i] : index) {
      i = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(p);
    }
    for (const auto& t : triangles_) {
      mesh.simplices.push_back({index.at(t[0]), index.at(t[1]), index.at(t[2])});
    }
    std::vector<mesher::MeshEdge> walls;
    for (const auto& e : walls_) walls.push_back({index.at(e[0]), index.at(e[1]), {}, 0});
    std::vector<mesher::Seed<2>> seeds;
    for (const auto& [name, seed] : seeds_) seeds.push_back(seed);
    const auto domain = find_domain(mesh, walls, seeds, mesher::Extent::enclosed);
    check_names(mesh, domain);
    Labels labels;
    for (std::uint32_t t = 0; t < mesh.simplices.size(); ++t) {
      const auto& c = mesh.simplices[t];
      labels[{mesh.vertices[c[0]], mesh.vertices[c[1]], mesh.vertices[c[2]]}] =
          domain.regions[domain.region_of[t]].label;
    }
    return labels;
  }

  // The list of regions is the same, with smallest triangles and attributes.
  void check_names(const mesher::Mesh<2>& mesh, const mesher::Domain<2>& domain) const {
    const auto named = regions_->regions();
    REQUIRE(named.size() == domain.regions.size());
    for (std::size_t r = 0; r < named.size(); ++r) {
      const mesher::Region& region = domain.regions[r];
      REQUIRE(named[r].label == region.label);
      REQUIRE(named[r].triangles == region.triangles);
      REQUIRE(named[r].attribute == region.attribute);
      REQUIRE(named[r].max_measure == region.max_measure);
      for (int i = 0; i < 3; ++i) {
        REQUIRE(places_[named[r].smallest[i]] == mesh.vertices[mesh.simplices[region.smallest][i]]);
      }
    }
  }

  [[nodiscard]] Places3 places(const Corners& t) const {
    return mesher::detail::smallest_first(Places3{places_[t[0]], places_[t[1]], places_[t[2]]});
  }

  // The difference is the one of the labels from scratch before and after, nothing said twice.
  void check(const mesher::detail::RegionsDifference& difference) {
    const Labels now = find_labels();
    Labels seen = labels_;
    for (const auto& t : difference.removed) {
      REQUIRE(seen.at(places(t.corners)) == t.label);
      seen.erase(places(t.corners));
    }
    for (const auto& t : difference.relabelled) {
      REQUIRE(t.before != t.after);
      REQUIRE(seen.at(places(t.corners)) == t.before);
      seen.at(places(t.corners)) = t.after;
    }
    for (const auto& t : difference.added) {
      REQUIRE(seen.emplace(places(t.corners), t.label).second);
    }
    REQUIRE(seen == now);
    REQUIRE(difference.enclosed_before == encloses(labels_));
    REQUIRE(difference.encloses == encloses(now));
    for (const auto extent : {mesher::Extent::enclosed, mesher::Extent::box}) {
      check_kept(difference, extent, now);
    }
    labels_ = now;
  }
  void check_kept(const mesher::detail::RegionsDifference& difference, mesher::Extent extent,
                  const Labels& now) const {
    std::set<Places3> seen = kept(labels_, extent);
    const auto change = kept_difference(*regions_, difference, extent);
    for (const auto& t : change.removed) REQUIRE(seen.erase(places(t)) == 1);
    for (const auto& t : change.added) REQUIRE(seen.insert(places(t)).second);
    REQUIRE(seen == kept(now, extent));
  }
  static std::set<Places3> kept(const Labels& labels, mesher::Extent extent) {
    std::set<Places3> all;
    const bool whole = extent == mesher::Extent::box || !encloses(labels);
    for (const auto& [t, label] : labels) {
      if (whole || label.zone == mesher::Zone::inside) all.insert(t);
    }
    return all;
  }
  static bool encloses(const Labels& labels) {
    return std::any_of(labels.begin(), labels.end(), [](const auto& entry) {
      return entry.second.zone != mesher::Zone::outside;
    });
  }

  std::set<Places3> triangles_;
  Walls walls_;
  Seeds seeds_;
  Labels labels_;
  std::unique_ptr<mesher::detail::Regions> regions_;
  std::map<Point<2>, std::uint32_t> numbers_;
  std::vector<Point<2>> places_;
  std::vector<std::uint32_t> free_;
};

}  // namespace support
