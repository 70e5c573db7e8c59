// Features in space: edges and polygons, and the positions of vertices on them.
//
// An *edge* is a straight line between two input points, whoever uses it: a segment of the input,
// or polygons that have it in a loop or declare it to lie inside. A *polygon* lies in a plane and
// is bounded by loops of edges. What lies on a feature is told by labels and by these records,
// never by a predicate: doubles are hardly ever coplanar [rules C1].
//
// Records are found by what they are (an edge by its ends, a polygon by its loops and what lies on
// it), so calls about them are recognised again; they stay where they are until an update ends.
//
// What the program asks about them:
//
//   crowded(s, piece)       whether a piece of an edge, or of a polygon, has to be split [rules C];
//                           an observation of InputFeatures<S> (program/input_features.hpp)
//   find_near(place, R)     the edges, or polygons, within R of a place, in canonical order, and
//   find_in(cell)           those that may meet a cell; Complete asks these of the surroundings of
//                           its cell, which it observes as it is
//   common(f, g, x, store)  what two features share, of several the nearest to x: an edge, a point,
//                           or nothing; a function of the two alone (both:
//                           space/feature_search.hpp)
#pragma once

#include <algorithm>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <vector>

#include "geometry/space_vectors.hpp"
#include "records/segment.hpp"
#include "records/vertex.hpp"
#include "space/dyadic.hpp"
#include "space/edge_tree.hpp"

namespace mesher::detail {

using EdgeHandle = SegmentHandle;     // 0: none
using PolygonHandle = std::uint32_t;  // 0: none
using Edge = SegmentOf<3>;
using EdgePool = SegmentPoolOf<3>;

/// A plane and a frame in it: a function of a polygon's corners alone [rules C2].
struct Plane {
  Point<3> origin{};
  Point<3> normal{};  // eu x ev; all three of length 1, and orthogonal, but for rounding
  Point<3> eu{}, ev{};

  /// Where the foot of x is in the frame.
  [[nodiscard]] Point<2> in_frame(const Point<3>& x) const {
    const Point<3> r = minus(x, origin);
    return {dot(r, eu), dot(r, ev)};
  }
  /// The place at (u, v) of the frame.
  [[nodiscard]] Point<3> at(const Point<2>& uv) const {
    return plus(origin, plus(scaled(uv[0], eu), scaled(uv[1], ev)));
  }
  /// How far x is from the plane, on the normal's side if positive.
  [[nodiscard]] double height(const Point<3>& x) const { return dot(minus(x, origin), normal); }
  /// The foot of x, without error if the plane is across an axis.
  [[nodiscard]] Point<3> foot(const Point<3>& x) const {
    Point<3> foot = minus(x, scaled(height(x), normal));
    for (int i = 0; i < 3; ++i) {
      if (normal[i] == 1) foot[i] = origin[i];
    }
    return foot;
  }
};

/// Part of a plane: what an odd number of loops goes around, the first loop around all others.
///
/// A loop begins at its lexicographically smallest corner and goes on to the smaller of its two
/// neighbours; loops after the first are ascending by their first corners. So equal polygons are
/// equal, however they were entered.
struct Polygon {
  PolygonHandle self = 0;          // in a free record: the next free one
  bool alive = false;              // part of the input that is being meshed
  bool changed = false;            // listed by next_changed
  PolygonHandle next_changed = 0;  // in the list of what has come or gone since the last update
  Plane plane;
  Point<3> middle{};
  double reach = 0;                     // all of it is within this of `middle`
  double thickness = 0;                 // all of it is within this of the plane
  std::vector<VertexHandle> corners;    // loop by loop
  std::vector<std::uint32_t> loop_end;  // one for each loop: the number of corners so far
  std::vector<Point<3>> places;         // of the corners
  std::vector<Point<2>> outline;        // the same in the frame
  Box<2> bounds{};                      // of the outline
  std::vector<bool> inside_left;        // one for each loop: its edges have the inside on the left
  std::vector<EdgeHandle> edges;        // from each corner to the next of its loop
  std::vector<EdgeHandle> inner_edges;  // that are declared to lie inside
  std::vector<VertexHandle> inner_points;  // their ends, and other declared points
  std::vector<Point<3>> inside;            // of the ends of each inner edge, and of inner points
  std::vector<VertexHandle> points;        // all that lie on it: a set, ascending
  std::vector<EdgeHandle> all_edges;       // all that lie on it: a set, ascending
  std::vector<std::uint32_t> corner_of;    // the first from which one leads to the next; kInner
  EdgeTree outline_tree;                   // of edges by the corners that they lead to, by loops
  EdgeTree inner_tree;                     // of inner edges, and then inner points
  static constexpr std::uint32_t kInner = ~std::uint32_t{0};

