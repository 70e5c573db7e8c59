// The points, lines and seeds of a mesher without the engine, and the edits announced of them.
#pragma once

#include <map>

#include "mesh_difference.hpp"
#include "mesher/mesher.hpp"
#include "static_lines.hpp"

namespace tool {

template <int D>
class StaticSeeds : public StaticLines<D> {
 public:
  using StaticLines<D>::StaticLines;

  /// As those of Mesher.
  /// Throws: Error (repeated_id, unknown_id), and then changes nothing.
  void insert_seed(const mesher::Seed<D>& seed) {
    if (edited_.emplace(seed.id, seed).second) return;
    throw mesher::Error(mesher::ErrorCode::repeated_id,
                        "there is a " + text_of(seed.id) + " already", {}, {seed.id});
  }
  void remove_seed(const mesher::SeedId& name) {
    if (edited_.erase(name) > 0) return;
    throw mesher::Error(mesher::ErrorCode::unknown_id, "there is no " + text_of(name), {}, {name});
  }
  void discard_edits() {
    StaticLines<D>::discard_edits();
    edited_ = current_;
  }

 protected:
  /// Adds those that are announced to be there.
  void add_seeds(mesher::Graph<D>& graph) const {
    for (const auto& [name, seed] : edited_) graph.seeds.push_back(seed);
  }
  void keep_edits() {
    StaticLines<D>::keep_edits();
    current_ = edited_;
  }

 private:
  std::map<mesher::SeedId, mesher::Seed<D>> current_, edited_;
};

/// What an update did to what is kept; `relabelled` is not found.
template <int D>
[[nodiscard]] mesher::DomainChange<D> change_of_kept(const mesher::Mesh<D>& before,
                                                     const mesher::Mesh<D>& after) {
  const auto was = simplices_of(before), is = simplices_of(after);
  return {difference(is, was), difference(was, is), {}, 0};
}

}  // namespace tool
