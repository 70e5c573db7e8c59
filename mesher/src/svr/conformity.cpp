// Pieces, crossings, and what insertions do to them.
#include "svr/conformity.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "delaunay/facets.hpp"
#include "input.hpp"
#include "make_set.hpp"
#include "plc/polygon_shape.hpp"
#include "plc/small_angles.hpp"
#include "plc/yielding.hpp"

namespace mesher::detail {

namespace {

// Balls are open, and somewhat smaller: what is on them but for rounding does not encroach.
constexpr double kOpen = 1 - 0x1p-30;

// Of a centre's height over a plane, squared, in units of the squared radius: it is not 0 but for
// rounding.
constexpr double kClear2 = 0x1p-32;

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

using Facet = std::array<std::uint32_t, 3>;

// Whether p is in the ball of squared radius r2 around the centre of a tile.
bool is_in_tile(const Point<3>& centre, double r2, const Point<3>& p) {
  return squared_distance(centre, p) < r2 * kOpen;
}

Face face_across(const Facet& facet) { return face_of(facet[0], facet[1], facet[2]); }

}  // namespace

Error too_close_near(const Point<3>& x) {
  return Error(ErrorCode::too_close,
               "features are too close for double precision near " + place_text(x));
}

Conformity::Conformity(FeatureStore& store, Kernel& kernel)
    : store_(store), kernel_(kernel), vertices_(1) {
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
  Known known{role, point, edge_of(role) != 0, role.on != 0};
  if (point != 0) {
    known.on_edge = store_.visit_edges_at(point, [](const Edge&) { return true; });
    known.on_polygon = !at_point_[point].empty();
  } else if (known.on_edge) {
    known.on_polygon = !at_edge_[role.on].empty();
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

void Conformity::set_vertex(std::uint32_t v, const Role& role, VertexHandle point) {
  vertices_[v] = known(role, point);
}

// --- Pieces of edges -------------------------------------------------------------------------

void Conformity::start() {
  std::vector<std::uint32_t> vertex_of;
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    const VertexHandle point = vertices_[v].point;
    if (point == 0) continue;
    if (vertex_of.size() <= point) vertex_of.resize(point + 1, kNone);
    vertex_of[point] = v;
  }
  std::vector<const Edge*> edges;
  EdgeHandle most = 0;
  store_.edges().for_each([&](const Edge& e) {
    if (e.alive) edges.push_back(&e), most = std::max(most, e.self);
  });
  std::sort(edges.begin(), edges.end(), [](const Edge* e, const Edge* t) {
    return std::tie(e->place_a, e->place_b) < std::tie(t->place_a, t->place_b);
  });
  std::vector<std::vector<std::uint32_t>> between(most + std::size_t{1});
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    if (const EdgeHandle e = edge_of(vertices_[v].role)) between[e].push_back(v);
  }
  for (const Edge* e : edges) add_pieces(*e, vertex_of[e->a], vertex_of[e->b], between[e->self]);
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) look_at_piece(i);
}

/// `between`: the vertices between its ends.
void Conformity::add_pieces(const Edge& e, std::uint32_t a, std::uint32_t b,
                            std::vector<std::uint32_t>& between) {
  const auto at = [&](std::uint32_t v) { return from_a(e, vertices_[v].role.label); };
  std::sort(between.begin(), between.end(),
            [&](std::uint32_t v, std::uint32_t w) { return at(v) < at(w); });
  Subedges::Piece piece{a, b, Label::start(), Label::end(), e.self};
  for (const std::uint32_t v : between) {
    piece.b = v, piece.hi = vertices_[v].role.label;
    pieces_.add(piece);
    piece.a = v, piece.lo = piece.hi;
  }
  piece.b = b, piece.hi = Label::end();
  pieces_.add(piece);
}

bool Conformity::is_in_ball(std::uint32_t piece, const Point<3>& p) const noexcept {
  const Point<3>&a = place(pieces_[piece].a), &b = place(pieces_[piece].b);
  const Point<3> to_a = minus(a, p), to_b = minus(b, p);
  return dot(to_a, to_b) < (kOpen - 1) * squared_distance(a, b);
}

