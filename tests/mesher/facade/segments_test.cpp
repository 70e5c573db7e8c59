// Lines through the facade: every update leaves the mesh of a run from scratch, or an error that
// names the features, and then the mesh as it was.
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <string>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"
#include "mesher/error.hpp"
#include "random_pslg.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Error;
using mesher::ErrorCode;
using mesher::LineId;
using mesher::Mesh;
using mesher::Options;
using mesher::Point;
using mesher::PointId;
using support::Pslg;
using support::PslgEditor;

AnyId id(std::int64_t i) { return AnyId{i}; }

const Options<2> kOptions = PslgEditor::options();

// A mesher as a target of an editor, which knows segments by their ends.
class Target {
 public:
  explicit Target(BoxMesher<2>& m) : m_(m) {}
  void insert(PointId point, const Point<2>& p) { m_.insert(point, p); }
  void remove(PointId point) { m_.remove(point); }
  void insert_segment(LineId line, PointId a, PointId b) {
    lines_[{a, b}] = line;
    m_.insert_segment(line, b, a);
  }
  void remove_segment(PointId a, PointId b) { m_.remove_line(lines_.at({a, b})); }

 private:
  BoxMesher<2>& m_;
  std::map<std::pair<PointId, PointId>, LineId> lines_;
};

// What update() throws, and that the mesh stays.
struct Refused {
  ErrorCode code{};
  support::Ids ids;
  std::string message;
};
Refused refused(BoxMesher<2>& m) {
  const Mesh<2> before = m.mesh();
  try {
    m.update();
  } catch (const Error& e) {
    CHECK(m.mesh() == before);
    m.check_invariants();
    return {e.code(), support::ids_of(e), e.message()};
  }
  FAIL("update() has not thrown");
  return {};
}

// A square with points at its corners, 1 to 4, and a fifth in the middle.
BoxMesher<2> square() {
  BoxMesher<2> m(kOptions);
  m.insert({id(1), id(2), id(3), id(4), id(5)}, {{1, 1}, {5, 1}, {5, 5}, {1, 5}, {3, 3}});
  return m;
}

std::vector<LineId> lines_of(const Mesh<2>& mesh) {
  std::vector<LineId> lines;
  for (const auto& e : mesh.edges) lines.push_back(e.feature.line().value());
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

}  // namespace

TEST_CASE("after random edits of points and segments the mesh is that of a run from scratch") {
  for (const auto family :
       {PslgEditor::Family::uniform, PslgEditor::Family::lattice, PslgEditor::Family::fan}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      PslgEditor editor(family, seed);
      Pslg pslg;
      BoxMesher<2> m(kOptions);
      Target target(m);
      const auto box = mesher::detail::mesh_box(kOptions);
      for (std::uint64_t update = 0; update < 25; ++update) {
        INFO("update " << update);
        const std::uint64_t edits = update == 0 ? 30 : 1 + (update + seed) % 4;
        for (std::uint64_t i = 0; i < edits; ++i) editor.edit(pslg, box, target);
        m.update();
        REQUIRE(m.mesh() == support::static_mesh(pslg, kOptions));
        if (update % 5 == 0) m.check_invariants();
      }
    }
  }
}

TEST_CASE("a point moves with its segments in one update") {
  BoxMesher<2> m = square();
  m.insert_polyline(id(1), {id(1), id(2), id(3), id(4), id(1)});
  m.insert_segment(id(2), id(5), id(3));
  m.update();
  for (int step = 1; step <= 8; ++step) {
    const Point<2> to{3 + 0.2 * step, 3 - 0.1 * step};
    m.move(id(5), to);
    m.move(id(3), {5, 5 + 0.01 * step});
    m.update();
    m.check_invariants();
    Pslg pslg;
    pslg.points = {{1, {1, 1}}, {2, {5, 1}}, {3, {5, 5 + 0.01 * step}}, {4, {1, 5}}, {5, to}};
    pslg.segments = {{{1, 2}, 1}, {{2, 3}, 1}, {{3, 4}, 1}, {{1, 4}, 1}, {{3, 5}, 2}};
    REQUIRE(m.mesh() == support::static_mesh(pslg, kOptions));
  }
}

