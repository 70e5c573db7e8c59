// Scripts of edits: what is read, what is refused and where, and what a bad line leaves behind.
#include "mesher/extra/edit_script.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/sizes.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::Edit;
using mesher::Error;
using mesher::ErrorCode;
using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using support::failure_of;
using support::ScratchFolder;

// Has the editing half of a mesher's interface, and logs what reaches it.
class Table {
 public:
  void insert(PointId id, const Point<2>& p) {
    if (edited_.contains(id)) throw Error(ErrorCode::repeated_id, "there");
    edited_[id] = p;
  }
  void remove(PointId id) {
    if (edited_.erase(id) == 0) throw Error(ErrorCode::unknown_id, "not there");
  }
  void move(PointId id, const Point<2>& p) {
    remove(id);
    insert(id, p);
  }
  void discard_edits() { edited_ = points; }
  mesher::Change<2> update() {
    if (fail_update) throw Error(ErrorCode::too_close, "too close");
    points = edited_;
    ++updates;
    return {};
  }

  std::map<PointId, Point<2>> points;
  int updates = 0;
  bool fail_update = false;

 private:
  std::map<PointId, Point<2>> edited_;
};

// Applies a script; the texts of the updates.
std::vector<std::string> apply(const std::string& content, Table& table) {
  const ScratchFolder folder;
  mesher::EditScript<2> script(folder.write("edits.txt", content));
  std::vector<std::string> texts;
  mesher::apply(script, table, [&](const mesher::Update<2>& u) { texts.push_back(u.text()); });
  return texts;
}

struct Refused {
  const char* content;
  const char* failure;  // code@line:column
};

}  // namespace

TEST_CASE("each edit is an update of its own, and those of a block are one") {
  Table table;
  const auto texts = apply(
      "# a comment\r\n"
      "\r\n"
      "+point 1 0.5 -2e-1\r\n"
      "  begin  # of a block\n"
      "+point 2 +1 2   # two\n"
      "-point 1\n"
      "\n"
      "commit\n"
      "begin\n"
      "commit\n"
      "move 2 3 -0",
      table);
  CHECK(texts == std::vector<std::string>{"+point 1 0.5 -2e-1", "+point 2 +1 2; -point 1", "",
                                          "move 2 3 -0"});
  CHECK(table.points == std::map<PointId, Point<2>>{{PointId{2}, {3, 0}}});
  CHECK(table.updates == 4);
}

TEST_CASE("an edit carries its id, its point and its place") {
  const ScratchFolder folder;
  const auto path = folder.write("edits.txt", "\n  move -8 1 2\n-point 3\n");
  mesher::EditScript<2> script(path);
  const auto edits = script.next().value();
  REQUIRE(edits.size() == 1);
  CHECK(edits[0].kind == Edit<2>::Kind::move);
  CHECK(edits[0].number == -8);
  CHECK(edits[0].point == Point<2>{1, 2});
  CHECK(edits[0].location.file == path);
  CHECK(edits[0].location.line == 2);
  CHECK(edits[0].location.column == 3);
  CHECK(script.next().value()[0].kind == Edit<2>::Kind::remove);
  CHECK_FALSE(script.next().has_value());
}

