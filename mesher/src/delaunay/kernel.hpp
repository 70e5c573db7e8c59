// Delaunay triangulations in the plane and in space, changed one vertex at a time.
//
// Representation. Simplices (simplex_store.hpp), by `Layout` with their balls or without
// (simplex_layout.hpp), and places. The convex hull is closed by ghosts: a ghost is a hull facet
// and vertex 0, kInfinite, so that every facet has a simplex on each side and insertion does not
// know the hull. A ghost is positively oriented if a point outside of its facet stands for
// kInfinite.
//   (The other design on paper gave a simplex 64 bytes with its ball, so that a test is one
//   distance. An insertion in space makes 20 simplices and tests 40: a circumcentre costs as much
//   as two filtered tests, and memory doubles. And hulls as facets without a neighbour, with cases
//   wherever a facet is crossed.)
//
// Ties by coordinates (mesher/predicates.hpp): incircle and insphere are never 0, so the conflict
// of a finite simplex with a point is whether the point is in its ball, and of a ghost, whether it
// is outside of its facet; in the facet's plane, whether it is in the ball of the finite neighbour,
// which meets the plane in the facet's own circle. All answers are those of lifted points in
// general position, where a hull that is flat somewhere is replaced by an infinitesimally round
// one; so conflicting simplices are connected, what they leave is filled from the new vertex by
// simplices that are not flat, and one set of points has one triangulation, in whatever order they
// come and whatever was removed between.
//
// Insertion: a walk to the simplex that holds the point, the conflicting simplices around it
// (Bowyer, Watson), new ones in their place. Removal: the triangulation of the neighbours alone
// (another kernel) holds all that fills the hole.
//
// A refiner can inspect a hole before it fills it or gives up: dig(), then fill() or undo_dig().
//
// Strong guarantee: a function that throws leaves everything as it was.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "delaunay/ball_filter.hpp"
#include "delaunay/facets.hpp"
#include "delaunay/simplex_store.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

/// The vertex that makes ghosts of simplices.
inline constexpr std::uint32_t kInfinite = 0;

/// In place of the balls' batch where there are none.
struct NoBalls {
  [[nodiscard]] Shape shape(std::size_t) const noexcept { return {}; }
};

template <int D, class Layout = ArrayLayout<D>>
class DelaunayKernel {
 public:
  using Ids = typename Layout::Ids;
  using Store = SimplexStore<D, Layout>;
  static constexpr bool kHasBalls = Layout::kHasBalls;

  DelaunayKernel();
  /// The same vertices and simplices in another layout. Requires: this one has no balls.
  template <class Other>
  explicit DelaunayKernel(const DelaunayKernel<D, Other>& other);

  void reserve(std::size_t points);
  /// A new place, numbered 1, 2, ...; it is no vertex yet.
  std::uint32_t add_place(const Point<D>& p);
  /// Forgets the place of the greatest number. Requires: it is no vertex.
  void drop_place() noexcept;
  /// Gives a place that is no vertex other coordinates.
  void set_place(std::uint32_t v, const Point<D>& p) noexcept;

  /// Begins with a simplex. Requires: no vertices yet, corners not in a plane (a line).
  void start(const std::array<std::uint32_t, D + 1>& corners);
  /// Makes v a vertex, unless one has the same place: returns v or that one.
  /// Requires: started; v is no vertex.
  /// Cost: expected O(1) near the last one inserted, in an order as random as spatial_order's.
  std::uint32_t insert(std::uint32_t v);