// The old segment and the new one are split alike, and their pieces near the end that stays are cut
// in one bucket: for a while there are two of each.
TEST_CASE("a segment whose end moves along it has pieces where the old one had the same") {
  BoxMesher<2> m({.domain = {{0, 0}, {16, 16}}});
  m.insert({id(3), id(5), id(7), id(8), id(9), id(10)},
           {{10, 16}, {9, 12}, {1, 1}, {9, 1}, {9, 9}, {1, 9}});
  m.insert_polyline(id(9), {id(5), id(3)});
  m.insert_polyline(id(10), {id(7), id(8), id(9), id(10), id(7)});
  m.insert({id(1), id(2), id(4), id(6)},
           {{6, 8}, {10, 1}, {6, 10}, {0.79287326172441475, 12.699168616720536}});
  m.update();
  m.insert_segment(id(11), id(3), id(9));
  m.insert(id(12), {10.201363279009195, 5.597689505579158});
  m.move(id(5), {7.975849177866456, 12.117338629285156});
  m.update();
  m.move(id(9), {9, 10});
  m.update();
  m.check_invariants();
  m.insert_segment(id(14), id(8), id(12));
  m.update();
  m.check_invariants();
}

TEST_CASE("a polyline comes and goes under one id") {
  BoxMesher<2> m = square();
  m.update();
  const Mesh<2> points = m.mesh();
  m.insert_polyline(id(7), {id(1), id(2), id(3), id(4), id(1)});
  CHECK(m.contains_line(id(7)));
  const auto change = m.update();
  CHECK(lines_of(m.mesh()) == std::vector{LineId{7}});
  CHECK(change.edges_added.size() == m.mesh().edges.size());
  m.remove_line(id(7));
  CHECK_FALSE(m.contains_line(id(7)));
  CHECK(m.update().edges_removed == change.edges_added);
  CHECK(m.mesh() == points);
  m.check_invariants();
}

TEST_CASE("a line that goes and comes back in one update changes nothing") {
  BoxMesher<2> m = square();
  m.insert_segment(id(1), id(1), id(3));
  m.remove(id(5));
  m.update();
  m.remove_line(id(1));
  m.insert_segment(id(1), id(1), id(3));
  CHECK(m.update().calls.executed == 0);
}

TEST_CASE("a segment that gets another id keeps its edges, which are said to be another line's") {
  BoxMesher<2> m = square();
  m.insert_segment(id(1), id(1), id(2));
  m.update();
  const auto vertices = m.mesh().vertices;
  m.remove_line(id(1));
  m.insert_segment(id(9), id(2), id(1));
  const auto change = m.update();
  CHECK(m.mesh().vertices == vertices);
  CHECK(lines_of(m.mesh()) == std::vector{LineId{9}});
  REQUIRE(change.edges_added.size() == m.mesh().edges.size());
  REQUIRE(change.edges_removed.size() == change.edges_added.size());
  CHECK(change.edges_added[0].feature == LineId{9});
  CHECK(change.edges_removed[0].feature == LineId{1});
}

TEST_CASE("points come to where segments have vertices, or into their finest cells, as those go") {
  for (const double beside : {0.0, 4e-16}) {
    BoxMesher<2> m(kOptions);
    m.insert({id(1), id(2), id(3)}, {{1, 1}, {8, 4}, {4, 2.6}});
    m.insert_segment(id(1), id(1), id(2));
    m.update();
    std::vector<Point<2>> on_segment;
    const Mesh<2> mesh = m.mesh();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      if (mesh.kinds[i] == mesher::VertexKind::segment) on_segment.push_back(mesh.vertices[i]);
    }
    REQUIRE(on_segment.size() > 3);
    m.remove_line(id(1));
    Pslg pslg;
    pslg.points = {{1, {1, 1}}, {2, {8, 4}}, {3, {4, 2.6}}};
    for (std::size_t i = 0; i < on_segment.size(); ++i) {
      const auto name = static_cast<std::int64_t>(10 + i);
      const Point<2> p{on_segment[i][0] * (1 + beside), on_segment[i][1]};
      m.insert(id(name), p);
      pslg.points[name] = p;
    }
    m.update();
    m.check_invariants();
    CHECK(m.mesh() == support::static_mesh(pslg, kOptions));
    for (std::size_t i = 0; i < on_segment.size(); ++i) {
      m.remove(id(static_cast<std::int64_t>(10 + i)));
    }
    m.insert_segment(id(1), id(1), id(2));
    m.update();
    m.check_invariants();
    CHECK(m.mesh() == mesh);
  }
}