TEST_CASE("a bad line is refused with its place and leaves the edits before it applied") {
  const Refused refused = GENERATE(values<Refused>({
      {"+segment 1 2\n", "bad_edit@2:13"},
      {"+segment 1 2 3 4\n", "bad_edit@2:16"},
      {"+segment 1 2 x\n", "bad_number@2:14"},
      {"-segment 1 2\n", "bad_edit@2:12"},
      {"+polyline 1 2\n", "bad_edit@2:14"},
      {"-polyline\n", "bad_edit@2:10"},
      {"+segment 1 2 3\n", "bad_edit@2:1"},  // the table has points only
      {"+hole 1 2\n", "bad_edit@2:10"},
      {"+hole 1 2 3 4\n", "bad_edit@2:13"},
      {"+hole 1 2 nan\n", "not_finite@2:11"},
      {"-hole\n", "bad_edit@2:6"},
      {"+region 1 2 3\n", "bad_edit@2:14"},
      {"+region 1 2 3 4 5 6\n", "bad_edit@2:19"},
      {"+region 1 2 1e31 4\n", "magnitude@2:13"},
      {"+region 1 2 3 inf\n", "not_finite@2:15"},
      {"+region 1 2 3 4 x\n", "bad_number@2:17"},
      {"+hole 1 2 3\n", "bad_edit@2:1"},  // the table has points only
      {"limit\n", "bad_edit@2:6"},
      {"limit areas 1\n", "bad_edit@2:7"},
      {"limit area\n", "bad_edit@2:11"},
      {"limit area 0\n", "bad_number@2:12"},
      {"limit size -1\n", "bad_number@2:12"},
      {"limit size nan\n", "not_finite@2:12"},
      {"limit area 1 2\n", "bad_edit@2:15"},
      {"limit none 1\n", "bad_edit@2:13"},
      {"limit area 1 in 0 0 1\n", "bad_edit@2:22"},
      {"limit area 1 at 0 0 1 1\n", "bad_edit@2:14"},
      {"limit none in 0 2 1 1\n", "bad_edit@2:15"},
      {"limit none in 0 x 1 1\n", "bad_number@2:17"},
      {"limit none in 0 0 1 1 1\n", "bad_edit@2:23"},
      {"limit none\n", "bad_edit@2:1"},  // the table has points only
      {"+Point 1 2 3\n", "bad_edit@2:1"},
      {"+point 2 3\n", "bad_edit@2:11"},
      {"+point 2 3 4 5\n", "bad_edit@2:14"},
      {"-point\n", "bad_edit@2:7"},
      {"-point 1 0 0\n", "bad_edit@2:10"},
      {"move 1 0\n", "bad_edit@2:9"},
      {"begin now\n", "bad_edit@2:7"},
      {"+point 2.0 3 4\n", "bad_number@2:8"},
      {"+point 2 3 4z\n", "bad_number@2:12"},
      {"+point 2 nan 4\n", "not_finite@2:10"},
      {"move 1 0 -inf\n", "not_finite@2:10"},
      {"+point 2 1e31 4\n", "magnitude@2:10"},
      {"move 1 1e-31 4\n", "magnitude@2:8"},
      {"commit\n", "unbalanced_commit@2:1"},
      {"begin\n+point 2 3 4\n", "unbalanced_commit@2:1"},
      {"begin\n+point 2 3 4\nbegin\ncommit\n", "unbalanced_commit@4:1"},
      {"begin\n+point 2 3 4\nwhat\ncommit\n", "bad_edit@4:1"},
      {"begin\n+point 2 3 4\n  -point 7\ncommit\n", "unknown_id@4:3"},
      {"-point 2\n", "unknown_id@2:1"},
      {"move 2 3 4\n", "unknown_id@2:1"},
      {" +point 1 3 4\n", "repeated_id@2:2"},
  }));
  INFO(refused.content);
  Table table;
  const std::string script = "+point 1 0 0\n" + std::string(refused.content) + "-point 1\n";
  CHECK(failure_of([&] { apply(script, table); }) == refused.failure);
  CHECK(table.points == std::map<PointId, Point<2>>{{PointId{1}, {0, 0}}});
  table.update();  // nothing of the bad line or its block is left waiting
  CHECK(table.points.size() == 1);
}

TEST_CASE("an update that fails is said of the last edit of its batch") {
  Table table;
  table.fail_update = true;
  CHECK(failure_of([&] { apply("begin\n+point 1 0 0\n +point 2 1 1\ncommit\n", table); }) ==
        "too_close@3:2");
  CHECK(table.points.empty());
}

TEST_CASE("lines are edited: points may go before their lines, and come after them, in a block") {
  const ScratchFolder folder;
  mesher::BoxMesher<2> m({.domain = {{0, 0}, {1, 1}}});
  mesher::EditScript<2> script(folder.write("edits.txt",
                                            "begin\n"
                                            "+segment 1 1 2\n"
                                            "+polyline 2 2 3 4 2\n"
                                            "+point 1 0.1 0.1\n"
                                            "+point 2 0.4 0.1\n"
                                            "+point 3 0.9 0.1\n"
                                            "+point 4 0.6 0.8\n"
                                            "commit\n"
                                            "begin\n"
                                            "-point 1\n"
                                            "-segment 1\n"
                                            "commit\n"
                                            "-polyline 2\n"));
  std::vector<std::size_t> lines;
  mesher::apply(script, m, [&](const mesher::Update<2>& u) {
    std::set<mesher::Feature> ids;
    const auto mesh = m.mesh();
    for (const auto& e : mesh.edges) ids.insert(e.feature);
    lines.push_back(ids.size());
    CHECK(u.change.edges_removed.empty() == (lines.size() == 1));
  });
  CHECK(lines == std::vector<std::size_t>{2, 1, 0});
}