  /// Whether a point, or an edge, of the input lies on it.
  [[nodiscard]] bool has(VertexHandle v) const noexcept {
    return std::binary_search(points.begin(), points.end(), v);
  }
  [[nodiscard]] bool has_edge(EdgeHandle e) const noexcept {
    return std::binary_search(all_edges.begin(), all_edges.end(), e);
  }
  /// The corner from which an edge that lies on it leads to the next; kInner: none.
  [[nodiscard]] std::uint32_t corner_at(EdgeHandle e) const noexcept {
    const auto at = std::lower_bound(all_edges.begin(), all_edges.end(), e);
    return corner_of[static_cast<std::size_t>(at - all_edges.begin())];
  }
  /// The loop of the i-th corner.
  [[nodiscard]] std::size_t loop_of(std::uint32_t i) const noexcept {
    const auto end = std::upper_bound(loop_end.begin(), loop_end.end(), i);
    return static_cast<std::size_t>(end - loop_end.begin());
  }
  [[nodiscard]] std::uint32_t loop_begin(std::size_t loop) const noexcept {
    return loop == 0 ? 0 : loop_end[loop - 1];
  }
  /// The corner after the i-th in its loop.
  [[nodiscard]] std::uint32_t next(std::uint32_t i) const noexcept {
    const std::size_t loop = loop_of(i);
    return i + 1 < loop_end[loop] ? i + 1 : loop_begin(loop);
  }
  /// The one before it.
  [[nodiscard]] std::uint32_t previous(std::uint32_t i) const noexcept {
    const std::size_t loop = loop_of(i);
    return (i > loop_begin(loop) ? i : loop_end[loop]) - 1;
  }
};

/// Polygons are ordered by their places.
[[nodiscard]] inline std::partial_ordering order(const Polygon& f, const Polygon& g) {
  if (const auto c = f.places <=> g.places; c != 0) return c;
  if (const auto c = f.loop_end <=> g.loop_end; c != 0) return c;
  return f.inside <=> g.inside;
}

/// The place of an edge that is this far from a, by its distance from the nearer end. Compare
/// labels, never coordinates.
[[nodiscard]] inline Label label_at(const Edge& e, double from_a) noexcept {
  return from_a <= e.length / 2 ? Label(from_a, false) : Label(e.length - from_a, true);
}
/// How far from a that is, but for rounding.
[[nodiscard]] inline double from_a(const Edge& e, const Label& label) noexcept {
  return label.from(false, e.length);
}

/// Where that is: measured from the nearer end; an end is where it is, bit for bit.
[[nodiscard]] inline Point<3> place_at(const Edge& e, const Label& label) {
  const Point<3>& o = label.from_b() ? e.place_b : e.place_a;
  const Point<3>& far = label.from_b() ? e.place_a : e.place_b;
  return plus(o, scaled(label.distance() / e.length, minus(far, o)));
}

/// Where the foot of x on the line of an edge is, in fractions of it from a.
[[nodiscard]] inline double foot_fraction(const Edge& e, const Point<3>& x) {
  const Point<3> along = minus(e.place_b, e.place_a);
  return dot(minus(x, e.place_a), along) / squared(along);
}

/// The roundest place of those in a span of an edge, in fractions of it: its middle, or else at the
/// coarsest dyadic distance from the nearer end. So edges that share an end are split at the same
/// distances from it, powers of 2 where they are split the most. Nothing if the span is too short.
[[nodiscard]] inline std::optional<Label> roundest(const Edge& e, const Span& span) noexcept {
  if (span.lo <= 0.5 && span.hi >= 0.5) return Label(e.length / 2, false);
  const bool from_b = span.lo > 0.5;
  const Span near = from_b ? Span{1 - span.hi, 1 - span.lo} : span;
  const auto at = coarsest_dyadic(near.lo * e.length, near.hi * e.length, e.length);
  if (!at) return std::nullopt;
  return Label(*at, from_b);
}

/// A part of an edge between two labelled places, `lo` nearer to a. An argument of traced
/// functions: equal by value, ordered by coordinates.
struct EdgePiece {
  const Edge* edge = nullptr;
  Label lo = Label::start(), hi = Label::end();