TEST_CASE("segments that do not make a planar graph are refused with both ids and the place") {
  struct Bad {
    std::function<void(BoxMesher<2>&)> edit;
    ErrorCode code;
    support::Ids ids;
    std::string says;
  };
  const std::vector<Bad> bad = {
      {[](auto& m) { m.insert_segment(id(12), id(2), id(4)); },
       ErrorCode::crossing_segments,
       {id(12), id(11)},
       "at (2"},
      {[](auto& m) { m.insert_segment(id(12), id(1), id(3)); },
       ErrorCode::overlapping_segments,
       {id(12), id(11)},
       "from (1, 1) to (3, 3)"},
      {[](auto& m) { m.remove_line(id(11)), m.insert_segment(id(12), id(1), id(3)); },
       ErrorCode::point_on_segment,
       {id(5), id(12)},
       "point 5 (3, 3)"},
      {[](auto& m) {
         m.insert(id(8), {3, 1});
       },
       ErrorCode::point_on_segment,
       {id(8), id(10)},
       "(3, 1)"},
      // Whichever of the segments comes later.
      {[](auto& m) {
         m.insert({id(8), id(9)}, {{3, 1}, {4, 2}});
         m.insert_segment(id(12), id(9), id(8));
       },
       ErrorCode::point_on_segment,
       {id(8), id(10)},
       "(3, 1)"},
      {[](auto& m) {
         m.remove_line(id(10));
         m.insert({id(8), id(9), id(20), id(21)}, {{3, 0.5}, {3, 1.5}, {4, 1}, {3, 1}});
         m.insert_segment(id(12), id(20), id(21)), m.insert_segment(id(14), id(8), id(9));
       },
       ErrorCode::point_on_segment,
       {id(21), id(14)},
       "(3, 1)"},
      {[](auto& m) {
         m.move(id(5), {2, 1});
       },
       ErrorCode::overlapping_segments,
       {id(11), id(10)},
       ""},
      {[](auto& m) {
         m.move(id(4), {2, 1});
       },
       ErrorCode::point_on_segment,
       {id(4), id(10)},
       ""},
      {[](auto& m) {
         m.insert(id(8), {9, 1}), m.insert_segment(id(12), id(1), id(8));
       },
       ErrorCode::overlapping_segments,
       {id(12), id(10)},
       "from (1, 1) to (5, 1)"},
      {[](auto& m) {
         m.insert({id(8), id(9)}, {{3, 1}, {9, 1}});
         m.insert_segment(id(12), id(9), id(8));
       },
       ErrorCode::overlapping_segments,
       {id(12), id(10)},
       "from (3, 1) to (5, 1)"},
      {[](auto& m) { m.insert_segment(id(12), id(2), id(1)); },
       ErrorCode::repeated_segment,
       {id(12), id(10)},
       "(1, 1) to (5, 1)"},
      {[](auto& m) {
         m.insert_polyline(id(12), {id(3), id(4), id(3)});
       },
       ErrorCode::repeated_segment,
       {id(12), id(12)},
       ""},
      {[](auto& m) { m.remove(id(2)); }, ErrorCode::point_in_use, {id(2), id(10)}, ""},
      {[](auto& m) { m.insert_segment(id(12), id(3), id(77)); },
       ErrorCode::unknown_id,
       {id(77), id(12)},
       ""},
      {[](auto& m) { m.remove(id(4)), m.insert_segment(id(12), id(3), id(4)); },
       ErrorCode::unknown_id,
       {id(4), id(12)},
       ""},
      // What takes an id's place is not it.
      {[](auto& m) {
         m.remove(id(4)), m.insert(id(40), {1, 5}), m.insert_segment(id(12), id(3), id(4));
       },
       ErrorCode::unknown_id,
       {id(4), id(12)},
       ""},
      {[](auto& m) {
         m.move(id(1), {9, 5});
       },
       ErrorCode::crossing_segments,
       {id(11), id(13)},
       ""},
  };
  for (std::size_t i = 0; i < bad.size(); ++i) {
    INFO("case " << i);
    BoxMesher<2> m = square();
    m.insert({id(6), id(7)}, {{6, 0.5}, {6, 5.5}});
    m.insert_segment(id(10), id(1), id(2));
    m.insert_segment(id(11), id(1), id(5));
    m.insert_segment(id(13), id(6), id(7));
    m.update();
    if (i == 0) m.move(id(5), {2.9, 3.5}), m.update();
    bad[i].edit(m);
    const Refused r = refused(m);
    CHECK(r.code == bad[i].code);
    CHECK(r.ids == bad[i].ids);
    CHECK(r.message.find(bad[i].says) != std::string::npos);
    m.insert(id(50), {4, 2});  // and life goes on
    m.update();
    m.check_invariants();
  }
}

