// Families of complexes: what they are, and that their parts fit together.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "feature_scene.hpp"
#include "graph/plc_builder.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "scratch_file.hpp"
#include "space/validity.hpp"

namespace {

using mesher::generate_plc;
using mesher::Graph;
using mesher::LineId;
using mesher::PlcFamily;
using mesher::PlcKind;
using mesher::Point;
using mesher::PointId;
using mesher::PolygonId;
using namespace mesher::detail;

struct SameNames : SpaceNames {
  PointId point(VertexHandle v) const override { return PointId{v}; }
  std::optional<LineId> segment(EdgeHandle) const override { return std::nullopt; }
  PolygonId polygon(PolygonHandle f) const override { return PolygonId{f}; }
};

// Puts all into a store; throws the first error.
void require_fits(const Graph<3>& plc) {
  sac::PlainScope scope;
  support::FeatureScene<sac::PlainScope> scene(1, scope);
  FeatureStore& store = scene.features().store();
  std::map<PointId, VertexHandle> handles;
  for (const auto& v : plc.points) {
    const auto* added = scene.add_point(v.at);
    REQUIRE(added != nullptr);
    handles[v.id] = added->self;
  }
  for (const auto& s : plc.segments) scene.features().insert(handles.at(s.from), handles.at(s.to));
  for (const auto& polygon : plc.polygons) {
    PolygonParts parts;
    for (const auto& loop : polygon.loops) {
      auto& corners = parts.loops.emplace_back();
      for (const PointId id : loop) corners.push_back(handles.at(id));
    }
    for (const auto& [a, b] : polygon.edges) parts.edges.emplace_back(handles.at(a), handles.at(b));
    for (const PointId id : polygon.points) parts.points.push_back(handles.at(id));
    require_shape(store.record(parts), polygon.id, store);
    scene.features().insert(parts);
  }
  std::optional<SpaceConflict> first;
  for (const auto& [id, h] : handles) keep_first(first, conflict_of(scene.pool()[h], store));
  store.edges().for_each(
      [&](const Edge& e) { keep_first(first, conflict_of(e, store, scene.point_tree())); });
  store.polygons().for_each([&](const mesher::detail::Polygon& f) {
    keep_first(first, conflict_of(f, store, scene.point_tree()));
  });
  if (first) fail(*first, SameNames(), store);
}

}  // namespace

TEST_CASE("Of every family of complexes the parts fit together") {
  for (std::size_t i = 0; i < mesher::plc_kind_names().size(); ++i) {
    const auto kind = static_cast<PlcKind>(i);
    CAPTURE(mesher::plc_kind_names()[i]);
    REQUIRE(mesher::plc_kind(mesher::plc_kind_names()[i]) == kind);
    const Graph<3> plc = generate_plc({kind, {}, 3});
    REQUIRE(plc.points.size() >= 8);
    REQUIRE_NOTHROW(require_fits(plc));
    REQUIRE(plc == generate_plc({kind, {}, 3}));
  }
}

TEST_CASE("Families of complexes fit together at other sizes") {
  const PlcFamily all[] = {
      {PlcKind::cube_square, 0.9}, {PlcKind::skew, 1e-9},    {PlcKind::dumbbell, 0.01},
      {PlcKind::nested, 0.49},     {PlcKind::l_hole, 0.25},  {PlcKind::plates, 1e-9},
      {PlcKind::cloud, 100},       {PlcKind::wedge, 1e-3},   {PlcKind::wedge, 179},
      {PlcKind::pages, 0.01},      {PlcKind::pages, 59},     {PlcKind::spike, 0.1},
      {PlcKind::vee, 1e-3},        {PlcKind::leaning, 1e-3}, {PlcKind::tetrahedron, 1e-6},
      {PlcKind::pump, 4},          {PlcKind::pump, 99},      {PlcKind::faults, 200, 7},
      {PlcKind::bricks, 1e-6},     {PlcKind::tee, 0.01},     {PlcKind::shells, 30},
      {PlcKind::island, 0.39},
  };
  for (const PlcFamily& family : all) {
    CAPTURE(mesher::plc_kind_names()[static_cast<std::size_t>(family.kind)], *family.size);
    REQUIRE_NOTHROW(require_fits(generate_plc(family)));
  }
}

TEST_CASE("The least sizes of complexes are written and read back, and smaller ones are refused") {
  const support::ScratchFolder folder;
  for (const PlcKind kind :
       {PlcKind::cube_square, PlcKind::skew, PlcKind::dumbbell, PlcKind::nested, PlcKind::l_hole,
        PlcKind::plates, PlcKind::wedge, PlcKind::pages, PlcKind::spike, PlcKind::vee,
        PlcKind::leaning, PlcKind::tetrahedron, PlcKind::bricks, PlcKind::tee, PlcKind::island}) {
    CAPTURE(mesher::plc_kind_names()[static_cast<std::size_t>(kind)]);
    const Graph<3> plc = generate_plc({kind, 1e-12});
    for (const auto& polygon : plc.polygons) {
      for (auto loop : polygon.loops) {
        std::sort(loop.begin(), loop.end());
        REQUIRE(std::adjacent_find(loop.begin(), loop.end()) == loop.end());
      }
    }
    const std::string path = folder.path("a.poly");
    write_graph(plc, path);
    REQUIRE(mesher::read<3>(path).graph.points == plc.points);
    for (const double less : {1e-13, 1e-40}) {
      REQUIRE(support::error_of([&] {
                static_cast<void>(generate_plc({kind, less}));
              }).code() == mesher::ErrorCode::bad_option);
    }
  }
}

