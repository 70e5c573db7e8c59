// Which faces are tiles.
#include <algorithm>
#include <cmath>

#include "delaunay/facets.hpp"
#include "refinement/conformity.hpp"
#include "refinement/conformity_balls.hpp"
#include "space/polygon_shape.hpp"

namespace mesher::detail {

void Conformity::start_polygons() {
  has_polygons_ = true;
  const auto last = static_cast<Rank>(by_rank_.size() - 1);
  tiles_.make_room(last);
  lost_.assign(by_rank_.size(), 0);
  gained_.assign(by_rank_.size(), 0);
  is_loose_.assign(by_rank_.size(), false);
  suspects_.resize(by_rank_.size());
  has_looked_.assign(by_rank_.size(), false);
  has_gap_.assign(by_rank_.size(), false);
  is_turned_.assign(by_rank_.size(), false);
  look_at_all();
  for (Rank f = last; f > 0; --f) note_loose(f);
}

void Conformity::look_at_all() {
  const auto& simplices = kernel_.simplices();
  for (std::uint32_t s = 0; s < simplices.places(); ++s) {
    if (!simplices.alive(s)) continue;
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (simplices.across(s)[i] >> 2 < s) look_at_facet(s, i);
    }
  }
}

/// Calls visit(f) for the polygons that all its corners are on, ascending.
template <class Visit>
void Conformity::visit_common_polygons(const Facet& facet, Visit&& visit) const {
  for (const std::uint32_t v : facet) {
    if (!vertices_[v].on_polygon) return;
  }
  for (const Rank f : polygons(facet[0])) {
    if (is_on(facet[1], f) && is_on(facet[2], f)) visit(f);
  }
}

/// Of the facet across from corner i of s: notes of which polygons it is a tile.
void Conformity::look_at_facet(std::uint32_t s, std::uint32_t i) {
  const Facet facet = facet_across<3>(kernel_.simplices().corners(s), i);
  visit_common_polygons(facet, [&](Rank f) {
    const Face face = face_across(facet);
    const std::uint32_t known = tiles_.find(face, f);
    const bool is = is_tile(s, i, f);
    if (is == (known != kNone)) return;
    if (is) {
      tiles_.add(face, f);
      suspect(f, face);
      gained_[f] += area_of(face);
    } else {
      erase(known);
    }
  });
}

/// Its middle is in f, and what is above it is no flat tetrahedron on f. One with three corners on
/// an edge of f is none: what is flat there may be above as well as beside f.
bool Conformity::is_tile(std::uint32_t s, std::uint32_t i, Rank f) const {
  const auto& simplices = kernel_.simplices();
  const Facet facet = facet_across<3>(simplices.corners(s), i);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = facet[k], w = facet[(k + 1) % 3];
    const EdgeHandle e = common_edge(v, w);
    if (e != 0 && polygon(f).has_edge(e) && pieces_.find(v, w) == kNone) return false;
  }
  const bool above = is_above(s, i, f);
  const std::uint32_t link = simplices.across(s)[i];
  const auto& corners = simplices.corners(above ? s : link >> 2);
  const std::uint32_t apex = corners[above ? i : link & 3];
  if (apex != kInfinite && is_on(apex, f) && !has_three_on_edge(corners, f)) return false;
  return contains(polygon(f), middle_of(face_across(facet)));
}

/// Whether s is on the upper side of its facet across from corner i.
bool Conformity::is_above(std::uint32_t s, std::uint32_t i, Rank f) const {
  const Facet facet = facet_across<3>(kernel_.simplices().corners(s), i);
  const Point<3>& a = place(facet[0]);
  const Point<3> up = cross(minus(place(facet[1]), a), minus(place(facet[2]), a));
  return (dot(up, polygon(f).plane.normal) > 0) != is_turned_[f];
}

/// The edge that both lie on; 0: none.
EdgeHandle Conformity::common_edge(std::uint32_t v, std::uint32_t w) const {
  const Known &a = vertices_[v], &b = vertices_[w];
  if (!a.on_edge || !b.on_edge) return 0;
  return store_.common_edge(edge_of(a.role), a.point, edge_of(b.role), b.point);
}

bool Conformity::has_three_on_edge(const std::array<std::uint32_t, 4>& corners, Rank f) const {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto [a, b, c] = facet_across<3>(corners, i);
    const EdgeHandle e = common_edge(a, b);
    if (e != 0 && polygon(f).has_edge(e) && common_edge(b, c) == e && common_edge(a, c) == e) {
      return true;
    }
  }
  return false;
}

Point<3> Conformity::middle_of(const Face& face) const {
  return scaled(1.0 / 3, plus(plus(place(face[0]), place(face[1])), place(face[2])));
}

/// Where places of f are as far from all three, which are on f.
Point<3> Conformity::centre_of(const Face& face, const Polygon& f) const {
  return f.plane.at(centre_in_frame(f, {place(face[0]), place(face[1]), place(face[2])}));
}

double Conformity::area_of(const Face& face) const {
  const Point<3>& a = place(face[0]);
  return std::sqrt(squared(cross(minus(place(face[1]), a), minus(place(face[2]), a)))) / 2;
}

void Conformity::want_tile(std::uint32_t tile, const Point<3>& from) {
  if (tiles_[tile].waiting) return;
  tiles_.set_waiting(tile, from);
  wanted_tiles_.push_back(tile);
}

void Conformity::erase(std::uint32_t tile) {
  const Tiles::Tile& gone = tiles_[tile];
  lost_[gone.polygon] += area_of(gone.face);
  suspect(gone.polygon, gone.face);
  note_loose(gone.polygon);
  tiles_.erase(tile);
}

bool Conformity::is_wall(std::uint32_t s, std::uint32_t i) const {
  const Facet facet = facet_across<3>(kernel_.simplices().corners(s), i);
  const auto is_on_polygon = [&](std::uint32_t v) { return vertices_[v].on_polygon; };
  return std::all_of(facet.begin(), facet.end(), is_on_polygon) &&
         tiles_.find(face_across(facet)) != kNone;
}

}  // namespace mesher::detail
