// Quickhull: the convex hull of points in the plane.
//
// The points are cut into chunks (chunk.hpp). The leftmost and the rightmost point divide the hull;
// the points outside of a line from a to b are filtered chunk by chunk; the farthest of them, found
// by contraction (contraction.hpp), is on the hull and gives two lines that are processed in the
// same way. A part of the hull is a call (points, node before, node after): so nothing is appended.
// Few points are done at once.
//
// Points equally far from a line lie on an edge of the hull; the first by coordinates is one of its
// ends. So the hull has corners only, and depends on the set of points alone.
//
// From scratch O(n) where a filter drops a constant part of the points, O(n h) at worst for h
// corners. An inserted or deleted point that is no corner costs one call of each filter that meets
// it, which looks at the chunks that are joined there, and O(log n) where it was farthest of a
// group. Where nearly all points are dropped, as in a square, lists of marks are left; one without
// a farthest point is the end. Source: [Aca05], there without chunks.
#pragma once

#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "chunk.hpp"
#include "contraction.hpp"
#include "point.hpp"

namespace examples {

template <class S>
using PointNode = Node<S, Point>;

/// A convex hull: circular, clockwise; null: of no points.
template <class S>
struct Hull {
  const PointNode<S>* left = nullptr;   ///< the leftmost corner, the lowest of these
  const PointNode<S>* right = nullptr;  ///< the rightmost, the highest of these
  friend bool operator==(const Hull&, const Hull&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Hull& x) {
    sac::label_arguments(sink, std::tie(x.left, x.right));
  }
};
template <class S>
using HullMod = typename S::template ModType<Hull<S>>;

// --- Extremes and farthest points ------------------------------------------------------------

struct Extremes {
  struct Value {
    Point left, right;
    friend bool operator==(const Value&, const Value&) = default;
    friend void label_bytes(sac::LabelSink& sink, const Value& x) {
      sac::label_arguments(sink, std::tie(x.left, x.right));
    }
  };
  static Value join(const Value& a, const Value& b) {
    if (a.left.id == 0) return b;
    if (b.left.id == 0) return a;
    return {std::min(a.left, b.left), further_right(a.right, b.right)};
  }

 private:
  static Point further_right(const Point& a, const Point& b) {
    return same_place(a, b) ? std::min(a, b) : std::max(a, b);
  }
};

struct Farthest {
  struct Value {
    std::int64_t distance = 0;  // times the length of the line
    Point point;
    friend bool operator==(const Value&, const Value&) = default;
    friend void label_bytes(sac::LabelSink& sink, const Value& x) {
      sac::label_arguments(sink, std::tie(x.distance, x.point));
    }
  };
  static Value join(const Value& a, const Value& b) {
    if (a.distance != b.distance) return a.distance > b.distance ? a : b;
    return b.point.id != 0 && b.point < a.point ? b : a;
  }
};

/// A chunk of points, and the fold of them; Op as for contraction.hpp. Who folds further does not
/// run again when points change and their fold does not.
template <class S, class Op>
struct PointChunk {
  struct State {
    std::vector<Point> points;
    const PointChunk* next = nullptr;
    friend bool operator==(const State&, const State&) = default;
    friend void label_bytes(sac::LabelSink& sink, const State& x) {
      sac::label_arguments(sink, std::tie(x.points, x.next));
    }
  };
  struct Folded {
    typename Op::Value value;
    const PointChunk* next = nullptr;
    friend bool operator==(const Folded&, const Folded&) = default;
    friend void label_bytes(sac::LabelSink& sink, const Folded& x) {
      sac::label_arguments(sink, std::tie(x.value, x.next));
    }
  };
  Point boundary;
  int marks = 0;  // as in Chunk
  typename S::template CellType<State> state;
  typename S::template CellType<Folded> folded;
};

/// Collects what goes into a chunk.
template <class S, class Op>
struct PointCollector {
  typename PointChunk<S, Op>::State state;
  typename Op::Value value;

