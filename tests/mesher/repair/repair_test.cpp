// Repaired graphs: planar by exact arithmetic, near what was there, and what a mesher takes.
#include "mesher/repair.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "geometry/segment_tests.hpp"
#include "repair/box_search.hpp"

namespace {

using mesher::Graph;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using mesher::repair;
using mesher::Repaired;
using mesher::RepairKind;
using Exact = boost::multiprecision::int1024_t;

AnyId id(std::int64_t i) { return AnyId{i}; }

using Piece = std::array<Point<2>, 2>;
struct Pieces {
  std::vector<Piece> pieces;
  std::vector<LineId> lines;
};

Pieces pieces_of(const Graph<2>& g) {
  std::map<PointId, Point<2>> at;
  for (const auto& p : g.points) at[p.id] = p.at;
  Pieces all;
  for (const auto& s : g.segments) {
    all.pieces.push_back({at.at(s.from), at.at(s.to)});
    all.lines.push_back(s.id);
  }
  for (const auto& line : g.polylines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      all.pieces.push_back({at.at(line.points[i - 1]), at.at(line.points[i])});
      all.lines.push_back(line.id);
    }
  }
  return all;
}

// A coordinate is a multiple of 2^-152 below 2^101; so these are integers.
Exact difference(double x, double y) {
  return Exact(std::ldexp(x, 160)) - Exact(std::ldexp(y, 160));
}

int exact_orientation(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  const Exact ux = difference(b[0], a[0]), uy = difference(b[1], a[1]);
  const Exact wx = difference(c[0], a[0]), wy = difference(c[1], a[1]);
  const Exact area = ux * wy - uy * wx;
  return area.sign();
}

bool between(double x, double a, double b) { return std::min(a, b) <= x && x <= std::max(a, b); }

bool exactly_on(const Point<2>& p, const Piece& s) {
  return exact_orientation(s[0], s[1], p) == 0 && between(p[0], s[0][0], s[1][0]) &&
         between(p[1], s[0][1], s[1][1]);
}

// Whether the closed segments have a point in common that is no end of both, exactly.
bool exactly_meet(const Piece& s, const Piece& t) {
  const auto is_end = [](const Point<2>& p, const Piece& of) { return p == of[0] || p == of[1]; };
  if (s == t || (s[0] == t[1] && s[1] == t[0])) return true;
  for (const auto& p : s) {
    if (!is_end(p, t) && exactly_on(p, t)) return true;
  }
  for (const auto& p : t) {
    if (!is_end(p, s) && exactly_on(p, s)) return true;
  }
  return exact_orientation(s[0], s[1], t[0]) * exact_orientation(s[0], s[1], t[1]) < 0 &&
         exact_orientation(t[0], t[1], s[0]) * exact_orientation(t[0], t[1], s[1]) < 0;
}

void require_planar(const Graph<2>& g) {
  const auto pieces = pieces_of(g).pieces;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    REQUIRE(pieces[i][0] != pieces[i][1]);
    for (std::size_t j = 0; j < i; ++j) {
      if (exactly_meet(pieces[i], pieces[j])) FAIL("pieces " << j << " and " << i << " meet");
    }
    for (const auto& p : g.points) {
      const bool end = p.at == pieces[i][0] || p.at == pieces[i][1];
      if (!end && exactly_on(p.at, pieces[i])) FAIL("a point is on piece " << i);
    }
  }
  std::set<Point<2>> places;
  for (const auto& p : g.points) REQUIRE(places.insert(p.at).second);
}

double distance(const Point<2>& p, const std::vector<Piece>& pieces) {
  double best = std::numeric_limits<double>::infinity();
  for (const Piece& s : pieces) best = std::min(best, mesher::detail::distance2(p, s[0], s[1]));
  return std::sqrt(best);
}

// All of `these` is within `most` of those, at some places of each.
void require_covered(const std::vector<Piece>& these, const std::vector<Piece>& those,
                     double most) {
  double farthest = 0;
  for (const Piece& s : these) {
    for (int i = 0; i <= 8; ++i) {
      const double t = i / 8.0;
      const Point<2> p{s[0][0] + t * (s[1][0] - s[0][0]), s[0][1] + t * (s[1][1] - s[0][1])};
      farthest = std::max(farthest, distance(p, those));
    }
  }
  REQUIRE(farthest <= most);
}

