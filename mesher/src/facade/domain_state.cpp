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

}  // namespace

// --- Edits -----------------------------------------------------------------------------------

void DomainState::insert(FeatureId id, const Point<2>& point, std::int64_t marker) {
  busy_.require_idle();
  mark(point_markers_, id, marker, [&] { mesher_.insert(id, point); });
}

void DomainState::remove(FeatureId id) {
  busy_.require_idle();
  mark(point_markers_, id, 0, [&] { mesher_.remove(id); });
}

void DomainState::move(FeatureId id, const Point<2>& point) {
  busy_.require_idle();
  mesher_.move(id, point);
}

void DomainState::insert_line(FeatureId id, const std::vector<FeatureId>& points,
                              std::int64_t marker) {
  busy_.require_idle();
  mark(line_markers_, id, marker, [&] { mesher_.insert_polyline(id, points); });
  needs_follower_ = true;
}

void DomainState::remove_line(FeatureId id) {
  busy_.require_idle();
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

void DomainState::limit(const SizeLimits<2>& limits) {
  busy_.require_idle();
  mesher_.limit(limits);
}

void DomainState::limit(const Box<2>& box, const SizeLimits<2>& limits) {
  busy_.require_idle();
  mesher_.limit(box, limits);
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
  DomainFollower first(mesh_of(change), walls_of(change), all_of(seeds_), extent_);
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
  return follower_->update(change, domain_edits(change, seeds_));
}

// Whether it matters what lines enclose.
bool DomainState::needs_unlimited() const {
  if (!follower_ && !needs_follower_) return false;  // no line, no seed
  if (extent_ == Extent::enclosed && mesher_.has_limits()) return true;
  if (areas_ == RegionAreas::ignored) return false;
  const std::vector<Seed> seeds = all_of(seeds_);
  return std::any_of(seeds.begin(), seeds.end(),
                     [](const Seed& seed) { return seed.max_area.has_value(); });
}

// It begins with what the last update left.
void DomainState::make_unlimited(const RunControl& control) {
  auto made = std::make_unique<UnlimitedMesh>(mesher_.options(), extent_, areas_);
  if (ran_) {
    EditedSeeds seeds;
    for (const auto& [name, seed] : seeds_.committed()) seeds.set(name, seed);
    announce(input(), made->mesher());
    made->update(seeds, control, [](const auto&, const auto&) {});
  }
  unlimited_ = std::move(made);
}

DomainUpdate DomainState::run(const RunControl& control) {
  DomainUpdate update;
  const auto run_limited = [&] {
    static_cast<Change<2>&>(update) =
        mesher_.update(control, [&](const Change<2>& change) { update.domain = follow(change); });
  };
  if (!unlimited_ && needs_unlimited()) make_unlimited(control);
  if (!unlimited_) {
    run_limited();
    return update;
  }
  unlimited_->mesher().discard_edits();
  mesher_.announce_to(unlimited_->mesher());
  unlimited_->update(seeds_, control, [&](const auto& limits, const auto& where) {
    const bool first = mesher_.options().region_limits == nullptr;
    mesher_.limit_regions(limits, first ? std::vector{mesher_.options().domain} : where);
    run_limited();
  });
  return update;
}

DomainUpdate DomainState::update(const RunControl& control) {
  const Busy::Run running(busy_);
  DomainUpdate update;
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