  void add(const Point& p, const typename Op::Value& its_value) {
    state.points.push_back(p);
    value = Op::join(value, its_value);
  }
  void write_to(S& s, const PointChunk<S, Op>& chunk) {
    s.write(chunk.folded, {value, state.next});
    s.write(chunk.state, std::move(state));
  }
};

template <class S>
using AllPoints = PointChunk<S, Extremes>;
template <class S>
using Outside = PointChunk<S, Farthest>;  // of a line

// Chunks are the members of the lowest groups of a contraction.
template <class Op, class S>
[[nodiscard]] typename PointChunk<S, Op>::Folded read_group(S& s, const PointChunk<S, Op>* chunk) {
  return s.read(chunk->folded);
}
template <class S, class Op>
[[nodiscard]] int height(const PointChunk<S, Op>& chunk) noexcept {
  return (heads(chunk.boundary.id) - kChunkBits) / kHeightBits;
}

/// The chunk that begins with `first`, and those behind.
struct CutPoints {
  static constexpr std::string_view kName = "cut_points";
  template <class S>
  void operator()(S& s, AllPoints<S>& self, const PointNode<S>* first) const;
};
inline constexpr CutPoints cut_points{};

template <class S>
void CutPoints::operator()(S& s, AllPoints<S>& self, const PointNode<S>* first) const {
  self.boundary = first->element;
  PointCollector<S, Extremes> cut;
  const auto* next = read_to_boundary(s, first, [&](const Point& p) { cut.add(p, {p, p}); });
  if (next != nullptr) cut.state.next = &s.template tail_make<AllPoints<S>, cut_points>(next);
  cut.write_to(s, self);
}

// --- The hull --------------------------------------------------------------------------------

/// The points of `from`, and of the chunks behind it, that lie to the left of the line from a to b;
/// a filter in the sense of chunk.hpp.
struct KeepOutside {
  static constexpr std::string_view kName = "keep_outside";
  template <class S, class C>
  void operator()(S& s, Outside<S>& self, const C* from, Point a, Point b) const;
};
inline constexpr KeepOutside keep_outside{};

template <class S, class C>
void KeepOutside::operator()(S& s, Outside<S>& self, const C* from, Point a, Point b) const {
  self.boundary = from->boundary;
  self.marks = marks_behind_filter(*from, left_of(a, b, from->boundary) > 0);
  PointCollector<S, Farthest> kept;
  const C* chunk = from;
  std::uint64_t seen = 0;
  Joins joins;
  do {
    const auto& state = s.read(chunk->state);
    for (const Point& p : state.points) {
      if (const std::int64_t d = left_of(a, b, p); d > 0) kept.add(p, {d, p});
    }
    seen += state.points.size() + 1;
    chunk = state.next;
  } while (chunk != nullptr && joins(*chunk, left_of(a, b, chunk->boundary) > 0));
  s.weigh(seen);
  if (chunk != nullptr)
    kept.state.next = &s.template tail_make<Outside<S>, keep_outside>(chunk, a, b);
  kept.write_to(s, self);
}

/// Appends the corners between a and b of the hull of few points. Returns how many points it has
/// looked at, again and again.
inline std::uint64_t hull_of_few(const std::vector<Point>& points, Point a, Point b,
                                 std::vector<Point>& corners) {
  Farthest::Value farthest;
  std::vector<Point> outside;
  for (const Point& p : points) {
    const std::int64_t d = left_of(a, b, p);
    if (d <= 0) continue;
    outside.push_back(p);
    farthest = Farthest::join(farthest, {d, p});
  }
  if (outside.empty()) return points.size();
  std::uint64_t looked = points.size() + hull_of_few(outside, a, farthest.point, corners);
  corners.push_back(farthest.point);
  return looked + hull_of_few(outside, farthest.point, b, corners);
}

/// Links the corners of the hull of `points`, which lie outside of ab, between a and b.
struct HullPart {
  static constexpr std::string_view kName = "hull_part";
  template <class S>
  void operator()(S& s, const Outside<S>* points, PointNode<S>* a, const PointNode<S>* b) const;
};
inline constexpr HullPart hull_part{};

/// The same, where the farthest of the points is known.
struct HullCorner {
  static constexpr std::string_view kName = "hull_corner";
  template <class S>
  void operator()(S& s, const Outside<S>* points,
                  typename S::template ModType<Farthest::Value> farthest, PointNode<S>* a,
                  const PointNode<S>* b) const;
};
inline constexpr HullCorner hull_corner{};

template <class S>
void HullPart::operator()(S& s, const Outside<S>* points, PointNode<S>* a,
                          const PointNode<S>* b) const {
  const auto& state = s.read(points->state);
  if (state.next == nullptr) {
    std::vector<Point> corners;
    s.weigh(hull_of_few(state.points, a->element, b->element, corners));
    return s.write(link_behind(s, a, corners, points)->next, b);
  }
  const auto farthest = s.template cell<Farthest::Value>(points);
  s.template call<fold<Farthest>>(points, farthest);
  s.template tail<hull_corner>(points, farthest, a, b);
}

template <class S>
void HullCorner::operator()(S& s, const Outside<S>* points,
                            typename S::template ModType<Farthest::Value> farthest, PointNode<S>* a,
                            const PointNode<S>* b) const {
  const Point p = s.read(farthest).point;
  if (p.id == 0) return s.write(a->next, b);  // a list of marks alone
  const Outside<S>& left = s.template make<Outside<S>, keep_outside>(points, a->element, p);
  const Outside<S>& right = s.template make<Outside<S>, keep_outside>(points, p, b->element);
  PointNode<S>& corner = node_of(s, p, points);
  s.template call<hull_part>(&left, a, static_cast<const PointNode<S>*>(&corner));
  s.template tail<hull_part>(&right, &corner, b);
}

/// Both parts of the hull, where the extreme points are known.
struct HullOfExtremes {
  static constexpr std::string_view kName = "hull_of_extremes";
  template <class S>
  void operator()(S& s, const AllPoints<S>* points,
                  typename S::template ModType<Extremes::Value> extremes, HullMod<S> result) const;
};
inline constexpr HullOfExtremes hull_of_extremes{};

template <class S>
void HullOfExtremes::operator()(S& s, const AllPoints<S>* points,
                                typename S::template ModType<Extremes::Value> extremes,
                                HullMod<S> result) const {
  const auto [left, right] = s.read(extremes);
  if (left.id == 0) return s.write(result, {});
  PointNode<S>& l = node_of(s, left, points);
  if (same_place(left, right)) {
    s.write(l.next, &l);
    return s.write(result, {&l, &l});
  }
  PointNode<S>& r = node_of(s, right, points);
  s.write(result, {&l, &r});
  const Outside<S>& above = s.template make<Outside<S>, keep_outside>(points, left, right);
  const Outside<S>& below = s.template make<Outside<S>, keep_outside>(points, right, left);
  s.template call<hull_part>(&above, &l, static_cast<const PointNode<S>*>(&r));
  s.template tail<hull_part>(&below, &r, static_cast<const PointNode<S>*>(&l));
}

/// Writes the convex hull of the points of `list` to `result`.
struct Quickhull {
  static constexpr std::string_view kName = "quickhull";
  template <class S>
  void operator()(S& s, const PointNode<S>* list, HullMod<S> result) const {
    const AllPoints<S>* points = &s.template make<AllPoints<S>, cut_points>(list);
    const auto extremes = s.template cell<Extremes::Value>(list);
    s.template call<fold<Extremes>>(points, extremes);
    s.template tail<hull_of_extremes>(points, extremes, result);
  }
};
inline constexpr Quickhull quickhull{};

/// The corners of a hull, from the leftmost, read by the host.
template <class Host, class S>
[[nodiscard]] std::vector<Point> corners_of(Host& host, const Hull<S>& hull) {
  std::vector<Point> corners;
  if (hull.left == nullptr) return corners;
  const PointNode<S>* node = hull.left;
  do {
    corners.push_back(node->element);
    node = host.get(node->next);
  } while (node != hull.left);
  return corners;
}

}  // namespace examples
