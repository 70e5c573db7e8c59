// Edits of a mesh with its domain, and updates of both together.
#include "facade/domain_state.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "domain/labels.hpp"

namespace mesher::detail {
namespace {

using Markers = DomainState::Markers;

// Sets a marker, 0 for none, and makes the edit; or does neither.
template <class Make>
void mark(Markers& markers, FeatureId id, std::int64_t marker, Make make) {
  if (marker == 0 && markers.find(id) == nullptr) return make();
  const auto before = markers.edit_of(id);
  markers.set(id, marker == 0 ? std::nullopt : std::optional(marker));
  try {
    make();
  } catch (...) {
    markers.restore(id, before);
    throw;
  }
}

std::int64_t marker_of(const Markers& markers, FeatureId id) {
  const auto it = markers.committed().find(id);
  return it == markers.committed().end() ? 0 : it->second;
}

std::uint32_t index_of(const std::vector<Point<2>>& sorted, const Point<2>& p) {
  return static_cast<std::uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), p) -
                                    sorted.begin());
}

// The mesh that a first run brings.
Mesh<2> mesh_of(const Change<2>& change) {
  Mesh<2> mesh;
  mesh.vertices = change.vertices_added;
  mesh.simplices.reserve(change.simplices_added.size());
  for (const auto& [a, b, c] : change.simplices_added) {
    const auto& all = mesh.vertices;
    mesh.simplices.push_back({index_of(all, a), index_of(all, b), index_of(all, c)});
  }
  return mesh;
}

std::vector<MeshEdge> walls_of(const Change<2>& change) {
  std::vector<MeshEdge> walls;
  for (const auto& e : change.edges_added) {
    const auto& all = change.vertices_added;
    walls.push_back({index_of(all, e.low), index_of(all, e.high), e.line, 0});
  }
  return walls;
}

std::vector<DomainEdits::Wall> ends_of(const std::vector<LineEdge<2>>& edges) {
  std::vector<DomainEdits::Wall> walls;
  for (const auto& e : edges) walls.push_back({e.low, e.high});
  return walls;
}

}  // namespace

// --- Edits -----------------------------------------------------------------------------------

void DomainState::insert(FeatureId id, const Point<2>& point, std::int64_t marker) {
  mark(point_markers_, id, marker, [&] { mesher_.insert(id, point); });
}

void DomainState::remove(FeatureId id) {
  mark(point_markers_, id, 0, [&] { mesher_.remove(id); });
}

void DomainState::insert_line(FeatureId id, const std::vector<FeatureId>& points,
                              std::int64_t marker) {
  mark(line_markers_, id, marker, [&] { mesher_.insert_polyline(id, points); });
  needs_follower_ = true;
}

void DomainState::remove_line(FeatureId id) {
  mark(line_markers_, id, 0, [&] { mesher_.remove_segment(id); });
}

void DomainState::insert_seed(const Seed& seed) {
  busy_.require_idle();
  check_seed(seed);
  if (seeds_.find(seed.name) != nullptr) {
    throw Error(ErrorCode::repeated_id, text_of(seed.name) + " is there already", {},
                {seed.name.id});
  }
  seeds_.set(seed.name, seed);
  needs_follower_ = true;
}

void DomainState::remove_seed(const SeedName& name) {
  busy_.require_idle();
  if (seeds_.find(name) == nullptr) {
    throw Error(ErrorCode::unknown_id, text_of(name) + " is not there", {}, {name.id});
  }
  seeds_.set(name, std::nullopt);
}

void DomainState::discard_edits() noexcept {
  mesher_.discard_edits();
  point_markers_.discard();
  line_markers_.discard();
  seeds_.discard();
  needs_follower_ = false;
}

// --- Updates ---------------------------------------------------------------------------------

// So that commit() needs no memory, and follow() has somebody to follow.
void DomainState::prepare() {
  point_markers_.prepare();
  line_markers_.prepare();
  seeds_.prepare();
  if (needs_follower_ && ran_ && !follower_) {
    follower_.emplace(mesher_.mesh(), std::vector<MeshEdge>(), std::vector<Seed>(), extent_);
  }
}

void DomainState::commit() noexcept {
  point_markers_.commit();
  line_markers_.commit();
  seeds_.commit();
  needs_follower_ = false;
  ran_ = true;
}

// The first run. The follower is there only if the run is accepted: nothing throws after it.
DomainChange DomainState::begin(const Change<2>& change) {
  std::vector<Seed> all;
  seeds_.for_each_edit([&](const SeedName&, const Seed*, const Seed* to) { all.push_back(*to); });
  DomainFollower first(mesh_of(change), walls_of(change), all, extent_);
  DomainChange domain;
  for (const auto& triangle : change.simplices_added) {
    if (first.keeps(triangle)) domain.kept_added.push_back(triangle);
  }
  follower_.emplace(std::move(first));
  return domain;
}

DomainChange DomainState::follow(const Change<2>& change) {
  if (!follower_ && needs_follower_) return begin(change);
  if (!follower_) return {change.simplices_added, change.simplices_removed, {}, 0};
  DomainEdits edits;
  edits.walls_out = ends_of(change.edges_removed);
  edits.walls_in = ends_of(change.edges_added);
  seeds_.for_each_edit([&](const SeedName& name, const Seed* was, const Seed* is) {
    if (was != nullptr) edits.seeds_out.push_back(name);
    if (is != nullptr) edits.seeds_in.push_back(*is);
  });
  return follower_->update(change, edits);
}

DomainUpdate DomainState::update(const RunControl& control) {
  const Busy::Run running(busy_);
  DomainUpdate update;
  try {
    prepare();
    static_cast<Change<2>&>(update) =
        mesher_.update(control, [&](const Change<2>& change) { update.domain = follow(change); });
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cancelled) discard_edits();
    throw;
  } catch (...) {
    discard_edits();
    throw;
  }
  commit();
  return update;
}

Pslg DomainState::input() const {
  Pslg graph;
  for (const auto& p : mesher_.points()) {
    graph.points.push_back({p.id, p.at, marker_of(point_markers_, p.id)});
  }
  for (auto& line : mesher_.lines()) {
    const std::int64_t marker = marker_of(line_markers_, line.id);
    if (line.points.size() == 2) {
      graph.segments.push_back({line.id, line.points[0], line.points[1], marker});
    } else {
      graph.polylines.push_back({line.id, std::move(line.points), marker});
    }
  }
  for (const auto& [name, seed] : seeds_.committed()) add_seed(graph, seed);
  return graph;
}

}  // namespace mesher::detail
