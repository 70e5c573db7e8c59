// What comes before refinement becomes edits of tiles, and their vertices become those of the mesh.
#include "facade/tiled_space_state.hpp"

#include <algorithm>
#include <iterator>

#include "facade/asking.hpp"
#include "facade/tile_changes.hpp"
#include "facade/whole_change.hpp"
#include "program/meter.hpp"
#include "program/world_impl.hpp"
#include "sets/make_set.hpp"
#include "sizes/fill_places.hpp"
#include "tiles/message_bytes.hpp"

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

TiledSpaceState::TiledSpaceState(const Options<3>& options) : TiledSpaceState(options, alone_) {}

TiledSpaceState::TiledSpaceState(const Options<3>& options, Peers& peers, std::size_t tiles)
    : SpaceState(options), options_(options), peers_(peers), tiles_wanted_(tiles) {
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
  std::unique_ptr<Tiles> tiles;
  Tiles::Edits by_tile;
  std::shared_ptr<CommonOrders<3>> common;
  together(peers_, [&] {
    std::vector<Point<3>> places;
    pool().for_each([&](const Vertex<3>& v) {
      if (!v.boundary && world_->features.has(v)) places.push_back(v.p);
    });
    WholeInput<3> whole{nullptr, nullptr, &store()};
    if (!peers_.is_alone()) whole.lines = &edge_numbers_, whole.polygons = &polygon_numbers_;
    tiles =
        make_tiles(std::move(places), tiles_wanted_, options_, box_, world_->limits, peers_, whole);
    by_tile.resize(tiles->size());
    common = std::make_shared<CommonOrders<3>>();
    FeatureOrders& orders = common->features_in_space;
    told_.assign(pool().end_of_handles(), Told());
    pool().for_each([&](const Vertex<3>& v) {
      const Told& is = told_[v.self] = now(v);
      const auto tile = tiles->own_tile(v.p);
      if (is.located && tile) by_tile[*tile].push_back({v.p, std::nullopt, is.located});
      if (is.is_input) orders.points_come.push_back(v.p);
    });
    store().edges().for_each([&](const Edge& e) {
      if (segment_names_.find(e.self)) orders.segments_come.push_back(e.self);
    });
    store().polygons().for_each([&](const Polygon& f) {
      if (f.alive) orders.polygons_come.push_back(f.self);
    });
    edge_numbers_.clear(), polygon_numbers_.clear();
    number(orders);
    edge_numbers_.commit(), polygon_numbers_.commit();
  });
  if (ask && &peers_ == &alone_) tiles->bound_looks();
  tiles->first_run(by_tile, ask, common);
  return tiles;
}

// Those that have none: edges in the order of their ends, polygons of their ids.
void TiledSpaceState::number(const FeatureOrders& come) {
  if (peers_.is_alone()) return;
  std::vector<EdgeHandle> edges = come.segments_come;
  std::vector<PolygonHandle> polygons = come.polygons_come;
  for (const PolygonHandle f : polygons) {
    const auto& all = store().polygons()[f].all_edges;
    edges.insert(edges.end(), all.begin(), all.end());
  }
  const auto ends = [&](EdgeHandle h) {
    const Edge& e = store().edges()[h];
    return std::pair(e.place_a, e.place_b);  // in order
  };
  std::sort(edges.begin(), edges.end(),
            [&](EdgeHandle e, EdgeHandle f) { return ends(e) < ends(f); });
  std::sort(polygons.begin(), polygons.end(), [&](PolygonHandle f, PolygonHandle g) {
    return polygon_names_.find(f) < polygon_names_.find(g);
  });
  for (const EdgeHandle e : edges) edge_numbers_.add(e);
  for (const PolygonHandle f : polygons) polygon_numbers_.add(f);
}

