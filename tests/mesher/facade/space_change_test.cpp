// What updates report of edges on segments and faces in polygons, against the meshes before and
// after.
#include <catch2/catch.hpp>

#include "failing_new.hpp"
#include "feature_ids.hpp"
#include "mesher/extra/generate.hpp"
#include "space_parcels.hpp"
#include "space_parts.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Change;
using mesher::LineId;
using mesher::Options;
using mesher::Polygon;
using mesher::PolygonId;
using support::id;
using support::ids;
using support::parts_of;
using support::SpaceParts;

const Options<3> kOptions{.domain = {{0, 0, 0}, {2, 2, 2}}};

// Two squares side by side, of points 1 to 6, and 7 and 8 inside the first; 9 above.
struct Scene {
  BoxMesher<3> m{kOptions};
  SpaceParts parts;
  Scene() {
    m.insert(ids({1, 2, 3, 4, 5, 6, 7, 8, 9}), {{0.25, 0.25, 1},
                                                {0.75, 0.25, 1},
                                                {0.75, 0.75, 1},
                                                {0.25, 0.75, 1},
                                                {1.25, 0.25, 1},
                                                {1.25, 0.75, 1},
                                                {0.4, 0.4, 1},
                                                {0.6, 0.6, 1},
                                                {0.75, 0.5, 1.5}});
  }
  /// The update's change; parts are those of the mesh.
  Change<3> update() {
    const Change<3> change = m.update();
    parts.follow(change);
    REQUIRE(parts == parts_of(m.mesh()));
    m.check_invariants();
    return change;
  }
  [[nodiscard]] Polygon first() const { return {id(1), {ids({1, 2, 3, 4})}, {}, ids({7, 8})}; }
  [[nodiscard]] Polygon second() const { return {id(2), {ids({2, 5, 6, 3})}}; }
};

}  // namespace

TEST_CASE("After random edits the parts of features are the old ones with the update's change") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5, 6);
  CAPTURE(seed);
  BoxMesher<3> m(kOptions);
  support::SpaceParcels<BoxMesher<3>> parcels(m, seed);
  SpaceParts parts;
  int refused = 0;
  for (int round = 0; round < 40; ++round) {
    CAPTURE(round);
    Change<3> change;
    const auto count = round == 0 ? 5 : 1 + parcels.below(3);
    if (!parcels.edit_and(count, [&] { change = m.update(); })) {
      ++refused;
      REQUIRE(parts == parts_of(m.mesh()));
      continue;
    }
    parts.follow(change);
    REQUIRE(parts == parts_of(m.mesh()));
    if (round % 8 == 0) m.check_invariants();
  }
  CHECK(refused < 30);
}

TEST_CASE(
    "A polygon that comes along another's edge gives its parts another name, and takes none") {
  Scene s;
  s.m.insert_polygon(s.second());
  s.update();
  s.m.insert_polygon(s.first());
  const Change<3> came = s.update();
  CHECK(came.faces_removed.empty());
  std::size_t renamed = 0;
  for (const auto& e : came.edges_removed) renamed += e.feature == PolygonId{2} ? 1 : 0;
  CHECK(renamed > 0);
  CHECK(renamed == came.edges_removed.size());
  s.m.remove_polygon(id(1));
  const Change<3> gone = s.update();
  CHECK(gone.faces_removed == came.faces_added);
  CHECK(gone.edges_added == came.edges_removed);
}

TEST_CASE("A segment along a polygon's edge takes its parts, and leaves them") {
  Scene s;
  s.m.insert_polygon(s.first());
  s.m.insert_polygon(s.second());
  s.update();
  s.m.insert_segment(id(9), id(3), id(2));
  const Change<3> came = s.update();
  CHECK(came.vertices_added.empty());
  CHECK(came.faces_added.empty());
  REQUIRE(!came.edges_added.empty());
  CHECK(came.edges_added.size() == came.edges_removed.size());
  for (const auto& e : came.edges_added) CHECK(e.feature == LineId{9});
  s.m.remove_polygon(id(1));
  s.m.remove_polygon(id(2));
  for (const auto& e : s.update().edges_removed) CHECK(e.feature.polygon());
  s.m.remove_line(id(9));
  CHECK(s.update().edges_removed == came.edges_added);
  CHECK(s.parts == SpaceParts());
}