void require_distinct_ids(const Graph<2>& g) {
  std::set<PointId> points;
  std::set<LineId> lines;
  for (const auto& p : g.points) REQUIRE(points.insert(p.id).second);
  for (const auto& s : g.segments) REQUIRE(lines.insert(s.id).second);
  for (const auto& line : g.polylines) REQUIRE(lines.insert(line.id).second);
}

// Without the order of its elements.
Graph<2> sorted(Graph<2> g) {
  const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
  std::sort(g.points.begin(), g.points.end(), by_id);
  std::sort(g.segments.begin(), g.segments.end(), by_id);
  std::sort(g.polylines.begin(), g.polylines.end(), by_id);
  return g;
}

// A mesher takes it as it is.
void require_meshable(const Graph<2>& g) {
  std::vector<Point<2>> points;
  std::vector<PointId> ids;
  for (const auto& p : g.points) points.push_back(p.at), ids.push_back(p.id);
  mesher::BoxMesher<2> m({.domain = mesher::snapped_domain<2>(points), .max_vertices = 100000});
  m.insert(ids, points);
  for (const auto& s : g.segments) m.insert_segment(s.id, s.from, s.to);
  for (const auto& line : g.polylines) m.insert_polyline(line.id, line.points);
  m.update();
}

double coordinate_unit(const Graph<2>& g) {
  double most = 0;
  for (const auto& p : g.points) most = std::max({most, std::abs(p.at[0]), std::abs(p.at[1])});
  return std::nextafter(most, 1e300) - most;
}

// What holds of every repaired graph.
void require_repaired(const Graph<2>& g, const Repaired<2>& repaired) {
  const Graph<2>& now = repaired.file.graph;
  require_planar(now);
  require_distinct_ids(now);
  INFO(repaired.deviation / repaired.tolerance << " tolerances");
  CHECK(repaired.deviation <= 8 * repaired.tolerance);
  const double most = repaired.deviation + 8 * coordinate_unit(g);
  auto left = pieces_of(now).pieces;
  for (const auto& p : now.points) left.push_back({p.at, p.at});  // of what has no length
  require_covered(pieces_of(g).pieces, left, most);
  require_covered(pieces_of(now).pieces, pieces_of(g).pieces, most);
  const Repaired<2> again = repair(now);
  REQUIRE(again.file.graph == now);
  REQUIRE(again.notes.empty());
  REQUIRE(again.deviation == 0);
}

// 0 is the least; others are shares of what is there.
constexpr double kTolerances[] = {0, 1e-6, 0.02};

// Points and lines on a small lattice: many meet, overlap, and are there twice.
class Nasty {
 public:
  explicit Nasty(std::uint64_t seed) : random_(seed) {}

  Graph<2> lattice(std::int64_t width, std::size_t points, std::size_t lines) {
    Graph<2> g;
    for (std::size_t i = 0; i < points; ++i) {
      const Point<2> p{static_cast<double>(below(width)), static_cast<double>(below(width))};
      g.points.push_back({id(10 + static_cast<std::int64_t>(i)), p, 0});
    }
    for (std::size_t i = 0; i < lines; ++i) {
      const auto line = id(100 + static_cast<std::int64_t>(i));
      const auto marker = static_cast<std::int64_t>(i % 5);
      if (below(4) != 0) {
        g.segments.push_back({line, some(g), some(g), marker});
        continue;
      }
      std::vector<PointId> along;
      for (std::int64_t k = 2 + below(4); k > 0; --k) along.push_back(some(g));
      if (below(2) == 0) along.push_back(along.front());
      g.polylines.push_back({line, along, marker});
    }
    return g;
  }
  void shuffle(Graph<2>& g) {
    std::shuffle(g.points.begin(), g.points.end(), random_);
    std::shuffle(g.segments.begin(), g.segments.end(), random_);
    std::shuffle(g.polylines.begin(), g.polylines.end(), random_);
  }
  std::int64_t below(std::int64_t n) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(n));
  }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

 private:
  PointId some(const Graph<2>& g) {
    return g.points[static_cast<std::size_t>(below(static_cast<std::int64_t>(g.points.size())))].id;
  }
  std::mt19937_64 random_;
};

