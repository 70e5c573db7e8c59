// What comes before refinement becomes edits of tiles, and their vertices become those of the mesh.
#include "facade/tiled_space_state.hpp"

#include <algorithm>

#include "facade/asking.hpp"
#include "facade/tile_changes.hpp"
#include "program/meter.hpp"
#include "program/world_impl.hpp"
#include "sets/make_set.hpp"
#include "sizes/fill_places.hpp"

namespace mesher::detail {

namespace {

// All that is run here.
struct DrainFeatures {
  static constexpr std::string_view kName = "features";
  void operator()(sac::Scope& s) const { drain_lines(s, s.environment<World<sac::Scope, 3>>()); }
};
inline constexpr DrainFeatures drain_features{};

}  // namespace

bool may_have_complexes_tiled(const Options<3>& options, const Edits<3>& edits) {
  return may_have_tiles(options, edits);
}

TiledSpaceState::TiledSpaceState(const Options<3>& options)
    : SpaceState(options), options_(options) {
  if (world_->limits.any()) retract_cells(*world_);
  world_->locates = false;
}

// --- What tiles are told ---------------------------------------------------------------------

auto TiledSpaceState::now(const Vertex<3>& v) const -> Told {
  if (v.boundary || !world_->features.has(v)) return {};
  const Role role = v.feature ? Role() : vertices().role(v);
  return {Located(v.level, world_->limits.pitch(v.p), role), v.feature};
}

// Of all that is there.
auto TiledSpaceState::build(const Tiles::Ask& ask) -> std::unique_ptr<Tiles> {
  const auto threads = static_cast<std::size_t>(options_.threads);
  std::vector<Point<3>> places;
  pool().for_each([&](const Vertex<3>& v) {
    if (!v.boundary && world_->features.has(v)) places.push_back(v.p);
  });
  places = places_of_work(std::move(places), world_->limits, box_, options_.domain);
  const WholeInput<3> whole{nullptr, nullptr, &store()};
  auto tiles = std::make_unique<Tiles>(options_, box_, places, threads, threads, alone_, whole);
  Tiles::Edits by_tile(tiles->size());
  const auto common = std::make_shared<CommonOrders<3>>();
  FeatureOrders& orders = common->features_in_space;
  told_.assign(pool().end_of_handles(), Told());
  pool().for_each([&](const Vertex<3>& v) {
    const Told& is = told_[v.self] = now(v);
    if (is.located) by_tile[*tiles->own_tile(v.p)].push_back({v.p, std::nullopt, is.located});
    if (is.is_input) orders.points_come.push_back(v.p);
  });
  store().edges().for_each([&](const Edge& e) {
    if (segment_names_.find(e.self)) orders.segments_come.push_back(e.self);
  });
  store().polygons().for_each([&](const Polygon& f) {
    if (f.alive) orders.polygons_come.push_back(f.self);
  });
  tiles->first_run(by_tile, ask, common);
  return tiles;
}

// What an update has changed, before it is committed here.
void TiledSpaceState::find_news(const Edits<3>& edits, News& news) {
  news.by_tile.resize(tiles_->size());
  if (edits.limits) {
    const auto& [is, where] = *edits.limits;
    news.common.limits = CommonOrders<3>::LimitsChange{options_, is, where};
  }
  FeatureOrders& orders = news.common.features_in_space;
  if (told_.size() < pool().end_of_handles()) told_.resize(pool().end_of_handles());
  for (const VertexHandle h : vertices().touched()) {
    const Vertex<3>& v = pool()[h];
    const Told is = now(v);
    Told& told = told_[h];
    if (is == told) continue;
    if (is.located != told.located) {
      news.by_tile[*tiles_->own_tile(v.p)].push_back({v.p, told.located, is.located});
    }
    if (is.is_input != told.is_input) {
      (is.is_input ? orders.points_come : orders.points_gone).push_back(v.p);
    }
    news.told.emplace_back(h, told);
    told = is;
  }
  orders.segments_gone.assign(segment_names_.taken().begin(), segment_names_.taken().end());
  std::sort(orders.segments_gone.begin(), orders.segments_gone.end());
  orders.segments_come = segment_names_.added();
  orders.polygons_gone = polygon_names_.taken();
  orders.polygons_come = polygon_names_.added();
}

void TiledSpaceState::take_back(const News& news) noexcept {
  for (const auto& [h, was] : news.told) told_[h] = was;
}

// --- What tiles say --------------------------------------------------------------------------

// As the tile has it that has the place.
void TiledSpaceState::set_vertex(const Point<3>& p) {
  const TileMesher<3>& tile = (*tiles_)[*tiles_->own_tile(p)];
  const auto& theirs = tile.world().vertices;
  const Vertex<3>* there = theirs.tree().find(p);
  const bool is_there = there != nullptr && there->alive;
  const Role role = is_there ? tile.named(theirs.role(*there)) : Role();
  vertices().set_vertex(*vertices().claim(p), is_there, role);
}

// After an update that has failed, of which tiles have nothing any more. Roles have had room.
void TiledSpaceState::set_touched() noexcept {
  try {
    for (const VertexHandle h : vertices().touched()) {
      if (!pool()[h].boundary) set_vertex(Point<3>(pool()[h].p));
    }
  } catch (const std::bad_alloc&) {
    // The list cannot be made: what is committed is what is there.
  }
}

// --- Runs ------------------------------------------------------------------------------------

Change<3> TiledSpaceState::first_run(Edits<3> edits, const RunControl& control,
                                     const Accept& accept) {
  ids_.reserve(edits.points.size());
  ask_ = asking(control, Phase::quadtree, &fail_stopped);
  for (const auto& edit : edits.points) add_first(edit);
  add_features_first(edits);
  in_tiles([&] {
    engine_->run<drain_features>();
    world_->features.require_apart();
  });
  commit();
  find_levels(*world_, options_.threads);
  const Tiles::Ask ask = [&, points = ids_.size()](Phase phase, std::uint64_t calls) {
    const std::uint64_t of = phase == Phase::quadtree ? std::max<std::uint64_t>(points, calls) : 0;
    return detail::report(control, {phase, calls, of});
  };
  in_tiles([&] { tiles_ = build(ask); });
  for (std::size_t t = 0; t < tiles_->size(); ++t) {
    (*tiles_)[t].for_each_own_vertex([&](const Vertex<3>& v) {
      const Role role = (*tiles_)[t].named((*tiles_)[t].world().vertices.role(v));
      vertices().set_vertex(*vertices().claim(v.p), true, role);
    });
  }
  vertices().keep_triangulation();
  commit();
  Change<3> change = first_change();
  set_first(stats_, change, *tiles_);
  change.calls.executed = tiles_->calls();
  if (accept) accept(change);
  return change;
}

Change<3> TiledSpaceState::propagate(const Edits<3>& edits, const RunControl& control,
                                     const Accept& accept) {
  Change<3> change;
  News news;
  Options<3> options = edits.limits ? edits.limits->options : options_;
  std::shared_ptr<const CommonOrders<3>> common;
  bool is_judged = false;  // what is thrown then is the caller's
  const std::uint64_t before = tiles_->calls();
  const Tiles::Ask ask = [&](Phase phase, std::uint64_t calls) {
    return detail::report(control, {phase, calls, 0});
  };
  constexpr std::uint64_t kFew = 1 << 16;  // calls; more than that, and than
  constexpr std::uint64_t kTimes = 4;      // times those that there are, are too many
  std::uint64_t there = 0;
  for (std::size_t t = 0; t < tiles_->size(); ++t) there += (*tiles_)[t].engine().live_calls();
  tiles_->set_most_calls(kFew + kTimes * there);
  const auto last = [&](const Tiles::Changes& changes) {
    std::vector<Point<3>> places;
    for (const auto& e : changes.vertices) places.push_back(e.p);
    make_set(places);
    for (const Point<3>& p : places) set_vertex(p);
    report(change);
    change.calls.executed = tiles_->calls() - before;
    is_judged = true;
    if (accept) accept(change);
  };
  const std::function<void()> run_tiles = [&] {  // while all can be undone here
    world_->features.require_apart();
    make_room();
    prepare_names();
    find_news(edits, news);
    if (!news.common.is_empty()) {
      common = std::make_shared<const CommonOrders<3>>(std::move(news.common));
    }
    tiles_->update(news.by_tile, ask, last, common);
  };
  ask_ = asking(control, Phase::update, &fail_stopped);
  make(edits);
  world_->most_records =
      std::max(world_->most_vertices, pool().size() - vertices().trials() + world_->most_vertices);
  try {
    engine_->propagate(run_tiles);
  } catch (...) {
    const bool gives_up = tiles_->has_given_up() && !is_judged;
    take_back(news);
    tiles_->take_back(news.by_tile, common);  // before records of points are freed
    forget();
    if (tiles_->is_broken()) tiles_ = build({});  // the mesh is a function of what is there
    set_touched();
    commit();
    if (gives_up) throw NotInTilesYet();
    in_tiles([] { throw; }, !is_judged);
  }
  options_ = std::move(options);
  end_update(edits.points, change);
  return change;
}

// --- Between updates -------------------------------------------------------------------------

MeshStats TiledSpaceState::stats() const {
  MeshStats s = SpaceState::stats();
  s.calls = s.edges = 0;
  if (tiles_ != nullptr) add_trace(*tiles_, s);
  return s;
}

void TiledSpaceState::check_invariants() const {
  SpaceState::check_invariants();
  tiles_->check_invariants();
  SAC_INVARIANT(pool().end_of_handles() >= told_.size());
  pool().for_each([&](const Vertex<3>& v) {
    SAC_INVARIANT((v.self < told_.size() ? told_[v.self] : Told()) == now(v));
    if (v.boundary) return;
    const TileMesher<3>& tile = (*tiles_)[*tiles_->own_tile(v.p)];
    const Vertex<3>* there = tile.world().vertices.tree().find(v.p);
    SAC_INVARIANT(v.alive == (there != nullptr && there->alive));
    if (v.alive) {
      SAC_INVARIANT(vertices().role(v) == tile.named(tile.world().vertices.role(*there)));
    }
  });
  std::size_t boundary = 0;
  pool().for_each([&](const Vertex<3>& v) { boundary += v.boundary; });
  std::size_t owned = 0;
  for (std::size_t t = 0; t < tiles_->size(); ++t) {
    (*tiles_)[t].for_each_own_vertex([&](const Vertex<3>&) { ++owned; });
  }
  SAC_INVARIANT(stats_.vertices == owned + boundary);
}

}  // namespace mesher::detail
