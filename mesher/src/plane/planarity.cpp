// Exact tests of pairs, and what is said of them.
#include "plane/planarity.hpp"

#include <string>
#include <tuple>

#include "geometry/input_point.hpp"
#include "geometry/segment_tests.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {

namespace {

bool on_one_line(const Segment& s, const Segment& t) {
  return predicates::orient2d(s.place_a, s.place_b, t.place_a) == 0 &&
         predicates::orient2d(s.place_a, s.place_b, t.place_b) == 0;
}

// Of segments on one line: whether they have more than a point in common.
bool overlap(const Segment& s, const Segment& t) {
  return std::max(s.place_a, t.place_a) < std::min(s.place_b, t.place_b);
}

// Of segments with a common end, which is on both lines: the other end of t decides. So that legs
// of a hub, each pair of which is looked at, need no exact arithmetic.
bool overlap_beyond_end(const Segment& s, const Segment& t) {
  const Point<2>& other = s.has_end(t.a) ? t.place_b : t.place_a;
  return overlap(s, t) && predicates::orient2d(s.place_a, s.place_b, other) == 0;
}

// Pieces of a polyline have one id.
std::string other_text(LineId line, LineId other) {
  return line == other ? "itself" : "segment " + id_text(other);
}

}  // namespace

namespace planarity {

std::optional<Conflict> conflict_with(const Segment& s, const Segment& t) {
  const Conflict overlapping{Conflict::Kind::overlap, &s, &t, nullptr};
  if (s.has_end(t.a) || s.has_end(t.b)) {
    return overlap_beyond_end(s, t) ? std::optional(overlapping) : std::nullopt;
  }
  if (!segments_meet(s.place_a, s.place_b, t.place_a, t.place_b)) return std::nullopt;
  if (on_one_line(s, t)) return overlap(s, t) ? std::optional(overlapping) : std::nullopt;
  return Conflict{Conflict::Kind::crossing, &s, &t, nullptr};
}

std::optional<Conflict> conflict_with(const Segment& s, const Vertex<2>& v) {
  if (s.has_end(v.self) || !on_segment(v.p, s.place_a, s.place_b)) return std::nullopt;
  return Conflict{Conflict::Kind::point_on_segment, &s, nullptr, &v};
}

void keep_first(std::optional<Conflict>& first, const std::optional<Conflict>& conflict) {
  if (!conflict.has_value()) return;
  const auto key = [](const Conflict& c) {
    const Segment& other = c.other != nullptr ? *c.other : *c.segment;
    const Point<2>& p = c.point != nullptr ? c.point->p : other.place_a;
    return std::tuple(c.kind, p, other.place_a, other.place_b);
  };
  if (!first.has_value() || key(*conflict) < key(*first)) first = conflict;
}

}  // namespace planarity

std::optional<Conflict> conflict_of(const Vertex<2>& v, SegmentStore& segments) {
  std::optional<Conflict> first;
  segments.visit_near(v.p, v.p, 0, [&](const Segment& s) {
    planarity::keep_first(first, planarity::conflict_with(s, v));
    return false;
  });
  return first;
}

Point<2> crossing(const Segment& s, const Segment& t) {
  const double ux = s.place_b[0] - s.place_a[0], uy = s.place_b[1] - s.place_a[1];
  const double wx = t.place_b[0] - t.place_a[0], wy = t.place_b[1] - t.place_a[1];
  const double dx = t.place_a[0] - s.place_a[0], dy = t.place_a[1] - s.place_a[1];
  const double det = ux * wy - uy * wx;
  const double at = det != 0 ? std::clamp((dx * wy - dy * wx) / det, 0.0, 1.0) : 0;
  return {s.place_a[0] + at * ux, s.place_a[1] + at * uy};
}

void fail_repeated(LineId line, LineId other, const Segment& s) {
  throw Error(ErrorCode::repeated_segment,
              "segment " + id_text(line) + " is " + other_text(line, other) + " again, from " +
                  place_text(s.place_a) + " to " + place_text(s.place_b),
              {}, {mesher::Feature(line), mesher::Feature(other)},
              {position_of(s.place_a), position_of(s.place_b)});
}

void fail_zero_length(LineId line, PointId point, std::vector<Position> places) {
  throw Error(ErrorCode::zero_length,
              "segment " + id_text(line) + " goes from point " + id_text(point) + " to itself", {},
              {mesher::Feature(line), mesher::Feature(point)}, std::move(places));
}

