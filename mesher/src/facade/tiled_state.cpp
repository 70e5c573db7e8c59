// Points become edits of tiles, and what tiles have changed becomes a change of the mesh.
#include "facade/tiled_state.hpp"

#include <algorithm>

#include "facade/held.hpp"
#include "facade/tile_changes.hpp"
#include "facade/whole_change.hpp"
#include "geometry/box.hpp"
#include "program/meter.hpp"
#include "rules/mesh_box.hpp"
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
TiledState<D>::TiledState(const Options<D>& options, Peers& peers, std::size_t tiles)
    : options_(options),
      peers_(peers),
      tiles_wanted_(tiles),
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
VertexHandle TiledState<D>::add_point(PointId id, const Point<D>& p) {
  Vertex<D>& v = points_.create(p);
  try {
    if (v.self >= names_.size()) names_.resize(v.self + std::size_t{1});
    names_[v.self] = {id, std::nullopt};
    ids_[id] = v.self;
  } catch (...) {
    points_.release(v);
    throw;
  }
  return v.self;
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

// Tiles of the points that there are.
template <int D>
auto TiledState<D>::build(const typename TiledMesher<D>::Ask& ask)
    -> std::unique_ptr<TiledMesher<D>> {
  std::unique_ptr<TiledMesher<D>> tiles;
  TileEdits by_tile;
  together(peers_, [&] {
    std::vector<Point<D>> places;
    places.reserve(ids_.size());
    points_.for_each([&](const Vertex<D>& v) { places.push_back(v.p); });
    tiles = make_tiles(std::move(places), tiles_wanted_, options_, box_, limits_, peers_,
                       WholeInput<D>{nullptr, &features_});
    by_tile.resize(tiles->size());
    find_levels(static_cast<std::size_t>(options_.threads));
    points_.for_each([&](Vertex<D>& v) {
      names_[v.self].level = v.level;
      const auto tile = tiles->own_tile(v.p);
      if (tile) by_tile[*tile].push_back({v.p, std::nullopt, Located(v.level, limits_.pitch(v.p))});
    });
  });
  const Held held(features_);
  tiles->first_run(by_tile, ask);
  return tiles;
}

template <int D>
Change<D> TiledState<D>::first_run(Edits<D> edits, const RunControl& control,
                                   const Accept& accept) {
  typename TiledMesher<D>::Ask ask;
  together(peers_, [&] {
    ids_.reserve(edits.points.size());
    for (const auto& edit : edits.points) {
      features_.insert_only(points_[add_point(edit.id, *edit.to)]);
    }
    ask = asks_first(control, ids_.size());
  });
  in_tiles([&] { tiles_ = build(ask); }, limits_.any() || bounds_dihedrals(options_));
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

// Changes the set of points, and says what that is to the tiles.
template <int D>
auto TiledState<D>::make(const PointEdits<D>& edits, Moves& moves) -> TileEdits {
  std::vector<VertexHandle> changed;
  const auto note = [&](const Vertex<D>& f) { changed.push_back(f.self); };
  TileEdits by_tile(tiles_->size());
  const LimitsOf<D>& limits = moves.limits ? *moves.limits : limits_;
  const bool any_limits = limits.any() || limits_.any();
  const auto was_at = [&](VertexHandle h) -> std::optional<Located> {
    if (!names_[h].level) return std::nullopt;
    return Located(*names_[h].level, limits_.pitch(points_[h].p));
  };
  const auto tell = [&](const Point<D>& p, std::optional<Located> was, std::optional<Located> is) {
    if (const auto tile = tiles_->own_tile(p)) by_tile[*tile].push_back({p, was, is});
  };
  const auto note_place = [&](const Point<D>& p) {
    if (any_limits) moves.common.features.push_back(p);
  };
  moves.gone.reserve(edits.size());
  moves.come.reserve(edits.size());
  const auto make_room = [&] {  // for what may not fail: 3^D points a level
    constexpr std::size_t kMost = 27 * (kLevels + 1);
    if (changed.capacity() < changed.size() + kMost) changed.reserve(2 * changed.size() + kMost);
  };
  for (const auto& edit : edits) {
    if (!edit.was) continue;
    const VertexHandle h = ids_.at(edit.id);
    tell(points_[h].p, was_at(h), std::nullopt);
    note_place(points_[h].p);
    make_room();
    features_.erase(points_[h], note);
    moves.gone.push_back(ids_.extract(edit.id));
  }
  for (const auto& edit : edits) {
    if (!edit.to) continue;
    const VertexHandle h = add_point(edit.id, *edit.to);
    try {
      make_room();
      features_.insert(points_[h], note);
    } catch (...) {
      ids_.erase(edit.id);
      points_.release(points_[h]);
      throw;
    }
    moves.come.emplace_back(edit.id, h);
    changed.push_back(h);
    note_place(points_[h].p);
  }
  if (moves.limits) {
    for (const Box<D>& box : moves.common.limits->where) {
      features_.visit_in(box, [&](const Vertex<D>& v) { return changed.push_back(v.self), false; });
    }
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  moves.levels.reserve(changed.size());
  for (const VertexHandle h : changed) {
    const auto it = ids_.find(names_[h].id);
    if (it == ids_.end() || it->second != h) continue;  // gone
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
  for (const auto& [id, h] : moves.come) {
    features_.erase(points_[h], [](const Vertex<D>&) {});
    ids_.erase(id);
    points_.release(points_[h]);
  }
  for (auto& node : moves.gone) {
    features_.insert(points_[node.mapped()], [](const Vertex<D>&) {});
    ids_.insert(std::move(node));
  }
}

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
      by_tile = make(edits.points, moves);
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
  return tiles_->mesh([this](const Point<D>& p) {
    const Vertex<D>* v = features_.obstacle(p);
    return v != nullptr && v->p == p;
  });
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
