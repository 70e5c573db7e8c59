// Where tiles are missing, and the vertices that polygons get there.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "delaunay/facets.hpp"
#include "refinement/conformity.hpp"
#include "refinement/conformity_balls.hpp"
#include "sets/make_set.hpp"
#include "space/polygon_shape.hpp"
#include "space/small_angles.hpp"
#include "space/yielding.hpp"

namespace mesher::detail {

namespace {

// Of the area of tiles that a polygon has lost: rounding makes no such difference to that of those
// that came.
constexpr double kUncovered = 0x1p-36;

}  // namespace

// --- Gaps ------------------------------------------------------------------------------------

void Conformity::note_loose(Rank f) {
  if (is_loose_[f]) return;
  is_loose_[f] = true;
  loose_.push_back(f);
}

/// Whether tiles have come where some were lost since the last look. (Compared with the area of all
/// of the polygon, that of small ones would be rounding.)
bool Conformity::is_covered_again(Rank f) const {
  return has_looked_[f] && !has_gap_[f] && std::abs(gained_[f] - lost_[f]) <= kUncovered * lost_[f];
}

/// Requires: v is on the polygon, or beside it.
bool Conformity::is_towards(const Side& side, std::uint32_t v) const {
  return dot(minus(place(v), place(side.a)), side.towards) > 0;
}

/// Of the tiles of f and of its pieces, in canonical order. Cost: O(n log n) for n of them.
void Conformity::find_open_sides(Rank rank) {
  const Polygon& f = polygon(rank);
  suspects_[rank].clear();
  struct At {
    std::uint32_t a, b, corner;  // a < b; of the tile's third corner
    auto operator<=>(const At&) const = default;
  };
  std::vector<At> tiles;
  for (const std::uint32_t i : tiles_.of(rank)) {
    const auto [a, b, c] = tiles_[i].face;
    tiles.insert(tiles.end(), {{a, b, c}, {b, c, a}, {a, c, b}});
  }
  std::sort(tiles.begin(), tiles.end());
  const auto across = [&](std::uint32_t a, std::uint32_t b) {
    return cross(f.plane.normal, minus(place(b), place(a)));
  };
  const auto add_if_open = [&](const Side& side) {
    auto it = std::lower_bound(tiles.begin(), tiles.end(), At{side.a, side.b, 0});
    for (; it != tiles.end() && it->a == side.a && it->b == side.b; ++it) {
      if (is_towards(side, it->corner)) return;
    }
    open_.push_back(side);
  };
  const std::size_t first = open_.size();
  for (const At& at : tiles) {
    if (pieces_.find(at.a, at.b) != kNone) continue;
    Side side{rank, at.a, at.b, across(at.a, at.b)};
    if (is_towards(side, at.corner)) side.towards = scaled(-1, side.towards);
    add_if_open(side);
  }
  const auto any = [](const Subedges::Piece&) { return true; };
  for (const EdgeHandle e : f.all_edges) {
    const std::uint32_t corner = f.corner_at(e);
    for (std::uint32_t i = pieces_.find_on(e, any); i != kNone; i = pieces_[i].next) {
      const auto [a, b] = std::minmax(pieces_[i].a, pieces_[i].b);
      if (corner != Polygon::kInner) {
        add_if_open({rank, a, b, inward(f, corner)});
      } else {
        add_if_open({rank, a, b, across(a, b)});
        add_if_open({rank, a, b, scaled(-1, across(a, b))});
      }
    }
  }
  sort_open_sides(first);
}

void Conformity::sort_open_sides(std::size_t first) {
  std::sort(open_.begin() + static_cast<std::ptrdiff_t>(first), open_.end(),
            [](const Side& s, const Side& t) {
              return std::tie(s.a, s.b, s.towards) < std::tie(t.a, t.b, t.towards);
            });
}

/// The same of the edges that are suspect: others have had their tiles before, or gap_at() has
/// found nothing there. Cost: O(simplices around them), mostly.
void Conformity::find_new_open_sides(Rank rank) {
  const Polygon& f = polygon(rank);
  auto suspects = std::move(suspects_[rank]);
  suspects_[rank].clear();
  make_set(suspects);
  const std::size_t first = open_.size();
  std::vector<std::uint32_t> corners_there;  // third corners of tiles at the edge
  for (const auto& [a, b] : suspects) {
    corners_there.clear();
    find_at_edge(kernel_, b, a, star_);
    for (const std::uint32_t s : star_) {
      for (const std::uint32_t w : kernel_.simplices().corners(s)) {
        if (w == a || w == b || w == kInfinite || !is_on(w, rank)) continue;
        if (tiles_.find(face_of(a, b, w), rank) != kNone) corners_there.push_back(w);
      }
    }
    const auto has_tile = [&](const Side& side) {
      return std::any_of(corners_there.begin(), corners_there.end(),
                         [&](std::uint32_t w) { return is_towards(side, w); });
    };
    const Point<3> across = cross(f.plane.normal, minus(place(b), place(a)));
    const Side left{rank, a, b, across}, right{rank, a, b, scaled(-1, across)};
    const std::uint32_t piece = pieces_.find(a, b);
    if (piece == kNone) {
      const bool on_left = has_tile(left), on_right = has_tile(right);
      if (on_left && !on_right) open_.push_back(right);
      if (on_right && !on_left) open_.push_back(left);
    } else if (f.has_edge(pieces_[piece].edge)) {
      const std::uint32_t corner = f.corner_at(pieces_[piece].edge);
      if (corner != Polygon::kInner) {
        const Side inside{rank, a, b, inward(f, corner)};
        if (!has_tile(inside)) open_.push_back(inside);
      } else {
        if (!has_tile(left)) open_.push_back(left);
        if (!has_tile(right)) open_.push_back(right);
      }
    }
  }
  sort_open_sides(first);
}

bool Conformity::looks_again() {
  if (!has_polygons_ || std::exchange(looked_again_, kernel_.places()) == kernel_.places()) {
    return false;
  }
  for (Rank f = 1; f < by_rank_.size(); ++f) find_open_sides(f);
  return !open_.empty();
}

/// Nothing: there is a tile, or no such edge any more, or nothing pierces the polygon beside it:
/// then it is suspect again.
auto Conformity::gap_at(const Side& side) -> std::optional<Gap> {
  const Rank rank = side.polygon;
  bool is_edge = false;
  const Polygon& f = polygon(rank);
  const auto height = [&](std::uint32_t w) {
    return is_on(w, rank) ? 0.0 : f.plane.height(place(w));
  };
  std::optional<Gap> gap;
  double away = 0;
  find_at_edge(kernel_, side.b, side.a, star_);
  for (const std::uint32_t s : star_) {
    if (kernel_.is_ghost(s)) continue;
    const auto& corners = kernel_.simplices().corners(s);
    is_edge = true;
    std::array<std::uint32_t, 2> across{};
    std::size_t found = 0;
    for (const std::uint32_t w : corners) {
      if (w != side.a && w != side.b) across[found++] = w;
    }
    const auto [u, v] = across;
    for (const std::uint32_t w : across) {
      if (is_on(w, rank) && is_towards(side, w) &&
          tiles_.find(face_of(side.a, side.b, w), rank) != kNone) {
        return std::nullopt;
      }
    }
    const double above_u = height(u), above_v = height(v);
    if (!(above_u < 0 && above_v > 0) && !(above_u > 0 && above_v < 0)) continue;
    const Point<3> x =
        plus(place(u), scaled(above_u / (above_u - above_v), minus(place(v), place(u))));
    const double to_x = dot(minus(x, place(side.a)), side.towards);
    if (to_x <= away || !contains(f, x)) continue;
    gap = Gap{rank, s, u, v, x};
    away = to_x;
  }
  if (is_edge) {
    has_gap_[rank] = true;
    if (!gap) suspect(rank, side.a, side.b);
  }
  return gap;
}

auto Conformity::next_gap() -> std::optional<Gap> {
  for (;;) {
    for (; !open_.empty(); open_.pop_back()) {
      const auto gap = gap_at(open_.back());
      if (!gap) continue;
      note_loose(gap->polygon);  // a vertex there may leave others
      return gap;
    }
    if (loose_.empty()) return std::nullopt;
    const Rank f = loose_.back();
    loose_.pop_back();
    is_loose_[f] = false;
    if (is_covered_again(f)) {
      suspects_[f].clear();
    } else if (has_looked_[f]) {
      find_new_open_sides(f);
    } else {
      has_looked_[f] = true;
      find_open_sides(f);
    }
    lost_[f] = gained_[f] = 0;
    has_gap_[f] = false;
  }
}

// --- Where polygons get vertices -------------------------------------------------------------

/// The foot of what is in its ball, or its centre. Nothing: neither is a good place on f.
std::optional<Placed> Conformity::place_for(const Tiles::Tile& tile, const Point<3>& from) const {
  const Polygon& f = polygon(tile.polygon);
  const Point<3> centre = centre_of(tile.face, f);
  if (const auto foot = foot_in(f, from, tile.face, centre)) return placed_on(f, *foot);
  if (contains(f, centre)) return placed_on(f, centre);
  return std::nullopt;
}

/// On f at x, or on an edge near x instead, if a vertex there helps, too. `d2`: the squared
/// distance of x from the nearest vertex.
template <class Helps>
Placed Conformity::place_near(const Polygon& f, const Point<3>& x, double d2, Helps&& helps) const {
  const auto on_edge = yield_to_edges(FeaturesBeside(store_, x, kEverywhere), x, std::sqrt(d2));
  return on_edge && helps(on_edge->p) ? *on_edge : placed_on(f, x);
}

/// A copy of one of the vertices at the edge that pierces the polygon, or the foot of one, or else
/// where that is; or on an edge that is near these.
Placed Conformity::place_for(const Gap& gap) const {
  const Polygon& f = polygon(gap.polygon);
  const Point<3>& centre = kernel_.simplices().ball(gap.simplex).centre;
  const double r2 = squared_distance(centre, place(gap.u));
  const auto is_in_ball = [&](const Point<3>& x) { return detail::is_in_ball(centre, r2, x); };
  const std::array<std::uint32_t, 2> across{gap.u, gap.v};
  const FeaturesBeside near(store_, gap.at, kEverywhere);
  for (const std::uint32_t w : across) {
    if (vertices_[w].role.on == 0) continue;
    const Vertex<3> v = record(w);
    const auto copy = SmallAngles(near).copy({v, vertices_[w].role}, f);
    if (copy && detail::polygon_of(copy->role) != 0 && is_in_ball(copy->p)) return *copy;
  }
  for (const std::uint32_t w : across) {
    const Point<3> foot = f.plane.foot(place(w));
    if (!is_in_ball(foot) || !contains(f, foot) || !is_nearest(w, foot)) continue;
    return place_near(f, foot, squared_distance(foot, place(w)),
                      [&](const Point<3>& x) { return cuts_cell(w, x); });
  }
  double nearest2 = std::numeric_limits<double>::infinity();
  for (const std::uint32_t w : kernel_.simplices().corners(gap.simplex)) {
    nearest2 = std::min(nearest2, squared_distance(gap.at, place(w)));
  }
  return place_near(f, gap.at, nearest2, is_in_ball);
}

/// The foot of x, if it is in f and in the face's ball, and x is nearer to it than the corners are.
std::optional<Point<3>> Conformity::foot_in(const Polygon& f, const Point<3>& x, const Face& face,
                                            const Point<3>& centre) const {
  const Point<3> foot = f.plane.foot(x);
  const double r2 = squared_distance(centre, place(face[0]));
  if (!detail::is_in_ball(centre, r2, foot) || !contains(f, foot)) return std::nullopt;
  const double gap2 = squared_distance(foot, x);
  for (const std::uint32_t w : face) {
    if (squared_distance(foot, place(w)) < gap2) return std::nullopt;
  }
  return foot;
}

/// Whether no vertex is nearer to x than v: its neighbours are asked.
bool Conformity::is_nearest(std::uint32_t v, const Point<3>& x) const {
  const double d2 = squared_distance(place(v), x);
  std::vector<std::uint32_t> star;
  const auto has_nearer = [&](std::uint32_t s) {
    const auto& corners = kernel_.simplices().corners(s);
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t w) {
      return w != kInfinite && squared_distance(place(w), x) < d2;
    });
  };
  return kernel_.find_in_star(v, star, has_nearer) == kNone;
}

/// Whether a vertex at x would be a neighbour of v.
bool Conformity::cuts_cell(std::uint32_t v, const Point<3>& x) const {
  std::vector<std::uint32_t> star;
  const auto is_in_ball = [&](std::uint32_t s) {
    if (kernel_.is_ghost(s)) return false;
    const Point<3>& centre = kernel_.simplices().ball(s).centre;
    return detail::is_in_ball(centre, squared_distance(centre, place(v)), x);
  };
  return kernel_.find_in_star(v, star, is_in_ball) != kNone;
}

std::optional<Placed> Conformity::yield(const Point<3>& x, double radius) const {
  return detail::yield(FeaturesBeside(store_, x, kEverywhere), x, radius);
}

}  // namespace mesher::detail
