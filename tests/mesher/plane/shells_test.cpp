// Where pieces are split, and what crowds them: what the rules promise of single cases [A1, A2].
#include "plane/shells.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <deque>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "plane/crowding.hpp"
#include "plane/input_segments.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::CrowdedZone;
using mesher::detail::Halves;
using mesher::detail::InputSegments;
using mesher::detail::Label;
using mesher::detail::MeshBox;
using mesher::detail::PieceKind;
using mesher::detail::PieceRef;
using mesher::detail::Vertex;
using mesher::detail::VertexHandle;

const MeshBox<2> kBox{.lo = {-16, -16}, .side = 64};

// An input of points and segments, without a mesh.
struct Input {
  sac::PlainScope scope;
  mesher::detail::VertexIndex<sac::PlainScope> vertices{kBox};
  mesher::detail::Features<sac::PlainScope> points{kBox, vertices.pool(), scope};
  InputSegments<sac::PlainScope> segments{kBox, vertices, points, scope};

  VertexHandle point(const Point<2>& p) {
    Vertex<2>& v = vertices.add_input(p, true);
    points.tree().insert_only(v);
    return v.self;
  }
  PieceRef segment(VertexHandle a, VertexHandle b) { return segments.insert(a, b); }
  bool crowded(const PieceRef& piece) { return segments.crowded(scope, piece); }
  Halves halves(const PieceRef& piece) { return segments.halves(scope, piece); }

  // The places at which a segment is split until no piece is longer than `longest`.
  std::vector<Label> split(const PieceRef& whole, double longest) {
    std::vector<Label> places;
    std::deque<PieceRef> open{whole};
    while (!open.empty()) {
      const PieceRef piece = open.front();
      open.pop_front();
      if (piece.length() <= longest) continue;
      const Halves h = halves(piece);
      places.push_back(h.role.label);
      open.insert(open.end(), {h.lower, h.upper});
    }
    return places;
  }
};

// Distances from an end, sorted.
std::vector<double> distances(const std::vector<Label>& labels, bool from_b, double length) {
  std::vector<double> d;
  for (const Label& l : labels) d.push_back(l.from(from_b, length));
  std::sort(d.begin(), d.end());
  return d;
}

bool is_power_of_two(double x) {
  int e = 0;
  return std::frexp(x, &e) == 0.5;
}

}  // namespace

TEST_CASE("halves are at least a third of their piece, and tile it [rules A1]") {
  SplitMix64 random(1);
  for (int i = 0; i < 200; ++i) {
    Input in;
    const VertexHandle o = in.point({16 * random.unit(), 16 * random.unit()});
    const PieceRef s = in.segment(o, in.point({16 * random.unit(), 16 * random.unit()}));
    // Others at both ends, at any angle.
    for (const VertexHandle end : {s.segment->a, s.segment->b}) {
      if (random.below(2) == 0) in.segment(end, in.point({16 * random.unit(), 16 * random.unit()}));
    }
    std::deque<PieceRef> open{s};
    while (!open.empty()) {
      const PieceRef piece = open.front();
      open.pop_front();
      if (piece.length() < s.length() / 100) continue;
      const Halves h = in.halves(piece);
      for (const PieceRef& half : {h.lower, h.upper}) {
        REQUIRE(half.length() > piece.length() * (1 / 3.0 - 1e-9));
        open.push_back(half);
      }
      REQUIRE(h.lower.piece.lo == piece.piece.lo);
      REQUIRE(h.lower.piece.hi == h.upper.piece.lo);
      REQUIRE(h.upper.piece.hi == piece.piece.hi);
      REQUIRE(h.place == h.lower.hi());
    }
  }
}

TEST_CASE("segments that meet at a small angle are split at equal distances from there") {
  for (const double angle : {0.3, 0.03, 1e-6}) {
    for (const double ratio : {1.0, 0.7, 0.13}) {
      Input in;
      const VertexHandle o = in.point({1, 1});
      const PieceRef s = in.segment(o, in.point({13, 2}));
      const double l = ratio * s.segment->length;
      const double turn = std::atan2(1, 12) + angle;
      const PieceRef t = in.segment(o, in.point({1 + l * std::cos(turn), 1 + l * std::sin(turn)}));
      const auto on_s = distances(in.split(s, 0.05), false, s.segment->length);
      const auto on_t = distances(in.split(t, 0.05), false, t.segment->length);
      int beside = 0;  // on s, in the part that t has as well, but for t's end
      for (const double d : on_t) {
        if (d > t.segment->length / 2) continue;
        CHECK(std::binary_search(on_s.begin(), on_s.end(), d));
        ++beside;
      }
      CHECK(beside > 3);
      CHECK(is_power_of_two(on_s.front()));
      CHECK(on_s.front() == on_t.front());
    }
  }
}

TEST_CASE("the end beside which there is a small angle is where distances are measured from") {
  Input in;
  const VertexHandle b = in.point({13, 2});
  const PieceRef s = in.segment(in.point({1, 1}), b);
  in.segment(b, in.point({1, 1.5}));
  const auto from_b = distances(in.split(s, 0.5), true, s.segment->length);
  CHECK(is_power_of_two(from_b.front()));
  for (const double d : from_b) CHECK(d * 64 == std::floor(d * 64));
}

TEST_CASE("a segment with a small angle at both ends is measured from both, to its middle") {
  Input in;
  const VertexHandle a = in.point({1, 1}), b = in.point({13, 1});
  const PieceRef s = in.segment(a, b);
  in.segment(a, in.point({13, 2}));
  in.segment(b, in.point({1, 0}));
  const auto from_a = distances(in.split(s, 0.5), false, 12);
  const auto from_b = distances(in.split(s, 0.5), true, 12);
  CHECK(from_a == from_b);
  CHECK(std::binary_search(from_a.begin(), from_a.end(), 6.0));
}

TEST_CASE("a point on the circle of a piece crowds it, a segment that touches it does not") {
  const auto crowded_by_point = [](const Point<2>& p) {
    Input in;
    const PieceRef s = in.segment(in.point({0, 0}), in.point({8, 0}));
    in.point(p);
    return in.crowded(s);
  };
  CHECK(crowded_by_point({4, 4}));
  CHECK_FALSE(crowded_by_point({4, std::nextafter(4.0, 5.0) + 1e-9}));
  CHECK(crowded_by_point({-0.99, 0}));  // an eighth of the length
  CHECK_FALSE(crowded_by_point({-1, 0}));
  const auto crowded_by_segment = [](double y) {
    Input in;
    const PieceRef s = in.segment(in.point({0, 0}), in.point({8, 0}));
    in.segment(in.point({-6, y}), in.point({14, y}));
    return in.crowded(s);
  };
  CHECK(crowded_by_segment(3.99));
  CHECK_FALSE(crowded_by_segment(4));
}

TEST_CASE("a segment with a common end does not crowd a piece, but its far end does") {
  Input in;
  const VertexHandle o = in.point({0, 0});
  const PieceRef s = in.segment(o, in.point({8, 0}));
  const VertexHandle far = in.point({9, 9});
  in.segment(o, far);
  CHECK_FALSE(in.crowded(s));
  in.segment(o, in.point({5, 3}));
  CHECK(in.crowded(s));
  CHECK(in.segments.witness(s).point() != 0);
}
