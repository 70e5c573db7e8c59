// What vertices are, and insertions.
#include "refinement/conformity.hpp"

#include <algorithm>
#include <utility>

#include "delaunay/facets.hpp"
#include "geometry/input_point.hpp"
#include "refinement/conformity_balls.hpp"
#include "sets/make_set.hpp"
#include "space/space_budget.hpp"

namespace mesher::detail {

Error too_close_near(const Point<3>& x) {
  return Error(ErrorCode::too_close,
               "features are too close for double precision near " + place_text(x));
}

Conformity::Conformity(FeatureStore& store, Kernel& kernel)
    : LineConformity(store.segments(), kernel), store_(store) {
  by_rank_.push_back(nullptr);
  store_.polygons().for_each([&](const Polygon& f) {
    if (f.alive) by_rank_.push_back(&f);
  });
  std::sort(by_rank_.begin() + 1, by_rank_.end(),
            [](const Polygon* f, const Polygon* g) { return order(*f, *g) < 0; });
  rank_.resize(store_.polygons().last() + std::size_t{1});
  for (Rank f = 1; f < by_rank_.size(); ++f) rank_[polygon(f).self] = f;
  at_edge_ = lists([](const Polygon& f) -> const auto& { return f.all_edges; });
  at_point_ = lists([](const Polygon& f) -> const auto& { return f.points; });
}

void Conformity::fail_too_many(std::size_t most, const SpaceNames* names) const {
  PlacesOnFeatures on_features;
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    const SegmentHandle on = vertices_[v].role.on;
    if (on != 0) on_features[on].push_back(kernel_.place(v));
  }
  throw too_many_vertices(on_features, names, store_, most);
}

void Conformity::fail_between(const NarrowGaps::Gap& gap, std::size_t most,
                              const SpaceNames* names) const {
  const PolygonPool& all = store_.polygons();
  throw too_many_between(all[gap.one], all[gap.other], gap.width, gap.at, names, store_, most);
}

// --- What vertices are -----------------------------------------------------------------------

/// `keys_of(polygon)`: handles.
template <class KeysOf>
auto Conformity::lists(KeysOf&& keys_of) const -> Lists {
  Lists lists;
  const auto for_each = [&](auto&& visit) {
    for (Rank f = 1; f < by_rank_.size(); ++f) {
      for (const std::uint32_t key : keys_of(polygon(f))) visit(key, f);
    }
  };
  for_each([&](std::uint32_t key, Rank) {
    if (lists.begin.size() < key + 2) lists.begin.resize(key + 2);
    ++lists.begin[key + 1];
  });
  for (std::size_t k = 1; k < lists.begin.size(); ++k) lists.begin[k] += lists.begin[k - 1];
  lists.all.resize(lists.begin.empty() ? 0 : lists.begin.back());
  std::vector<std::uint32_t> next = lists.begin;
  for_each([&](std::uint32_t key, Rank f) { lists.all[next[key]++] = f; });
  return lists;
}

auto Conformity::known(const Role& role, VertexHandle point) const -> Known {
  Known known = known_by_edges(role, point);
  if (point != 0) {
    known.on_polygon = !at_point_[point].empty();
  } else {
    known.on_polygon = known.on_edge ? !at_edge_[role.on].empty() : role.on != 0;
  }
  return known;
}

auto Conformity::polygons(std::uint32_t v) const noexcept -> Polygons {
  const Known& known = vertices_[v];
  if (known.point != 0) return at_point_[known.point];
  if (const PolygonHandle f = detail::polygon_of(known.role)) return {&rank_[f], 1};
  return known.role.on == 0 ? Polygons{} : at_edge_[known.role.on];
}

bool Conformity::is_on(std::uint32_t v, Rank f) const noexcept {
  const Polygons all = polygons(v);
  return std::binary_search(all.begin(), all.end(), f);
}

void Conformity::start() {
  std::vector<std::vector<std::uint32_t>> between(store_.edges().last() + std::size_t{1});
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    if (const EdgeHandle e = edge_of(vertices_[v].role)) between[e].push_back(v);
  }
  start_pieces([&](const Edge& e, std::uint32_t a, std::uint32_t b) {
    add_pieces(e, a, b, between[e.self]);
  });
}

// --- Insertions ------------------------------------------------------------------------------

auto Conformity::next() -> std::optional<Wanted> {
  for (; !wanted_pieces_.empty(); wanted_pieces_.pop_back()) {
    const std::uint32_t piece = wanted_pieces_.back();
    if (!pieces_[piece].encroached) continue;
    if (pieces_[piece].by_centre || !at_piece(piece).is_there) {
      splitting_ = piece;
      return split_piece(piece);
    }
    pieces_.set_fine(piece);
  }
  splitting_ = kNone;
  if (!has_polygons_) start_polygons();
  for (; !wanted_tiles_.empty(); wanted_tiles_.pop_back()) {
    const std::uint32_t i = wanted_tiles_.back();
    const Tiles::Tile& tile = tiles_[i];
    if (tile.alive) {
      const Polygon& f = polygon(tile.polygon);
      return wanted(*place_for(tile, tile.from), tile.face[0],
                    placed_on(f, f.plane.foot(middle_of(tile.face))));
    }
    tiles_.set_done(i);
  }
  if (const auto gap = next_gap()) {
    return wanted(place_for(*gap), gap->u, placed_on(polygon(gap->polygon), gap->at));
  }
  return std::nullopt;
}

