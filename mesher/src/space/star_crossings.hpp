// Where features of the input cross the star of a vertex: there they are no unions of edges and
// faces yet [rules F].
//
// A mesh has all edges of the input as unions of edges, and polygons as unions of faces, iff no
// edge of it pierces a polygon, and no face an edge of the input. What an insertion makes is in the
// star of the new vertex, so each vertex looks at its own star: once that is clean, what could
// cross it later is in the star of a later vertex, which looks at it. A function of the star and
// the features that meet it; nothing else of the mesh is looked at.
//
//   v on e           e goes on along an edge of the star
//   v not on e       no face at v has a place of e inside
//   v on f           no edge of the link pierces f
//   v not on f       no edge at v pierces f
//
// The alternative, that no feature meets the Voronoi cell of a vertex that is not on it, asks for
// empty diametral balls [Fig 6.2]. Each vertex on a surface of triangles then splits the longer of
// the two other edges of its triangles, and so on: three to five times as many vertices.
//
// Where polygons meet at small angles more is asked: what leans on a polygon of v may not meet v's
// cell. So a vertex on one page of a fan has copies on all pages, and none comes nearer to the
// place of one that is still missing.
//
// What the clip hides is not there: who has a hidden corner looks again, in a later bucket. A
// feature is looked at as it is, a vertex on it as its label says. What is as near as rounding may
// move vertices counts as touching: an edge may not touch a face, and a polygon may touch an edge.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cells/voronoi_cell3.hpp"
#include "space/dyadic.hpp"
#include "space/feature_search.hpp"
#include "space/placed.hpp"
#include "space/small_angles.hpp"

namespace mesher::detail {

class StarCrossings {
 public:
  /// What is known of the star: nothing, then features as far as it reaches are asked for; that the
  /// cell is as it was observed; and that no feature crosses it that has not come in this update.
  enum class Known : std::uint8_t { nothing, observed, was_clear };

  /// Lists of a star, of one after the other: large ones keep their room.
  class Room;

  /// `role_of(vertex)`: what it lies on. `room`: of one star at a time.
  template <class RoleOf>
  StarCrossings(Room& room, VoronoiCell3& cell, const VertexPool<3>& pool,
                const FeaturesBeside& near, RoleOf&& role_of)
      : StarCrossings(room, cell, pool, near) {
    self_ = role_of(cell.center());
    for (const int i : real_) roles_[index(i)] = role_of(pool[cell.handle(i)]);
  }

  /// Of the first feature that crosses the star, edges before polygons, in canonical order: where
  /// it gets a vertex, which takes some of the cell. Nothing: none crosses.
  /// Throws: Error (too_close), if rounding leaves no such place.
  [[nodiscard]] std::optional<Placed> place(Known known);
  /// Whether one does. Requires: the cell is as it was observed.
  [[nodiscard]] bool any();

 private:
  static constexpr int kSelf = -1;
  // An edge of the star that pierces a polygon.
  struct PiercingEdge {
    Point<3> at{};
    int p = kSelf, q = kSelf;
  };
  // What a vertex on an edge of the input would mend. In fractions of the edge: where it may go
  // well, where it does in any case, and what room it has there.
  struct MissingEdge {
    Span part;
    double at = 0, room = 0;
    std::array<int, 2> beside{kSelf, kSelf};  // vertices in the way
  };
  // Of a vertex: across the line of an edge, in two directions; along it, in fractions; and on
  // which sides of these lines, and of the ends, it is for sure.
  struct Beside {
    double x = 0, y = 0, along = 0;
    std::uint8_t sides = 0;
  };
  // An edge of the link, from the lesser place.
  struct LinkEdge {
    int p, q;
  };

  StarCrossings(Room& room, VoronoiCell3& cell, const VertexPool<3>& pool,
                const FeaturesBeside& near);

