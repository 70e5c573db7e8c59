// What tiles have changed becomes a change of the mesh.
#pragma once

#include <algorithm>
#include <map>
#include <optional>

#include "sets/report_difference.hpp"
#include "tiles/tiled_mesher.hpp"

namespace mesher::detail {

/// Of vertices and simplices. What has come and gone again on the way is left out.
template <int D>
[[nodiscard]] Change<D> change_of(typename TiledMesher<D>::Changes& changes) {
  Change<D> change;
  struct Fate {
    std::optional<VertexKind> before, now;
    bool is_known = false;
  };
  std::map<Point<D>, Fate> fates;
  for (const auto& e : changes.vertices) {
    Fate& fate = fates[e.p];
    if (!fate.is_known && !e.came) fate.before = e.kind;
    fate.is_known = true;
    fate.now = e.came ? std::optional(e.kind) : std::nullopt;
  }
  for (const auto& [p, fate] : fates) {
    if (!fate.before && fate.now) {
      change.vertices_added.push_back(p);
      change.kinds_added.push_back(*fate.now);
    } else if (fate.before && !fate.now) {
      change.vertices_removed.push_back(p);
    } else if (fate.before != fate.now) {
      change.kinds_changed.push_back({p, *fate.before, *fate.now});
    }
  }
  report_difference(changes.simplices_come, changes.simplices_gone, change.simplices_added,
                    change.simplices_removed);
  return change;
}

/// By how much it changes the sizes of a mesh.
template <int D>
struct Growth {
  std::ptrdiff_t vertices = 0, simplices = 0;
  explicit Growth(const Change<D>& change) {
    const auto more = [](const auto& come, const auto& gone) {
      return static_cast<std::ptrdiff_t>(come.size()) - static_cast<std::ptrdiff_t>(gone.size());
    };
    vertices = more(change.vertices_added, change.vertices_removed);
    simplices = more(change.simplices_added, change.simplices_removed);
  }
  void add_to(MeshStats& stats) const noexcept {
    stats.vertices += static_cast<std::size_t>(vertices);
    stats.simplices += static_cast<std::size_t>(simplices);
  }
};

/// The calls, edges and bytes of the tiles of this process.
template <int D>
void add_trace(const TiledMesher<D>& tiles, MeshStats& stats) {
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    stats.calls += tiles[t].engine().live_calls();
    stats.edges += tiles[t].engine().live_edges();
    stats.trace_bytes += tiles[t].bytes();
  }
}

/// The sizes of what the tiles of this process have: after they have begun anew with the same mesh,
/// of which another part is theirs.
template <int D>
void count_own(MeshStats& stats, const TiledMesher<D>& tiles) noexcept {
  stats.vertices = tiles.vertices();
  stats.simplices = 0;
  for (std::size_t t = 0; t < tiles.size(); ++t) stats.simplices += tiles[t].own_simplices();
}

/// The sizes of a mesh that is all new, and the seconds of the phases of a first run.
template <int D>
void set_first(MeshStats& stats, const Change<D>& change, const TiledMesher<D>& tiles) {
  stats.vertices = change.vertices_added.size();
  stats.simplices = change.simplices_added.size();
  stats.seconds_quadtree = tiles.seconds()[0];
  stats.seconds_steiner = tiles.seconds()[1];
  stats.seconds_triangulate = tiles.seconds()[2];
}

}  // namespace mesher::detail