TEST_CASE("a line that cannot come is said of its own edit, not of that of a point of its id") {
  const ScratchFolder folder;
  mesher::BoxMesher<2> m({.domain = {{0, 0}, {1, 1}}});
  mesher::EditScript<2> script(folder.write("edits.txt",
                                            "begin\n"
                                            "+point 1 0.1 0.1\n"
                                            "+point 2 0.9 0.9\n"
                                            "+point 3 0.1 0.9\n"
                                            "+point 4 0.9 0.1\n"
                                            "+segment 1 1 2\n"
                                            "commit\n"
                                            "begin\n"
                                            "+segment 2 3 4\n"
                                            "+point 5 0.5 0.1\n"
                                            "move 2 0.9 0.8\n"
                                            "commit\n"));
  CHECK(failure_of([&] { mesher::apply(script, m, [](const mesher::Update<2>&) {}); }) ==
        "crossing_segments@9:1");
  CHECK(m.mesh().edges.size() > 0);
}

TEST_CASE("an edit of a seed carries its place, attribute and limit; a limit of 0 is none") {
  const ScratchFolder folder;
  mesher::EditScript<2> script(folder.write("edits.txt",
                                            "+region 7 1 -2 0.5 0.25\n"
                                            "+region 7 1 2 -3\n"
                                            "+region 7 1 2 3 -1\n"
                                            "+hole 7 3 4\n"
                                            "-region 7\n"));
  const auto next = [&] { return script.next().value().at(0); };
  const Edit<2> whole = next();
  CHECK(whole.kind == Edit<2>::Kind::insert_region);
  CHECK(whole.point == Point<2>{1, -2});
  CHECK(whole.attribute == 0.5);
  CHECK(whole.max_measure == 0.25);
  CHECK_FALSE(next().max_measure.has_value());
  CHECK_FALSE(next().max_measure.has_value());
  const Edit<2> hole = next();
  CHECK(hole.feature().kind == mesher::FeatureKind::hole);
  CHECK(hole.point == Point<2>{3, 4});
  CHECK(next().feature().kind == mesher::FeatureKind::region);
}

TEST_CASE("an edit of limits carries what they are and where") {
  const ScratchFolder folder;
  folder.write("h.csv", "x,y,h\n0,0,0.5\n1,0,0.5\n0,1,0.25\n");
  mesher::EditScript<2> script(folder.write("edits.txt",
                                            "limit area 0.5\n"
                                            "limit size 2 in 0 -1 4 5\n"
                                            "limit sizes h.csv in 0 0 1 1\n"
                                            "limit none\n"
                                            "limit sizes absent.csv\n"));
  const auto next = [&] { return script.next().value().at(0); };
  const Edit<2> everywhere = next();
  CHECK(everywhere.kind == Edit<2>::Kind::limit);
  CHECK(everywhere.limits == mesher::SizeLimits<2>{.max_measure = 0.5});
  CHECK_FALSE(everywhere.box.has_value());
  const Edit<2> inside = next();
  CHECK(inside.limits.max_measure == Approx(std::sqrt(3.0)));
  CHECK(inside.box == mesher::Box<2>{{0, -1}, {4, 5}});
  const Edit<2> background = next();
  CHECK(background.limits.max_measure == 0);
  REQUIRE(background.limits.sizes != nullptr);
  CHECK(background.limits.sizes->at({0, 1}) == 0.25);
  CHECK(next().limits == mesher::SizeLimits<2>());
  CHECK(failure_of([&] { static_cast<void>(next()); }).starts_with("cannot_read"));
}

