// Carries a solver's field through an update: vertices that stay keep their values, new ones get
// values interpolated in the mesh before the update.
//
// Example, a field by vertex slots:
//   const auto change = m.update();
//   field.resize(m.live().vertex_slots());
//   for (const auto& v : mesher::Transfer<2>(change, m.live()).interpolation()) {
//     field[v.vertex] = 0;
//     for (std::size_t i = 0; i < 3; ++i) field[v.vertex] += v.weights[i] * field[v.from[i]];
//   }
//
// This works in place: the slot of a removed vertex becomes free at the next update only, so no new
// vertex has taken it. A linear field is reproduced, up to rounding.
#pragma once

#include <array>
#include <vector>

#include "mesher/live_mesh.hpp"
#include "mesher/mesher.hpp"

namespace mesher {

/// The value at a new vertex: the sum of weights[i] times the value at from[i].
template <int D>
struct Interpolated {
  Slot vertex = kNoSlot;
  /// The corners of a removed simplex that contains it, as vertex slots; kNoSlot if there was no
  /// mesh before.
  std::array<Slot, D + 1> from{};
  std::array<double, D + 1> weights{};  ///< 0 to 1, with sum 1; 0 if there was no mesh before
};

/// What an update means for a field. Independent of the mesher once it is made. D is 2 or 3.
template <int D>
class Transfer {
 public:
  /// Requires: the mesher of `live` keeps slots, and `change` is that of its last update. Cost:
  /// O(c) for a change of c simplices.
  Transfer(const Change<D>& change, const LiveMesh<D>& live);

  /// One for each new vertex, in the order of Change::vertices_added. Cost: O(c log c), if vertices
  /// are about evenly spread.
  [[nodiscard]] std::vector<Interpolated<D>> interpolation() const;

 private:
  struct Removed {
    std::array<Point<D>, D + 1> corners;
    std::array<Slot, D + 1> slots;
  };
  std::vector<Removed> removed_;
  std::vector<Slot> added_;
  std::vector<Point<D>> places_;  // of added_
};

}  // namespace mesher