VertexHandle fail_no_end(PointId point, LineId line) {
  throw Error(ErrorCode::unknown_id,
              "point " + id_text(point) + ", an end of segment " + id_text(line) + ", is not there",
              {}, {mesher::Feature(point), mesher::Feature(line)});
}

Error too_close_to_segment(const PieceRef& piece, Witness witness, const Names* names,
                           const VertexPool<2>& points, const SegmentPool& segments) {
  std::vector<mesher::Feature> features;
  std::string segment = "a segment";
  std::string other = "another";
  if (names != nullptr) {
    features.push_back(mesher::Feature(names->line(piece.piece.segment)));
    segment = text_of(features[0]);
  }
  if (witness.point() != 0) {
    other = "point ";
    if (names != nullptr) {
      features.push_back(mesher::Feature(names->point(witness.point())));
      other = text_of(features.back()) + " ";
    }
    other += place_text(points[witness.point()].p);
  } else if (names != nullptr && witness.segment() != 0) {
    features.push_back(mesher::Feature(names->line(segments[witness.segment()].self)));
    other = text_of(features.back());
  }
  return Error(ErrorCode::too_close,
               segment + " is too close to " + other + " near " + place_text(piece.lo()) +
                   " for double precision",
               {}, std::move(features), {position_of(piece.lo())});
}

Error too_close_vertices(const Vertex<2>& v, const Vertex<2>& w, const Names& names,
                         const Roles& roles) {
  std::vector<mesher::Feature> features;
  const auto feature = [&](const Vertex<2>& x) -> std::string {
    if (x.input) return text_of(features.emplace_back(mesher::Feature(names.point(x.self))));
    if (!x.on_segment) return "a segment";
    return text_of(features.emplace_back(mesher::Feature(names.line(roles[x.self].on))));
  };
  const std::string first = feature(v) + " needs a vertex at " + place_text(v.p);
  const std::string second = feature(w) + " one at " + place_text(w.p);
  return Error(ErrorCode::too_close,
               "features are too close to each other: " + first + ", " + second +
                   "; these share a cell of 2^-50 of the meshing box's side",
               {}, std::move(features), {position_of(v.p), position_of(w.p)});
}

namespace {

[[noreturn]] void fail_on_segment(PointId point, const Point<2>& p, LineId line) {
  throw Error(ErrorCode::point_on_segment,
              "point " + id_text(point) + " " + place_text(p) + " lies on segment " + id_text(line),
              {}, {mesher::Feature(point), mesher::Feature(line)}, {position_of(p)});
}

// An end of s on t is named as a point on a segment, whichever of the two is looked at first.
void fail_if_end_is_on(const Segment& s, const Segment& t, const Names& names) {
  const auto test = [&](VertexHandle end, const Point<2>& p) {
    if (!on_segment(p, t.place_a, t.place_b)) return;
    fail_on_segment(names.point(end), p, names.line(t.self));
  };
  test(s.a, s.place_a);
  test(s.b, s.place_b);
}

}  // namespace

void fail(const Conflict& c, const Names& names) {
  const LineId line = names.line(c.segment->self);
  if (c.kind == Conflict::Kind::point_on_segment) {
    fail_on_segment(names.point(c.point->self), c.point->p, line);
  }
  const LineId other = names.line(c.other->self);
  if (c.kind == Conflict::Kind::crossing) {
    fail_if_end_is_on(*c.segment, *c.other, names);
    fail_if_end_is_on(*c.other, *c.segment, names);
    throw Error(ErrorCode::crossing_segments,
                "segment " + id_text(line) + " crosses " + other_text(line, other) + " at " +
                    place_text(crossing(*c.segment, *c.other)),
                {}, {mesher::Feature(line), mesher::Feature(other)},
                {position_of(crossing(*c.segment, *c.other))});
  }
  const Point<2> from = std::max(c.segment->place_a, c.other->place_a);
  const Point<2> to = std::min(c.segment->place_b, c.other->place_b);
  throw Error(ErrorCode::overlapping_segments,
              "segment " + id_text(line) + " overlaps " + other_text(line, other) + " from " +
                  place_text(from) + " to " + place_text(to),
              {}, {mesher::Feature(line), mesher::Feature(other)},
              {position_of(from), position_of(to)});
}

}  // namespace mesher::detail
