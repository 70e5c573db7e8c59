// Families of complexes: what they are, and that their parts fit together.
#include "mesher/generate_plc.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "feature_scene.hpp"
#include "plc/validity.hpp"
#include "scratch_file.hpp"

namespace {

using mesher::FeatureId;
using mesher::generate_plc;
using mesher::Plc;
using mesher::PlcFamily;
using mesher::PlcKind;
using namespace mesher::detail;

struct SameNames : SpaceNames {
  FeatureId point(VertexHandle v) const override { return FeatureId{v}; }
  std::optional<FeatureId> segment(EdgeHandle) const override { return std::nullopt; }
  FeatureId polygon(PolygonHandle f) const override { return FeatureId{f}; }
};

// Puts all into a store; throws the first error.
void require_fits(const Plc& plc) {
  sac::PlainScope scope;
  support::FeatureScene<sac::PlainScope> scene(1, scope);
  FeatureStore& store = scene.features().store();
  std::map<FeatureId, VertexHandle> handles;
  for (const auto& v : plc.points) {
    const auto* added = scene.add_point(v.at);
    REQUIRE(added != nullptr);
    handles[v.id] = added->self;
  }
  for (const auto& s : plc.segments) scene.features().insert(handles.at(s.from), handles.at(s.to));
  for (const auto& [polygon, marker] : plc.facets) {
    PolygonParts parts;
    for (const auto& loop : polygon.loops) {
      auto& corners = parts.loops.emplace_back();
      for (const FeatureId id : loop) corners.push_back(handles.at(id));
    }
    for (const auto& [a, b] : polygon.edges) parts.edges.emplace_back(handles.at(a), handles.at(b));
    for (const FeatureId id : polygon.points) parts.points.push_back(handles.at(id));
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
    const Plc plc = generate_plc({kind, {}, 3});
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
    const Plc plc = generate_plc({kind});
    const std::string path = folder.path("a.poly");
    write_plc(plc, path);
    REQUIRE(mesher::read_plc(path).plc == plc);
  }
}
