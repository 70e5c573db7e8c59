// Polygons that cover what others do, or themselves.
#include <algorithm>
#include <catch2/catch.hpp>

#include "feature_ids.hpp"
#include "repaired_complex.hpp"

namespace {

using mesher::Graph;
using mesher::Point;
using mesher::Repaired;
using mesher::RepairKind;
using mesher::detail::PlcBuilder;
using support::area;
using support::id;
using support::ids;
using support::repaired;
using support::square;

}  // namespace

TEST_CASE("what polygons of one plane cover belongs to the first; the others are cut around it") {
  PlcBuilder b;
  b.polygon({square(1, 1, 0, 1)});
  b.polygon({square(0, 0, 0, 3)});
  b.polygon({square(2.5, -1, 0, 2)});
  Graph<3> plc = b.finish();
  const Repaired<3> r = repaired(plc);
  const auto& out = r.file.graph;
  REQUIRE(out.polygons.size() == 3);
  REQUIRE(out.polygons[1].loops.size() == 2);
  REQUIRE(area(out) == Approx(9 + 4 - 0.5));
  // The other way around the small one goes, and what is inside the large one stays declared.
  std::swap(plc.polygons[0].id, plc.polygons[1].id);
  const auto& other = repaired(plc).file.graph;
  REQUIRE(other.polygons.size() == 2);
  REQUIRE(area(other) == Approx(12.5));
  REQUIRE(other.polygons[0].edges.size() >= 4);
}

TEST_CASE("a polygon that is cut in two by another one goes on under a new id") {
  PlcBuilder b;
  b.polygon({square(1, -1, 0, 3)});
  b.polygon({{{0, 0, 0}, {6, 0, 0}, {6, 1, 0}, {0, 1, 0}}});
  const Repaired<3> r = repaired(b.finish());
  REQUIRE(r.file.graph.polygons.size() == 3);
  REQUIRE(area(r.file.graph) == Approx(9 + 3));
  REQUIRE(std::count_if(r.notes.begin(), r.notes.end(), [](const auto& note) {
            return note.kind == RepairKind::overlap && note.polygons == ids({2, 1});
          }) == 1);
}

TEST_CASE("loops that cross themselves, touch, go there and back, or lie outside are cut") {
  PlcBuilder bow;
  bow.polygon({{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}});
  const auto& tie = repaired(bow.finish()).file.graph;
  REQUIRE(tie.polygons.size() == 2);
  REQUIRE(tie.points.size() == 5);
  REQUIRE(area(tie) == Approx(2));

  PlcBuilder key;  // a keyhole: the border of a hole hangs on a bridge
  key.polygon({{{0, 0, 0},
                {4, 0, 0},
                {4, 4, 0},
                {0, 4, 0},
                {0, 0, 0},
                {1, 1, 0},
                {1, 2, 0},
                {2, 2, 0},
                {2, 1, 0},
                {1, 1, 0}}});
  const auto& keyhole = repaired(key.finish()).file.graph;
  REQUIRE(keyhole.polygons.size() == 1);
  REQUIRE(keyhole.polygons[0].loops.size() == 2);
  REQUIRE(area(keyhole) == Approx(15));

  PlcBuilder apart;
  apart.polygon({square(0, 0, 0), square(3, 0, 0)});
  REQUIRE(repaired(apart.finish()).file.graph.polygons.size() == 2);

  PlcBuilder twice;
  twice.polygon({square(0, 0, 0)});
  Graph<3> plc = twice.finish();
  plc.polygons.push_back(plc.polygons[0]);
  plc.polygons[1].id = id(8);
  std::reverse(plc.polygons[1].loops[0].begin(), plc.polygons[1].loops[0].end());
  plc.polygons.push_back({id(9), {ids({1, 2})}});
  REQUIRE(repaired(plc).file.graph.polygons.size() == 1);
}