// Edges that nothing has any more.
void TiledSpaceState::list_gone(const FeatureOrders& orders, std::vector<EdgeHandle>& gone) const {
  if (peers_.is_alone()) return;
  const auto look = [&](EdgeHandle h) {
    if (store().users(store().edges()[h]) == 0) gone.push_back(h);
  };
  for (const EdgeHandle e : orders.segments_gone) look(e);
  for (const PolygonHandle f : orders.polygons_gone) {
    for (const EdgeHandle e : store().polygons()[f].all_edges) look(e);
  }
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
    const auto tile = tiles_->own_tile(v.p);
    if (is.located != told.located && tile) {
      news.by_tile[*tile].push_back({v.p, told.located, is.located});
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
  number(orders);
  list_gone(orders, news.edges_gone);
}

void TiledSpaceState::take_back(const News& news) noexcept {
  for (const auto& [h, was] : news.told) told_[h] = was;
  edge_numbers_.take_back(), polygon_numbers_.take_back();
}

// --- What tiles say --------------------------------------------------------------------------

// As the tile has it that has the place. Requires: that is this process's.
auto TiledSpaceState::standing(const Point<3>& p) const -> Standing {
  const TileMesher<3>& tile = (*tiles_)[*tiles_->own_tile(p)];
  const auto& theirs = tile.world().vertices;
  const Vertex<3>* there = theirs.tree().find(p);
  const bool is_there = there != nullptr && there->alive;
  return {p, is_there, is_there ? tile.named(theirs.role(*there)) : Role()};
}

// Of all processes, by the handles of this one.
auto TiledSpaceState::of_all(std::vector<Standing> own) const -> std::vector<Standing> {
  if (peers_.is_alone()) return own;
  const WholeInput<3> whole{nullptr, nullptr, &store(), &edge_numbers_, &polygon_numbers_};
  Packer mine;
  together(peers_, [&] {
    for (const Standing& v : own) {
      mine.put(v.p), mine.put(v.is_there);
      pack(v.role, whole, mine);
    }
  });
  const std::vector<Bytes> told = peers_.gather(mine.bytes());
  std::vector<Standing> all;
  together(peers_, [&] {
    for (const Bytes& some : told) {
      for (Unpacker rest(some); !rest.is_empty();) {
        Standing& v = all.emplace_back();
        v.p = rest.take<Point<3>>(), v.is_there = rest.take<bool>();
        v.role = unpack_role(rest, whole);
      }
    }
  });
  return all;
}

void TiledSpaceState::set_vertices(const std::vector<Standing>& all) {
  for (const Standing& is : all) {
    Vertex<3>& v = *vertices().claim(is.p);
    if (v.on_segment) roles_before_.emplace_back(v.self, vertices().role(v));
    vertices().set_vertex(v, is.is_there, is.role);
  }
}

// After an update that has failed, of which tiles have nothing any more. Roles have had room.
void TiledSpaceState::set_touched() noexcept {
  try {
    for (const VertexHandle h : vertices().touched()) {
      Vertex<3>& v = *vertices().claim(pool()[h].p);
      if (!v.boundary) vertices().set_vertex(v, v.committed, vertices().role(v));
    }
    for (auto it = roles_before_.rbegin(); it != roles_before_.rend(); ++it) {
      Vertex<3>& v = *vertices().claim(pool()[it->first].p);
      vertices().set_vertex(v, v.committed, it->second);
    }
  } catch (const std::bad_alloc&) {
    // The list cannot be made: what is committed is what is there.
  }
}

// --- Runs ------------------------------------------------------------------------------------

Change<3> TiledSpaceState::first_run(Edits<3> edits, const RunControl& control,
                                     const Accept& accept) {
  together(peers_, [&] { begin_first(edits, control); });
  in_tiles([&] {
    together(peers_, [&] {
      engine_->run<drain_features>();
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
  std::vector<Standing> own;
  together(peers_, [&] {
    for (std::size_t t = 0; t < tiles_->size(); ++t) {
      const TileMesher<3>& tile = (*tiles_)[t];
      tile.for_each_own_vertex([&](const Vertex<3>& v) {
        own.push_back({v.p, true, tile.named(tile.world().vertices.role(v))});
      });
    }
  });
  const std::vector<Standing> all = of_all(std::move(own));
  Change<3> change;
  together(peers_, [&] {
    set_vertices(all);
    roles_before_.clear();
    vertices().keep_triangulation();
    commit();
    change = first_change();
  });
  set_first(stats_, change, *tiles_);
  change.calls.executed = tiles_->calls();
  if (accept) accept(change);
  return change;
}

Change<3> TiledSpaceState::propagate(const Edits<3>& edits, const RunControl& control,
                                     const Accept& accept) {
  Change<3> change;
  News news;
  std::optional<Options<3>> options;
  std::shared_ptr<const CommonOrders<3>> common;
  bool is_judged = false;  // what is thrown then is the caller's
  const std::uint64_t before = tiles_->calls();
  Tiles::Ask ask;
  std::function<void(Tiles::Changes&)> last;
  std::function<void()> run_tiles;
  roles_before_.clear();
  const auto end = [&](Tiles::Changes& changes) {
    std::vector<Standing> own;
    together(peers_, [&] {
      std::vector<Point<3>> places;
      for (const auto& e : changes.vertices) places.push_back(e.p);
      make_set(places);
      for (const Point<3>& p : places) own.push_back(standing(p));
    });
    const std::vector<Standing> all = of_all(std::move(own));
    together(peers_, [&] {
      set_vertices(all);
      report(change);
    });
    change.calls.executed = tiles_->calls() - before;
    is_judged = true;
    if (accept) accept(change);
  };
  TogetherInside inside(peers_);
  const auto begin = [&] {  // while all can be undone here
    inside.begin();
    together(peers_, [&] {
      world_->features.require_apart();
      make_room();
      prepare_names();
      find_news(edits, news);
      if (!news.common.is_empty()) {
        common = std::make_shared<const CommonOrders<3>>(std::move(news.common));
      }
    });
    tiles_->update(news.by_tile, ask, last, common);
  };
  inside.before([&] {
    options = edits.limits ? edits.limits->options : options_;
    ask = asks_update(control);
    last = end, run_tiles = begin;
    ask_ = asking(control, Phase::update, &fail_stopped);
    make(edits);
  });
  world_->most_records =
      std::max(world_->most_vertices, pool().size() - vertices().trials() + world_->most_vertices);
  try {
    engine_->propagate(run_tiles);
  } catch (...) {
    const std::exception_ptr failure = inside.failure();
    const bool gives_up = inside.has_begun() && tiles_->has_given_up() && !is_judged;
    take_back(news);
    tiles_->take_back(news.by_tile, common);  // before records of points are freed
    forget();
    if (tiles_->is_broken()) tiles_ = build({});  // the mesh is a function of what is there
    set_touched();
    commit();
    if (gives_up) throw NotInTilesYet();
    in_tiles([&] { std::rethrow_exception(failure); }, !is_judged);
  }
  for (const EdgeHandle e : news.edges_gone) edge_numbers_.take(e);
  for (const PolygonHandle f : polygon_names_.taken()) {
    if (!store().polygons()[f].alive) polygon_numbers_.take(f);
  }
  edge_numbers_.commit(), polygon_numbers_.commit();
  options_ = std::move(*options);
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

void TiledSpaceState::judge_new(Change<3>& change) const {
  together(peers_, [&] { SpaceState::judge_new(change); });
}

Change<3> TiledSpaceState::whole() const { return own_part(whole_change(mesh()), *tiles_); }

// What the simplices, edges and faces of this process need of the mesh.
Mesh<3> TiledSpaceState::own_mesh() const {
  Mesh<3> whole = mesh();
  if (peers_.is_alone()) return whole;
  Mesh<3> own;
  const auto is_own = [&](std::uint32_t i) {
    return tiles_->own_tile(whole.vertices[i]).has_value();
  };
  const auto keep = [](const auto& from, auto& to, auto&& is_kept) {
    std::copy_if(from.begin(), from.end(), std::back_inserter(to), is_kept);
  };
  keep(whole.simplices, own.simplices, [&](const auto& s) { return is_own(s[0]); });
  keep(whole.edges, own.edges, [&](const auto& e) { return is_own(e.low); });
  keep(whole.faces, own.faces, [&](const auto& f) { return is_own(f.corners[0]); });
  std::vector<std::uint32_t> name(whole.vertices.size());  // 1: it is used
  const auto for_each_corner = [&](auto&& act) {
    for (auto& s : own.simplices) std::for_each(s.begin(), s.end(), act);
    for (auto& e : own.edges) act(e.low), act(e.high);
    for (auto& f : own.faces) std::for_each(f.corners.begin(), f.corners.end(), act);
  };
  for_each_corner([&](std::uint32_t i) { name[i] = 1; });
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == 0) continue;
    name[i] = static_cast<std::uint32_t>(own.vertices.size());
    own.vertices.push_back(whole.vertices[i]);
    own.kinds.push_back(whole.kinds[i]);
  }
  for_each_corner([&](std::uint32_t& i) { i = name[i]; });
  return own;
}

void TiledSpaceState::check_invariants() const {
  SpaceState::check_invariants();
  tiles_->check_invariants();
  SAC_INVARIANT(pool().end_of_handles() >= told_.size());
  pool().for_each([&](const Vertex<3>& v) {
    SAC_INVARIANT((v.self < told_.size() ? told_[v.self] : Told()) == now(v));
    const auto own = tiles_->own_tile(v.p);
    if (v.boundary || !own) return;
    const TileMesher<3>& tile = (*tiles_)[*own];
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
  if (peers_.is_alone()) SAC_INVARIANT(stats_.vertices == owned + boundary);
}

}  // namespace mesher::detail