/// In the triangulation an edge with a vertex in its ball has one in the tetrahedra around it.
void Conformity::look_at_piece(std::uint32_t piece) {
  const Subedges::Piece& p = pieces_[piece];
  kernel_.find_in_star(p.a, star_, [](std::uint32_t) { return false; });
  bool is_there = false;
  for (const std::uint32_t s : star_) {
    const auto& corners = kernel_.simplices().corners(s);
    if (corner_of(corners, p.b) == corners.size()) continue;
    is_there = true;
    for (const std::uint32_t w : corners) {
      if (w == p.a || w == p.b || w == kInfinite) continue;
      if (is_in_ball(piece, place(w))) return want_piece(piece, w);
    }
  }
  if (!is_there) want_piece(piece, kNone);
}

void Conformity::want_piece(std::uint32_t piece, std::uint32_t by) {
  if (pieces_[piece].encroached) return;
  pieces_.set_encroached(piece, by);
  wanted_pieces_.push_back(piece);
}

/// Where features meet at a small angle at a copy of what is in the ball, else about in the middle.
auto Conformity::split_piece(std::uint32_t piece) const -> Wanted {
  const Subedges::Piece& p = pieces_[piece];
  const Edge& e = store_.edges()[p.edge];
  if (p.by != kNone && vertices_[p.by].role.on != 0) {
    const Vertex<3> v = record(p.by);
    const FeaturesBeside near(store_, place(p.a), 0, kEverywhere);
    const auto copy = SmallAngles(near).copy({v, vertices_[p.by].role}, e);
    if (copy && from_a(e, p.lo) < from_a(e, copy->role.label) &&
        from_a(e, copy->role.label) < from_a(e, p.hi)) {
      return {*copy, p.a};
    }
  }
  const auto middle = EdgePiece{&e, p.lo, p.hi}.middle_if_any();
  if (!middle) throw too_close_near(place(p.a));
  return {placed_on(e, *middle), p.a};
}

// --- Where features meet at small angles -----------------------------------------------------

/// As plc/ knows it.
Vertex<3> Conformity::record(std::uint32_t v) const {
  Vertex<3> record;
  record.p = place(v);
  record.self = vertices_[v].point;
  return record;
}

bool Conformity::keeps(std::uint32_t v, std::uint32_t w) const {
  if (vertices_[v].role.on == 0 || vertices_[w].role.on == 0) return false;
  const FeaturesBeside near(store_, scaled(0.5, plus(place(v), place(w))), 0, kEverywhere);
  return SmallAngles(near).keeps({record(v), vertices_[v].role}, {record(w), vertices_[w].role});
}

// --- Crossings of polygons -------------------------------------------------------------------

void Conformity::want_crossing(std::uint32_t crossing, const Point<3>& from) {
  if (crossings_[crossing].waiting) return;
  crossings_.set_waiting(crossing, from);
  wanted_crossings_.push_back(crossing);
}

void Conformity::start_polygons() {
  has_polygons_ = true;
  std::vector<std::vector<std::uint32_t>> on(by_rank_.size());
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    for (const Rank f : polygons(v)) on[f].push_back(v);
  }
  std::vector<Rank> seen_for(vertices_.size());
  for (Rank f = 1; f < on.size(); ++f) find_crossings(f, std::move(on[f]), seen_for);
}

/// From the cells of the vertices on it on, from cell to cell. `cells`: these vertices.
void Conformity::find_crossings(Rank f, std::vector<std::uint32_t> cells,
                                std::vector<Rank>& seen_for) {
  for (const std::uint32_t v : cells) seen_for[v] = f;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    kernel_.find_in_star(cells[k], star_, [](std::uint32_t) { return false; });
    look_at_faces(star_, false, f, [&](std::uint32_t crossing) {
      for (const std::uint32_t w : crossings_[crossing].face) {
        if (std::exchange(seen_for[w], f) != f) cells.push_back(w);
      }
    });
  }
}

/// Notes which faces of `all` cross f, and which do not any more: of those between two of them, and
/// of their borders if `with_borders`. Calls visit(crossing) for each.
template <class Visit>
void Conformity::look_at_faces(const std::vector<std::uint32_t>& all, bool with_borders, Rank f,
                               Visit&& visit) {
  const auto& simplices = kernel_.simplices();
  sides_.resize(simplices.places(), Side::unknown);
  for (const std::uint32_t s : all) sides_[s] = side(s, f);
  for (const std::uint32_t s : all) {
    if (sides_[s] == Side::none) continue;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t other = simplices.across(s)[i] >> 2;
      const bool is_border = sides_[other] == Side::unknown;
      if (is_border ? !with_borders : other < s) continue;
      const Side across = is_border ? side(other, f) : sides_[other];
      if (across == Side::none || (across == sides_[s] && !is_border)) continue;
      const std::uint32_t crossing = look_at_face(s, i, f, across != sides_[s]);
      if (crossing != kNone) visit(crossing);
    }
  }
  for (const std::uint32_t s : all) sides_[s] = Side::unknown;
}