TEST_CASE("seeds of a block move, whatever comes between; they are never to blame for a line") {
  const ScratchFolder folder;
  mesher::Mesher<2> m({.domain = {{0, 0}, {1, 1}}});
  mesher::EditScript<2> script(folder.write("edits.txt",
                                            "begin\n"
                                            "+polyline 1 1 2 3 1\n"
                                            "+hole 1 .5 .5\n"
                                            "+point 1 0.1 0.1\n"
                                            "+point 2 0.9 0.1\n"
                                            "+point 3 0.5 0.9\n"
                                            "commit\n"
                                            "begin\n"
                                            "-hole 1\n"
                                            "+point 4 .25 .75\n"
                                            "+hole 1 .5 .25\n"
                                            "commit\n"
                                            "begin\n"
                                            "-point 1\n"
                                            "+hole 2 .5 .75\n"
                                            "-hole 1\n"
                                            "commit\n"));
  std::vector<mesher::DomainUpdate<2>> updates;
  CHECK(failure_of([&] {
          mesher::apply(script, m, [&](const auto& u) { updates.push_back(u.change); });
        }) == "point_in_use@14:1");
  REQUIRE(updates.size() == 2);
  CHECK(m.input().holes() == std::vector{mesher::hole_seed<2>(1, {.5, .25})});
  CHECK(m.domain_mesh().mesh.simplices.empty());
}

TEST_CASE("a block may take a place before it frees it") {
  const ScratchFolder folder;
  mesher::BoxMesher<2> m({.domain = {{0, 0}, {1, 1}}});
  mesher::EditScript<2> script(
      folder.write("edits.txt",
                   "begin\n+point 1 .25 .5\n+point 2 .5 .25\ncommit\n"
                   "begin\n+point 3 .25 .5\nmove 2 .25 .75\n+point 4 .5 .25\n-point 1\ncommit\n"));
  std::vector<std::string> texts;
  mesher::apply(script, m, [&](const auto& u) { texts.push_back(u.text()); });
  CHECK(texts.size() == 2);
  CHECK(texts[1] == "+point 3 .25 .5; move 2 .25 .75; +point 4 .5 .25; -point 1");
  CHECK(m.mesh() == mesher::mesh_statically<2>({{.25, .5}, {.25, .75}, {.5, .25}}, m.options()));
}

TEST_CASE("an update that fails because of a point is said of that point's last edit") {
  const ScratchFolder folder;
  mesher::BoxMesher<2> m({.domain = {{0, 0}, {1, 1}}});
  mesher::EditScript<2> script(
      folder.write("edits.txt",
                   "begin\n+point 1 .25 .5\n+point 2 .5 .25\ncommit\n"
                   "begin\nmove 2 .1 .1\n  move 2 .25 .5\n+point 3 .75 .75\ncommit\n"));
  CHECK(failure_of([&] { mesher::apply(script, m, [](const auto&) {}); }) == "duplicate_point@7:3");
  CHECK(m.size() == 2);
}

TEST_CASE("a script that is not there, or is a folder, cannot be read") {
  const ScratchFolder folder;
  CHECK(failure_of([&] { mesher::EditScript<2> script(folder.path("none.txt")); }) ==
        "cannot_read@0:0");
  CHECK(failure_of([&] { mesher::EditScript<2> script(folder.path("")); }) == "cannot_read@0:0");
}

