// Edits of a mesh with its domain, and updates of both together.
#include "facade/domain_state.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "domain/labels.hpp"
#include "facade/graph_runs.hpp"

namespace mesher::detail {
namespace {

// Sets a marker, 0 for none, and makes the edit; or does neither.
template <class Id, class Make>
void mark(Staged<Id, std::int64_t>& markers, Id id, std::int64_t marker, Make make) {
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

template <class Id>
std::int64_t marker_of(const Staged<Id, std::int64_t>& markers, Id id) {
  const auto it = markers.committed().find(id);
  return it == markers.committed().end() ? 0 : it->second;
}

template <int D>
void add_line(Graph<D>& graph, Polyline line) {
  if (line.points.size() == 2) {
    graph.segments.push_back({line.id, line.points[0], line.points[1], line.marker});
  } else {
    graph.polylines.push_back(std::move(line));
  }
}

}  // namespace

template <int D>
DomainState<D>::DomainState(const Options<D>& options)
    : mesher_(options), extent_(options.extent), areas_(options.region_areas) {}

// --- Edits -----------------------------------------------------------------------------------

template <int D>
void DomainState<D>::insert(PointId id, const Point<D>& point, std::int64_t marker) {
  busy_.require_idle();
  mark(point_markers_, id, marker, [&] { mesher_.insert(id, point); });
}

template <int D>
void DomainState<D>::remove(PointId id) {
  busy_.require_idle();
  mark(point_markers_, id, 0, [&] { mesher_.remove(id); });
}

template <int D>
void DomainState<D>::move(PointId id, const Point<D>& point) {
  busy_.require_idle();
  mesher_.move(id, point);
}

template <int D>
void DomainState<D>::insert_line(LineId id, const std::vector<PointId>& points,
                                 std::int64_t marker) {
  busy_.require_idle();
  mark(line_markers_, id, marker, [&] { mesher_.insert_polyline(id, points); });
  needs_follower_ = needs_follower_ || D == 2;  // in space lines enclose nothing
}

template <int D>
void DomainState<D>::remove_line(LineId id) {
  busy_.require_idle();
  mark(line_markers_, id, 0, [&] { mesher_.remove_line(id); });
}

template <int D>
void DomainState<D>::insert_polygon(mesher::Polygon polygon) {
  busy_.require_idle();
  const std::int64_t marker = std::exchange(polygon.marker, 0);  // which the mesh does not know
  mark(polygon_markers_, polygon.id, marker, [&] { mesher_.insert_polygon(polygon); });
  needs_follower_ = true;
}

template <int D>
void DomainState<D>::remove_polygon(PolygonId id) {
  busy_.require_idle();
  mark(polygon_markers_, id, 0, [&] { mesher_.remove_polygon(id); });
}

template <int D>
void DomainState<D>::insert_seed(const Seed<D>& seed) {
  busy_.require_idle();
  check_seed(seed);
  if (seeds_.find(seed.id) != nullptr) {
    throw Error(ErrorCode::repeated_id, text_of(seed.id) + " is there already", {},
                {mesher::Feature(seed.id)}, {position_of(seed.at)});
  }
  seeds_.set(seed.id, seed);
  needs_follower_ = true;
}

template <int D>
void DomainState<D>::remove_seed(const SeedId& name) {
  busy_.require_idle();
  if (seeds_.find(name) == nullptr) {
    throw Error(ErrorCode::unknown_id, text_of(name) + " is not there", {},
                {mesher::Feature(name)});
  }
  seeds_.set(name, std::nullopt);
}

template <int D>
void DomainState<D>::limit(const SizeLimits<D>& limits) {
  busy_.require_idle();
  mesher_.limit(limits);
}

template <int D>
void DomainState<D>::limit(const Box<D>& box, const SizeLimits<D>& limits) {
  busy_.require_idle();
  mesher_.limit(box, limits);
}

template <int D>
void DomainState<D>::keep_slots(bool keep) {
  busy_.require_idle();
  mesher_.keep_slots(keep);
}

template <int D>
void DomainState<D>::discard_edits() noexcept {
  mesher_.discard_edits();
  point_markers_.discard();
  line_markers_.discard();
  polygon_markers_.discard();
  seeds_.discard();
  needs_follower_ = false;
}

// --- Updates ---------------------------------------------------------------------------------

// So that commit() needs no memory, and follow() has somebody to follow.
template <int D>
void DomainState<D>::prepare() {
  point_markers_.prepare();
  line_markers_.prepare();
  polygon_markers_.prepare();
  seeds_.prepare();
  if (needs_follower_ && ran_ && !follower_) {
    follower_.emplace(mesher_.mesh(), std::vector<WallOf<D>>(), std::vector<Seed<D>>(), extent_);
  }
}

template <int D>
void DomainState<D>::commit() noexcept {
  point_markers_.commit();
  line_markers_.commit();
  polygon_markers_.commit();
  seeds_.commit();
  needs_follower_ = false;
  ran_ = true;
}

// The first run. The follower is there only if the run is accepted: nothing throws after it.
template <int D>
void DomainState<D>::begin(const Change<D>& change, DomainUpdate<D>& update) {
  DomainFollower<D> first(mesh_of(change), walls_of(change), all_of(seeds_), extent_);
  DomainChange<D> domain;
  for (const auto& triangle : change.simplices_added) {
    if (first.keeps(triangle)) domain.kept_added.push_back(triangle);
  }
  update.kept = kept_slots(change, domain);
  update.domain = std::move(domain);
  follower_.emplace(std::move(first));
}

template <int D>
void DomainState<D>::follow(const Change<D>& change, DomainUpdate<D>& update) {
  if (!follower_ && needs_follower_) return begin(change, update);
  if (!follower_) {
    update.domain = {change.simplices_added, change.simplices_removed, {}, 0};
    update.kept = {change.slots.simplices_added, change.slots.simplices_removed};
    return;
  }
  update.domain = follower_->update(
      change, domain_edits<D>(change, seeds_),
      [&](const DomainChange<D>& domain) { update.kept = kept_slots(change, domain); });
}

// What is kept is in the same order as what comes or goes; the rest was there before and stays.
template <int D>
KeptSlots DomainState<D>::kept_slots(const Change<D>& change, const DomainChange<D>& domain) const {
  if (!mesher_.keeps_slots()) return {};
  const auto slots = [&](const auto& kept, const auto& listed, const std::vector<Slot>& those) {
    std::vector<Slot> all;
    all.reserve(kept.size());
    std::size_t i = 0;
    for (const auto& corners : kept) {
      while (i < listed.size() && listed[i] < corners) ++i;
      const bool is_listed = i < listed.size() && listed[i] == corners;
      all.push_back(is_listed ? those[i] : mesher_.last_slot(corners));
    }
    return all;
  };
  return {slots(domain.kept_added, change.simplices_added, change.slots.simplices_added),
          slots(domain.kept_removed, change.simplices_removed, change.slots.simplices_removed)};
}

template <int D>
auto DomainState<D>::corners(Slot simplex) const -> typename DomainChange<D>::Corners {
  const LiveMesh<D> live = mesher_.live();
  SAC_EXPECTS(live.is_simplex(simplex));
  typename DomainChange<D>::Corners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = live.points()[live.simplices()[simplex][i]];
  }
  return corners;
}

// Whether it matters what lines, or polygons, enclose.
template <int D>
bool DomainState<D>::needs_unlimited() const {
  if (!follower_ && !needs_follower_) return false;  // no line, no seed
  if (extent_ == Extent::enclosed && mesher_.has_limits()) return true;
  if (areas_ == RegionAreas::ignored) return false;
  const std::vector<Seed<D>> seeds = all_of(seeds_);
  return std::any_of(seeds.begin(), seeds.end(),
                     [](const Seed<D>& seed) { return seed.max_measure.has_value(); });
}

// It begins with what the last update left.
template <int D>
void DomainState<D>::make_unlimited(const RunControl& control) {
  auto made = std::make_unique<UnsizedMesh<D>>(mesher_.options(), extent_, areas_);
  if (ran_) {
    EditedSeedsOf<D> seeds;
    for (const auto& [name, seed] : seeds_.committed()) seeds.set(name, seed);
    announce(input(), made->mesher());
    made->update(seeds, control, [](const auto&, const auto&) {});
  }
  unlimited_ = std::move(made);
}

template <int D>
void DomainState<D>::run_with_unlimited(const RunControl& control,
                                        const std::function<void()>& run_limited) {
  if (!unlimited_) make_unlimited(control);
  unlimited_->mesher().discard_edits();
  mesher_.announce_to(unlimited_->mesher());
  unlimited_->update(seeds_, control, [&](const auto& limits, const auto& where) {
    const bool first = mesher_.options().region_limits == nullptr;
    mesher_.limit_regions(limits, first ? std::vector{mesher_.options().domain} : where);
    run_limited();
  });
}

template <int D>
DomainUpdate<D> DomainState<D>::run(const RunControl& control) {
  DomainUpdate<D> update;
  const auto run_limited = [&] {
    static_cast<Change<D>&>(update) =
        mesher_.update(control, [&](const Change<D>& change) { follow(change, update); });
  };
  if (unlimited_ || needs_unlimited()) {
    run_with_unlimited(control, run_limited);
  } else {
    run_limited();
  }
  return update;
}

template <int D>
DomainUpdate<D> DomainState<D>::update(const RunControl& control) {
  const ReentryGuard::Run running(busy_);
  DomainUpdate<D> update;
  try {
    prepare();
    update = run(control);
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

template <int D>
Graph<D> DomainState<D>::input() const {
  Graph<D> graph;
  for (const auto& p : mesher_.points()) {
    graph.points.push_back({p.id, p.at, marker_of(point_markers_, p.id)});
  }
  for (auto& line : mesher_.lines()) {
    line.marker = marker_of(line_markers_, line.id);
    add_line(graph, std::move(line));
  }
  if constexpr (D == 3) {
    for (auto& polygon : mesher_.polygons()) {
      polygon.marker = marker_of(polygon_markers_, polygon.id);
      graph.polygons.push_back(std::move(polygon));
    }
  }
  for (const auto& [name, seed] : seeds_.committed()) graph.seeds.push_back(seed);
  return graph;
}

template <int D>
std::optional<GraphPoint<D>> DomainState<D>::point(PointId id) const {
  std::optional<GraphPoint<D>> found = mesher_.point(id);
  if (found) found->marker = marker_of(point_markers_, id);
  return found;
}

template <int D>
std::optional<Polyline> DomainState<D>::line(LineId id) const {
  std::optional<Polyline> found = mesher_.line(id);
  if (found) found->marker = marker_of(line_markers_, id);
  return found;
}

template <int D>
std::optional<mesher::Polygon> DomainState<D>::polygon(PolygonId id) const {
  std::optional<mesher::Polygon> found = mesher_.polygon(id);
  if (found) found->marker = marker_of(polygon_markers_, id);
  return found;
}

template <int D>
std::optional<Seed<D>> DomainState<D>::seed(const SeedId& name) const {
  const auto it = seeds_.committed().find(name);
  return it == seeds_.committed().end() ? std::nullopt : std::optional(it->second);
}

template class DomainState<2>;
#ifndef MESHER_PLANE_ONLY
template class DomainState<3>;
#endif

}  // namespace mesher::detail