  static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] const Vertex<3>& vertex(int i) const {
    return i == kSelf ? cell_.center() : pool_[cell_.handle(i)];
  }
  [[nodiscard]] Standing standing(int i) const {
    return {vertex(i), i == kSelf ? self_ : roles_[index(i)]};
  }
  [[nodiscard]] double nearest2(const Point<3>& x) const;
  [[nodiscard]] bool meets(const Point<3>& middle, double radius) const noexcept;
  using Polygons = std::vector<const Polygon*>;
  using Edges = std::vector<const Edge*>;
  template <class F>
  [[nodiscard]] std::vector<const F*> find_changed() const;
  [[nodiscard]] Polygons find_polygons() const;
  [[nodiscard]] Edges find_edges(const Polygons& polygons) const;
  template <class F>
  [[nodiscard]] bool any_of(const std::vector<const F*>& all);
  template <class F, class Is>
  [[nodiscard]] static const F* first(const std::vector<const F*>& all, Is&& is);
  [[nodiscard]] std::optional<Placed> place_leaning(const Polygon& f);

  [[nodiscard]] std::optional<MissingEdge> look_at(const Edge& e);
  void project(const Edge& e);
  void project_labels(const Edge& e);
  [[nodiscard]] Beside seen(const Point<3>& p) const;
  [[nodiscard]] bool are_beside() const;
  [[nodiscard]] bool is_before(const LinkEdge& a, const LinkEdge& b) const noexcept;
  [[nodiscard]] double turn(const Beside& a, const Beside& b) const;
  [[nodiscard]] std::optional<double> crossing(const Beside& a, const Beside& b,
                                               const Beside& c) const;
  [[nodiscard]] std::optional<MissingEdge> pierced_face(const Edge& e) const;
  [[nodiscard]] Span piece_at(double at, double room) const;
  [[nodiscard]] std::optional<MissingEdge> missing_from_self(const Edge& e, double towards) const;
  [[nodiscard]] bool is_visible(double towards) const;
  [[nodiscard]] Placed place_on(const Edge& e, const MissingEdge& missing);

  [[nodiscard]] std::optional<PiercingEdge> look_at(const Polygon& f);
  [[nodiscard]] std::vector<PiercingEdge> all_piercing(const Polygon& f) const;
  [[nodiscard]] std::optional<Placed> copy_on(const Polygon& f, const PiercingEdge& edge);
  [[nodiscard]] std::optional<Point<3>> foot_on(const Polygon& f, const PiercingEdge& edge);
  [[nodiscard]] Point<3> roomiest_on(const Polygon& f, const PiercingEdge& edge);
  [[nodiscard]] Placed place_on(const Polygon& f, const PiercingEdge& edge);
  [[nodiscard]] Placed place_near(const Polygon& f, const Point<3>& x);

  struct Ball {
    Point<3> centre;
    double radius;
  };

  VoronoiCell3& cell_;
  const VertexPool<3>& pool_;
  const FeaturesBeside& near_;
  // Numbers of neighbours are accidental: what depends on an order goes by places.
  std::vector<int>& real_;       // neighbours that are vertices
  std::vector<Role>& roles_;     // of these
  std::vector<LinkEdge>& link_;  // between these
  std::vector<Ball>& balls_;     // of simplices
  Role self_;
  double reach_ = 0;     // how far the star reaches from v
  double rounding_ = 0;  // of a length in it
  Box<3> box_{};         // of the star
  // Scratch, of one feature.
  std::vector<double>& height_;  // of neighbours; 0: on the polygon, or in its plane
  double self_height_ = 0;
  std::vector<Beside>& beside_;  // of neighbours
  std::vector<char>& on_;        // of neighbours: whether they are on the edge
  Beside self_beside_{};
  struct {
    Point<3> origin, one, other, along;
  } axes_{};  // of the edge
};

class StarCrossings::Room {
  friend StarCrossings;
  std::vector<int> real_;
  std::vector<Role> roles_;
  std::vector<LinkEdge> link_;
  std::vector<Ball> balls_;
  std::vector<double> height_;
  std::vector<Beside> beside_;
  std::vector<char> on_;
};

}  // namespace mesher::detail