TEST_CASE("A size that a complex cannot have is refused") {
  for (const PlcFamily& family : {PlcFamily{PlcKind::nested, 0.5},
                                  {PlcKind::nested, -1.0},
                                  {PlcKind::pump, 3.5},
                                  {PlcKind::cloud, -1.0}}) {
    REQUIRE(support::error_of([&] { static_cast<void>(generate_plc(family)); }).code() ==
            mesher::ErrorCode::bad_option);
  }
}

TEST_CASE("A generated complex is written and read back equal") {
  const support::ScratchFolder folder;
  for (const PlcKind kind : {PlcKind::dumbbell, PlcKind::pump, PlcKind::tee, PlcKind::island}) {
    const Graph<3> plc = generate_plc({kind});
    const std::string path = folder.path("a.poly");
    write_graph(plc, path);
    REQUIRE(mesher::read<3>(path).graph == plc);
  }
}

namespace {

// The complex with every polygon of one loop, convex, cut into triangles from its first corner.
Graph<3> triangulated(const Graph<3>& plc) {
  Graph<3> out = plc;
  out.polygons.clear();
  for (const auto& polygon : plc.polygons) {
    const auto& loop = polygon.loops.at(0);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const auto id = static_cast<std::int64_t>(out.polygons.size()) + 1;
      out.polygons.push_back(
          {PolygonId{id}, {{loop[0], loop[i], loop[i + 1]}}, {}, {}, polygon.marker});
    }
  }
  return out;
}

}  // namespace

TEST_CASE("Triangles of one plane are merged to the polygons that they were cut from") {
  for (const PlcKind kind : {PlcKind::cube, PlcKind::nested, PlcKind::faults, PlcKind::bricks}) {
    CAPTURE(mesher::plc_kind_names()[static_cast<std::size_t>(kind)]);
    const Graph<3> plc = generate_plc({kind});
    const Graph<3> merged = with_merged_polygons(triangulated(plc));
    REQUIRE(merged.polygons.size() == plc.polygons.size());
    for (std::size_t i = 0; i < plc.polygons.size(); ++i) {
      auto expected = plc.polygons[i].loops.at(0), loop = merged.polygons[i].loops.at(0);
      std::sort(expected.begin(), expected.end());
      std::sort(loop.begin(), loop.end());
      REQUIRE(loop == expected);
      REQUIRE(merged.polygons[i].loops.size() == 1);
      REQUIRE(merged.polygons[i].edges.empty());
    }
    REQUIRE_NOTHROW(require_fits(merged));
  }
  const Graph<3> shells = generate_plc({PlcKind::shells});
  REQUIRE(with_merged_polygons(shells) == shells);
}

TEST_CASE("A merge keeps holes, markers, and what others need of an edge or a point") {
  PlcBuilder b;
  const auto square = [&](double x, double y) {
    b.polygon({{{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}}});
  };
  for (int i = 0; i < 9; ++i) {
    if (i != 4) square(i % 3, i / 3);
  }
  b.polygon({{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}}});  // stands on an edge that else would go
  Graph<3> plc = b.finish();
  const Graph<3> merged = with_merged_polygons(plc);
  REQUIRE(merged.polygons.size() == 2);
  const mesher::Polygon& ring = merged.polygons[0];
  REQUIRE(ring.loops.size() == 2);
  REQUIRE(ring.loops[0].size() == 12);
  REQUIRE(ring.loops[1].size() == 4);
  REQUIRE(ring.edges.size() == 1);
  REQUIRE(ring.points.empty());
  REQUIRE_NOTHROW(require_fits(merged));
  plc.polygons[3].marker = 1;  // the square on the left in the middle
  REQUIRE(with_merged_polygons(plc).polygons.size() == 3);
}

TEST_CASE("Points within merged triangles lie on the polygon") {
  PlcBuilder b;
  const Point<3> middle{0.5, 0.5, 0};
  const Point<3> corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (int i = 0; i < 4; ++i) b.polygon({{corners[i], corners[(i + 1) % 4], middle}});
  const Graph<3> merged = with_merged_polygons(b.plc());
  REQUIRE(merged.polygons.size() == 1);
  REQUIRE(merged.polygons[0].points == std::vector{PointId{3}});
  REQUIRE_NOTHROW(require_fits(merged));
}

TEST_CASE("Triangles that are nearly in one plane are not merged") {
  PlcBuilder b;
  const Point<3> up{1, 1, 1e-6};
  b.polygon({{{0, 0, 0}, {1, 0, 0}, up}});
  b.polygon({{{0, 0, 0}, {0, 1, 0}, up}});
  REQUIRE(with_merged_polygons(b.plc()) == b.plc());
}