Graph<2> moved(Graph<2> g, double scale, double by) {
  for (auto& p : g.points) p.at = {p.at[0] * scale + by, p.at[1] * scale + by / 2};
  return g;
}

Graph<2> two_crossing() {
  Graph<2> g;
  g.points = {{id(1), {0, 0}, 0}, {id(2), {4, 4}, 0}, {id(3), {0, 4}, 0}, {id(4), {4, 0}, 0}};
  g.segments = {{id(7), id(1), id(2), 5}, {id(8), id(3), id(4), 6}};
  return g;
}

}  // namespace

TEST_CASE("random lines on small lattices become planar, near what they were, for a mesher") {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    INFO("seed " << seed);
    Nasty nasty(seed);
    const auto size = static_cast<std::size_t>(4 + nasty.below(20));
    const Graph<2> g = nasty.lattice(2 + nasty.below(8), size, size);
    const Repaired<2> repaired = repair(g);
    require_repaired(g, repaired);
    require_meshable(repaired.file.graph);
  }
}

TEST_CASE("a repair takes scales and places from one end of the range to the other") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Nasty nasty(seed);
    const Graph<2> g = nasty.lattice(7, 14, 14);
    for (const double scale : {0x1p-90, 1e-20, 1 / 3.0, 1e20, 0x1p70}) {
      for (const double by : {0.0, 1.0, 1e3, 1e7}) {
        INFO("seed " << seed << " scale " << scale << " by " << by);
        const Graph<2> there = moved(g, scale, by * scale);
        require_repaired(there, repair(there));
      }
    }
  }
}

TEST_CASE("what a repair makes depends on places and ids, not on the order of the input") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    Nasty nasty(seed);
    Graph<2> g = moved(nasty.lattice(6, 16, 16), 1 / 3.0, 0.1);
    const Repaired<2> repaired = repair(g);
    nasty.shuffle(g);
    const Repaired<2> other = repair(g);
    REQUIRE(sorted(other.file.graph) == sorted(repaired.file.graph));
    REQUIRE(other.notes.size() == repaired.notes.size());
    for (std::size_t i = 0; i < other.notes.size(); ++i) {
      REQUIRE(other.notes[i].text() == repaired.notes[i].text());
    }
  }
}

TEST_CASE("long lines at tiny angles and bundles through one place end") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    INFO("seed " << seed);
    Nasty nasty(seed);
    Graph<2> g;
    const double spread = std::pow(10, -15 * nasty.unit());
    for (std::int64_t i = 0; i < 24; ++i) {
      const bool bundle = seed % 2 == 0;
      const double y = bundle ? spread * (2 * nasty.unit() - 1) : spread * nasty.unit();
      const double end = bundle ? -y : spread * nasty.unit();
      g.points.push_back({id(2 * i), {0, y}, 0});
      g.points.push_back({id(2 * i + 1), {1, end}, 0});
      g.segments.push_back({id(i), id(2 * i), id(2 * i + 1), 0});
    }
    for (const double t : kTolerances) require_repaired(g, repair(g, {.tolerance = t}));
  }
}

TEST_CASE("hubs through which many lines lead, and other lines, become planar in any order") {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    INFO("seed " << seed);
    Nasty nasty(seed);
    const double spread = std::pow(10, -5 * nasty.unit() * static_cast<double>(seed % 2));
    const std::int64_t hubs = 1 + nasty.below(3);
    std::vector<Point<2>> at;
    for (std::int64_t i = 0; i < hubs; ++i) at.push_back({nasty.unit(), nasty.unit()});
    Graph<2> g;
    for (std::int64_t i = 0; i < 70; ++i) {
      const Point<2>& hub = at[static_cast<std::size_t>(i % hubs)];
      const double angle = 3.14 * spread * nasty.unit();
      const double x = std::cos(angle), y = std::sin(angle), r = nasty.unit(), q = nasty.unit();
      Point<2> a{hub[0] + r * x, hub[1] + r * y}, b{hub[0] - q * x, hub[1] - q * y};
      if (i % 9 == 8) a = {nasty.unit(), nasty.unit()}, b = {nasty.unit(), nasty.unit()};
      g.points.push_back({id(2 * i), a, 0});
      g.points.push_back({id(2 * i + 1), b, 0});
      g.segments.push_back({id(i), id(2 * i), id(2 * i + 1), 0});
    }
    for (const double t : kTolerances) {
      if (t > 0 && seed % 4 > 1) continue;  // it takes as long as with the least
      const Repaired<2> repaired = repair(g, {.tolerance = t});
      require_repaired(g, repaired);
      nasty.shuffle(g);
      REQUIRE(sorted(repair(g, {.tolerance = t}).file.graph) == sorted(repaired.file.graph));
    }
  }
}