TEST_CASE("Scripts give markers to points and lines, which the mesh then has") {
  const ScratchFolder folder;
  mesher::EditScript<2> script(folder.write("edits.txt",
                                            "begin\n"
                                            "+point 1 1 1 marker 7\n+point 2 9 1\n+point 3 9 9\n"
                                            "+point 4 1 9\n"
                                            "+segment 1 1 2 marker -3\n"
                                            "+polyline 2 2 3 4 1 marker 11\n"
                                            "commit\n"
                                            "-segment 1\n"
                                            "+segment 1 2 1\n"));
  mesher::Mesher<2> m({.domain = {{0, 0}, {10, 10}}});
  const auto markers = [&] {
    const mesher::MeshData<2> kept = m.domain_mesh().mesh;
    std::map<Point<2>, std::int64_t> of;
    for (std::size_t v = 0; v < kept.vertices.size(); ++v) {
      of[kept.vertices[v]] = kept.features.markers[v];
    }
    std::map<std::int64_t, std::set<std::int64_t>> of_lines;
    for (const auto& e : kept.features.edges) {
      if (e.line) of_lines[static_cast<std::int64_t>(*e.line)].insert(e.marker);
    }
    return std::pair(of, of_lines);
  };
  mesher::apply(*script.next(), m);
  const auto [points, lines] = markers();
  CHECK(points.at({1, 1}) == 7);
  CHECK(points.at({9, 1}) == -3);  // it has none of its own: that of a line, the least
  CHECK(points.at({9, 9}) == 11);
  CHECK(lines.at(1) == std::set<std::int64_t>{-3});
  CHECK(lines.at(2) == std::set<std::int64_t>{11});
  mesher::apply(*script.next(), m);
  mesher::apply(*script.next(), m);
  const auto [again, unmarked] = markers();
  CHECK(again.at({1, 1}) == 7);
  CHECK(again.at({9, 1}) == 11);
  CHECK(unmarked.at(1) == std::set<std::int64_t>{1});  // what is on the boundary and has none
  const auto refused = [&](const std::string& text) {
    mesher::EditScript<2> one(folder.write("bad.txt", text));
    return failure_of([&] { (void)one.next(); });
  };
  CHECK(refused("+segment 1 2 3 marker 0.5\n") == "bad_number@1:23");
  CHECK(refused("+segment 1 2 marker 5\n") == "bad_edit@1:21");
  CHECK(refused("-segment 1 marker 5\n") == "bad_edit@1:12");
  CHECK(refused("move 1 2 3 marker 5\n") == "bad_edit@1:12");
}

TEST_CASE("a script may begin with a byte order mark") {
  Table table;
  CHECK(apply("\xEF\xBB\xBF+point 1 2 3\r\n-point 1\r\n", table).size() == 2);
  CHECK(apply("\xEF\xBB\xBF", table).empty());
  CHECK(apply("\xEF\xBB\xBF# nothing\n\n", table).empty());
}

TEST_CASE("a script in space has points with three coordinates") {
  const ScratchFolder folder;
  mesher::BoxMesher<3> m({.domain = {{0, 0, 0}, {1, 1, 1}}});
  mesher::EditScript<3> script(folder.write("edits.txt",
                                            "+point 1 .5 .25 .125  # a point\n"
                                            "begin\n+point 2 .5 .5 .5\nmove 1 .25 .25 1\ncommit\n"
                                            "-point 2\n"));
  std::vector<std::string> texts;
  mesher::apply(script, m, [&](const mesher::Update<3>& u) { texts.push_back(u.text()); });
  CHECK(texts == std::vector<std::string>{"+point 1 .5 .25 .125",
                                          "+point 2 .5 .5 .5; move 1 .25 .25 1", "-point 2"});
  CHECK(m.points() == std::vector{mesher::GraphPoint<3>{PointId{1}, {.25, .25, 1}}});
  CHECK(m.mesh() == mesher::mesh_statically<3>({{.25, .25, 1}}, m.options()));
}

TEST_CASE("a script in space has segments, and polygons with holes and what lies inside") {
  const ScratchFolder folder;
  const auto list = [](std::initializer_list<std::int64_t> values) {
    std::vector<PointId> all;
    for (const auto v : values) all.push_back(PointId{v});
    return all;
  };
  mesher::BoxMesher<3> m({.domain = {{0, 0, 0}, {1, 1, 1}}});
  mesher::EditScript<3> script(folder.write(
      "edits.txt",
      "begin\n"
      "+polygon 1 1 2 3 4 / 5 6 7 on 8 10 along 8 9 9 10  # before its points\n"
      "+polygon 2 1 2 11\n"
      "+point 1 0 0 .5\n+point 2 1 0 .5\n+point 3 1 1 .5\n+point 4 0 1 .5\n"
      "+point 5 .25 .25 .5\n+point 6 .5 .25 .5\n+point 7 .25 .5 .5\n"
      "+point 8 .75 .25 .5\n+point 9 .75 .5 .5\n+point 10 .75 .75 .5\n+point 11 .5 0 1\n"
      "+segment 1 9 11\ncommit\n"
      "begin\n-point 11\n-segment 1\n-polygon 2\n+polyline 3 5 12 7\n"
      "+point 12 .25 .25 1\ncommit\n"));
  std::size_t updates = 0;
  mesher::apply(script, m, [&](const mesher::Update<3>&) {
    if (++updates > 1) return;
    REQUIRE(m.polygons().size() == 2);
    const mesher::Polygon f = m.polygons()[0];
    CHECK(f.loops == std::vector<std::vector<PointId>>{list({1, 2, 3, 4}), list({5, 6, 7})});
    CHECK(f.points == list({8, 10}));
    CHECK(f.edges ==
          std::vector<std::array<PointId, 2>>{{PointId{8}, PointId{9}}, {PointId{9}, PointId{10}}});
  });
  CHECK(updates == 2);
  CHECK(m.polygons().size() == 1);
  CHECK(m.lines() == std::vector{mesher::Polyline{LineId{3}, list({5, 12, 7})}});
}