auto Conformity::side(std::uint32_t s, Rank f) const -> Side {
  if (kernel_.is_ghost(s)) return Side::none;
  return is_above(s, f) ? Side::above : Side::below;
}

/// Of the face across from corner i of s: notes whether it crosses f. Returns: the crossing, or
/// kNone. `crosses`: the plane.
std::uint32_t Conformity::look_at_face(std::uint32_t s, std::uint32_t i, Rank f, bool crosses) {
  const Facet facet = facet_across<3>(kernel_.simplices().corners(s), i);
  if (!crosses && foreign_ == 0 && !all_on_polygons(facet)) return kNone;
  const Face face = face_across(facet);
  const std::uint32_t known = crossings_.find(face, f);
  const auto found = crosses ? crossing_of(face, s, kernel_.simplices().across(s)[i] >> 2, f)
                             : std::nullopt;
  if (known != kNone) {
    if (found) return known;
    erase(known);
  }
  if (!found) return kNone;
  const std::uint32_t crossing = crossings_.add(*found);
  if (!found->is_tile) {
    ++foreign_;
    want_crossing(crossing, found->at);
  }
  return crossing;
}

bool Conformity::all_on_polygons(const std::array<std::uint32_t, 3>& facet) const noexcept {
  return vertices_[facet[0]].on_polygon && vertices_[facet[1]].on_polygon &&
         vertices_[facet[2]].on_polygon;
}

void Conformity::erase(std::uint32_t crossing) {
  if (!crossings_[crossing].is_tile) --foreign_;
  crossings_.erase(crossing);
}

/// Whether the centre of s is above f, on the normal's side: if it is on the plane, but for
/// rounding, that is where the corners are. So what is on the ball of a face on f does not count as
/// in it.
bool Conformity::is_above(std::uint32_t s, Rank rank) const {
  const Polygon& f = polygon(rank);
  const SimplexBall<3>& ball = kernel_.simplices().ball(s);
  const double height = f.plane.height(ball.centre);
  if (height * height > kClear2 * static_cast<double>(ball.outer2)) return height > 0;
  const auto& corners = kernel_.simplices().corners(s);
  std::array<std::uint32_t, 4> order{};  // those on f first
  std::size_t on = 0, off = 4;
  for (const std::uint32_t w : corners) order[is_on(w, rank) ? on++ : --off] = w;
  if (on == 3) {
    const Point<3> at = middle_of({order[0], order[1], order[2]}, f);
    const Point<3>& apex = place(order[3]);
    return (f.plane.height(apex) > 0) != is_in_tile(at, squared_distance(at, place(order[0])), apex);
  }
  double beside = 0, most = 0;
  for (std::size_t i = on; i < 4; ++i) {
    const double off_plane = f.plane.height(place(order[i]));
    beside += off_plane;
    most = std::max(most, std::abs(off_plane));
  }
  const double r2 = squared_distance(ball.centre, place(order[0]));
  return (2 * std::abs(height) * most < r2 * (1 - kOpen) ? beside : height) > 0;
}

/// Where places of f are as far from all three, which are on f.
Point<3> Conformity::middle_of(const Face& face, const Polygon& f) const {
  return f.plane.at(centre_in_frame(f, {place(face[0]), place(face[1]), place(face[2])}));
}

/// The face between s and t, whose Voronoi edge crosses the plane, if that is inside f.
auto Conformity::crossing_of(const Face& face, std::uint32_t s, std::uint32_t t,
                             Rank rank) const -> std::optional<Crossings::Crossing> {
  const Polygon& f = polygon(rank);
  Crossings::Crossing crossing{.face = face, .polygon = rank};
  crossing.is_tile = is_on(face[0], rank) && is_on(face[1], rank) && is_on(face[2], rank);
  if (crossing.is_tile) {
    const Point<3> sum = plus(plus(place(face[0]), place(face[1])), place(face[2]));
    if (!contains(f, scaled(1.0 / 3, sum))) return std::nullopt;
    crossing.at = middle_of(face, f);
    return crossing;
  }
  const Point<3>&c = kernel_.simplices().ball(s).centre, &d = kernel_.simplices().ball(t).centre;
  const double above_c = f.plane.height(c), above_d = f.plane.height(d);
  const double share = above_c == above_d ? 0 : std::clamp(above_c / (above_c - above_d), 0.0, 1.0);
  const Point<3> x = plus(c, scaled(share, minus(d, c)));
  if (!contains(f, x)) return std::nullopt;
  crossing.at = f.plane.foot(x);
  return crossing;
}