TEST_CASE("A polygon that gets another id has all its parts in both lists") {
  Scene s;
  s.m.insert_polygon(s.first());
  s.update();
  const std::size_t faces = s.parts.faces.size(), edges = s.parts.edges.size();
  s.m.remove_polygon(id(1));
  Polygon other = s.first();
  other.id = id(5);
  s.m.insert_polygon(other);
  const Change<3> change = s.update();
  CHECK(change.simplices_added.empty());
  CHECK(change.faces_added.size() == faces);
  CHECK(change.faces_removed.size() == faces);
  CHECK(change.edges_added.size() == edges);
}

TEST_CASE("What a hole was comes when the polygon is put in its place without") {
  Scene s;
  s.m.insert(ids({20, 21, 22}), {{0.9, 0.4, 1}, {1.1, 0.4, 1}, {1, 0.6, 1}});
  Polygon holed = s.second();
  holed.loops.push_back(ids({20, 21, 22}));
  s.m.insert_polygon(holed);
  s.update();
  s.m.insert_polygon({id(3), {ids({20, 21, 22})}});  // a lid on the hole
  CHECK(s.update().faces_removed.empty());
  s.m.remove_polygon(id(2));
  s.m.remove_polygon(id(3));
  Polygon whole = s.second();
  whole.points = ids({20, 21, 22});
  s.m.insert_polygon(whole);
  s.update();
  for (const std::int64_t p : {7, 8}) s.m.remove(id(p));
  s.update();
}

TEST_CASE("The same edge of the mesh may pass from one line to another on it") {
  Scene s;  // 1 and 10 are on both sides of 2
  s.m.insert(id(10), {1.25, 0.25, 0.5});
  s.m.insert_segment(id(1), id(1), id(2));
  s.update();
  s.m.remove_line(id(1));
  s.m.insert_segment(id(2), id(1), id(2));
  s.m.insert_segment(id(3), id(2), id(10));
  s.update();
  // Of the segment from 1 to 5 places are midpoints of those from 1 to 2, which goes.
  s.m.remove_line(id(2));
  s.m.remove_line(id(3));
  s.m.remove(id(2));
  s.m.insert_segment(id(4), id(1), id(5));
  s.update();
  s.m.remove_line(id(4));
  s.m.insert(id(2), {0.75, 0.25, 1});
  s.m.insert_polygon(s.first());
  s.update();
}

TEST_CASE("The first run reports all parts, and one without features none") {
  Scene s;
  CHECK(s.update().faces_added.empty());
  s.m.insert_polygon(s.first());
  const Change<3> change = s.update();
  CHECK(!change.faces_added.empty());
  Scene other;
  other.m.insert_polygon(other.first());
  CHECK(other.update().faces_added == change.faces_added);
}

// Many parts on a long edge and in a large polygon, and an edit beside a few.
TEST_CASE("What an update reports of a large polygon is what is near the edit") {
  Scene s;
  s.m.insert(ids({31, 32, 33, 34}),
             {{0.05, 0.05, 0.5}, {1.95, 0.05, 0.5}, {1.95, 1.95, 0.5}, {0.05, 1.95, 0.5}});
  s.m.insert_polygon({id(7), {ids({31, 32, 33, 34})}});
  mesher::SplitMix64 random(3);
  for (std::int64_t i = 100; i < 400; ++i) {
    const auto number = [&] { return 0.1 + 1.8 * static_cast<double>(random.below(1024)) / 1024; };
    s.m.insert(id(i), {number(), number(), 0.53125});
  }
  s.update();
  const std::size_t all = s.parts.faces.size();
  REQUIRE(all > 500);
  s.m.insert(id(1000), {1.0001, 1.0003, 0.52});
  const Change<3> change = s.update();
  CHECK(!change.faces_added.empty());
  CHECK(change.faces_added.size() < all / 8);
}

TEST_CASE("An update of a polygon whose parts find no memory leaves the parts that are known") {
  Scene s;
  s.m.insert_polygon(s.first());
  s.update();
  bool burnt = true;
  int failures = 0;
  for (std::uint64_t count = 1; burnt; count += 1 + count / 12) {
    CAPTURE(count);
    s.m.remove_polygon(id(1));
    s.m.insert_polygon(s.second());
    s.m.insert_segment(id(9), id(9), id(7));
    Change<3> change;
    if (!support::fails(count, burnt, [&] { change = s.m.update(); })) {
      s.parts.follow(change);
      if (burnt) {  // somebody could do without
        s.m.remove_line(id(9));
        s.m.remove_polygon(id(2));
        s.m.insert_polygon(s.first());
        s.update();
      }
      continue;
    }
    ++failures;
    s.m.check_invariants();
    REQUIRE(s.parts == parts_of(s.m.mesh()));
  }
  CHECK(failures > 50);
  CHECK(s.parts == parts_of(s.m.mesh()));
}
