// The parts of World that need the program's functions.
#pragma once

#include "geometry/input_point.hpp"
#include "plane/near_features.hpp"
#include "plane/vertex_budget.hpp"
#include "program/build_qt.hpp"
#include "program/choose_steiners.hpp"
#include "program/cut.hpp"
#include "program/fill.hpp"
#include "program/fill_facets.hpp"
#include "program/split_edges.hpp"
#include "program/split_segments.hpp"
#include "program/split_slivers.hpp"
#include "program/triangulate.hpp"
#include "program/world.hpp"
#include "space/space_budget.hpp"

namespace mesher::detail {

// The points of the boundary grid, with their events asked for from the outside: Complete with the
// vertices whose nearest neighbours are as far as theirs, a step away.
template <class S, int D>
void PointWorld<S, D>::add_boundary() {
  const double step = box.shortest_boundary_step();
  const int b = buckets().bucket(step * step);
  box.for_each_boundary_point([&](const Point<D>& p) {
    const VertexRef<D> v = vertices.add_boundary(p);
    const Fixed<D> f = box.fixed(p);
    if (!owns(p)) return;
    steiner_at(b).template post_from_outside<complete>(complete_key(buckets(), f, b), v, b);
    if constexpr (S::kTraced && D > 3) stars.template post_from_outside<star>(star_key(f), v);
  });
}

// Edges are split before there are tiles.
template <class AnyWorld>
void post_cells(AnyWorld& w) {
  using Whole = typename AnyWorld::AnyCell;
  if (w.locates) w.fills.template post_from_outside<fill>(fill_key(Whole()), Whole());
  if (w.border == nullptr) w.post_edges();
}
template <class AnyWorld>
void retract_cells(AnyWorld& w) {
  using Whole = typename AnyWorld::AnyCell;
  if (w.locates) w.fills.template retract_from_outside<fill>(Whole());
  if (w.border == nullptr) w.retract_edges();
}

template <class S, class AnyWorld, int D>
void post_parts(S& s, AnyWorld& w, const Cell<D>& c) {
  w.quadtree.template post<split>(s, split_key(c), c);
  MeshBox<D>::for_each_child(c, [&](const Cell<D>& part) {
    if (!w.meets(w.box.box_of(part))) return;
    if constexpr (!S::kTraced) w.plain.tick();
    w.fills.template post<fill>(s, fill_key(part), part);
  });
}

// Who splits a piece of a segment, fills a cell, locates a feature, or completes a vertex.
template <class S>
void World<S, 2>::limits_changed(const Box<2>& where) noexcept {
  segments.limits_changed(where);
  plans.limits_changed(where);
  features.limits_changed(where);
  vertices.limits_changed(where);
}

// Who splits an edge or a piece of a polygon, fills a cell, locates a feature, or completes a
// vertex.
template <class S>
void World<S, 3>::limits_changed(const Box<3>& where) noexcept {
  plc.limits_changed(where);
  plans.limits_changed(where);
  features.limits_changed(where);
  vertices.limits_changed(where);
}

template <class S>
void World<S, 2>::post_split(S& s, const PieceRef& piece) {
  if constexpr (!S::kTraced) this->plain.tick();
  splits.template post<split_segment>(s, split_segment_key(box, piece), piece);
}

// add a ComputeNN(p) event, with key |c| / 2; c is the cell of `leaf_level` around p. Where there
// is a lattice, its points may be nearer
template <class S, int D>
void PointWorld<S, D>::post_nearest(S& s, VertexRef<D> v, int leaf_level) {
  double nearest = box.cell_side(leaf_level) / 2;
  if (limits.any()) nearest = std::min(nearest, kClear * limits.pitch(v->p));
  post_nearest_from(s, v, nearest);
}

template <class S, int D>
void PointWorld<S, D>::post_nearest_from(S& s, VertexRef<D> v, double distance) {
  post_nearest_in(s, v, buckets().bucket(distance * distance));
}

template <class S, int D>
void PointWorld<S, D>::post_nearest_in(S& s, VertexRef<D> v, int b) {
  if constexpr (!S::kTraced) plain.tick();
  steiner_at(b).template post<compute_nn>(s, nearest_key(box.fixed(v->p), b), v, b);
}

template <class S, int D>
void PointWorld<S, D>::post_complete(S& s, VertexRef<D> v, int b) {
  if constexpr (!S::kTraced) {
    plain.tick();
  } else if (!owns(v->p)) [[unlikely]] {
    return border->hand_over(s, v, b);
  }
  steiner_at(b).template post<complete>(s, complete_key(buckets(), box.fixed(v->p), b), v, b);
}

template <class S>
bool World<S, 2>::post_cuts(S& s, const std::vector<LeafRef>& found, int b) {
  for (const LeafRef leaf : found) {
    const sac::Key key = cut_key(box.fixed(leaf->middle()), b);
    this->steiner_at(b).template post<cut>(s, key, leaf, b);
    if constexpr (S::kTraced) {
      if (this->border != nullptr) [[unlikely]]
        this->border->request_cut(s, leaf->piece, b, key);
    }
  }
  return !found.empty();
}

template <class S>
void World<S, 2>::refuse_cut(S& s, const Error& error) {
  if constexpr (S::kTraced) this->border->fault(s, error);
}

template <class S, int D>
void PointWorld<S, D>::post_star(S& s, VertexRef<D> v) {
  if constexpr (S::kTraced && D > 3) {
    stars.template post<star>(s, star_key(box.fixed(v->p)), v);
  }
}

template <class S, int D>
void PointWorld<S, D>::post_border_star(S& s, VertexRef<D> v, const CellOf<D>& cell) {
  if constexpr (S::kTraced && D <= 3) {
    if (border == nullptr || border->whole().complex != nullptr) return;
    if (vertices.is_whole(cell) && border->holds(*v, vertices.concern(cell))) return;
    stars.template post<star>(s, star_key(box.fixed(v->p)), v);
  }
}

template <class S, int D>
void PointWorld<S, D>::post_border_star(S& s, VertexRef<D> v, double reach) {
  if constexpr (S::kTraced && D <= 3) {
    if (border == nullptr || border->whole().complex != nullptr) return;
    if (border->holds(around(v->p, reach))) return;
    stars.template post<star>(s, star_key(box.fixed(v->p)), v);
  }
}

template <class S, int D>
void PointWorld<S, D>::begin_questions(S&) {
  if constexpr (S::kTraced) {
    vertices.begin_questions();
  } else {
    vertices.begin_questions(limits.any() ? 0 : rule->surely_good2(), [&] { plain.tick(); });
  }
}

template <class S, int D>
void PointWorld<S, D>::triangulate(S& s) {
  if constexpr (S::kTraced && D <= 3) {
    vertices.keep_triangulation();
  } else if constexpr (S::kTraced) {
    stars.drain(s);
  } else if (vertices.triangulation() != nullptr) {  // it is done
    vertices.pool().for_each([&](const Vertex<D>&) { plain.tick(); });
  } else if constexpr (D <= 3) {
    triangulate_at_once(vertices.pool(), plain);
  } else {
    triangulate_star_by_star(s, vertices, plain);
  }
}

template <class S>
void World<S, 2>::fail_too_short(const PieceRef& piece) {
  const Witness witness = segments.witness(piece);
  if (!witness) fail_near(piece.lo(), piece.length(), "segments are split ever shorter");
  throw too_close_to_segment(piece, witness, names, vertices.pool(), segments.pool());
}

template <class S>
void World<S, 2>::fail_too_close(const Vertex<2>& v, const Vertex<2>& x) const {
  if (names == nullptr) refuse_close(v, x);
  const bool in_order = v.p < x.p;
  throw too_close_vertices(in_order ? v : x, in_order ? x : v, *names, vertices.roles());
}

// Edits that are undone have had room.
template <class S, int D>
void PointWorld<S, D>::fail_too_many(S& s) const {
  if constexpr (S::kTraced) {
    if (s.engine().undoing()) return;
  }
  throw static_cast<const World<S, D>&>(*this).too_many();
}

template <class S>
Error World<S, 2>::too_many() const {
  return too_many_vertices(vertices, names, this->most_vertices);
}

template <class S>
Error World<S, 3>::too_many() const {
  return too_many_vertices(vertices, feature_names, plc.store(), this->most_vertices);
}

template <class S, int D>
Error World<S, D>::too_many() const {
  return {ErrorCode::too_many,
          "more than " + std::to_string(this->most_vertices) + " vertices are needed"};
}

template <int D>
[[noreturn]] void fail_rounded(const Point<D>& near, const Point<D>& to) {
  throw Error(ErrorCode::too_close, "input points are too close for double precision near " +
                                        place_text(near) + ": rounding moved a new vertex to " +
                                        place_text(to));
}

template <class S, int D>
void World<S, D>::fail_useless(const Vertex<D>& v, const Vertex<D>& x) const {
  fail_rounded<D>(v.p, x.p);
}

template <class S>
void World<S, 3>::fail_useless(const Vertex<3>& v, const Vertex<3>& x) const {
  fail_rounded<3>(v.p, x.p);
}

template <class S>
void World<S, 3>::fail_too_fine(const Polygon& f, const Point<2>& at) const {
  throw Error(ErrorCode::too_close, "features are too close for double precision near " +
                                        place_text(f.plane.at(at)) +
                                        ": a polygon would be filled ever more closely");
}

template <class S>
void World<S, 2>::fail_useless(const Vertex<2>& v, const Vertex<2>& x) {
  fail_near(v.p, std::sqrt(squared_distance(v.p, x.p)),
            "rounding moved a new vertex to " + place_text(x.p));
}

template <class S>
void World<S, 3>::post_edge(const Edge& e) {
  const EdgePiece all{&e};
  splits.template post_from_outside<split_edge>(split_edge_key(box, all), all);
}

template <class S>
void World<S, 3>::retract_edge(const Edge& e) {
  splits.template retract_from_outside<split_edge>(EdgePiece{&e});
}

template <class S>
void World<S, 3>::post_edges() {
  plc.store().edges().for_each([&](const Edge& e) {
    if (plc.store().users(e) != 0) post_edge(e);
  });
}

template <class S>
void World<S, 3>::retract_edges() {
  plc.store().edges().for_each([&](const Edge& e) {
    if (plc.store().users(e) != 0) retract_edge(e);
  });
}

template <class S>
void World<S, 3>::edge_came(const Edge& e) {
  if (limits.any() && plc.store().users(e) == 1) post_edge(e);
}

template <class S>
void World<S, 3>::edge_goes(const Edge& e) {
  if (limits.any() && plc.store().users(e) == 0) retract_edge(e);
}

template <class S>
const Edge& World<S, 3>::insert_edge(VertexHandle a, VertexHandle b) {
  const Edge& e = plc.insert(a, b);
  edge_came(e);
  return e;
}

template <class S>
void World<S, 3>::erase_edge(const Edge& e) {
  plc.erase(e);
  edge_goes(e);
}

template <class S>
const Polygon& World<S, 3>::insert_polygon(PolygonParts parts) {
  const Polygon& f = plc.insert(std::move(parts));
  for (const EdgeHandle e : f.all_edges) edge_came(plc.store().edges()[e]);
  const FacetPiece all{&f};
  fills.template post_from_outside<fill_facet>(fill_facet_key(box, all), all);
  return f;
}

template <class S>
void World<S, 3>::erase_polygon(const Polygon& f) {
  plc.erase(f);
  for (const EdgeHandle e : f.all_edges) edge_goes(plc.store().edges()[e]);
  fills.template retract_from_outside<fill_facet>(FacetPiece{&f});
}

template <class S>
void World<S, 3>::post_split(S& s, const EdgePiece& piece) {
  if constexpr (!S::kTraced) this->plain.tick();
  splits.template post<split_edge>(s, split_edge_key(box, piece), piece);
}

template <class S>
void World<S, 3>::post_fill(S& s, const FacetPiece& piece) {
  if constexpr (!S::kTraced) this->plain.tick();
  fills.template post<fill_facet>(s, fill_facet_key(box, piece), piece);
}

template <class S>
void World<S, 3>::post_split_slivers(S& s, VertexRef<3> v, int b) {
  const sac::Key key = split_slivers_key(this->buckets(), box.fixed(v->p), b);
  if constexpr (!S::kTraced) {
    this->plain.tick();
  } else if (!this->owns(v->p)) [[unlikely]] {
    return this->border->hand_over_slivers(s, v, b, key);
  }
  this->steiner_at(b).template post<split_slivers>(s, key, v, b);
}

/// Whether x is so near to the cell's vertex or a neighbour of that.
[[nodiscard]] inline bool is_within(const VoronoiCell3& cell, const Point<3>& x, double distance) {
  const auto is_near = [&](const Point<3>& p) {
    return squared_distance(p, x) < distance * distance;
  };
  if (is_near(cell.center().p)) return true;
  for (int i = 0; i < cell.size(); ++i) {
    if (cell.used(i) && cell.real(i) && is_near(cell.place(i))) return true;
  }
  return false;
}

// In a tile others may be near that will not be there in the end, as for fill_at().
template <class S>
void World<S, 3>::insert_beside(S& s, const Vertex<3>& v, CellOf<3>& cell, const Placed& y, int b) {
  if constexpr (S::kTraced) {
    if (this->border != nullptr) [[unlikely]] {
      const double least =
          this->border->nearness(s) * nearest_in(*this) * this->buckets().shortest(b);
      if (is_within(cell, y.p, least)) throw TooNear();
    }
  }
  const VertexRef<3> x = y.role.on != 0 ? vertices.insert(s, y.p, y.role) : vertices.insert(s, y.p);
  if (!cell.cuts(x->p)) fail_useless(v, *x);
  this->require_room(s);
  cell.cut(x->self);
  if constexpr (S::kTraced) {
    if (!this->owns(x->p)) [[unlikely]] {
      return this->border->hand_over(s, x, b + 1, y.role, true);
    }
  }
  this->post_nearest_in(s, x, b + 1);
}

template <class S>
void World<S, 2>::fail_near(const Point<2>& p, double radius, const std::string& why) {
  const double least = box.side * 0x1p-52;
  NamedFeatures near =
      named_near(p, std::max(radius, least), 2 * box.side, segments.store(), features, names);
  throw Error(ErrorCode::too_close,
              near.text + " are too close to each other for double precision near " +
                  place_text(p) + ": " + why,
              {}, std::move(near.features), {position_of(p)});
}

}  // namespace mesher::detail
