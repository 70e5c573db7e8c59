// The mesh of a mesher, and its changes, as arrays of messages: by slot, as pages keep it.
#pragma once

#include <cstdint>
#include <set>

#include "fields.hpp"
#include "mesher/mesher.hpp"
#include "message.hpp"

namespace tool::view {

/// Of a simplex: 0 if it is not kept, 1 without a region of its own, else by the region's number.
/// 255 is for free slots.
template <int D>
[[nodiscard]] std::uint8_t label_of(const mesher::Mesher<D>& mesher, mesher::Slot simplex);

/// How many simplices are kept. Cost: O(simplices).
template <int D>
[[nodiscard]] std::size_t count_kept(const mesher::Mesher<D>& mesher);

/// All of the mesh, with points of the input: `places`, `simplices`, `labels`, `edges`,
/// `edge_lines` (NaN: a free slot; -1 - id: of a polygon alone), in space `neighbours`, `faces` and
/// `face_polygons`; `point_ids` and `point_places`. Cost: O(mesh).
template <int D>
void add_mesh(const mesher::Mesher<D>& mesher, Message& message);

/// What an update has changed: the same by the slots in `..._added`, slots in `..._removed`,
/// simplices that stay with another label in `relabelled` and `new_labels`. Cost: that of the
/// change.
template <int D>
void add_change(const mesher::Mesher<D>& mesher, const mesher::DomainUpdate<D>& change,
                Message& message);
/// The points of a graph: `point_ids` and `point_places`.
template <int D>
void add_points(const mesher::Graph<D>& now, Message& message);

/// Those of these holes and regions that are there, with what is wrong with them. Cost: O(seeds).
template <int D>
[[nodiscard]] Json json_of_seeds(const mesher::Mesher<D>& mesher,
                                 const std::set<mesher::SeedId>& ids);

}  // namespace tool::view