TEST_CASE("of lines through one place each is looked at a few times, and one point is made") {
  const std::int64_t n = 2000;
  Graph<2> g;
  mesher::detail::Drawing<2> drawing({.lo = {-4, -4}}, 0x1p-41);
  for (std::int64_t i = 0; i < n; ++i) {
    const double angle = 3.141592653589793 * (static_cast<double>(i) + 0.5) / n;
    const double x = std::cos(angle), y = std::sin(angle);
    g.points.push_back({id(2 * i), {0.3 + x, 0.2 + y}, 0});
    g.points.push_back({id(2 * i + 1), {0.3 - x, 0.2 - y}, 0});
    g.segments.push_back({id(i), id(2 * i), id(2 * i + 1), 0});
    const auto a = drawing.add_spot({0.3 + x, 0.2 + y}), b = drawing.add_spot({0.3 - x, 0.2 - y});
    drawing.rod(a, b);
  }
  std::int64_t looks = 0;
  mesher::detail::BoxSearch(drawing).rods_and_rods({}, [&](auto, auto, const auto&) {
    ++looks;
    return true;
  });
  CHECK(looks <= 8 * n);
  const Repaired<2> repaired = repair(g);
  CHECK(repaired.file.graph.points.size() == 2 * n + 1);
  CHECK(repaired.notes.size() == 1);
  CHECK(repaired.deviation <= repaired.tolerance);
}

TEST_CASE("a crossing gets a point, and both lines keep id and marker") {
  const Repaired<2> repaired = repair(two_crossing());
  const Graph<2>& g = repaired.file.graph;
  CHECK(g.segments.empty());
  REQUIRE(g.points.size() == 5);
  CHECK(g.points[4] == mesher::GraphPoint<2>{id(5), {2, 2}, 5});
  CHECK(g.polylines == std::vector<mesher::Polyline>{{id(7), {id(1), id(5), id(2)}, 5},
                                                     {id(8), {id(3), id(5), id(4)}, 6}});
  CHECK(repaired.deviation == 0);
  REQUIRE(repaired.notes.size() == 1);
  CHECK(repaired.notes[0].kind == RepairKind::split_at_crossing);
  CHECK(repaired.notes[0].text() == "lines 7 and 8 cross at (2, 2), point 5 now");
}

TEST_CASE("crossings that are doubles are found to the last bit") {
  Nasty nasty(3);
  for (int k = 0; k < 300; ++k) {
    // Two lines through a place with few bits.
    const Point<2> at{nasty.below(1000) / 64.0, nasty.below(1000) / 64.0};
    Graph<2> g;
    for (std::int64_t i = 0; i < 2; ++i) {
      const double x = 1 + static_cast<double>(nasty.below(900));
      const double y = 1 + static_cast<double>(nasty.below(900)) * (i == 0 ? 1.0 : -1.0);
      const double u = 1 + static_cast<double>(nasty.below(5));
      const double w = 1 + static_cast<double>(nasty.below(5));
      g.points.push_back({id(2 * i), {at[0] + u * x, at[1] + u * y}, 0});
      g.points.push_back({id(2 * i + 1), {at[0] - w * x, at[1] - w * y}, 0});
      g.segments.push_back({id(i), id(2 * i), id(2 * i + 1), 0});
    }
    const Graph<2> now = repair(g).file.graph;
    REQUIRE(now.points.size() == 5);
    REQUIRE(now.points[4].at == at);
  }
}