TEST_CASE("a script in space gives markers to points, lines and polygons") {
  auto script = mesher::EditScript<3>::of_text(
      "begin\n+point 1 0 0 0 marker 5\n+segment 2 1 3 marker -6\n"
      "+polyline 3 1 3 4 marker 7\n+polygon 4 1 3 4 on 5 marker 8\n+polygon 5 1 3 4\ncommit\n",
      "edits.txt");
  const auto edits = script.next();
  REQUIRE((edits && edits->size() == 5));
  std::vector<std::int64_t> markers;
  for (const auto& edit : *edits) markers.push_back(edit.marker);
  CHECK(markers == std::vector<std::int64_t>{5, -6, 7, 8, 0});
  CHECK((*edits)[3].polygon.marker == 8);
  CHECK((*edits)[3].polygon.points == std::vector{PointId{5}});
  CHECK((*edits)[4].polygon.marker == 0);
}

TEST_CASE("a script may be a text in memory, of which errors are said, and files beside it read") {
  const ScratchFolder folder;
  const std::string path = folder.write("edits.txt", "");
  folder.write("sizes.csv", "x,y,h\n0,0,0.5\n1,0,0.5\n0,1,0.5\n");
  auto script = mesher::EditScript<2>::of_text("limit sizes sizes.csv\n+point 1 0\n", path);
  const auto edits = script.next();
  REQUIRE((edits && edits->size() == 1));
  CHECK((*edits)[0].limits.sizes != nullptr);
  const Error error = support::error_of([&] { static_cast<void>(script.next()); });
  CHECK(error.location() == mesher::FileLocation{path, 2, 11});
}

TEST_CASE("a script in space has seeds, whose errors are said of their lines") {
  const ScratchFolder folder;
  mesher::Mesher<3> m({.domain = {{0, 0, 0}, {1, 1, 1}}});
  mesher::EditScript<3> script(folder.write("edits.txt",
                                            "begin\n+hole 1 .25 .5 .75\n"
                                            "+region 1 .5 .5 .125 -2 0.5\n"
                                            "+region 2 .5 .25 .5 3 -1\n+point 1 0 0 .5\ncommit\n"
                                            "begin\n-region 1\n-hole 1\n"
                                            "+region 1 .5 .5 .5 4\ncommit\n"
                                            "+region 2 0 0 0 1\n"));
  std::vector<mesher::Graph<3>> inputs;
  CHECK(failure_of([&] {
          mesher::apply(script, m, [&](const auto&) { inputs.push_back(m.input()); });
        }) == "repeated_id@12:1");
  REQUIRE(inputs.size() == 2);
  using mesher::region_seed;
  CHECK(inputs[0].holes() == std::vector{mesher::hole_seed<3>(1, {.25, .5, .75})});
  CHECK(inputs[0].regions() == std::vector{region_seed<3>(1, {.5, .5, .125}, -2, 0.5),
                                           region_seed<3>(2, {.5, .25, .5}, 3)});
  CHECK(inputs[1].holes().empty());
  CHECK(inputs[1].regions().at(0) == region_seed<3>(1, {.5, .5, .5}, 4));
}

