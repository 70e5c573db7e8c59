// Meshes of segments from scratch: what they must be, and how large they may be.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "pslg_judge.hpp"
#include "random_pslg.hpp"
#include "rules/mesh_box.hpp"

namespace {

using mesher::LineId;
using mesher::Point;
using mesher::PointId;
using support::Pslg;
using support::PslgEditor;
using support::PslgJudge;

// Edits that change only the graph.
struct Nobody {
  void insert(PointId, const Point<2>&) {}
  void remove(PointId) {}
  void insert_segment(LineId, PointId, PointId) {}
  void remove_segment(PointId, PointId) {}
};

Pslg random_pslg(PslgEditor::Family family, int edits, std::uint64_t seed) {
  const mesher::detail::MeshBox<2> box = mesher::detail::mesh_box(PslgEditor::options());
  PslgEditor editor(family, seed);
  Pslg pslg;
  Nobody nobody;
  for (int i = 0; i < edits; ++i) editor.edit(pslg, box, nobody);
  return pslg;
}

// A wedge of two segments, the second `ratio` times as long, turned so that nothing is level.
Pslg wedge(double degrees, double ratio) {
  const double turn = 0.3;
  const double angle = degrees * 3.14159265358979323846 / 180;
  const auto at = [&](double x, double y) {
    return Point<2>{std::cos(turn) * x - std::sin(turn) * y,
                    std::sin(turn) * x + std::cos(turn) * y};
  };
  Pslg pslg;
  pslg.points = {
      {1, at(0, 0)}, {2, at(1, 0)}, {3, at(ratio * std::cos(angle), ratio * std::sin(angle))}};
  pslg.segments = {{{1, 2}, 4}, {{1, 3}, 5}};
  return pslg;
}

}  // namespace

TEST_CASE("A mesh of random segments conforms, and keeps its bound off small angles") {
  for (const auto family : {PslgEditor::Family::uniform, PslgEditor::Family::lattice,
                            PslgEditor::Family::fan, PslgEditor::Family::wedge}) {
    for (std::uint64_t seed = 50; seed < 58; ++seed) {
      INFO("family " << static_cast<int>(family) << " seed " << seed);
      const Pslg pslg = random_pslg(family, 120, seed);
      const mesher::Options<2> options = PslgEditor::options();
      const mesher::Mesh<2> mesh = static_mesh(pslg, options);
      REQUIRE(PslgJudge(mesh, pslg).fault(options) == "");
    }
  }
}

TEST_CASE("The mesh does not depend on ids, on their order, nor on which end comes first") {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    INFO("seed " << seed);
    const Pslg pslg = random_pslg(PslgEditor::Family::fan, 100, seed);
    const mesher::Options<2> options = PslgEditor::options();
    const mesher::Mesh<2> expected = static_mesh(pslg, options);
    std::mt19937_64 random(seed);
    std::vector<std::pair<std::int64_t, Point<2>>> points(pslg.points.begin(), pslg.points.end());
    std::shuffle(points.begin(), points.end(), random);
    std::vector<Point<2>> places;
    std::vector<PointId> ids;
    for (const auto& [id, p] : points) {
      places.push_back(p);
      ids.push_back(PointId{-id});
    }
    std::vector<mesher::Segment> segments;
    for (const auto& [ends, id] : pslg.segments) {
      segments.push_back({LineId{id}, PointId{-ends.second}, PointId{-ends.first}});
    }
    std::shuffle(segments.begin(), segments.end(), random);
    CHECK(mesher::mesh_statically(places, segments, options, ids) == expected);
  }
}

// The counts of the model [rules A], without the vertices of the box.
TEST_CASE("Wedges need as many vertices as the model says") {
  struct Row {
    double degrees, ratio;
    int most;
  };
  for (const Row& row : {Row{1, 1, 51}, Row{1, 0.7, 75}, Row{0.01, 1, 87}, Row{0.01, 0.7, 109}}) {
    const Pslg pslg = wedge(row.degrees, row.ratio);
    std::vector<Point<2>> points;
    for (const auto& [id, p] : pslg.points) points.push_back(p);
    mesher::Options<2> options;
    options.domain = mesher::snapped_domain<2>(points);
    const mesher::Mesh<2> mesh = static_mesh(pslg, options);
    const auto boundary =
        std::count(mesh.kinds.begin(), mesh.kinds.end(), mesher::VertexKind::boundary);
    INFO(row.degrees << " degrees, legs 1 : " << row.ratio);
    CHECK(PslgJudge(mesh, pslg).fault(options) == "");
    CHECK(static_cast<double>(mesh.vertices.size()) - static_cast<double>(boundary) <=
          1.03 * row.most);
  }
}

TEST_CASE("Every small angle ends the refinement") {
  for (const double degrees : {60.0, 30.0, 20.0, 10.0, 5.0, 0.1, 0.001, 0.00003}) {
    for (const double ratio : {1.0, 0.7, 0.013}) {
      INFO(degrees << " degrees, legs 1 : " << ratio);
      const Pslg pslg = wedge(degrees, ratio);
      mesher::Options<2> options{.domain = {{-1, -1}, {1, 1}}, .max_vertices = 2000};
      CHECK(PslgJudge(static_mesh(pslg, options), pslg).fault(options) == "");
    }
  }
}

TEST_CASE("Segments ask for the rule radius_edge") {
  const Pslg pslg = wedge(30, 1);
  mesher::Options<2> options{.domain = {{-1, -1}, {1, 1}}, .rule = mesher::Rule::voronoi_aspect};
  try {
    (void)static_mesh(pslg, options);
    FAIL("not refused");
  } catch (const mesher::Error& error) {
    CHECK(error.code() == mesher::ErrorCode::bad_option);
  }
}
