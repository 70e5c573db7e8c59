// What an update is to make of the input.
#pragma once

#include <optional>
#include <vector>

#include "facade/pending.hpp"
#include "facade/pending_limits.hpp"
#include "facade/staged.hpp"
#include "mesher/graph.hpp"

namespace mesher::detail {

using LinePoints = std::vector<PointId>;  // that a line goes along
using StagedLines = Staged<LineId, LinePoints>;
using StagedPolygons = Staged<PolygonId, mesher::Polygon>;

template <int D>
using PointEdits = std::vector<typename Pending<D>::Edit>;  // in Morton order of where to

/// The edits of points, those that go first; lines and polygons, as they were and shall be.
template <int D>
struct Edits {
  PointEdits<D> points;
  const StagedLines& lines;
  const StagedPolygons& polygons;         // in space
  std::optional<LimitsEdit<D>> limits{};  // nothing: they stay
};

}  // namespace mesher::detail
