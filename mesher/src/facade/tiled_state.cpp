// Points become edits of tiles, and what tiles have changed becomes a change of the mesh.
#include "facade/tiled_state.hpp"

#include <algorithm>
#include <iterator>

#include "facade/held.hpp"
#include "facade/tile_changes.hpp"
#include "facade/whole_change.hpp"
#include "geometry/box.hpp"
#include "program/meter.hpp"
#include "rules/mesh_box.hpp"
#include "sets/make_set.hpp"
#include "sizes/fill_places.hpp"
#include "tiles/on_threads.hpp"

namespace mesher::detail {

namespace {

template <int D>
bool may_have_points_tiled(const Options<D>& options, const Edits<D>& edits) {
  return may_have_tiles(options, edits) && !edits.polygons.has_edits();
}

}  // namespace

template <int D>
bool may_be_tiled(const Options<D>& options, const Edits<D>& edits) {
  return !edits.lines.has_edits() && may_have_points_tiled(options, edits);
}

bool may_have_lines_tiled(const Options<2>& options, const Edits<2>& edits) {
  return may_have_points_tiled(options, edits);
}

template <int D>
TiledState<D>::TiledState(const Options<D>& options)
    : options_(options),
      peers_(alone_),
      box_(mesh_box(options)),
      features_(box_, points_),
      limits_(options, box_) {}

template <int D>
TiledState<D>::TiledState(const Options<D>& options, Peers& peers, std::size_t tiles,
                          PointsOf points)
    : options_(options),
      peers_(peers),
      tiles_wanted_(tiles),
      which_(points),
      box_(mesh_box(options)),
      features_(box_, points_),
      limits_(options, box_) {}

// --- Points ----------------------------------------------------------------------------------

template <int D>
auto TiledState<D>::place(PointId id) const -> typename Pending<D>::Place {
  const auto it = ids_.find(id);
  return it == ids_.end() ? typename Pending<D>::Place() : points_[it->second].p;
}

template <int D>
auto TiledState<D>::obstacle(const Point<D>& p) const -> std::optional<Named> {
  const Vertex<D>* v = features_.obstacle(p);
  return v == nullptr ? std::optional<Named>() : Named{names_[v->self].id, v->p};
}

template <int D>
std::vector<GraphPoint<D>> TiledState<D>::points() const {
  std::vector<GraphPoint<D>> all;
  all.reserve(ids_.size());
  for (const auto& [id, h] : ids_) all.push_back({id, points_[h].p});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

template <int D>
VertexHandle TiledState<D>::add_record(PointId id, const Point<D>& p) {
  Vertex<D>& v = points_.create(p);
  try {
    if (v.self >= names_.size()) names_.resize(v.self + std::size_t{1});
  } catch (...) {
    points_.release(v);
    throw;
  }
  names_[v.self] = {id, std::nullopt};
  return v.self;
}

template <int D>
VertexHandle TiledState<D>::add_point(PointId id, const Point<D>& p) {
  const VertexHandle h = add_record(id, p);
  try {
    ids_[id] = h;
  } catch (...) {
    points_.release(points_[h]);
    throw;
  }
  return h;
}

// Not gone, and no ghost.
template <int D>
bool TiledState<D>::is_own(VertexHandle h) const noexcept {
  const auto it = ids_.find(names_[h].id);
  return it != ids_.end() && it->second == h;
}

// --- The first run ---------------------------------------------------------------------------

// Of all points, by parts of the pool: these are in Morton order.
template <int D>
void TiledState<D>::find_levels(std::size_t threads) {
  on_threads(threads, [&](std::size_t part) {
    typename FeatureTree<D>::Path path;
    points_.for_each_in(part, threads, [&](Vertex<D>& v) {
      v.level = static_cast<std::int16_t>(features_.crowded_level(v, path));
    });
  });
}

template <int D>
auto TiledState<D>::make_all() const -> std::unique_ptr<TiledMesher<D>> {
  std::vector<Point<D>> places = sample_;
  if (!is_divided()) {
    places.reserve(ids_.size());
    points_.for_each([&](const Vertex<D>& v) { places.push_back(v.p); });
  }
  return make_tiles(std::move(places), tiles_wanted_, options_, box_, limits_, peers_,
                    WholeInput<D>{nullptr, &features_});
}

// With the points that there are.
template <int D>
void TiledState<D>::start(TiledMesher<D>& tiles, const typename TiledMesher<D>::Ask& ask) {
  TileEdits by_tile;
  together(peers_, [&] {
    by_tile.resize(tiles.size());
    if (!is_divided()) find_levels(static_cast<std::size_t>(options_.threads));
    points_.for_each([&](Vertex<D>& v) {
      names_[v.self].level = v.level;
      const auto tile = tiles.own_tile(v.p);
      if (tile) by_tile[*tile].push_back({v.p, std::nullopt, Located(v.level, limits_.pitch(v.p))});
    });
  });
  const Held held(features_);
  if (ask && &peers_ == &alone_) tiles.bound_looks();
  tiles.first_run(by_tile, ask);
}

template <int D>
auto TiledState<D>::build(const typename TiledMesher<D>::Ask& ask)
    -> std::unique_ptr<TiledMesher<D>> {
  std::unique_ptr<TiledMesher<D>> tiles;
  together(peers_, [&] { tiles = make_all(); });
  start(*tiles, ask);
  return tiles;
}

template <int D>
Change<D> TiledState<D>::first_run(Edits<D> edits, const RunControl& control,
                                   const Accept& accept) {
  typename TiledMesher<D>::Ask ask;
  together(peers_, [&] {
    ask = asks_first(control, edits.points.size());
    if (is_divided()) return;
    ids_.reserve(edits.points.size());
    for (const auto& edit : edits.points) {
      features_.insert_only(points_[add_point(edit.id, *edit.to)]);
    }
  });
  if (is_divided()) {
    sample_ = sample_of_all<D>(
        edits.points, tiles_wanted_ != 0 ? tiles_wanted_ : options_.threads * peers_.size(),
        peers_);
  }
  std::unique_ptr<TiledMesher<D>> tiles;
  together(peers_, [&] { tiles = make_all(); });
  if (is_divided()) insert_divided(edits.points, *tiles);
  edits.points = PointEdits<D>();
  in_tiles([&] { start(*tiles, ask); }, limits_.any() || bounds_dihedrals(options_));
  tiles_ = std::move(tiles);
  Change<D> change;
  together(peers_, [&] { change = whole(); });
  set_first(stats_, change, *tiles_);
  change.calls.executed = tiles_->calls();
  if (accept) accept(change);
  return change;
}

template <int D>
Change<D> TiledState<D>::whole() const {
  return own_part(whole_change(mesh()), *tiles_);
}

// --- Updates ---------------------------------------------------------------------------------

template <int D>
bool TiledState<D>::takes(const Edits<D>& edits) const noexcept {
  return !edits.lines.has_edits() && !edits.polygons.has_edits();
}

// Nothing has changed yet.
template <int D>
void TiledState<D>::begin_limits(const Edits<D>& edits, Moves& moves) {
  if (!edits.limits) return;
  const auto& [is, where] = *edits.limits;
  moves.limits.emplace(is, box_);
  moves.common.limits = typename CommonOrders<D>::LimitsChange{options_, is, where};
}

// Where there are limits all tiles are told of places.
template <int D>
void TiledState<D>::note_places(const PointEdits<D>& edits, Moves& moves) const {
  if (!limits_.any() && !(moves.limits && moves.limits->any())) return;
  for (const auto& edit : edits) {
    if (edit.was) moves.common.features.push_back(*edit.was);
    if (edit.to) moves.common.features.push_back(*edit.to);
  }
}

// For what may not fail: 3^D points a level.
template <int D>
void TiledState<D>::make_room(Moves& moves) {
  constexpr std::size_t kMost = 27 * (kLevels + 1);
  auto& changed = moves.changed;
  if (changed.capacity() < changed.size() + kMost) changed.reserve(2 * changed.size() + kMost);
}

template <int D>
void TiledState<D>::make_gone(const PointEdits<D>& edits, Moves& moves) {
  moves.gone.reserve(edits.size());
  for (const auto& edit : edits) {
    if (!edit.was) continue;
    make_room(moves);
    features_.erase(points_[ids_.at(edit.id)], moves.note());
    moves.gone.push_back(ids_.extract(edit.id));
  }
}

template <int D>
void TiledState<D>::make_come(const PointEdits<D>& edits, Moves& moves) {
  moves.come.reserve(edits.size());
  for (const auto& edit : edits) {
    if (!edit.to) continue;
    const VertexHandle h = add_point(edit.id, *edit.to);
    try {
      make_room(moves);
      features_.insert(points_[h], moves.note());
    } catch (...) {
      ids_.erase(edit.id);
      points_.release(points_[h]);
      throw;
    }
    moves.come.emplace_back(edit.id, h);
    moves.changed.push_back(h);
  }
}

// What has changed, to the tiles.
template <int D>
auto TiledState<D>::told(Moves& moves) -> TileEdits {
  TileEdits by_tile(tiles_->size());
  const LimitsOf<D>& limits = moves.limits ? *moves.limits : limits_;
  const auto was_at = [&](VertexHandle h) -> std::optional<Located> {
    if (!names_[h].level) return std::nullopt;
    return Located(*names_[h].level, limits_.pitch(points_[h].p));
  };
  const auto tell = [&](const Point<D>& p, std::optional<Located> was, std::optional<Located> is) {
    if (const auto tile = tiles_->own_tile(p)) by_tile[*tile].push_back({p, was, is});
  };
  for (const auto& node : moves.gone) {
    const VertexHandle h = node.mapped();
    tell(points_[h].p, was_at(h), std::nullopt);
  }
  auto& changed = moves.changed;
  if (moves.limits) {
    for (const Box<D>& box : moves.common.limits->where) {
      features_.visit_in(box, [&](const Vertex<D>& v) { return changed.push_back(v.self), false; });
    }
  }
  make_set(changed);
  moves.levels.reserve(changed.size());
  for (const VertexHandle h : changed) {
    if (!is_own(h)) continue;
    const Vertex<D>& v = points_[h];
    const std::optional<Located> was = was_at(h), is = Located(v.level, limits.pitch(v.p));
    if (was == is) continue;
    tell(v.p, was, is);
    moves.levels.emplace_back(h, std::exchange(names_[h].level, int{v.level}));
  }
  return by_tile;
}

template <int D>
void TiledState<D>::take_back(Moves moves) {
  for (const auto& [h, level] : moves.levels) names_[h].level = level;
  const auto ignore = [](const Vertex<D>&) {};
  const auto drop = [&](VertexHandle h) {
    features_.erase(points_[h], ignore);
    points_.release(points_[h]);
  };
  for (const VertexHandle h : moves.ghosts_come) drop(h);
  for (const auto& [id, h] : moves.come) {
    ids_.erase(id);
    drop(h);
  }
  for (auto& node : moves.gone) {
    features_.insert(points_[node.mapped()], ignore);
    ids_.insert(std::move(node));
  }
  for (const VertexHandle h : moves.ghosts_gone) features_.insert(points_[h], ignore);
}

// --- Divided points --------------------------------------------------------------------------

// Of a first run: the points of this process.
template <int D>
void TiledState<D>::insert_divided(const PointEdits<D>& share, const TiledMesher<D>& tiles) {
  const PointEdits<D> here = arrivals_here<D>(share, box_, tiles, peers_);
  Clashes<D> clashes(box_);
  Moves moves;
  together(peers_, [&] {
    ids_.reserve(here.size());
    for (const auto& edit : here) {
      const VertexHandle h = add_point(edit.id, *edit.to);
      moves.changed.push_back(h);
      const Vertex<D>* other = features_.insert_unless(points_[h]);
      if (other != nullptr) clashes.add(named(points_[h]), named(*other), false);
    }
  });
  clashes.require_none(peers_);
  together(peers_, [&] { find_levels(static_cast<std::size_t>(options_.threads)); });
  ask_others(tiles, moves);
}

// The edits of all processes become those of points of this one, and of others'.
template <int D>
void TiledState<D>::divide(const PointEdits<D>& share, Moves& moves) {
  const Pending<D> all = edits_of_all<D>(share, box_, peers_);
  Clashes<D> clashes(box_);
  together(peers_, [&] {
    const auto is_here = [&](const Point<D>& p) { return tiles_->own_tile(p).has_value(); };
    for (const auto& edit : all.sorted()) {
      typename Pending<D>::Edit own{edit.id, {}, {}}, other = own;
      if (edit.was) (is_here(*edit.was) ? own : other).was = edit.was;
      if (edit.to) (is_here(*edit.to) ? own : other).to = edit.to;
      if (own.was || own.to) moves.own.push_back(own);
      if (other.was || other.to) moves.others.push_back(other);
      if (!edit.to) continue;
      const NamedPlace<D> comes{edit.id, *edit.to};
      if (const auto* arrival = all.arrival_near(comes.p, comes.id)) {
        clashes.add(comes, {arrival->id, *arrival->to}, false);
      }
      const Vertex<D>* there = features_.obstacle(comes.p);
      if (there == nullptr || !is_own(there->self)) continue;  // another's: that process says so
      const NamedPlace<D> stays = named(*there);
      if (stays.id != comes.id && all.find(stays.id) == nullptr) clashes.add(comes, stays, true);
    }
  });
  clashes.require_none(peers_);
}

template <int D>
void TiledState<D>::make_ghosts_gone(Moves& moves) {
  moves.ghosts_gone.reserve(moves.others.size());
  for (const auto& edit : moves.others) {
    const Vertex<D>* there = edit.was ? features_.obstacle(*edit.was) : nullptr;
    if (there == nullptr || there->p != *edit.was || is_own(there->self)) continue;
    make_room(moves);
    features_.erase(points_[there->self], moves.note());
    moves.ghosts_gone.push_back(there->self);
  }
}

// A point of another process, which is kept if it crowds one of this one. False: it is in the
// finest cell of another.
template <int D>
bool TiledState<D>::add_ghost(const NamedPlace<D>& point, Moves& moves) {
  const Vertex<D>* there = features_.obstacle(point.p);
  if (there != nullptr) return there->p == point.p;
  make_room(moves);
  moves.ghosts_come.reserve(moves.ghosts_come.size() + 1);
  const VertexHandle h = add_record(point.id, point.p);
  const auto before = static_cast<std::ptrdiff_t>(moves.changed.size());
  try {
    features_.insert(points_[h], moves.note());
  } catch (...) {
    points_.release(points_[h]);
    throw;
  }
  const auto first = moves.changed.begin() + before;
  if (std::any_of(first, moves.changed.end(), [&](VertexHandle f) { return is_own(f); })) {
    moves.ghosts_come.push_back(h);
    return true;
  }
  features_.erase(points_[h], [](const Vertex<D>&) {});
  moves.changed.erase(first, moves.changed.end());
  points_.release(points_[h]);
  return true;
}

// Points whose level may be another, with those known here: who else crowds them is asked for.
template <int D>
void TiledState<D>::ask_others(const TiledMesher<D>& tiles, Moves& moves) {
  std::vector<VertexHandle> whom;
  together(peers_, [&] {
    std::copy_if(moves.changed.begin(), moves.changed.end(), std::back_inserter(whom),
                 [&](VertexHandle h) { return is_own(h); });
    make_set(whom);
  });
  const std::vector<NamedPlace<D>> found = crowders_elsewhere(
      whom, points_, features_, box_, tiles, peers_, [&](const Vertex<D>& v) { return named(v); });
  Clashes<D> clashes(box_);
  together(peers_, [&] {
    for (const NamedPlace<D>& point : found) {
      if (add_ghost(point, moves)) continue;
      clashes.add(named(*features_.obstacle(point.p)), point, false);
    }
  });
  clashes.require_none(peers_);
}

// --- The next update -------------------------------------------------------------------------

template <int D>
Change<D> TiledState<D>::propagate(const Edits<D>& edits, const RunControl& control,
                                   const Accept& accept) {
  SAC_EXPECTS(takes(edits));
  Moves moves;
  Change<D> change;
  std::optional<Growth<D>> growth;  // of this process's part, before `accept` makes more of it
  const std::uint64_t before = tiles_->calls();
  typename TiledMesher<D>::Ask ask;
  std::function<void(TileChanges&)> last;
  TileEdits by_tile;
  std::shared_ptr<const CommonOrders<D>> common;
  std::optional<Options<D>> options;
  bool is_judged = false;  // what is thrown then is the caller's
  bool is_in_tiles = false;
  try {
    together(peers_, [&] {
      ask = asks_update(control);
      last = [&](TileChanges& changes) {
        together(peers_, [&] { change = change_of<D>(changes); });
        growth.emplace(change);
        change.calls.executed = tiles_->calls() - before;
        is_judged = true;
        if (accept) accept(change);
      };
      options = edits.limits ? edits.limits->options : options_;
      begin_limits(edits, moves);
    });
    if (is_divided()) divide(edits.points, moves);
    together(peers_, [&] {
      const PointEdits<D>& own = is_divided() ? moves.own : edits.points;
      note_places(own, moves);
      make_gone(own, moves), make_ghosts_gone(moves);
      make_come(own, moves);
      for (const auto& edit : moves.others) {
        if (edit.to) static_cast<void>(add_ghost({edit.id, *edit.to}, moves));
      }
    });
    if (is_divided()) ask_others(*tiles_, moves);
    together(peers_, [&] {
      by_tile = told(moves);
      if (!moves.common.is_empty()) {
        common = std::make_shared<const CommonOrders<D>>(std::move(moves.common));
      }
    });
    const Held held(features_);
    is_in_tiles = true;
    tiles_->update(by_tile, ask, last, common);
  } catch (...) {
    const bool gives_up = is_in_tiles && tiles_->has_given_up() && !is_judged;
    const bool is_theirs =
        bounds_dihedrals(options_) || limits_.any() || (moves.limits && moves.limits->any());
    together(peers_, [&] { take_back(std::move(moves)); });
    const Held held(features_);
    tiles_->take_back(by_tile, common);
    if (tiles_->is_broken()) {  // the mesh is a function of the points
      tiles_ = build({});
      count_own(stats_, *tiles_);
    }
    if (gives_up) throw NotInTilesYet();
    in_tiles([] { throw; }, is_theirs && !is_judged);
  }
  for (const auto& node : moves.gone) points_.release(points_[node.mapped()]);
  for (const VertexHandle h : moves.ghosts_gone) points_.release(points_[h]);
  if (moves.limits) {
    limits_ = std::move(*moves.limits);
    options_ = std::move(*options);
  }
  growth->add_to(stats_);
  return change;
}

// --- Between updates -------------------------------------------------------------------------

template <int D>
Mesh<D> TiledState<D>::mesh() const {
  return tiles_->mesh();
}

template <int D>
MeshStats TiledState<D>::stats() const {
  MeshStats s = stats_;
  if (tiles_ != nullptr) add_trace(*tiles_, s);
  return s;
}

template <int D>
void TiledState<D>::check_invariants() const {
  features_.check_invariants();
  tiles_->check_invariants();
  for (const auto& [id, h] : ids_) {
    SAC_INVARIANT(names_[h].id == id && names_[h].level == points_[h].level);
  }
  SAC_INVARIANT(stats_.vertices == tiles_->vertices());
  std::size_t simplices = 0;
  for (std::size_t t = 0; t < tiles_->size(); ++t) simplices += (*tiles_)[t].own_simplices();
  SAC_INVARIANT(stats_.simplices == simplices);
}

template bool may_be_tiled(const Options<2>&, const Edits<2>&);
template class TiledState<2>;
#ifndef MESHER_PLANE_ONLY
template bool may_be_tiled(const Options<3>&, const Edits<3>&);
template class TiledState<3>;
#endif

}  // namespace mesher::detail
