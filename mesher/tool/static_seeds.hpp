// The points, lines and seeds of a mesher without the engine, and the edits announced of them.
#pragma once

#include <map>

#include "mesh_difference.hpp"
#include "mesher/domain_mesher.hpp"
#include "static_lines.hpp"

namespace tool {

template <int D>
class StaticSeeds : public StaticLines<D> {
 public:
  using StaticLines<D>::StaticLines;

  /// As those of DomainMesher.
  /// Throws: Error (repeated_id, unknown_id), and then changes nothing.
  void insert_seed(const mesher::SeedOf<D>& seed) {
    if (edited_.emplace(seed.name, seed).second) return;
    throw mesher::Error(mesher::ErrorCode::repeated_id,
                        "there is a " + text_of(seed.name) + " already", {},
                        {mesher::seed_named(seed.name)});
  }
  void remove_seed(const mesher::SeedName& name) {
    if (edited_.erase(name) > 0) return;
    throw mesher::Error(mesher::ErrorCode::unknown_id, "there is no " + text_of(name), {},
                        {mesher::seed_named(name)});
  }
  void discard_edits() {
    StaticLines<D>::discard_edits();
    edited_ = current_;
  }

 protected:
  /// Adds those that are announced to be there.
  void add_seeds(mesher::GraphOf<D>& graph) const {
    for (const auto& [name, seed] : edited_) mesher::add_seed(graph, seed);
  }
  void keep_edits() {
    StaticLines<D>::keep_edits();
    current_ = edited_;
  }

 private:
  std::map<mesher::SeedName, mesher::SeedOf<D>> current_, edited_;
};

/// Whether it matters to limits of size what lines, or polygons, enclose.
template <int D>
[[nodiscard]] bool needs_regions(const mesher::Options<D>& options, mesher::Extent extent,
                                 mesher::RegionAreas areas) {
  if (areas == mesher::RegionAreas::limits) return true;
  const bool limited =
      options.max_measure != 0 || options.sizes != nullptr || !options.box_limits.empty();
  return extent == mesher::Extent::enclosed && limited;
}

/// What an update did to what is kept; `relabelled` is not found.
template <int D>
[[nodiscard]] mesher::DomainChangeOf<D> change_of_kept(const mesher::Mesh<D>& before,
                                                       const mesher::Mesh<D>& after) {
  const auto was = simplices_of(before), is = simplices_of(after);
  return {difference(is, was), difference(was, is), {}, 0};
}

}  // namespace tool