// --- What is enclosed ------------------------------------------------------------------------

/// Unknown ones are joined to known ones around them; those that tiles alone are around are inside.
bool Conformity::is_outside(std::uint32_t s) {
  if (region_[s] != Region::unknown) return region_[s] == Region::outside;
  std::vector<std::uint32_t> all{s};
  region_[s] = Region::inside;
  bool outside = false;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t other = kernel_.simplices().across(all[k])[i] >> 2;
      if (is_wall(all[k], i)) continue;
      if (region_[other] == Region::unknown) {
        region_[other] = Region::inside;
        all.push_back(other);
      }
      outside = outside || region_[other] == Region::outside;
    }
  }
  if (outside) {
    for (const std::uint32_t t : all) region_[t] = Region::outside;
  }
  return outside;
}

bool Conformity::find_regions(std::span<const Point<3>> holes) {
  const auto& simplices = kernel_.simplices();
  region_.assign(simplices.places(), Region::unknown);
  std::uint32_t any = kNone;
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s)) continue;
    any = s;
    if (kernel_.is_ghost(s)) flood_outside(s);
  }
  for (const Point<3>& p : holes) flood_outside(kernel_.walk(p, any));
  bool encloses = false;
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s) || region_[s] != Region::unknown) continue;
    region_[s] = Region::inside;
    encloses = true;
  }
  return encloses;
}

void Conformity::flood_outside(std::uint32_t from) {
  if (std::exchange(region_[from], Region::outside) == Region::outside) return;
  std::vector<std::uint32_t> all{from};
  while (!all.empty()) {
    const std::uint32_t s = all.back();
    all.pop_back();
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t other = kernel_.simplices().across(s)[i] >> 2;
      if (region_[other] == Region::outside || is_wall(s, i)) continue;
      region_[other] = Region::outside;
      all.push_back(other);
    }
  }
}

bool Conformity::is_wall(std::uint32_t s, std::uint32_t i) const {
  const Facet facet = facet_across<3>(kernel_.simplices().corners(s), i);
  return all_on_polygons(facet) && crossings_.find(face_across(facet)) != kNone;
}

/// A place that takes the crossing: a copy of the vertex whose cell meets the polygon, or its foot,
/// or else where the crossing is.
Placed Conformity::place_for(const Crossings::Crossing& crossing) const {
  const Polygon& f = polygon(crossing.polygon);
  if (crossing.is_tile) {
    const auto foot = foot_in(f, crossing.from, crossing);
    return placed_on(f, foot ? *foot : crossing.at);
  }
  const double r2 = squared_distance(crossing.at, place(crossing.face[0]));
  for (const std::uint32_t w : crossing.face) {
    if (vertices_[w].role.on == 0 || is_on(w, crossing.polygon)) continue;
    const Vertex<3> v = record(w);
    const FeaturesBeside near(store_, crossing.at, 0, kEverywhere);
    const auto copy = SmallAngles(near).copy({v, vertices_[w].role}, f);
    if (copy && detail::polygon_of(copy->role) != 0 && is_in_tile(crossing.at, r2, copy->p)) return *copy;
  }
  for (const std::uint32_t w : crossing.face) {
    if (is_on(w, crossing.polygon)) continue;
    if (const auto foot = foot_in(f, place(w), crossing)) return placed_on(f, *foot);
  }
  return placed_on(f, crossing.at);
}

/// The foot of x, if it is in f, takes the crossing, and x is nearer to it than the corners are.
std::optional<Point<3>> Conformity::foot_in(const Polygon& f, const Point<3>& x,
                                            const Crossings::Crossing& crossing) const {
  const Point<3> foot = f.plane.foot(x);
  const double r2 = squared_distance(crossing.at, place(crossing.face[0]));
  if (!is_in_tile(crossing.at, r2, foot) || !contains(f, foot)) return std::nullopt;
  const double gap2 = squared_distance(foot, x);
  for (const std::uint32_t w : crossing.face) {
    if (squared_distance(foot, place(w)) < gap2) return std::nullopt;
  }
  return foot;
}

std::optional<Placed> Conformity::yield(const Point<3>& x, double radius) const {
  return detail::yield(FeaturesBeside(store_, x, 0, kEverywhere), x, radius);
}

// --- Insertions ------------------------------------------------------------------------------