  // --- The same in steps.
  /// A simplex that holds p, or a ghost whose facet p is outside of. Requires: started.
  /// Cost: as many simplices as are between it and `from`.
  [[nodiscard]] std::uint32_t walk(const Point<D>& p, std::uint32_t from) const;
  /// Whether a vertex at p takes simplex s out. Requires: p is no vertex's place.
  [[nodiscard]] bool conflicts(std::uint32_t s, const Point<D>& p) const;
  /// Finds what v takes out, from simplex s on. Requires: v is no vertex, nobody is at its place;
  /// conflicts(s, place(v)). What throws digs nothing.
  void dig(std::uint32_t v, std::uint32_t s);
  /// The simplices that v takes out. Requires: dug.
  [[nodiscard]] const std::vector<std::uint32_t>& doomed() const noexcept { return cavity_; }
  /// Whether s is one of them.
  [[nodiscard]] bool is_doomed(std::uint32_t s) const noexcept;
  /// Calls visit(w) for each vertex that v will have an edge with, infinity too. Requires: dug.
  template <class Visit>
  void for_each_in_link(Visit&& visit) const;
  /// Calls visit(facet) for the facets, as D vertices, that simplices with v will have. Requires:
  /// dug.
  template <class Visit>
  void for_each_facet_of_hole(Visit&& visit) const {
    for (const Border& b : borders_) visit(facet_across<D>(b.corners, b.slot));
  }
  void undo_dig() noexcept;
  /// Makes v a vertex. Requires: dug.
  void fill(std::uint32_t v) noexcept;
  /// The simplices that the last removal made, or insertion, if the layout has balls. Requires (for
  /// all that follows on them): it has.
  [[nodiscard]] const std::vector<std::uint32_t>& made() const noexcept { return made_; }
  /// Of made()[k]; not a number for ghosts.
  [[nodiscard]] Shape shape_made(std::size_t k) const noexcept { return balls_.shape(k); }
  /// Computes the ball of one simplex again. Returns: its shape; not a number for ghosts.
  Shape measure(std::uint32_t s) noexcept;
  /// Calls visit(s, shape) for each simplex. Requires: visit does not change the kernel.
  template <class Visit>
  void for_each_shape(Visit&& visit);
  /// The first simplex with corner v that is_wanted(s), or kNone; ghosts are asked, too. `star` has
  /// those that were not wanted afterwards: all, if none was. Requires: has(v).
  template <class IsWanted>
  std::uint32_t find_in_star(std::uint32_t v, std::vector<std::uint32_t>& star,
                             IsWanted&& is_wanted);

  /// The next insertion starts its walk at vertex v. Requires: has(v).
  void walk_from(std::uint32_t v) noexcept { last_ = vertices_[v].simplex; }
  /// Takes a vertex out. False, and nothing done, if all others are in one plane (on one line).
  /// Cost: the triangulation of its neighbours.
  bool remove(std::uint32_t v);
  /// Whether v is a vertex.
  [[nodiscard]] bool has(std::uint32_t v) const noexcept { return vertices_[v].simplex != kNone; }

