// Lines that are copies of others: which piece is whose twin.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesher/periodic.hpp"

namespace mesher::detail {

/// A segment, or a piece of a polyline.
struct LinePiece {
  LineId line{};
  std::size_t index = 0;  // from 0, along the line
  PointId from{}, to{};
};

/// Two pieces, and how the second goes: from the twin of the first's end if it is `reversed`.
struct TwinPieces {
  LinePiece a, b;
  bool reversed = false;
};

/// All twin pieces of a pair of markers.
struct TwinLines {
  PeriodicMarkers markers;
  Point<2> translation{};
  std::vector<TwinPieces> pieces;  // in the order of the graph
};

/// By id.
using Places = std::unordered_map<PointId, Point<2>>;

/// Throws: Error(bad_option): see periodic_box_mesh.
[[nodiscard]] std::vector<TwinLines> twin_lines(const Graph<2>& graph, const Places& places,
                                                const std::vector<PeriodicMarkers>& pairs);

}  // namespace mesher::detail
