// Split segments become edits of tiles, and what tiles have changed becomes a change of the mesh.
#include "facade/tiled_plane_state.hpp"

#include <algorithm>
#include <map>

#include "facade/asking.hpp"
#include "facade/held.hpp"
#include "facade/tile_angles.hpp"
#include "facade/tile_changes.hpp"
#include "facade/whole_change.hpp"
#include "program/meter.hpp"
#include "program/world_impl.hpp"
#include "sets/report_difference.hpp"
#include "sizes/fill_places.hpp"

namespace mesher::detail {

namespace {

// All that is run here.
struct SplitAll {
  static constexpr std::string_view kName = "split";
  void operator()(sac::Scope& s) const { s.environment<World<sac::Scope, 2>>().splits.drain(s); }
};
inline constexpr SplitAll split_all{};

template <class T>
std::optional<T>& at(std::vector<std::optional<T>>& all, std::uint32_t handle) {
  if (handle >= all.size()) all.resize(handle + std::size_t{1});
  return all[handle];
}

}  // namespace

TiledPlaneState::TiledPlaneState(const Options<2>& options) : TiledPlaneState(options, alone_) {}

TiledPlaneState::TiledPlaneState(const Options<2>& options, Peers& peers, std::size_t tiles)
    : PlaneState(options), options_(options), peers_(peers), tiles_wanted_(tiles) {
  if (world_->limits.any()) retract_cells(*world_);
  world_->locates = false;
}

// --- What tiles are told ---------------------------------------------------------------------

std::optional<TileMesher<2>::Located> TiledPlaneState::located(const Vertex<2>& v) const {
  if (v.boundary || !world_->features.has(v)) return std::nullopt;
  return Located(v.level, world_->limits.pitch(v.p), v.feature ? Role() : vertices().role(v));
}

// Of all that is there.
auto TiledPlaneState::build(const Tiles::Ask& ask) -> std::unique_ptr<Tiles> {
  std::unique_ptr<Tiles> tiles;
  Tiles::Edits by_tile;
  std::shared_ptr<CommonOrders<2>> common;
  together(peers_, [&] {
    std::vector<Point<2>> places;
    pool().for_each([&](const Vertex<2>& v) {
      if (!v.boundary && world_->features.has(v)) places.push_back(v.p);
    });
    const WholeInput<2> whole{&pool(), &world_->features.tree(), nullptr,
                              peers_.is_alone() ? nullptr : &numbers_};
    tiles =
        make_tiles(std::move(places), tiles_wanted_, options_, box_, world_->limits, peers_, whole);
    by_tile.resize(tiles->size());
    told_points_.assign(pool().end_of_handles(), std::nullopt);
    pool().for_each([&](const Vertex<2>& v) {
      const auto is = told_points_[v.self] = located(v);
      const auto tile = tiles->own_tile(v.p);
      if (is && tile) by_tile[*tile].push_back({v.p, std::nullopt, is});
    });
    common = std::make_shared<CommonOrders<2>>();
    LineOrders& lines = common->lines;
    auto& segments = world_->segments;
    told_zones_.assign(segments.pool().last() + std::size_t{1}, std::nullopt);
    std::vector<SegmentHandle> all;
    segments.pool().for_each([&](const Segment& s) {
      if (!s.alive) return;
      const Zones zones = segments.zones(s);
      told_zones_[s.self] = zones;
      lines.segments.push_back({s.self, s.a, s.b, std::nullopt, zones});
      all.push_back(s.self);
    });
    numbers_.clear();
    number(std::move(all));
    numbers_.commit();
    world_->leaves.for_each([&](const Leaf& leaf) { lines.leaves.push_back({leaf.piece, true}); });
  });
  const Held held(world_->features);
  if (ask && &peers_ == &alone_) tiles->bound_looks();
  tiles->first_run(by_tile, ask, common);
  return tiles;
}

// Those that have none, in the order of their ends.
void TiledPlaneState::number(std::vector<SegmentHandle> segments) {
  if (peers_.is_alone()) return;
  const auto ends = [&](SegmentHandle h) {
    const Segment& s = world_->segments.pool()[h];
    return std::pair(s.place_a, s.place_b);  // in order
  };
  std::sort(segments.begin(), segments.end(),
            [&](SegmentHandle s, SegmentHandle t) { return ends(s) < ends(t); });
  for (const SegmentHandle s : segments) numbers_.add(s);
}

// What an update has changed, before it is committed here.
void TiledPlaneState::find_news(const Edits<2>& edits, News& news) {
  world_->features.require_apart();
  news.by_tile.resize(tiles_->size());
  if (edits.limits) {
    const auto& [is, where] = *edits.limits;
    news.common.limits = CommonOrders<2>::LimitsChange{options_, is, where};
  }
  find_points(news);
  find_lines(news);
}

// Those that have come or gone, or are crowded otherwise, and those where limits are others: all
// have been touched.
void TiledPlaneState::find_points(News& news) {
  for (const VertexHandle h : vertices().log().touched) {
    const Vertex<2>& v = pool()[h];
    const std::optional<Located> is = located(v);
    std::optional<Located>& told = at(told_points_, h);
    if (is == told) continue;
    const auto tile = tiles_->own_tile(v.p);
    if (tile) news.by_tile[*tile].push_back({v.p, told, is});
    news.points.emplace_back(h, told);
    if (is.has_value() != told.has_value()) news.common.features.push_back(v.p);
    told = is;
  }
}

void TiledPlaneState::note_zones(const Segment& s, News& news, std::vector<SegmentHandle>& come) {
  std::optional<Zones> is;
  if (s.alive) is = world_->segments.zones(s);
  std::optional<Zones>& told = at(told_zones_, s.self);
  if (is == told) return;
  news.common.lines.segments.push_back({s.self, s.a, s.b, told, is});
  news.zones.emplace_back(s.self, told);
  if (!told) come.push_back(s.self);
  if (!is) news.gone.push_back(s.self);
  told = is;
}

void TiledPlaneState::find_lines(News& news) {
  auto& segments = world_->segments;
  std::vector<SegmentHandle> come;
  const auto note = [&](const Segment& s) { note_zones(s, news, come); };
  if (are_zones_known_) {
    segments.store().for_each_changed(note);
  } else {
    segments.pool().for_each(note);
  }
  number(std::move(come));
  world_->leaves.for_each_changed([&](const Leaf& leaf) {
    const bool is = world_->leaves.is_leaf(leaf);
    if (is != leaf.committed) news.common.lines.leaves.push_back({leaf.piece, is});
  });
}

// Where an edit was taken back, what it has made forget is found again: only of who is known it is
// noted that something has changed near by.
void TiledPlaneState::free_features() noexcept {
  try {
    world_->segments.store().for_each_changed([&](const Segment& s) {
      const bool is_told = s.self < told_zones_.size() && told_zones_[s.self];
      if (is_told && s.alive) static_cast<void>(world_->segments.zones(s));
    });
  } catch (const std::bad_alloc&) {
    are_zones_known_ = false;
  }
  PlaneState::free_features();
}

void TiledPlaneState::take_back(const News& news) noexcept {
  for (const auto& [h, was] : news.points) told_points_[h] = was;
  for (const auto& [h, was] : news.zones) told_zones_[h] = was;
  numbers_.take_back();
}

// --- Runs ------------------------------------------------------------------------------------

Change<2> TiledPlaneState::first_run(Edits<2> edits, const RunControl& control,
                                     const Accept& accept) {
  together(peers_, [&] { begin_first(edits, control); });
  in_tiles([&] {
    together(peers_, [&] {
      engine_->run<split_all>();
      world_->features.require_apart();
    });
  });
  Tiles::Ask ask;
  together(peers_, [&] {
    commit();
    find_levels(*world_, options_.threads);
    ask = asks_first(control, ids_.size());
  });
  in_tiles([&] { tiles_ = build(ask); });
  if (tiles_wanted_ != 1) require_leaves();  // one tile: one process has looked at them
  ran_ = true;
  Change<2> change;
  together(peers_, [&] { change = peers_.is_alone() ? whole_change(mesh()) : whole(); });
  set_first(stats_, change, *tiles_);
  change.angles = all_angles(wholly(), *tiles_, options_.rho);
  change.calls.executed = tiles_->calls();
  if (accept) accept(change);
  return change;
}

// One thread looks at them all.
void TiledPlaneState::require_leaves() const {
  std::uint64_t keeps = 1;
  for (std::size_t t = 0; t < tiles_->size(); ++t) {
    if ((*tiles_)[t].may_lose_leaves()) keeps = 0;
  }
  peers_.least({&keeps, 1});
  if (keeps == 0) throw NotInTiles();
}

Change<2> TiledPlaneState::propagate(const Edits<2>& edits, const RunControl& control,
                                     const Accept& accept) {
  SAC_EXPECTS(takes(edits));
  Change<2> change;
  std::optional<Growth<2>> growth;  // before `accept` makes more of it
  News news;
  std::optional<Options<2>> options;
  std::shared_ptr<const CommonOrders<2>> common;
  bool is_judged = false;  // what is thrown then is the caller's
  const std::uint64_t before = tiles_->calls();
  Tiles::Ask ask;
  std::function<void(Tiles::Changes&)> last;
  std::function<void()> run_tiles;
  const auto end = [&](Tiles::Changes& changes) {
    require_leaves();
    together(peers_, [&] {
      change = change_of(changes);
      growth.emplace(change);
    });
    change.angles = new_angles(wholly(), *tiles_, options_.rho, change.simplices_added);
    change.calls.executed = tiles_->calls() - before;
    is_judged = true;
    if (accept) accept(change);
  };
  TogetherInside inside(peers_);
  const auto begin = [&] {  // while all can be undone here
    inside.begin();
    together(peers_, [&] {
      make_room();
      prepare_names();
      find_news(edits, news);
      if (!news.common.is_empty()) {
        common = std::make_shared<const CommonOrders<2>>(std::move(news.common));
      }
    });
    const Held held(world_->features);
    tiles_->update(news.by_tile, ask, last, common);
  };
  inside.before([&] {
    options = edits.limits ? edits.limits->options : options_;
    ask = asks_update(control);
    last = end, run_tiles = begin;
    ask_ = asking(control, Phase::update, &fail_stopped);
    make(edits);
  });
  try {
    engine_->propagate(run_tiles);
  } catch (...) {
    const std::exception_ptr failure = inside.failure();
    const bool gives_up = inside.has_begun() && tiles_->has_given_up() && !is_judged;
    take_back(news);
    const Held held(world_->features);
    tiles_->take_back(news.by_tile, common);  // before records of ends are freed
    commit();
    forget();
    if (tiles_->is_broken()) {  // the mesh is a function of what is there
      tiles_ = build({});
      count_own(stats_, *tiles_);
    }
    if (gives_up) throw NotInTilesYet();
    in_tiles([&] { std::rethrow_exception(failure); }, !is_judged);
  }
  options_ = std::move(*options);
  are_zones_known_ = true;
  for (const SegmentHandle s : news.gone) numbers_.take(s);
  numbers_.commit();
  rename(edits.points);
  commit_names();
  forget();
  commit();
  growth->add_to(stats_);
  return change;
}

// --- Changes ---------------------------------------------------------------------------------

Change<2> TiledPlaneState::change_of(Tiles::Changes& changes) const {
  Change<2> change = detail::change_of<2>(changes);
  report_edges(changes, change);
  return change;
}

// Of triangles that were not there before, in any process.
void TiledPlaneState::judge_new(Change<2>& change) const {
  std::vector<std::array<Point<2>, 3>> own;
  together(peers_, [&] {
    for (const auto& t : change.simplices_added) {
      if (tiles_->own_tile(t[0])) own.push_back(t);
    }
  });
  change.angles = new_angles(wholly(), *tiles_, options_.rho, own);
}

// Leaves that ended or began, without those of which another piece is in the same place; and those
// that stay, of segments that are now of another line.
void TiledPlaneState::report_edges(const Tiles::Changes& changes, Change<2>& change) const {
  struct Fate {
    Point<2> lo{}, hi{};
    bool before = false, now = false;
  };
  std::map<Piece, Fate> fates;
  for (const auto& e : changes.leaves) {
    const auto [it, is_new] = fates.try_emplace(e.piece, Fate{e.lo, e.hi, !e.came, e.came});
    it->second.now = e.came;
  }
  LineEdges gone, come;
  for (const auto& [piece, fate] : fates) {
    const SegmentHandle s = piece.segment;
    if (fate.before) gone.push_back(edge_between(fate.lo, fate.hi, old_line(s)));
    if (fate.now) come.push_back(edge_between(fate.lo, fate.hi, line(s)));
  }
  if (any_renamed()) {
    for (std::size_t t = 0; t < tiles_->size(); ++t) {
      (*tiles_)[t].for_each_own_leaf([&](const Piece& piece, const auto& lo, const auto& hi) {
        const SegmentHandle s = piece.segment;
        if (!is_renamed(s) || fates.contains(piece)) return;
        gone.push_back(edge_between(lo, hi, old_line(s)));
        come.push_back(edge_between(lo, hi, line(s)));
      });
    }
  }
  report_difference(std::move(come), std::move(gone), change.edges_added, change.edges_removed);
}

// --- Between updates -------------------------------------------------------------------------

Mesh<2> TiledPlaneState::mesh() const {
  return tiles_->mesh([this](SegmentHandle s) { return old_line(s); });
}

Change<2> TiledPlaneState::whole() const { return own_part(whole_change(mesh()), *tiles_); }

WholeWorld TiledPlaneState::wholly() const { return {*world_, numbers_, peers_}; }

MeshStats TiledPlaneState::stats() const {
  MeshStats s = stats_;
  s.trace_bytes = engine_->bytes() + pool().bytes() + vertices().tree().bytes() +
                  world_->features.bytes() + feature_bytes();
  if (tiles_ != nullptr) add_trace(*tiles_, s);
  return s;
}

void TiledPlaneState::check_invariants() const {
  engine_->check_invariants();
  world_->features.check_invariants();
  world_->segments.check_invariants();
  world_->leaves.check_invariants();
  tiles_->check_invariants();
  pool().for_each([&](const Vertex<2>& v) {
    const auto told = v.self < told_points_.size() ? told_points_[v.self] : std::nullopt;
    SAC_INVARIANT(told == located(v));
  });
  world_->segments.pool().for_each([&](const Segment& s) {
    SAC_INVARIANT(s.alive && told_zones_[s.self] == world_->segments.zones(s));
  });
  SAC_INVARIANT(stats_.vertices == tiles_->vertices());
  std::size_t simplices = 0;
  for (std::size_t t = 0; t < tiles_->size(); ++t) simplices += (*tiles_)[t].own_simplices();
  SAC_INVARIANT(stats_.simplices == simplices);
}

}  // namespace mesher::detail