TEST_CASE("a point on a line becomes a point of it") {
  Graph<2> g;
  g.points = {{id(1), {0, 0}, 0}, {id(2), {6, 3}, 0}, {id(3), {2, 1}, 0}, {id(4), {2, 5}, 0}};
  g.segments = {{id(1), id(1), id(2), 0}, {id(2), id(4), id(3), 0}};
  const Repaired<2> repaired = repair(g);
  CHECK(repaired.file.graph.segments == std::vector<mesher::Segment>{{id(2), id(4), id(3), 0}});
  CHECK(repaired.file.graph.polylines ==
        std::vector<mesher::Polyline>{{id(1), {id(1), id(3), id(2)}, 0}});
  REQUIRE(repaired.notes.size() == 1);
  CHECK(repaired.notes[0].text() == "line 1 is split at point 3 (2, 1)");
}

TEST_CASE("of points in one place the one of the smallest id stays, with a marker of the others") {
  Graph<2> g;
  g.points = {{id(9), {1, 1}, 0}, {id(4), {1, 1}, 0}, {id(5), {1, 1}, 7}, {id(6), {3, 1}, 0}};
  g.attributes_per_point = 1;
  g.attributes = {90, 40, 50, 60};
  g.segments = {{id(1), id(9), id(6), 0}, {id(2), id(9), id(5), 0}};
  const Repaired<2> repaired = repair(g);
  const Graph<2>& now = repaired.file.graph;
  CHECK(now.points == std::vector<mesher::GraphPoint<2>>{{id(4), {1, 1}, 7}, {id(6), {3, 1}, 0}});
  CHECK(now.attributes == std::vector<double>{40, 60});
  CHECK(now.segments == std::vector<mesher::Segment>{{id(1), id(4), id(6), 0}});
  std::vector<std::string> notes;
  for (const auto& note : repaired.notes) notes.push_back(note.text());
  CHECK(notes ==
        std::vector<std::string>{"point 5 is point 4 at (1, 1)", "point 9 is point 4 at (1, 1)",
                                 "line 2: a piece without length is dropped, at point 4 (1, 1)",
                                 "line 2 is dropped: nothing is left of it"});
}

TEST_CASE("points merge that a mesher would refuse as too close") {
  const double near = 0x1p-49 * 8;  // of a box of side 8
  Graph<2> g;
  g.points = {{id(2), {1, 1}, 0}, {id(1), {1 + near, 1}, 0}, {id(3), {0, 0}, 0}};
  g.points.push_back({id(4), {2, 2}, 0});
  const Repaired<2> repaired = repair(g, {.domain = mesher::Box<2>{{0, 0}, {2, 2}}});
  REQUIRE(repaired.file.graph.points.size() == 3);
  CHECK(repaired.file.graph.points[0].id == id(2));
  CHECK(repaired.deviation == near);
  CHECK(repaired.notes[0].points == std::vector{PointId{1}, PointId{2}});
}

TEST_CASE("what two lines cover is the line's of the smaller id, and a gap ends a name") {
  Graph<2> g;
  for (std::int64_t i = 0; i < 6; ++i) g.points.push_back({id(i), {static_cast<double>(i), 0}, 0});
  g.segments = {{id(3), id(0), id(5), 8}, {id(1), id(2), id(3), 0}};
  const Repaired<2> repaired = repair(g);
  const Graph<2>& now = repaired.file.graph;
  CHECK(now.segments == std::vector<mesher::Segment>{{id(1), id(2), id(3), 0}});
  CHECK(now.polylines == std::vector<mesher::Polyline>{{id(3), {id(0), id(1), id(2)}, 8},
                                                       {id(4), {id(3), id(4), id(5)}, 8}});
  std::vector<std::string> notes;
  for (const auto& note : repaired.notes) {
    if (note.kind != RepairKind::split_at_point) notes.push_back(note.text());
  }
  CHECK(notes ==
        std::vector<std::string>{"line 3 leaves to line 1 what both cover, from (2, 0) on",
                                 "line 3 has a gap, and goes on as line 4 from (3, 0) on"});
}

TEST_CASE("a ring with a gap is one line from the gap's end to its begin") {
  Graph<2> g;
  g.points = {{id(1), {0, 0}, 0}, {id(2), {4, 0}, 0}, {id(3), {4, 4}, 0}, {id(4), {0, 4}, 0}};
  g.polylines = {{id(5), {id(1), id(2), id(3), id(4), id(1)}, 2}};
  g.segments = {{id(1), id(2), id(3), 0}, {id(2), id(3), id(2), 0}};
  const Graph<2> now = repair(g).file.graph;
  CHECK(now.segments == std::vector<mesher::Segment>{{id(1), id(2), id(3), 0}});
  CHECK(now.polylines == std::vector<mesher::Polyline>{{id(5), {id(3), id(4), id(1), id(2)}, 2}});
}

