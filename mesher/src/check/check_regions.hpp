// Whether regions end at lines, or polygons, alone, and are those of their seeds: (d), in space
// (e).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/checked_mesh.hpp"
#include "sets/union_find.hpp"
#include "text/text.hpp"

namespace mesher::detail {

/// `is_bound(half_side)`: whether a region may end there. `seeded_by(place)`: the simplex that a
/// seed stands for; nothing if it is outside, or on a bound, where it stands for neither side.
template <int D, class IsBound, class SeededBy>
class RegionCheck {
 public:
  RegionCheck(const CheckedMesh<D>& mesh, const CheckOptions<D>& options, IsBound is_bound,
              SeededBy seeded_by)
      : mesh_(mesh),
        options_(options),
        is_bound_(std::move(is_bound)),
        seeded_by_(std::move(seeded_by)),
        known_(options.features != nullptr && !options.features->regions.empty()),
        regions_(known_ ? options.features->regions
                        : std::vector<double>(mesh.mesh().simplices.size())),
        parts_(regions_.size()) {}

  Verdict run() {
    auto trouble = trouble_across();
    if (!trouble && options_.graph != nullptr) trouble = trouble_with_holes();
    if (!trouble && options_.graph != nullptr && known_) trouble = trouble_with_seeds();
    if (trouble) return Verdict::bad(*trouble);
    const std::set<double> distinct(regions_.begin(), regions_.end());
    return Verdict::good(std::to_string(distinct.size()) + " regions, none across " +
                         (D == 2 ? "an edge off lines" : "a face in no polygon"));
  }

 private:
  // Of a side that is no bound.
  std::optional<std::string> trouble_across() {
    const HalfSides<D>& sides = mesh_.sides();
    for (std::size_t i = 0, n = 0; i < sides.size(); i += n) {
      n = sides.partners(i);
      if (n != 2 || is_bound_(sides[i])) continue;
      const std::size_t a = simplex_of(sides[i]), b = simplex_of(sides[i + 1]);
      parts_.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
      if (regions_[a] == regions_[b]) continue;
      return "the regions " + text::to_text(regions_[a]) + " and " + text::to_text(regions_[b]) +
             " meet at " + mesh_.side(sides[i]) + ", which is " +
             (D == 2 ? "on no line" : "in no polygon");
    }
    return std::nullopt;
  }

  // In what hangs together with a hole's seed no region's stands for anything.
  std::optional<std::string> trouble_with_holes() {
    for (const Seed<D>& hole : options_.graph->graph.holes()) {
      const auto simplex = seeded_by_(hole.at);
      if (!simplex) continue;
      in_holes_.insert(part(*simplex));
      if (!may_leave_out(options_)) continue;
      return mesh_.simplex(*simplex) + " holds the seed of " + text_of(hole.id) + " at " +
             text::to_text<D>(hole.at);
    }
    return std::nullopt;
  }

  std::optional<std::string> trouble_with_seeds() {
    std::map<std::uint32_t, std::set<double>> seeded;
    std::vector<std::pair<const Seed<D>*, std::size_t>> found;
    for (const Seed<D>& region : options_.graph->graph.seeds) {
      if (region.id.kind != SeedKind::region) continue;
      const auto simplex = seeded_by_(region.at);
      if (!simplex || in_holes_.count(part(*simplex)) > 0) continue;
      seeded[part(*simplex)].insert(region.attribute);
      found.emplace_back(&region, *simplex);
    }
    for (const auto& [region, simplex] : found) {
      if (seeded[part(simplex)].count(regions_[simplex]) > 0) continue;
      return mesh_.simplex(simplex) + " has the region " + text::to_text(regions_[simplex]) +
             ", the seed in it at " + text::to_text<D>(region->at) + " " +
             text::to_text(region->attribute);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::uint32_t part(std::size_t simplex) {
    return parts_.find(static_cast<std::uint32_t>(simplex));
  }

  const CheckedMesh<D>& mesh_;
  const CheckOptions<D>& options_;
  IsBound is_bound_;
  SeededBy seeded_by_;
  bool known_;
  std::vector<double> regions_;
  UnionFind parts_;  // simplices that hang together across sides that are no bounds
  std::set<std::uint32_t> in_holes_;  // parts
};

}  // namespace mesher::detail