/// On an edge, that splits a piece.
auto Conformity::wanted(const Placed& place, std::uint32_t beside, const Placed& otherwise)
    -> Wanted {
  if (const EdgeHandle e = edge_of(place.role)) splitting_ = piece_at(e, place.role.label);
  if (otherwise.p == place.p) return {place, beside};
  return {place, beside, otherwise};
}

/// Calls visit(tile) for those of what is dug with v in their balls, some twice.
template <class Visit>
void Conformity::visit_tiles_around(std::uint32_t v, Visit&& visit) const {
  for (const std::uint32_t s : kernel_.doomed()) {
    visit_tiles_of(s, [&](std::uint32_t i, std::uint32_t) {
      const Tiles::Tile& tile = tiles_[i];
      const Point<3> centre = centre_of(tile.face, polygon(tile.polygon));
      const double r2 = squared_distance(centre, place(tile.face[0]));
      if (detail::is_in_ball(centre, r2, place(v))) visit(i);
    });
  }
}

bool Conformity::yields(std::uint32_t v) {
  if (yields_to_edges(v)) return true;
  bool yields = false;
  visit_tiles_around(v, [&](std::uint32_t i) {
    if (!place_for(tiles_[i], place(v))) return;
    want_tile(i, place(v));
    yields = true;
  });
  return yields;
}

bool Conformity::encroaches_on_features(std::uint32_t v) {
  bool encroaches = encroaches_on_edges(v);
  if (!encroaches) visit_tiles_around(v, [&](std::uint32_t) { encroaches = true; });
  return encroaches;
}

bool Conformity::is_disturbed() const {
  bool is_disturbed = false;
  for (const std::uint32_t s : kernel_.doomed()) {
    visit_tiles_of(s, [&](std::uint32_t, std::uint32_t across) {
      is_disturbed = is_disturbed || kernel_.is_doomed(across);
    });
  }
  const auto stays = [&](std::uint32_t piece) {
    bool stays = false;
    kernel_.for_each_facet_of_hole([&](const Facet& facet) {
      const auto has = [&](std::uint32_t v) {
        return std::find(facet.begin(), facet.end(), v) != facet.end();
      };
      stays = stays || (has(pieces_[piece].a) && has(pieces_[piece].b));
    });
    return stays;
  };
  visit_pieces_dug([&](std::uint32_t piece) { is_disturbed = is_disturbed || !stays(piece); });
  return is_disturbed;
}

void Conformity::before_fill(std::uint32_t) {
  dug_pieces_.clear();
  visit_pieces_dug([&](std::uint32_t piece) {
    if (piece != splitting_) dug_pieces_.push_back(piece);
  });
  make_set(dug_pieces_);
  if (!has_polygons_) return;
  for (const std::uint32_t s : kernel_.doomed()) {
    visit_tiles_of(s, [&](std::uint32_t i, std::uint32_t across) {
      if (kernel_.is_doomed(across)) erase(i);
    });
  }
}

/// Whether the edge of a piece is in a simplex that was made: of one that was dug, whether it is
/// still there.
bool Conformity::is_made(std::uint32_t piece) const {
  const auto& made = kernel_.made();
  return std::any_of(made.begin(), made.end(), [&](std::uint32_t s) {
    const auto& corners = kernel_.simplices().corners(s);
    return corner_of(corners, pieces_[piece].a) != corners.size() &&
           corner_of(corners, pieces_[piece].b) != corners.size();
  });
}

void Conformity::after_fill(std::uint32_t v) {
  if (splitting_ != kNone) {
    const std::uint32_t piece = std::exchange(splitting_, kNone);
    const std::uint32_t other = pieces_.split(piece, v, vertices_[v].role.label);
    look_at_piece(piece);
    look_at_piece(other);
    for (const Rank f : has_polygons_ ? at_edge_[pieces_[piece].edge] : Polygons{}) {
      for (const std::uint32_t i : {piece, other}) suspect(f, pieces_[i].a, pieces_[i].b);
    }
  }
  for (const std::uint32_t piece : dug_pieces_) {
    if (!is_made(piece)) want_piece(piece, v);
  }
  enclosed_.forget_made();
  if (!has_polygons_) return;
  for (const std::uint32_t s : kernel_.made()) {
    for (std::uint32_t i = 0; i < 4; ++i) look_at_facet(s, i);
  }
}

}  // namespace mesher::detail