TEST_CASE("new points have attributes that are linear along the first line through them") {
  Graph<2> g = two_crossing();
  g.attributes_per_point = 2;
  g.attributes = {0, 1, 8, 3, 100, 100, 100, 100};
  const Graph<2> now = repair(g).file.graph;
  REQUIRE(now.attributes.size() == 10);
  CHECK(now.attributes[8] == 4);
  CHECK(now.attributes[9] == 2);
}

TEST_CASE("notes say where in a file a line stood, new points have no position") {
  mesher::GraphFile<2> file;
  file.graph = two_crossing();
  file.file = file.point_file = "roads.poly";
  file.points = {{2, 1}, {3, 1}, {4, 1}, {5, 1}};
  file.segments = {{7, 1}, {8, 1}};
  const Repaired<2> repaired = repair(file);
  CHECK(repaired.notes.at(0).text() ==
        "roads.poly:7:1: lines 7 and 8 cross at (2, 2), point 5 now");
  CHECK(repaired.file.points.size() == 5);
  CHECK(repaired.file.points[4].line == 0);
  CHECK(repaired.file.polylines.size() == 2);
  CHECK(repaired.file.polylines[1].line == 8);
}

TEST_CASE("what cannot be repaired is an error with its place") {
  Graph<2> g = two_crossing();
  const auto code = [](const Graph<2>& bad, const std::optional<mesher::Box<2>>& domain = {}) {
    try {
      (void)repair(bad, {.domain = domain});
    } catch (const mesher::Error& e) {
      return e.code();
    }
    FAIL("no error");
    return mesher::ErrorCode{};
  };
  using mesher::ErrorCode;
  CHECK(code(g, mesher::Box<2>{{0, 0}, {1, 1}}) == ErrorCode::outside_domain);
  g.points[0].at[0] = std::nan("");
  CHECK(code(g) == ErrorCode::not_finite);
  g.points[0].at[0] = 1e-200;
  CHECK(code(g) == ErrorCode::magnitude);
  g = two_crossing();
  g.segments[0].id = id(8);
  CHECK(code(g) == ErrorCode::repeated_id);
  g.segments[0] = {id(7), id(1), id(77), 0};
  CHECK(code(g) == ErrorCode::unknown_id);
  g = two_crossing();
  g.points[3].id = id(std::numeric_limits<std::int64_t>::max());
  g.segments[1].to = g.points[3].id;
  CHECK(code(g) == ErrorCode::too_many);
}

TEST_CASE("nothing, points alone and a planar graph come back as they are") {
  CHECK(repair(Graph<2>()).file.graph == Graph<2>());
  Graph<2> g;
  g.points = {{id(3), {1, 2}, 4}};
  CHECK(repair(g).file.graph == g);
  g.points.push_back({id(2), {5, 2}, 0});
  g.segments = {{id(1), id(3), id(2), 0}};
  g.seeds = {mesher::hole_seed<2>(1, {2, 2}), mesher::region_seed<2>(1, {3, 3}, 2.5, 0.1)};
  const Repaired<2> repaired = repair(g);
  CHECK(repaired.file.graph == g);
  CHECK(repaired.notes.empty());
}

TEST_CASE("a graph that was made by hand, without positions, is repaired in its file as well") {
  mesher::GraphFile<2> file;
  file.graph = two_crossing();
  file.graph.polylines = {{id(50), {id(1), id(4), id(3)}, 0}};
  file.graph.seeds = {mesher::hole_seed<2>(1, {2, 2})};
  const Repaired<2> repaired = repair(file);
  CHECK(repaired.file.graph == repair(file.graph).file.graph);
  CHECK(!repaired.notes.empty());
  CHECK(repaired.file.points.size() == repaired.file.graph.points.size());
  CHECK(repaired.file.seeds.size() == 1);
  file.graph.attributes = {1};
  CHECK_THROWS_WITH(repair(file),
                    "error[wrong_count]: 1 attributes are there, of 4 points with 0 each");
}