  /// Where it is split: in its middle third. Requires: that is not shorter than the finest cells.
  [[nodiscard]] Label middle() const noexcept { return *middle_if_any(); }
  /// The same; nothing if it is too short.
  [[nodiscard]] std::optional<Label> middle_if_any() const noexcept {
    return roundest(*edge, span().middle(1.0 / 3));
  }
  [[nodiscard]] Span span() const noexcept {
    return {from_a(*edge, lo) / edge->length, from_a(*edge, hi) / edge->length};
  }
  [[nodiscard]] double length() const noexcept { return from_a(*edge, hi) - from_a(*edge, lo); }

  friend bool operator==(const EdgePiece&, const EdgePiece&) = default;
  friend std::partial_ordering operator<=>(const EdgePiece& x, const EdgePiece& y) {
    if (const auto c = x.edge->place_a <=> y.edge->place_a; c != 0) return c;
    if (const auto c = x.edge->place_b <=> y.edge->place_b; c != 0) return c;
    if (const auto c = x.span().lo <=> y.span().lo; c != 0) return c;
    return x.span().hi <=> y.span().hi;
  }
  friend std::uint64_t hash_value(const EdgePiece& p) noexcept {
    std::uint64_t h = sac::mix(p.edge->self);
    for (const Label& l : {p.lo, p.hi}) h = sac::mix(h + l.bits());
    return h;
  }
  friend std::ostream& operator<<(std::ostream& out, const EdgePiece& p) {
    const char* separator = "(";
    for (const Label& l : {p.lo, p.hi}) {
      for (const double x : place_at(*p.edge, l)) out << separator << x, separator = " ";
      out << ')', separator = "-(";
    }
    return out;
  }
  friend void label_bytes(sac::LabelSink& sink, const EdgePiece& p) {
    for (const Point<3>& at : {p.edge->place_a, p.edge->place_b}) {
      for (const double x : at) sink.number(std::bit_cast<std::uint64_t>(x));
    }
    for (const Label& l : {p.lo, p.hi}) sink.number(l.bits());
  }
};

/// A point, an edge, a polygon, or nothing.
class Feature {
 public:
  enum class Kind : std::uint8_t { none, point, edge, polygon };
  Feature() = default;
  explicit Feature(const Vertex<3>& v) noexcept : handle_(v.self), kind_(Kind::point) {}
  explicit Feature(const Edge& e) noexcept : handle_(e.self), kind_(Kind::edge) {}
  explicit Feature(const Polygon& f) noexcept : handle_(f.self), kind_(Kind::polygon) {}

  [[nodiscard]] explicit operator bool() const noexcept { return kind_ != Kind::none; }
  [[nodiscard]] Kind kind() const noexcept { return kind_; }
  [[nodiscard]] std::uint32_t handle() const noexcept { return handle_; }
  friend bool operator==(const Feature&, const Feature&) = default;

 private:
  std::uint32_t handle_ = 0;
  Kind kind_ = Kind::none;
};

}  // namespace mesher::detail
