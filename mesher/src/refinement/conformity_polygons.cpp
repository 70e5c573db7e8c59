// Crossings of polygons.
#include <algorithm>
#include <cmath>
#include <utility>

#include "delaunay/facets.hpp"
#include "refinement/conformity.hpp"
#include "refinement/conformity_balls.hpp"
#include "space/polygon_shape.hpp"

namespace mesher::detail {

namespace {

// Of a centre's height over a plane, squared, in units of the squared radius: it is not 0 but for
// rounding.
constexpr double kClear2 = 0x1p-32;

}  // namespace

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
  const auto found =
      crosses ? crossing_of(face, s, kernel_.simplices().across(s)[i] >> 2, f) : std::nullopt;
  if (known != kNone) {
    if (found) {
      crossings_.move(known, found->at);
      return known;
    }
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
    return (f.plane.height(apex) > 0) !=
           detail::is_in_ball(at, squared_distance(at, place(order[0])), apex);
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
auto Conformity::crossing_of(const Face& face, std::uint32_t s, std::uint32_t t, Rank rank) const
    -> std::optional<Crossings::Crossing> {
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

/// Of the faces that the last insertion made.
void Conformity::look_at_made(Rank f) {
  look_at_faces(kernel_.made(), true, f, [](std::uint32_t) {});
}

}  // namespace mesher::detail