  [[nodiscard]] const Store& simplices() const noexcept { return store_; }
  [[nodiscard]] const Point<D>& place(std::uint32_t v) const noexcept { return vertices_[v].place; }
  /// A vertex at which the last insertion or removal changed something. Requires: started.
  [[nodiscard]] std::uint32_t last_changed() const noexcept {
    const Ids& c = store_.corners(last_);
    return c[0] != kInfinite ? c[0] : c[1];
  }
  [[nodiscard]] std::size_t places() const noexcept { return vertices_.size() - 1; }
  /// Of what is kept between calls.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return vertices_.capacity() * sizeof(Vertex) + reach_.capacity() * sizeof(double) +
           store_.bytes() + mark_.capacity();
  }
  [[nodiscard]] bool is_ghost(std::uint32_t s) const noexcept;
  /// Calls visit(s) for each simplex that is no ghost. Requires: visit does not change the kernel.
  template <class Visit>
  void for_each_finite(Visit&& visit) const {
    for (std::uint32_t s = 0; s < store_.places(); ++s) {
      if (store_.alive(s) && !is_ghost(s)) visit(s);
    }
  }
  /// A simplex with corner v. Requires: has(v).
  [[nodiscard]] std::uint32_t simplex_at(std::uint32_t v) const noexcept {
    return vertices_[v].simplex;
  }
  /// The simplices with corner v, ghosts too. Requires: has(v). Cost: O(k) for k of them.
  [[nodiscard]] std::vector<std::uint32_t> star(std::uint32_t v) const;
  /// The finite vertices of v's star but v, ascending.
  [[nodiscard]] std::vector<std::uint32_t> link_of(const std::vector<std::uint32_t>& star,
                                                   std::uint32_t v) const;

  /// No vertices; the places stay.
  void clear_simplices() noexcept;
  /// No places, nothing.
  void clear() noexcept;
  /// Takes the simplices out and frees all else.
  [[nodiscard]] Store release() &&;

  /// Throws: sac::InvariantError. Cost: O(simplices).
  void check_invariants() const;

 private:
  template <int, class>
  friend class DelaunayKernel;

  // All that an insertion asks of a vertex; in space they are 32 bytes, in one line of the cache.
  struct alignas(D == 3 ? 32 : 8) Vertex {
    Point<D> place;
    std::uint32_t simplex = kNone;  // with this corner; kNone: it is no vertex
    std::uint32_t link_number = 0;  // in dig() and fill()
  };
  // A facet between a conflicting simplex and one that stays: that simplex's corners, the one
  // across replaced by the new vertex, at `slot`; `outer`: the other side, as in the store.
  struct Border {
    Ids corners;
    std::uint32_t outer;
    std::uint32_t slot;
  };
  // An edge of the border, in space, and the corner of a new simplex across from it.
  struct Ridge {
    std::uint64_t edge;
    std::uint32_t simplex, corner;
  };

  [[nodiscard]] std::uint32_t corner_of(std::uint32_t s, std::uint32_t v) const noexcept {
    return detail::corner_of(store_.corners(s), v);
  }
  [[nodiscard]] auto places_of(const Ids& corners) const noexcept {
    std::array<const Point<D>*, D + 1> places;
    for (std::size_t i = 0; i <= D; ++i) places[i] = &place(corners[i]);
    return places;
  }
  void note_unit(std::uint32_t v) noexcept;
  [[nodiscard]] std::uint32_t finite(std::uint32_t s) const noexcept;
  [[nodiscard]] int side(const Ids& corners, std::size_t i, const Point<D>& p) const;
  [[nodiscard]] double least_reach(const Ids& corners, std::size_t i,
                                   const Point<D>& p) const noexcept;
  template <class Reach>
  [[nodiscard]] bool conflicts_quickly(std::uint32_t s, const Point<D>& p, Reach&& reach) const;
  [[nodiscard]] bool conflicts_slowly(std::uint32_t s, const Point<D>& p, BallSide side) const;
  [[nodiscard]] bool conflicts_slowly(std::uint32_t s, const Point<D>& p, double reach) const;
  [[nodiscard]] BallSide quick_side(const Ids& corners, const Point<D>& p, double reach) const;
  [[nodiscard]] bool ball_holds(const Ids& corners, const Point<D>& p) const;
  [[nodiscard]] bool ball_holds_exactly(const Ids& corners, const Point<D>& p, bool tie) const;
  [[nodiscard]] bool ghost_conflicts(std::uint32_t s, std::size_t i, const Point<D>& p) const;
  void find_doomed(std::uint32_t v, std::uint32_t start);
  void fetch_around(std::uint32_t s) const;
  void make_room(std::size_t simplices);
  void make_room_for_fill();
  void number_link() noexcept;
  void forget_link() noexcept;
  void place_borders() noexcept;
  void join_borders() noexcept;
  void join_many_borders() noexcept;
  void measure_made(std::uint32_t v) noexcept;
  void set_corners(std::size_t k, std::uint32_t s) noexcept;
  void set_ball(std::size_t k, std::uint32_t s, std::size_t apex) noexcept;

  [[nodiscard]] bool has_finite_beside(const std::vector<std::uint32_t>& star,
                                       std::uint32_t v) const;
  bool triangulate(const std::vector<std::uint32_t>& link);
  [[nodiscard]] std::vector<Ids> filling_from_link(const std::vector<std::uint32_t>& star,
                                                   std::uint32_t v,
                                                   const std::vector<std::uint32_t>& link) const;
  [[nodiscard]] std::vector<Ids> ghosts_for(const std::vector<std::uint32_t>& star,
                                            std::uint32_t v) const;
  [[nodiscard]] std::vector<Ids> wrapping(const std::vector<std::uint32_t>& star, std::uint32_t v,
                                          const std::vector<std::uint32_t>& link) const;
  [[nodiscard]] std::uint32_t apex_over(const Ids& c, const std::vector<std::uint32_t>& link) const;
  void refill(std::uint32_t v, const std::vector<std::uint32_t>& star,
              const std::vector<Ids>& filling);
  void check_simplex(std::uint32_t s) const;
  void check_facet(std::uint32_t s, std::size_t i) const;
  void check_vertices() const;

  std::vector<Vertex, sac::HugePages<Vertex>> vertices_;  // the place of [0] is not a number
  Store store_;
  double least_reach_ = std::numeric_limits<double>::max();  // of places: see exact_reach
  std::vector<double, sac::HugePages<double>> reach_;        // if there are balls: of each place
  std::uint32_t last_ = kNone;                               // where the last vertex was inserted

  // Scratch, empty between calls (the marks are 0).
  std::vector<std::uint8_t, sac::HugePages<std::uint8_t>> mark_;  // by simplex
  std::vector<std::uint32_t> cavity_, outside_, link_, ridges_, made_;
  std::vector<Border> borders_;
  std::vector<std::array<std::uint32_t, D>> ends_;  // of the facets of borders_, by link_number
  std::vector<Ridge> many_;
  std::conditional_t<kHasBalls, BallBatch<D>, NoBalls> balls_;  // of made_
  std::vector<Point<D>> relative_;                              // to the new vertex, likewise
  std::unique_ptr<DelaunayKernel> star_;                        // for removal
};