TEST_CASE("a first run and a static run refuse what an update refuses") {
  BoxMesher<2> m = square();
  m.insert_segment(id(1), id(1), id(3));
  CHECK(refused(m).code == ErrorCode::point_on_segment);
  const std::vector<Point<2>> points{{1, 1}, {5, 1}, {5, 5}, {1, 5}};
  const auto code = [&](const std::vector<mesher::Segment>& segments) {
    try {
      static_cast<void>(mesher::mesh_statically(points, segments, kOptions));
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::cancelled;
  };
  CHECK(code({{id(1), id(1), id(3)}, {id(2), id(2), id(4)}}) == ErrorCode::crossing_segments);
  CHECK(code({{id(1), id(1), id(2)}, {id(2), id(2), id(1)}}) == ErrorCode::repeated_segment);
  CHECK(code({{id(1), id(1), id(1)}}) == ErrorCode::zero_length);
  CHECK(code({{id(1), id(1), id(8)}}) == ErrorCode::unknown_id);
}

TEST_CASE("lines are announced by ids that are free, and taken back by ids that are there") {
  BoxMesher<2> m = square();
  const auto code = [&](auto&& edit) {
    try {
      edit();
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::cancelled;
  };
  m.insert_segment(id(1), id(1), id(2));
  CHECK(code([&] { m.insert_segment(id(1), id(2), id(3)); }) == ErrorCode::repeated_id);
  CHECK(code([&] { m.insert_segment(id(2), id(3), id(3)); }) == ErrorCode::zero_length);
  try {
    m.insert_segment(id(2), id(3), id(3));
  } catch (const Error& e) {
    CHECK(e.places() == std::vector<mesher::Position>{{5, 5, 0}});
  }
  CHECK(code([&] { m.insert_polyline(id(2), {id(3)}); }) == ErrorCode::bad_option);
  CHECK(code([&] { m.remove_line(id(2)); }) == ErrorCode::unknown_id);
  m.discard_edits();
  CHECK_FALSE(m.contains_line(id(1)));
}

TEST_CASE(
    "a point nearly on a segment is refused with the ids of both, if doubles do not suffice") {
  BoxMesher<2> m(kOptions);
  m.insert({id(1), id(2)}, {{1, 1}, {8, 4}});
  m.insert_segment(id(1), id(1), id(2));
  m.update();
  m.insert(id(3), {4.5, std::nextafter(2.5, 3.0)});
  const Refused r = refused(m);
  CHECK(r.code == ErrorCode::too_close);
  CHECK(r.ids == std::vector{id(1), id(3)});
}

TEST_CASE("features whose vertices share a finest cell are refused with the ids of both") {
  // Two legs at 2^-45, and a point near their apex that asks for vertices on both.
  const Options<2> options{.domain = {{0, 0}, {1, 1}}};
  const std::vector<Point<2>> points{{0, 0}, {1, 0.3}, {1, 0.3 + 0x1p-43}, {0, 0x1p-8}};
  BoxMesher<2> m(options);
  m.insert({id(11), id(12), id(13), id(14)}, points);
  m.insert_segment(id(1), id(11), id(12));
  m.update();
  m.insert_segment(id(2), id(11), id(13));
  const Refused r = refused(m);
  CHECK(r.code == ErrorCode::too_close);
  CHECK(r.ids == std::vector{id(2), id(1)});
  CHECK(r.message.find("segment 2 needs a vertex at (0.0") != std::string::npos);
  try {
    (void)mesher::mesh_statically(points, {{id(1), id(11), id(12)}, {id(2), id(11), id(13)}},
                                  options, {id(11), id(12), id(13), id(14)});
    FAIL("not refused");
  } catch (const Error& e) {
    CHECK(e.code() == r.code);  // of several such places another may be found first
    CHECK(support::ids_of(e) == r.ids);
  }
}
