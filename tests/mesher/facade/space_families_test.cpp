// Families of complexes, and a file, through the facade: a first run, and a polygon that goes and
// comes again, leave the meshes of static runs.
#include <catch2/catch.hpp>
#include <fstream>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/graph_runs.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/read.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Graph;
using mesher::Mesh;
using mesher::Options;
using mesher::PlcKind;
using mesher::Point;
using mesher::PointId;

// A complex as static runs take it.
struct Input {
  std::vector<PointId> ids;
  std::vector<Point<3>> points;
  std::vector<mesher::Segment> segments;
  std::vector<mesher::Polygon> polygons;

  explicit Input(const Graph<3>& plc) {
    for (const auto& v : plc.points) {
      ids.push_back(v.id);
      points.push_back(v.at);
    }
    for (const auto& s : plc.segments) segments.push_back({s.id, s.from, s.to});
    for (const auto& f : plc.polygons) polygons.push_back(f);
  }
  [[nodiscard]] Mesh<3> mesh(const Options<3>& options) const {
    return mesh_statically(points, segments, polygons, options, ids);
  }
};

void require_followed(const Graph<3>& plc) {
  Input input(plc);
  const Options<3> options{.domain = mesher::snapped_domain<3>(input.points)};
  BoxMesher<3> m(options);
  m.insert(input.ids, input.points);
  for (const auto& s : input.segments) m.insert_segment(s.id, s.from, s.to);
  for (const auto& f : input.polygons) m.insert_polygon(f);
  m.update();
  const Mesh<3> first = m.mesh();
  REQUIRE(first == input.mesh(options));

  const mesher::Polygon last = input.polygons.back();
  input.polygons.pop_back();
  m.remove_polygon(last.id);
  m.update();
  REQUIRE(m.mesh() == input.mesh(options));
  m.insert_polygon(last);
  m.update();
  REQUIRE(m.mesh() == first);
  m.check_invariants();
}

}  // namespace

TEST_CASE("Families of complexes are followed as a polygon goes and comes again") {
  for (const PlcKind kind :
       {PlcKind::cube_square, PlcKind::skew, PlcKind::dumbbell, PlcKind::nested, PlcKind::l_hole,
        PlcKind::wedge, PlcKind::pages, PlcKind::spike, PlcKind::leaning, PlcKind::tetrahedron,
        PlcKind::pump, PlcKind::faults, PlcKind::tee, PlcKind::island}) {
    CAPTURE(mesher::plc_kind_names()[static_cast<std::size_t>(kind)]);
    require_followed(mesher::generate_plc({kind}));
  }
}

TEST_CASE("TetGen's example is followed as a polygon goes and comes again") {
  const char* path = "/usr/share/doc/tetgen/examples/example.poly";
  if (std::ifstream(path)) require_followed(mesher::read<3>(path).graph);
}