TEST_CASE("an error of an update in space is said of the edit of the feature to blame") {
  const ScratchFolder folder;
  const auto failure = [&](const std::string& last) {
    mesher::BoxMesher<3> m({.domain = {{0, 0, 0}, {1, 1, 1}}});
    mesher::EditScript<3> script(
        folder.write("edits.txt",
                     "begin\n+point 1 0 0 0\n+point 2 1 0 0\n+point 3 0 1 0\n"
                     "+point 4 .25 .25 -0\n+point 5 .25 .5 .5\ncommit\n" +
                         last));
    return failure_of([&] { mesher::apply(script, m, [](const auto&) {}); });
  };
  CHECK(failure("begin\n+polygon 1 1 2 3\n+point 6 1 1 1\n+segment 4 4 5\ncommit\n") ==
        "point_on_polygon@9:1");
  CHECK(failure("begin\n+segment 1 4 5\n+polygon 1 1 2 3 5\ncommit\n") == "not_flat@10:1");
  CHECK(failure("begin\n+polygon 1 1 2 4\n+polygon 7 4 2 1\n+point 6 1 1 1\ncommit\n") ==
        "repeated_polygon@10:1");
}

TEST_CASE("bad lines of a script in space are refused with the code and the place of the mistake") {
  const Refused refused = GENERATE(values<Refused>({
      {"+point 1 0 0\n", "bad_edit@1:13"},
      {"+point 1 0 0 0 0\n", "bad_edit@1:16"},
      {"+point 1 0 0 0 marker 5.5\n", "bad_number@1:23"},
      {"+point 1 0 0 0\nmove 1 0 0\n", "bad_edit@2:11"},
      {"+point 1 0 0 nan\n", "not_finite@1:14"},
      {"+point 1 0 0 1e-31\n", "magnitude@1:14"},
      {"-point 1 0\n", "bad_edit@1:10"},
      {"+point 1 0 0 2\n", "outside_domain@1:1"},
      {"+point 1 0 0 0\n+point 2 0 0 0\n", "duplicate_point@2:1"},
      {"begin\n+point 1 0 0 0\n move 1 0 0 0\n+point 2 0 0 0\ncommit\n", "duplicate_point@4:1"},
      {"+segment 1 1 2\n", "unknown_id@1:1"},
      {"+segment 1 1 2 marker x\n", "bad_number@1:23"},
      {"+polygon 1 1 2 3 marker\n", "bad_number@1:18"},
      {"+polyline 1 1\n", "bad_edit@1:14"},
      {"+polygon 1 1 2\n", "bad_edit@1:15"},
      {"+polygon 1 1 2 3\n", "unknown_id@1:1"},
      {"+polygon 1 1 2 x\n", "bad_number@1:16"},
      {"+polygon 1 1 2 3 / 4 5\n", "bad_polygon@1:1"},
      {"+polygon 1 1 2 2\n", "bad_polygon@1:1"},
      {"+polygon 1 1 2 3 along 4 5 6\n", "bad_edit@1:18"},
      {"+polygon 1 1 2 3 on\n+polygon 1 1 2 3\n", "unknown_id@1:1"},
      {"-polygon 1\n", "unknown_id@1:1"},
      {"+hole 1 0 0 0\n", "bad_edit@1:1"},  // the mesher knows of no seeds
      {"+region 1 0 0 0 1\n", "bad_edit@1:1"},
      {"+hole 1 0 0\n", "bad_edit@1:12"},
      {"+hole 1 0 0 nan\n", "not_finite@1:13"},
      {"-hole 1 0\n", "bad_edit@1:9"},
      {"+region 1 0 0 0\n", "bad_edit@1:16"},
      {"+region 1 0 0 0 1 2 3\n", "bad_edit@1:21"},
      {"+region 1 0 0 0 inf\n", "not_finite@1:17"},
      {"+region 1 0 0 0 1 x\n", "bad_number@1:19"},
      {"limit area 1\n", "bad_edit@1:7"},
      {"limit volume\n", "bad_edit@1:13"},
      {"limit volume 0\n", "bad_number@1:14"},
      {"limit size inf\n", "not_finite@1:12"},
      {"limit none in 0 0 1 1\n", "bad_edit@1:22"},
      {"limit none in 0 0 2 1 1 1\n", "bad_edit@1:15"},
      {"+tetrahedron 1\n", "bad_edit@1:1"},
      {"begin\n+point 1 0 0 0\n", "unbalanced_commit@1:1"},
  }));
  CAPTURE(refused.content);
  const ScratchFolder folder;
  mesher::BoxMesher<3> m({.domain = {{0, 0, 0}, {1, 1, 1}}});
  mesher::EditScript<3> script(folder.write("edits.txt", refused.content));
  CHECK(failure_of([&] { mesher::apply(script, m, [](const auto&) {}); }) == refused.failure);
}