auto Conformity::next() -> std::optional<Wanted> {
  for (;;) {
    while (!wanted_pieces_.empty()) {
      const std::uint32_t piece = wanted_pieces_.back();
      if (pieces_[piece].encroached) {
        splitting_ = piece;
        return split_piece(piece);
      }
      wanted_pieces_.pop_back();
    }
    splitting_ = kNone;
    if (!has_polygons_) start_polygons();
    while (!wanted_crossings_.empty()) {
      const std::uint32_t i = wanted_crossings_.back();
      const Crossings::Crossing& crossing = crossings_[i];
      if (crossing.alive) {
        return Wanted{place_for(crossing), crossing.face[0]};
      }
      crossings_.set_done(i);
      wanted_crossings_.pop_back();
    }
    return std::nullopt;
  }
}

/// Calls visit(piece) for the pieces whose edges are in the hole that is dug, some repeatedly.
template <class Visit>
void Conformity::visit_pieces_dug(Visit&& visit) const {
  for (const std::uint32_t s : kernel_.doomed()) {
    const auto& corners = kernel_.simplices().corners(s);
    for (std::size_t i = 0; i < 4; ++i) {
      if (!vertices_[corners[i]].on_edge) continue;
      for (std::size_t k = 0; k < i; ++k) {
        if (!vertices_[corners[k]].on_edge) continue;
        const std::uint32_t piece = pieces_.find(corners[i], corners[k]);
        if (piece != kNone) visit(piece);
      }
    }
  }
}

bool Conformity::yields_to_edges(std::uint32_t v) {
  bool yields = false;
  visit_pieces_dug([&](std::uint32_t piece) {
    if (!is_in_ball(piece, place(v))) return;
    want_piece(piece, kNone);
    yields = true;
  });
  return yields;
}

bool Conformity::yields(std::uint32_t v) {
  if (yields_to_edges(v)) return true;
  bool yields = false;
  for (const std::uint32_t s : kernel_.doomed()) {
    visit_crossings_of(s, [&](std::uint32_t i, std::uint32_t) {
      const Crossings::Crossing& tile = crossings_[i];
      const double r2 = squared_distance(tile.at, place(tile.face[0]));
      if (!is_in_tile(tile.at, r2, place(v))) return;
      want_crossing(i, place(v));
      yields = true;
    });
  }
  return yields;
}

/// Calls visit(crossing, across) for the crossings of the faces of s.
template <class Visit>
void Conformity::visit_crossings_of(std::uint32_t s, Visit&& visit) const {
  const auto& corners = kernel_.simplices().corners(s);
  std::uint32_t on_polygons = 0;
  for (const std::uint32_t w : corners) on_polygons += vertices_[w].on_polygon ? 1 : 0;
  if (foreign_ == 0 && on_polygons < 3) return;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Facet facet = facet_across<3>(corners, i);
    if (foreign_ == 0 && on_polygons == 3 && vertices_[corners[i]].on_polygon) continue;
    for (std::uint32_t c = crossings_.find(face_across(facet)); c != kNone;) {
      const std::uint32_t next = crossings_[c].next;
      visit(c, kernel_.simplices().across(s)[i] >> 2);
      c = next;
    }
  }
}

void Conformity::before_fill(std::uint32_t v) {
  visit_pieces_dug([&](std::uint32_t piece) {
    if (is_in_ball(piece, place(v))) want_piece(piece, v);
  });
  touched_.clear();
  if (!has_polygons_) return;
  const Polygons on = polygons(v);
  touched_.assign(on.begin(), on.end());
  for (const std::uint32_t s : kernel_.doomed()) {
    visit_crossings_of(s, [&](std::uint32_t i, std::uint32_t across) {
      touched_.push_back(crossings_[i].polygon);
      if (kernel_.is_doomed(across)) erase(i);
    });
  }
  make_set(touched_);
}

void Conformity::after_fill(std::uint32_t v) {
  if (splitting_ != kNone) {
    const std::uint32_t piece = std::exchange(splitting_, kNone);
    const std::uint32_t other = pieces_.split(piece, v, vertices_[v].role.label);
    look_at_piece(piece);
    look_at_piece(other);
  }
  region_.resize(kernel_.simplices().places(), Region::unknown);
  for (const std::uint32_t s : kernel_.made()) region_[s] = Region::unknown;
  for (const Rank f : touched_) {
    look_at_faces(kernel_.made(), true, f, [](std::uint32_t) {});
  }
}

}  // namespace mesher::detail