template <int D, class Layout>
template <class Other>
DelaunayKernel<D, Layout>::DelaunayKernel(const DelaunayKernel<D, Other>& other)
    : store_(other.store_), last_(other.last_), mark_(other.mark_.size(), 0) {
  static_assert(!kHasBalls);
  vertices_.reserve(other.vertices_.size());
  for (const auto& v : other.vertices_) vertices_.push_back({v.place, v.simplex});
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) note_unit(v);
}

/// Several go through the batch at a time.
template <int D, class Layout>
template <class Visit>
void DelaunayKernel<D, Layout>::for_each_shape(Visit&& visit) {
  constexpr std::size_t kAtATime = 16;
  std::array<std::uint32_t, kAtATime> some;
  std::array<Shape, kAtATime> shapes;
  std::size_t used = 0;
  balls_.make_room(kAtATime);
  const auto measure_some = [&] {
    balls_.start(Point<D>{}, used);
    for (std::size_t k = 0; k < used; ++k) set_corners(k, some[k]);
    balls_.run();
    std::array<bool, kAtATime> is_flat;
    for (std::size_t k = 0; k < used; ++k) {
      is_flat[k] = balls_.is_flat(k) && !is_ghost(some[k]);
      shapes[k] = balls_.shape(k);
    }
    for (std::size_t k = 0; k < used; ++k) {
      visit(some[k], is_flat[k] ? measure(some[k]) : shapes[k]);
    }
    used = 0;
  };
  for (std::uint32_t s = 0; s < store_.places(); ++s) {
    if (store_.alive(s)) some[used++] = s;
    if (used == kAtATime) measure_some();
  }
  measure_some();
}

/// From one to the next over facets that have v as a corner.
template <int D, class Layout>
template <class IsWanted>
std::uint32_t DelaunayKernel<D, Layout>::find_in_star(std::uint32_t v,
                                                      std::vector<std::uint32_t>& star,
                                                      IsWanted&& is_wanted) {
  star.assign(1, vertices_[v].simplex);
  mark_[star.front()] = 1;
  const auto look_around = [&](std::uint32_t s) {
    for (std::uint32_t i = 0; i <= D; ++i) {
      const std::uint32_t other = store_.across(s)[i] >> 2;
      if (store_.corners(s)[i] == v || mark_[other] != 0) continue;
      star.push_back(other);
      mark_[other] = 1;
    }
  };
  const auto unmark = [&] {
    for (const std::uint32_t s : star) mark_[s] = 0;
  };
  std::size_t asked = 0;
  try {
    for (; asked < star.size() && !is_wanted(star[asked]); ++asked) look_around(star[asked]);
  } catch (...) {
    unmark();
    throw;
  }
  unmark();
  const std::uint32_t found = asked < star.size() ? star[asked] : kNone;
  star.resize(asked);
  return found;
}

template <int D, class Layout>
template <class Visit>
void DelaunayKernel<D, Layout>::for_each_in_link(Visit&& visit) const {
  if constexpr (D == 2) {  // each begins one edge of the border
    for (const Border& b : borders_) visit(b.corners[kFacet<2>[b.slot][0]]);
  } else {
    for (const std::uint32_t v : link_) visit(v);
  }
}

}  // namespace mesher::detail
